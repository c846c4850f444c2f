//! What decides how a simulated frame looks, as one number.

use drape::math::StateHash;
use drape::render::{Options, Renderer};
use drape::scene::Scene;

/// A hash of the scene with all defaults and changes, the drawing options, the textures and the version
/// of this program.
pub(crate) struct Fingerprint(u64);

impl Fingerprint {
    /// The fingerprint of the pictures of `scene`.
    pub(crate) fn new(scene: &Scene, renderer: &Renderer, options: &Options) -> Self {
        let mut scene = scene.clone();
        // The length of the animation does not change its pictures.
        scene.render.time = 0.0;
        let mut hash = StateHash::default();
        hash.write(format!("{} {scene:?} {options:?}", env!("CARGO_PKG_VERSION")).as_bytes());
        renderer.hash_textures(&mut hash);
        Self(hash.finish())
    }

    /// The text that the picture of `frame` carries.
    pub(crate) fn text(&self, frame: u64) -> String {
        format!("scene {:016x} frame {frame}", self.0)
    }
}
