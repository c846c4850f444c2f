//! Whether a cloth has come to rest.
//!
//! A cloth in contact, or held by the stretch limit, may jitter within a frame although every frame
//! ends alike. So both measures are taken over frames: the mean velocity of a point in
//! a frame, and the acceleration by what acts on it but drag: what changed its velocity since the frame before, and
//! what damping took. At rest, forces, contact and the stretch limit balance each other, and drag has no part in
//! it: a cloth that falls at its terminal speed is held by drag alone, however slow it is. The second measure also
//! tells rest from the turning point of a swing.
//!
//! Two frames may be alike by chance, so a cloth is at rest when it was quiet for [`QUIET`] seconds.

use crate::cloth::{Params, Points, damping_rate};
use crate::error::Result;
use crate::math::length;
use crate::scene::{Cloth, Damping, Sim};

/// Largest speed at rest, in sides of the cloth per second: 1 mm/s for a cloth of 1 m.
const SPEED: f64 = 1e-3;

/// Largest residual force on a point at rest, as a part of its weight.
const RESIDUAL: f64 = 0.01;

/// For how long a cloth at rest was quiet, in seconds.
pub const QUIET: f64 = 0.5;

/// What a cloth still does at the end of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Motion {
    /// Largest mean speed of a point in the frame, in m/s.
    pub speed: f64,
    /// Largest acceleration of a point by all that acts on it but drag, in m/s².
    pub residual: f64,
}

impl Motion {
    /// The larger of both measures.
    fn most(self, other: Self) -> Self {
        Self { speed: self.speed.max(other.speed), residual: self.residual.max(other.residual) }
    }
}

/// For how long a cloth has been quiet.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Quiet {
    /// The last frames in which it was.
    frames: u64,
    /// The most that it did in them.
    most: Motion,
}

/// Looks at a cloth frame by frame.
#[derive(Clone, Debug)]
pub struct RestWatch {
    fps: f64,
    /// The rate at which damping slows a point down, per second.
    drag: f64,
    /// The most at rest.
    limit: Motion,
    /// Positions at the last frame.
    x: Points,
    /// How the points moved in the last frame, if two were seen.
    moved: Points,
    frames: u64,
    quiet: Quiet,
}

impl RestWatch {
    /// A watch over `cloth` moved as `sim` says, that is at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub fn new(cloth: &Cloth, sim: &Sim, x: &Points) -> Result<Self> {
        let (side, g) = (cloth.width.max(cloth.height), length(sim.gravity));
        // Without weight the unit is a side of the cloth per second, squared.
        let acceleration = if g > 0.0 { g } else { side };
        let drag = match sim.damping {
            Damping::PerStep => cloth.damping / 100.0 / Params::new(cloth, sim).dt,
            Damping::PerSecond => damping_rate(cloth.damping),
        };
        Ok(Self {
            fps: sim.fps,
            drag,
            limit: Motion { speed: SPEED * side, residual: RESIDUAL * acceleration },
            x: x.clone(),
            moved: Points::zeros(x.len())?,
            frames: 0,
            quiet: Quiet::default(),
        })
    }

    /// A watch over a cloth that is in motion: at `x`, from `before` at the start of the frame, and `quiet` for so long.
    ///
    /// # Errors
    /// As [`RestWatch::new`].
    pub fn in_motion(cloth: &Cloth, sim: &Sim, [before, x]: [&Points; 2], quiet: Quiet) -> Result<Self> {
        let mut watch = Self::new(cloth, sim, before)?;
        watch.look(x);
        watch.quiet = quiet;
        Ok(watch)
    }

    /// For how long the cloth has been quiet.
    pub fn quiet(&self) -> Quiet {
        self.quiet
    }

    /// The most that a cloth at rest does.
    pub fn limit(&self) -> Motion {
        self.limit
    }

    /// The most that the cloth did since it has been quiet.
    pub fn most(&self) -> Motion {
        self.quiet.most
    }

    /// What the points, now at `x`, did in the frame that ended.
    pub fn look(&mut self, x: &Points) -> Motion {
        let (mut farthest, mut change) = (0.0_f64, 0.0_f64);
        for p in 0..x.len() {
            let moved = x.get(p) - self.x.get(p);
            farthest = farthest.max(length(moved));
            change = change.max(length((moved - self.moved.get(p)) * self.fps + moved * self.drag));
            self.moved.set(p, moved);
        }
        self.x.copy_from(x);
        self.frames += 1;
        let motion = Motion { speed: farthest * self.fps, residual: change * self.fps };
        let limit = self.limit;
        // After one frame nobody knows the change.
        if self.frames > 1 && motion.speed <= limit.speed && motion.residual <= limit.residual {
            self.quiet.frames += 1;
            self.quiet.most = self.quiet.most.most(motion);
        } else {
            self.quiet = Quiet::default();
        }
        motion
    }

    /// Whether the cloth is at rest: it was quiet for [`QUIET`] seconds, and at least two frames.
    pub fn is_rest(&self) -> bool {
        self.quiet.frames as f64 >= (QUIET * self.fps).max(2.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, load_text};

    fn scene(damping: f64) -> Scene {
        let text = format!(
            r#"{{"cloth": {{"width": 2, "height": 1, "num_width_points": 2, "num_height_points": 2,
            "thickness": 0, "orientation": 0, "damping": {damping}, "density": 1, "ks": 1,
            "enable_structural": true, "enable_shearing": true, "enable_bending": true}}}}"#
        );
        load_text("a.json", &text, &Default::default()).unwrap().scene
    }

    /// The motion in the last of the frames in which one point goes by `steps` metres each.
    fn last_motion(damping: f64, steps: &[f64]) -> (Motion, bool) {
        let scene = scene(damping);
        let mut x = Points::zeros(4).unwrap();
        let mut watch = RestWatch::new(scene.cloth.as_ref().unwrap(), &scene.sim, &x).unwrap();
        let mut motion = Motion::default();
        for step in steps {
            x.z[2] += step;
            motion = watch.look(&x);
        }
        (motion, watch.is_rest())
    }

    #[test]
    fn rest_is_slow_and_without_force() {
        let slow = 2e-3 / 90.0;
        let (motion, rest) = last_motion(0.0, &[0.9 * slow; 60]);
        assert!(rest && (motion.speed - 1.8e-3).abs() < 1e-12 && motion.residual < 1e-9, "{motion:?}");
        assert!(!last_motion(0.0, &[1.1 * slow; 60]).1, "too fast for a cloth of 2 m");
        let (motion, rest) = last_motion(0.0, &[&[0.9 * slow; 60][..], &[-0.9 * slow]].concat());
        assert!(
            !rest && (motion.residual - 2.0 * 1.8e-3 * 90.0).abs() < 1e-9,
            "the turn of a swing: {motion:?}"
        );
    }

    #[test]
    fn what_drag_alone_holds_is_not_at_rest() {
        // A terminal speed of 1.8 mm/s at 20 % a step: 2700 steps a second lose 540 times the speed.
        let (motion, rest) = last_motion(20.0, &[1.8e-3 / 90.0; 60]);
        assert!(!rest && (motion.residual - 1.8e-3 * 540.0).abs() < 1e-9, "{motion:?}");
        assert!(last_motion(20.0, &[1e-7; 60]).1, "slower than drag shows");
    }

    #[test]
    fn half_a_second_of_quiet_is_rest() {
        assert!(!last_motion(0.0, &[0.0; 45]).1, "the first frame tells nothing");
        assert!(last_motion(0.0, &[0.0; 46]).1);
        assert!(
            !last_motion(0.0, &[&[0.0; 40][..], &[1.0], &[0.0; 45]].concat()).1,
            "frames alike by chance"
        );
        assert!(
            last_motion(0.0, &[&[1.0][..], &[0.0; 47]].concat()).1,
            "all that was before does not matter"
        );
    }
}
