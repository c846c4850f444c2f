//! What of a scene decides how the cloth moves, as keys with their values.

use serde_json::Value;

use super::json::key::Listed;
use super::{ColliderKind, PerKind, Scene};
use crate::math::StateHash;

impl Scene {
    /// Every key that decides how the cloth moves, with its value and defaults filled in: those of the cloth, of
    /// `sim` and of the objects, each as `sphere.0.radius`, but none that only pictures show.
    pub fn motion(&self) -> Vec<(String, Value)> {
        let mut list = Vec::new();
        self.cloth.iter().for_each(|cloth| cloth.list("cloth", &mut list));
        self.sim.list("sim", &mut list);
        let mut numbers = PerKind::<usize>::default();
        for collider in &self.colliders {
            let kind: ColliderKind = collider.kind();
            collider.list(&format!("{}.{}", kind.key(), numbers[kind]), &mut list);
            numbers[kind] += 1;
        }
        list.retain(|(path, _)| !path.ends_with(".resolution"));
        list
    }

    /// A hash of [`Scene::motion`]: scenes whose cloths move alike have the same.
    pub fn motion_hash(&self) -> u64 {
        let mut hash = StateHash::default();
        self.motion().iter().for_each(|(path, value)| hash.write(format!("{path}={value}\n").as_bytes()));
        hash.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Overrides, load_text};

    fn hash(text: &str, sets: &[&str]) -> u64 {
        let sets = sets.iter().map(ToString::to_string).collect();
        load_text("a.json", text, &Overrides { sets, ..Overrides::default() }).unwrap().scene.motion_hash()
    }

    #[test]
    fn what_moves_the_cloth_counts_and_what_is_only_seen_does_not() {
        let text = include_str!("../../scenes/sphere.json");
        let same = ["cloth.material.shader=bump", "sphere.resolution=[9,9]", "camera.polar=3", "sim.fps=90"];
        assert_eq!(hash(text, &[]), hash(text, &same));
        for other in [
            "cloth.ks=5001",
            "cloth.pinned=[[0,1]]",
            "sphere.friction=0.25",
            "sphere.origin.1=0.25",
            "sim.gravity.0=1",
            "sim.integrator=bdf2",
            "sim.stretch_limit=null",
            "plane={\"point\":[0,0,0],\"normal\":[0,1,0],\"friction\":0}",
        ] {
            assert_ne!(hash(text, &[]), hash(text, &[other]), "{other}");
        }
    }
}
