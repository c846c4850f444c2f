//! The step against the bound of its integrator, and where on each slider it reaches the bound.

use drape::diagnostics::advice::largest_ks;
use drape::diagnostics::stability::Stability;
use drape::error::Result;
use drape::integrator::step_bound;
use drape::scene::{Cloth, Scene, Sim};
use serde::Serialize;

/// `dt ω` of the fastest vibration against its bound, at rest and in the worst deformation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Gauge {
    /// `dt ω` at rest.
    rest: f64,
    /// The bound at rest.
    limit: f64,
    /// `dt ω` at worst.
    worst: f64,
    /// The bound in motion.
    limit_worst: f64,
    /// Where the step becomes unstable, at rest and at worst, on the slider of each key; absent where it never does.
    marks: Marks,
}

/// The values of keys at which the step becomes unstable, at rest and at worst.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Marks {
    /// Largest stiffness.
    ks: [Option<f64>; 2],
    /// Smallest density.
    density: [Option<f64>; 2],
    /// Fewest steps per frame.
    steps_per_frame: [Option<f64>; 2],
    /// Largest damping.
    damping: [Option<f64>; 2],
}

/// The gauge of `scene`; `None` without a cloth, without springs, or under an integrator that is stable at every step.
///
/// # Errors
/// As [`Stability::new`].
pub(crate) fn gauge(scene: &Scene) -> Result<Option<Gauge>> {
    let Some(cloth) = &scene.cloth else { return Ok(None) };
    let Some(stability) = Stability::of_bounded(cloth, &scene.sim)? else { return Ok(None) };
    if stability.omega_rest <= 0.0 {
        return Ok(None);
    }
    let Stability { dt, limit, limit_worst, omega_rest, omega_safe, .. } = stability;
    let [rest, worst] = [dt * omega_rest, dt * omega_safe];
    // ω² is proportional to the stiffness over the mass.
    let lightest = [rest / limit, worst / limit_worst].map(|part| Some(cloth.density * part * part));
    let marks = Marks {
        ks: largest_ks(&stability, cloth.ks).map(|ks| Some(ks).filter(|ks| ks.is_finite())),
        density: lightest,
        steps_per_frame: [stability.fewest_steps_rest(), stability.fewest_steps_worst()].map(Some),
        damping: most_damping(cloth, &scene.sim, [rest, worst]),
    };
    Ok(Some(Gauge { rest, limit, worst, limit_worst, marks }))
}

/// The damping in percent at which the bounds at rest and at worst fall to `dt_omega`, if they do.
fn most_damping(cloth: &Cloth, sim: &Sim, dt_omega: [f64; 2]) -> [Option<f64>; 2] {
    let dt = 1.0 / sim.fps / f64::from(sim.steps_per_frame);
    let bounds = |damping: f64| {
        let bound = step_bound(&Cloth { damping, ..cloth.clone() }, sim, dt);
        bound.map_or([f64::INFINITY; 2], |bound| [bound.at_rest, bound.in_motion])
    };
    [0, 1].map(|which| {
        let is_stable = |damping: f64| dt_omega[which] < bounds(damping)[which];
        if !is_stable(0.0) || is_stable(100.0) {
            return None;
        }
        let (mut stable, mut unstable) = (0.0, 100.0);
        for _ in 0..30 {
            let middle = 0.5 * (stable + unstable);
            *if is_stable(middle) { &mut stable } else { &mut unstable } = middle;
        }
        Some(stable)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape::scene::{Overrides, load_stock};
    use std::path::Path;

    fn scene(sets: &[String]) -> Scene {
        let overrides = Overrides { sets: sets.to_vec(), ..Overrides::default() };
        load_stock(Path::new("scenes/pinned2.json"), &overrides).unwrap().scene
    }

    fn is_unstable(path: &str, value: f64) -> bool {
        let gauge = gauge(&scene(&[format!("{path}={value}")])).unwrap().unwrap();
        gauge.rest >= gauge.limit
    }

    #[test]
    fn a_mark_stands_where_the_step_becomes_unstable() {
        let found = gauge(&scene(&[])).unwrap().unwrap();
        assert!(found.rest < found.limit);
        let ks = found.marks.ks[0].unwrap();
        assert!(!is_unstable("cloth.ks", ks) && is_unstable("cloth.ks", ks * 1.002), "{ks}");
        let density = found.marks.density[0].unwrap();
        assert!(
            !is_unstable("cloth.density", density * 1.001) && is_unstable("cloth.density", density * 0.999)
        );
        let steps = found.marks.steps_per_frame[0].unwrap();
        assert!(
            !is_unstable("sim.steps_per_frame", steps) && is_unstable("sim.steps_per_frame", steps - 1.0)
        );
    }

    #[test]
    fn more_damping_lowers_the_bound_until_its_mark() {
        let at = |damping: f64| {
            let sets = ["cloth.ks=150000".to_owned(), format!("cloth.damping={damping}")];
            gauge(&scene(&sets)).unwrap().unwrap()
        };
        let damping = at(0.2).marks.damping[0].unwrap();
        let is_unstable = |damping: f64| at(damping).rest >= at(damping).limit;
        assert!(!is_unstable(damping - 0.01) && is_unstable(damping + 0.01), "{damping}");
    }

    #[test]
    fn what_is_always_stable_has_no_gauge() {
        assert_eq!(gauge(&scene(&["sim.integrator=implicit_euler".to_owned()])).unwrap(), None);
        assert_eq!(gauge(&scene(&["cloth.ks=0".to_owned()])).unwrap(), None);
    }
}
