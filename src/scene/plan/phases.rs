//! The phases of a step that a scene needs, with the reasons.

use crate::scene::{Cloth, ColliderKind, Contact, Scene, SelfCollision};

/// Why something is needed, or why it is left out.
pub(super) type Decision = Result<String, String>;

impl Scene {
    /// How self-collision is found: off, too, where the scene does not need that phase.
    pub fn needed_self_collision(&self) -> SelfCollision {
        self_collision(self).map_or(SelfCollision::Off, |_| self.sim.self_collision)
    }

    /// The strain that the stretch limit leaves; none, too, where the scene does not need that phase.
    pub fn needed_stretch_limit(&self) -> Option<f64> {
        self.sim.stretch_limit.filter(|_| stretch_limit(self).is_ok())
    }
}

fn cloth(scene: &Scene) -> Result<&Cloth, String> {
    scene.cloth.as_ref().ok_or_else(|| "the scene has no cloth".into())
}

/// Springs of one kind, which `cloth.enable_KIND` turns on.
pub(super) fn springs(scene: &Scene, kind: &str, enabled: fn(&Cloth) -> bool) -> Decision {
    let enabled = enabled(cloth(scene)?);
    let reason = format!("cloth.enable_{kind} is {enabled}");
    if enabled { Ok(reason) } else { Err(reason) }
}

pub(super) fn self_collision(scene: &Scene) -> Decision {
    let cloth = cloth(scene)?;
    if scene.sim.self_collision == SelfCollision::Off {
        return Err("sim.self_collision is off".into());
    }
    if cloth.thickness == 0.0 {
        return Err("cloth.thickness is 0".into());
    }
    let whole = scene.sim.self_collision == SelfCollision::Neighbors;
    let seen = if whole { ", and sim.self_collision is neighbors: all pairs are seen" } else { "" };
    Ok(format!("cloth.thickness is {} m{seen}", cloth.thickness))
}

pub(super) fn collision(scene: &Scene, kind: ColliderKind) -> Decision {
    cloth(scene)?;
    match scene.collider_counts()[kind] {
        0 => Err(format!("the scene has no {}", kind.key())),
        count => {
            let name = if count == 1 { kind.key() } else { kind.plural() };
            let outside = scene.sim.contact == Contact::Outside;
            let kept = if outside { ", and sim.contact is outside: points are kept out" } else { "" };
            Ok(format!("the scene has {count} {name}{kept}"))
        }
    }
}

pub(super) fn stretch_limit(scene: &Scene) -> Decision {
    let cloth = cloth(scene)?;
    if !(cloth.enable_structural || cloth.enable_shearing || cloth.enable_bending) {
        return Err("there are no springs".into());
    }
    let limit = scene.sim.stretch_limit.ok_or("sim.stretch_limit is null")?;
    Ok(format!("sim.stretch_limit is {limit}"))
}
