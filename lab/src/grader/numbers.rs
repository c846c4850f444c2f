//! Numbers that programs get wrong, such as damping: each is fitted so that our positions come as near to
//! theirs as possible, by Gauss-Newton iterations with one unknown.

use super::mistakes::Mistake;
use super::states::State;
use drape::cloth::Points;
use drape::error::{Kind, Result};
use drape::math::length;
use drape::scene::{Cloth, Scene};

/// The most iterations of a fit.
const ITERATIONS: usize = 6;

/// The relative change of the number by which its effect is measured.
const PROBE: f64 = 1e-4;

/// A fit ends when an iteration changes the number by less than this part.
const SETTLED: f64 = 1e-7;

/// A number of a scene.
pub(super) struct Number {
    name: &'static str,
    of: fn(&Scene, &Cloth) -> f64,
    set: Set,
}

/// What has a number.
enum Set {
    /// A scene.
    Scene(fn(&mut Scene, f64)),
    /// The bending springs: their part of `cloth.ks`.
    Bending,
}

/// The numbers that are fitted. Stiffness and density act only by their quotient, so one stands for both.
pub(super) const NUMBERS: [Number; 6] = [
    Number {
        name: "gravity",
        of: |scene, _| length(scene.sim.gravity),
        set: Set::Scene(|scene, value| scene.sim.gravity *= value / length(scene.sim.gravity)),
    },
    Number {
        name: "cloth.damping",
        of: |_, cloth| cloth.damping,
        set: Set::Scene(|scene, value| scene.cloth.iter_mut().for_each(|cloth| cloth.damping = value)),
    },
    Number {
        name: "cloth.ks (or density the other way round)",
        of: |_, cloth| cloth.ks,
        set: Set::Scene(|scene, value| scene.cloth.iter_mut().for_each(|cloth| cloth.ks = value)),
    },
    Number {
        name: "sim.fps",
        of: |scene, _| scene.sim.fps,
        set: Set::Scene(|scene, value| scene.sim.fps = value),
    },
    Number {
        name: "cloth.thickness",
        of: |_, cloth| cloth.thickness,
        set: Set::Scene(|scene, value| scene.cloth.iter_mut().for_each(|cloth| cloth.thickness = value)),
    },
    Number { name: "bending springs with a part of ks", of: |_, _| 0.2, set: Set::Bending },
];

/// The state that a number is fitted to, and the start of ours.
pub(super) struct Target<'a> {
    pub(super) scene: &'a Scene,
    pub(super) cloth: &'a Cloth,
    pub(super) start: Option<&'a Points>,
    pub(super) frame: u64,
    pub(super) state: &'a State,
}

impl Target<'_> {
    /// The most frames that a fit simulates.
    pub(super) fn most_frames(&self) -> u64 {
        2 * ITERATIONS as u64 * self.frame
    }
}

impl Number {
    /// The scene with the value at which ours comes nearest to theirs, as a mistake; `None` if the number has no
    /// effect, or no valid value comes nearer.
    ///
    /// # Errors
    /// Those of the simulation, and of `watch`, which is called after every frame.
    pub(super) fn fit(&self, target: &Target<'_>, watch: &dyn Fn() -> Result<()>) -> Result<Option<Mistake>> {
        let right = (self.of)(target.scene, target.cloth);
        let mut value = right;
        for _ in 0..ITERATIONS {
            let step = PROBE * value.abs().max(PROBE);
            let [here, beside] = [value, value + step].map(|value| self.residual(target, value, watch));
            let (Some(here), Some(beside)) = (here?, beside?) else { return Ok(None) };
            let slope = |i: usize| (beside[i] - here[i]) / step;
            let sum = |term: &dyn Fn(usize) -> f64| (0..here.len()).map(term).sum::<f64>();
            let change = -sum(&|i| slope(i) * here[i]) / sum(&|i| slope(i) * slope(i));
            value += change;
            if !(value.is_finite() && value >= 0.0) {
                return Ok(None);
            }
            if change.abs() <= SETTLED * value {
                break;
            }
        }
        let value = shortened(value, (value - right).abs());
        let name = format!("{} of {value} instead of {right}", self.name);
        Ok((value != right).then(|| self.mistake(name, target, value)))
    }

    /// The mistake of another value.
    fn mistake(&self, name: String, target: &Target<'_>, value: f64) -> Mistake {
        match self.set {
            Set::Scene(set) => {
                let mut scene = target.scene.clone();
                set(&mut scene, value);
                Mistake::of(name, scene)
            }
            Set::Bending => Mistake::of_bending(name, target.scene, value * target.cloth.ks),
        }
    }

    /// Ours minus theirs, all components, with the number at `value`; `None` if ours becomes unstable.
    fn residual(
        &self,
        target: &Target<'_>,
        value: f64,
        watch: &dyn Fn() -> Result<()>,
    ) -> Result<Option<Vec<f64>>> {
        let mut simulation = self.mistake(String::new(), target, value).simulation(target.start)?;
        while simulation.frame() < target.frame {
            watch()?;
            match simulation.advance_frame() {
                Err(error) if error.kind == Kind::Unstable => return Ok(None),
                ended => ended?,
            }
        }
        let ours = simulation.positions();
        let pairs = target.state.iter().enumerate();
        Ok(Some(pairs.flat_map(|(p, theirs)| [0, 1, 2].map(|c| ours.get(p)[c] - theirs[c])).collect()))
    }
}

/// `value` with the fewest digits that change it by at most a thousandth of `change`.
fn shortened(value: f64, change: f64) -> f64 {
    let rounded = |digits: usize| format!("{value:.digits$e}").parse().unwrap_or(value);
    (0..17).map(rounded).find(|short| (short - value).abs() <= 1e-3 * change).unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fitted_number_has_the_digits_that_are_known() {
        assert_eq!(shortened(0.400_000_3, 0.2), 0.4);
        assert_eq!(shortened(9.81, 0.01), 9.81);
        assert_eq!(shortened(9.999_999_9, 0.2), 10.0);
        assert_eq!(shortened(0.2, 0.0), 0.2);
    }
}
