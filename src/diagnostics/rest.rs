//! Whether a cloth has come to rest.
//!
//! A cloth in contact, or held by the stretch limit, may jitter within a frame although every frame
//! ends alike. So both measures are taken over frames: the mean velocity of a point in
//! a frame, and what changed it since the frame before, which is all that acts on the point:
//! forces, contacts and the stretch limit. The second tells rest from the turning point of a swing.

use crate::cloth::{Points, len};
use crate::error::Result;
use crate::scene::{Cloth, Sim};

/// Largest speed at rest, in sides of the cloth per second: 1 mm/s for a cloth of 1 m.
const SPEED: f64 = 1e-3;

/// Largest residual force on a point at rest, as a part of its weight.
const RESIDUAL: f64 = 0.01;

/// What a cloth still does at the end of a frame.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Motion {
    /// Largest mean speed of a point in the frame, in m/s.
    pub speed: f64,
    /// Largest residual acceleration of a point, in m/s².
    pub residual: f64,
}

/// Looks at a cloth frame by frame.
#[derive(Clone, Debug)]
pub struct RestWatch {
    fps: f64,
    /// The most at rest.
    limit: Motion,
    /// Positions at the last frame.
    x: Points,
    /// How the points moved in the last frame, if two were seen.
    moved: Points,
    frames: u64,
}

impl RestWatch {
    /// A watch over `cloth` moved as `sim` says, that is at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub fn new(cloth: &Cloth, sim: &Sim, x: &Points) -> Result<Self> {
        let (side, g) = (cloth.width.max(cloth.height), len(sim.gravity));
        // Without weight the unit is a side of the cloth per second, squared.
        let acceleration = if g > 0.0 { g } else { side };
        let limit = Motion { speed: SPEED * side, residual: RESIDUAL * acceleration };
        Ok(Self { fps: sim.fps, limit, x: x.clone(), moved: Points::zeros(x.len())?, frames: 0 })
    }

    /// A watch over a cloth that is in motion: at `x`, from `before` at the start of the frame.
    ///
    /// # Errors
    /// As [`RestWatch::new`].
    pub fn in_motion(cloth: &Cloth, sim: &Sim, before: &Points, x: &Points) -> Result<Self> {
        let mut watch = Self::new(cloth, sim, before)?;
        watch.look(x);
        Ok(watch)
    }

    /// The most that a cloth at rest does.
    pub fn limit(&self) -> Motion {
        self.limit
    }

    /// What the points, now at `x`, did in the frame that ended.
    pub fn look(&mut self, x: &Points) -> Motion {
        let (mut farthest, mut change) = (0.0_f64, 0.0_f64);
        for p in 0..x.len() {
            let moved = x.get(p) - self.x.get(p);
            farthest = farthest.max(len(moved));
            change = change.max(len(moved - self.moved.get(p)));
            self.moved.set(p, moved);
        }
        self.x.copy_from(x);
        self.frames += 1;
        Motion { speed: farthest * self.fps, residual: change * self.fps * self.fps }
    }

    /// Whether a cloth that does `motion` is at rest. After one frame nobody knows.
    pub fn is_rest(&self, motion: Motion) -> bool {
        self.frames > 1 && motion.speed <= self.limit.speed && motion.residual <= self.limit.residual
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, load_text};

    fn scene() -> Scene {
        let text = r#"{"cloth": {"width": 2, "height": 1, "num_width_points": 2, "num_height_points": 2,
            "thickness": 0, "orientation": 0, "damping": 0, "density": 1, "ks": 1,
            "enable_structural": true, "enable_shearing": true, "enable_bending": true}}"#;
        load_text("a.json", text, &Default::default()).unwrap().scene
    }

    /// The motion in the last of three frames in which one point goes by `steps` metres each.
    fn last_motion(steps: [f64; 3]) -> (Motion, bool) {
        let scene = scene();
        let mut x = Points::zeros(4).unwrap();
        let mut watch = RestWatch::new(scene.cloth.as_ref().unwrap(), &scene.sim, &x).unwrap();
        let mut motion = Motion { speed: 0.0, residual: 0.0 };
        for step in steps {
            x.z[2] += step;
            motion = watch.look(&x);
        }
        (motion, watch.is_rest(motion))
    }

    #[test]
    fn rest_is_slow_and_without_force() {
        let slow = 2e-3 / 90.0;
        let (motion, rest) = last_motion([0.9 * slow; 3]);
        assert!(rest && (motion.speed - 1.8e-3).abs() < 1e-12 && motion.residual < 1e-9, "{motion:?}");
        assert!(!last_motion([1.1 * slow; 3]).1, "too fast for a cloth of 2 m");
        let (motion, rest) = last_motion([0.9 * slow, 0.9 * slow, -0.9 * slow]);
        assert!(
            !rest && (motion.residual - 2.0 * 1.8e-3 * 90.0).abs() < 1e-9,
            "the turn of a swing: {motion:?}"
        );
        assert!(last_motion([1.0, 0.0, 0.0]).1, "all that was before does not matter");
    }

    #[test]
    fn one_frame_tells_nothing() {
        let scene = scene();
        let x = Points::zeros(4).unwrap();
        let mut watch = RestWatch::new(scene.cloth.as_ref().unwrap(), &scene.sim, &x).unwrap();
        let motion = watch.look(&x);
        assert!(!watch.is_rest(motion));
        let motion = watch.look(&x);
        assert!(watch.is_rest(motion));
    }
}
