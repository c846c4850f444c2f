//! The images that the shaders of a scene read.

use crate::scene::Needs;
use crate::scene::Scene;

/// The names of the images that a scene needs, each once, in the order in which the objects that are drawn
/// read them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Images {
    /// Textures and height maps.
    pub textures: Vec<String>,
    /// Cube maps.
    pub environments: Vec<String>,
}

impl Images {
    /// The images that `scene` needs.
    pub fn of(scene: &Scene) -> Self {
        let mut images = Self::default();
        for material in scene.materials() {
            let needs = Needs::of(material.shader);
            add(&mut images.textures, needs.texture, &material.texture);
            add(&mut images.textures, needs.height_map, &material.height_map);
            add(&mut images.environments, needs.environment, &material.environment);
        }
        images
    }

    /// Whether none is read.
    pub fn is_empty(&self) -> bool {
        self.textures.is_empty() && self.environments.is_empty()
    }
}

fn add(names: &mut Vec<String>, needed: bool, name: &str) {
    if needed && names.iter().all(|known| known != name) {
        names.push(name.into());
    }
}
