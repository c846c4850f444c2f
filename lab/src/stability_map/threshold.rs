//! The fewest steps a second at which a cloth is stable, found by bisection.
//!
//! There are two such thresholds. *At rest*: the points of a cloth without gravity and contact are moved a
//! little out of its rest shape. The vibration either stays bounded or grows without limit, with a sharp
//! edge at `dt ω = limit`. *In motion*: the scene itself runs for the given time. The edge lies between
//! the bounds at rest and at worst, depending on how the cloth is deformed.

use super::outcome::run;
use drape::cloth::Points;
use drape::diagnostics::stability::Stability;
use drape::error::Result;
use drape::math::splitmix64;
use drape::scene::{Cloth, Scene, SelfCollision};
use drape::simulation::Simulation;

/// Steps after which a vibration at rest that grows has become large. At the least damping a step that is
/// 0.1 % too long multiplies it by e^50, at the most damping a step that is 1 % too long by e^40.
const STEPS: u32 = 2000;

/// The fewest steps of a run in motion: a step that is 1 % too long needs some hundred to show.
const SHORTEST: f64 = 600.0;

/// The factor on the bound at worst above which a step is stable despite rounding.
const ABOVE: f64 = 1.0 + 1e-12;

/// Steps between two measurements of the energy, each of which costs as much as a step.
const BLOCK: u32 = 20;

/// The growth of energy that no stable vibration reaches: 0.1 % below the limit the energy as measured here
/// varies by a factor of 500.
const GROWTH: f64 = 1e6;

/// The displacement out of the rest shape, as a fraction of the distance between neighbours.
const NUDGE: f64 = 1e-8;

/// The steps a second at which the cloth of `scene` at rest becomes stable, to 0.1 %; `None` for an
/// integrator that is stable at every step, or springs without stiffness.
///
/// # Errors
/// As [`Simulation::new`].
pub fn at_rest(scene: &Scene, cloth: &Cloth) -> Result<Option<f64>> {
    let Some(stability) = limited(cloth, scene)? else { return Ok(None) };
    let expected = stability.omega_rest / stability.limit;
    let mut rest = scene.clone();
    rest.colliders.clear();
    rest.sim.gravity.fill(0.0);
    rest.sim.self_collision = SelfCollision::Off;
    rest.sim.stretch_limit = None;
    rest.sim.steps_per_frame = 1;
    bisect([0.5 * expected, 2.0 * expected], 0.001, |steps_per_second| {
        rest.sim.fps = steps_per_second;
        grows(&rest)
    })
}

/// The steps a second at which `scene` becomes stable over `time` seconds, to 1 %; at most the bound at worst
/// if it is stable there. `None` as for [`at_rest`], or if it is stable at half the bound at rest, or
/// unstable at twice the bound at worst.
///
/// # Errors
/// As [`Simulation::new`].
pub fn in_motion(scene: &Scene, cloth: &Cloth, time: f64) -> Result<Option<f64>> {
    let Some(stability) = limited(cloth, scene)? else { return Ok(None) };
    let mut scene = scene.clone();
    let steps_per_frame = f64::from(scene.sim.steps_per_frame);
    let rest = stability.omega_rest / stability.limit;
    let worst = stability.omega_safe / stability.limit_worst * ABOVE;
    let mut is_unstable = |steps_per_second: f64| {
        scene.sim.fps = steps_per_second / steps_per_frame;
        let shortest = frames(SHORTEST / steps_per_frame, 1.0);
        Ok(run(&scene, frames(time, scene.sim.fps).max(shortest))?.outcome.is_unstable())
    };
    // The edge is often the bound at worst itself, above which the ledger is not judged: an interval across
    // it would end above it.
    match bisect([0.5 * rest, worst], 0.01, &mut is_unstable)? {
        None => bisect([worst, 2.0 * worst], 0.01, is_unstable),
        found => Ok(found),
    }
}

/// The stability of a cloth with a longest stable step: under an integrator that has one, and with springs that
/// can vibrate.
fn limited(cloth: &Cloth, scene: &Scene) -> Result<Option<Stability>> {
    Ok(Stability::of_bounded(cloth, &scene.sim)?.filter(|stability| stability.omega_rest > 0.0))
}

/// The frames that `time` seconds take, at least one.
pub fn frames(time: f64, fps: f64) -> u64 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a float to int cast saturates"
    )]
    let frames = (time * fps).ceil().max(1.0) as u64;
    frames
}

/// Where `is_unstable` becomes false between two positive numbers, to the relative `tolerance`: the
/// upper end of the last interval. None if it does not change from true to false.
fn bisect(
    [mut low, mut high]: [f64; 2],
    tolerance: f64,
    mut is_unstable: impl FnMut(f64) -> Result<bool>,
) -> Result<Option<f64>> {
    if !is_unstable(low)? || is_unstable(high)? {
        return Ok(None);
    }
    while high > low * (1.0 + tolerance) {
        let middle = (low * high).sqrt();
        *if is_unstable(middle)? { &mut low } else { &mut high } = middle;
    }
    Ok(Some(high))
}

/// Whether a small vibration of the cloth of `scene` grows without limit.
fn grows(scene: &Scene) -> Result<bool> {
    let mut simulation = Simulation::new(scene)?;
    simulation.allow_unstable();
    let moved = nudged(simulation.positions(), scene);
    simulation.set_state(moved.clone(), moved)?;
    let start = simulation.energy().spring;
    for _ in 0..STEPS / BLOCK {
        (0..BLOCK).for_each(|_| simulation.step());
        let energy = simulation.energy();
        let growth = (energy.kinetic + energy.spring) / start;
        if growth > GROWTH || growth.is_nan() {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The points of the cloth of `scene`, each moved at random by up to [`NUDGE`] along each axis.
fn nudged(x: &Points, scene: &Scene) -> Points {
    let spacing = scene.cloth.as_ref().map_or(0.0, |c| c.width / (c.num_width_points.max(2) - 1) as f64);
    let mut moved = x.clone();
    for (axis, component) in [&mut moved.x, &mut moved.y, &mut moved.z].into_iter().enumerate() {
        for (p, value) in component.iter_mut().enumerate() {
            let noise = (splitmix64((3 * p + axis) as u64) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
            *value += NUDGE * spacing * noise;
        }
    }
    moved
}
