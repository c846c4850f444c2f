//! The simulation up to a frame, with progress and a way to stop it.

use std::time::{Duration, Instant};

use crate::session::Session;
use crate::session::progress::Progress;
use drape::cloth::{Counters, Points};
use drape::diagnostics::rest::{Motion, RestWatch};
use drape::diagnostics::stability::Stability;
use drape::error::{Error, Kind, Result};
use drape::scene::Scene;
use drape::simulation::{Simulation, Unresolved};

/// The simulation of `scene` at its start. Where steps will follow, a cloth that is certain to
/// blow up is refused, unless that is allowed, and one that may blow up behind the stretch limit is
/// watched by a ledger.
///
/// # Errors
/// [`Kind::Unstable`] for such a cloth; otherwise as [`Simulation::new`].
pub(crate) fn start(
    scene: &Scene,
    frames: u64,
    allow_unstable: bool,
    session: &Session,
) -> Result<Simulation> {
    begin(scene, frames, None, allow_unstable, session)
}

/// As [`start`], with the points at `x` if that is given.
///
/// # Errors
/// As [`start`] and [`Simulation::starting_at`].
pub(crate) fn begin(
    scene: &Scene,
    frames: u64,
    x: Option<&Points>,
    allow_unstable: bool,
    session: &Session,
) -> Result<Simulation> {
    let mut simulation = Simulation::starting_at(scene, x)?;
    if allow_unstable {
        simulation.allow_unstable();
    }
    if let Some(cloth) = scene.cloth.as_ref().filter(|_| frames > 0) {
        if let Some(error) = stuck(&simulation, frames as f64 / scene.sim.fps).filter(|_| !allow_unstable) {
            return Err(error);
        }
        let Some(stability) = Stability::of_bounded(cloth, &scene.sim)? else { return Ok(simulation) };
        if stability.is_unstable_at_rest() {
            let error = certain(&stability, cloth.ks, scene.sim.steps_per_frame);
            if !allow_unstable {
                return Err(error);
            }
            session.ui.note(&format!("warning: {error}"));
        } else if !stability.is_always_stable() {
            session.ui.note(&format!("warning: {}", possible(&stability, scene.sim.steps_per_frame)));
            if !allow_unstable && scene.sim.stretch_limit.is_some() {
                simulation.record_ledger()?;
            }
        }
    }
    Ok(simulation)
}

/// The error of a step that is too short for numbers to tell its two ends apart.
fn stuck(simulation: &Simulation, time: f64) -> Option<Error> {
    let Unresolved { point: (i, j), axis, fall, rounding } = simulation.unresolved(time)?;
    let axis = ["x", "y", "z"][axis];
    let message = format!(
        "stuck before the first step: gravity moves point ({i}, {j}) by {fall:.3e} m along {axis} in a step, \
         and its position is rounded to {rounding:.3e} m"
    );
    let help =
        "lower steps_per_frame or fps, or bring the cloth nearer to the origin; --allow-unstable runs on";
    Some(Error::new(Kind::Unstable, message).with_help(help))
}

/// The error of a cloth that vibrates too fast even at rest.
pub(crate) fn certain(stability: &Stability, ks: f64, steps: u32) -> Error {
    let Stability { mass, dt, limit, omega_rest, .. } = *stability;
    let (found, limit_text) = apart(dt * omega_rest, limit);
    let message = format!(
        "unstable before the first step: dt·ω = {found} > {limit_text} (ks {ks} N/m, m {mass} kg, dt {dt:.4e} s)"
    );
    let [fewest, fewest_worst] = [stability.fewest_steps_rest(), stability.fewest_steps_worst()];
    let [softer, softer_worst] = largest_ks(stability, ks);
    let help = format!(
        "raise steps_per_frame from {steps} to at least {fewest} at rest, {fewest_worst} at worst: --set \
         sim.steps_per_frame={fewest_worst} (damping per step acts that much more often); or lower ks to at most \
         {softer} at rest, {softer_worst} at worst; --allow-unstable runs on"
    );
    Error::new(Kind::Unstable, message).with_help(help)
}

/// The warning for a cloth that is stable at rest but perhaps not when it is deformed.
fn possible(stability: &Stability, steps: u32) -> String {
    let Stability { dt, limit_worst, omega_rest, omega_safe, .. } = *stability;
    let undamped = if limit_worst < stability.limit { " without damping" } else { "" };
    format!(
        "the cloth may become unstable in motion: dt·ω is {:.3} at rest but {:.3} at worst, and only below \
         {limit_worst:.3} is it stable{undamped}; steps_per_frame {} instead of {steps} is stable at worst",
        dt * omega_rest,
        dt * omega_safe,
        stability.fewest_steps_worst(),
    )
}

/// Two numbers, the first not below the second, with two decimals or as many more as tell them
/// apart.
fn apart(a: f64, b: f64) -> (String, String) {
    let text = |decimals: usize| (format!("{a:.decimals$}"), format!("{b:.decimals$}"));
    (2..16).map(text).find(|(a, b)| a != b).unwrap_or_else(|| text(16))
}

/// The largest ks of four digits, in N/m, at which a cloth of `ks` would be stable at rest and at worst;
/// not finite if the springs have no stiffness.
pub(crate) fn largest_ks(stability: &Stability, ks: f64) -> [f64; 2] {
    let Stability { dt, limit, limit_worst, omega_rest, omega_safe, .. } = *stability;
    [limit / (dt * omega_rest), limit_worst / (dt * omega_safe)].map(|part| {
        // At the bound itself the cloth is not stable; of another ks ω is rounded otherwise.
        rounded_down(ks * part * part * (1.0 - 1e-9))
    })
}

/// The largest number of four digits that is not above `value` (> 0).
fn rounded_down(value: f64) -> f64 {
    let text = format!("{value:.3e}");
    let near = text.parse().unwrap_or(value);
    match text.split_once('e').and_then(|(digits, exponent)| Some((digits.parse::<f64>().ok()?, exponent))) {
        Some((digits, exponent)) if near > value => {
            let unit = if digits == 1.0 { 1e-4 } else { 1e-3 };
            format!("{:.4}e{exponent}", digits - unit).parse().unwrap_or(value)
        }
        _ => near,
    }
}

/// Until when a cloth is moved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Until {
    /// The last frame.
    pub(crate) frames: u64,
    /// Whether the frame at which the cloth is at rest is the last one, and must come in time.
    pub(crate) rest: bool,
}

/// What came of moving a cloth.
pub(crate) struct Moved {
    /// The wall time that it took.
    pub(crate) elapsed: Duration,
    /// The error, of [`Kind::Difference`], of a cloth that should be at rest and is not: it was checked,
    /// though nothing failed, so it ends a command whose results are there.
    pub(crate) restless: Option<Error>,
}

impl Moved {
    /// The end of a command whose results are written.
    pub(crate) fn result(self) -> Result<()> {
        self.restless.map_or(Ok(()), Err)
    }
}

/// Moves the cloth of `scene` on to the last frame; `each` sees the start and every frame. A scene
/// without a cloth is always at rest.
///
/// # Errors
/// Those of the simulation and of `each`, and [`Kind::Signal`] between two frames.
pub(crate) fn advance_until(
    simulation: &mut Simulation,
    scene: &Scene,
    until: Until,
    session: &Session,
    mut each: impl FnMut(&Simulation) -> Result<()>,
) -> Result<Moved> {
    let Some(cloth) = scene.cloth.as_ref().filter(|_| until.rest) else {
        let last = if until.rest { 0 } else { until.frames };
        let elapsed = advance_while(simulation, last, session, |simulation| each(simulation).map(|()| true))?;
        return Ok(Moved { elapsed, restless: None });
    };
    let mut watch = RestWatch::new(cloth, &scene.sim, simulation.positions())?;
    let mut motion = None;
    let elapsed = advance_while(simulation, until.frames, session, |simulation| {
        each(simulation)?;
        if simulation.frame() > 0 {
            motion = Some(watch.look(simulation.positions()));
        }
        Ok(!motion.is_some_and(|motion| watch.is_rest(motion)))
    })?;
    let restless = match motion {
        Some(motion) if watch.is_rest(motion) => None,
        _ => Some(no_rest(simulation, motion, watch.limit())),
    };
    Ok(Moved { elapsed, restless })
}

/// Warns of steps that an implicit integrator did not solve.
pub(crate) fn warn_of_unsolved(simulation: &Simulation, session: &Session) {
    let Counters { steps, unsolved_steps, .. } = simulation.counters();
    if unsolved_steps > 0 {
        session.ui.note(&format!(
            "warning: {unsolved_steps} of {steps} steps left more than sim.tolerance of the forces unbalanced\n  \
             = help: raise steps_per_frame, or sim.tolerance if so much is good enough"
        ));
    }
}

/// The error of a cloth that still moves at the end.
fn no_rest(simulation: &Simulation, motion: Option<Motion>, limit: Motion) -> Error {
    let does = motion.map_or_else(String::new, |motion| {
        format!(
            ": a point moves at {:.3e} m/s (at rest at most {:.3e}), the residual force is {:.3e} m/s² of its \
             mass (at most {:.3e})",
            motion.speed, limit.speed, motion.residual, limit.residual,
        )
    });
    let message = format!("not at rest after {} frames, {} s{does}", simulation.frame(), simulation.time());
    Error::new(Kind::Difference, message).with_help(
        "the results are those of this frame; more time (--time) or damping may help, but not where the step is \
         too long, nothing damps, or self-collision works against the stretch limit: see docs/restless.md",
    )
}

/// Moves `simulation` on to frame `frames` while `each`, which sees the start and every frame, says
/// so. Returns the wall time that took.
fn advance_while(
    simulation: &mut Simulation,
    frames: u64,
    session: &Session,
    mut each: impl FnMut(&Simulation) -> Result<bool>,
) -> Result<Duration> {
    let started = Instant::now();
    let mut progress = Progress::new(&session.ui, "simulating", frames);
    let mut goes_on = each(simulation)?;
    while goes_on && simulation.frame() < frames {
        session.signals.check()?;
        simulation.advance_frame()?;
        progress.set(simulation.frame());
        goes_on = each(simulation)?;
    }
    drop(progress);
    session.signals.check()?;
    warn_of_unsolved(simulation, session);
    let elapsed = started.elapsed();
    session.ui.remark(&format!("simulated {} frames in {:.3} s", simulation.frame(), elapsed.as_secs_f64()));
    Ok(elapsed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_down_to_four_digits() {
        for (value, digits) in [
            (58012.3, 58010.0),
            (58019.9, 58010.0),
            (9.99999, 9.999),
            (99998.0, 99990.0),
            (0.12, 0.12),
            (1e5, 1e5),
        ] {
            assert_eq!(rounded_down(value), digits, "{value}");
        }
        assert!(rounded_down(f64::NAN).is_nan() && rounded_down(f64::INFINITY).is_infinite());
    }
}
