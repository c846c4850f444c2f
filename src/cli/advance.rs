//! The simulation up to a frame, with progress and a way to stop it.

use std::time::{Duration, Instant};

use super::Session;
use super::progress::Progress;
use crate::cloth::stability::Stability;
use crate::error::{Error, Kind, Result};
use crate::scene::Scene;
use crate::simulation::Simulation;

/// The simulation of `scene` at its start. Where steps will follow, a cloth that is certain to
/// blow up is refused, unless that is allowed.
///
/// # Errors
/// [`Kind::Unstable`] for such a cloth; otherwise as [`Simulation::new`].
pub(super) fn start(
    scene: &Scene,
    frames: u64,
    allow_unstable: bool,
    session: &Session,
) -> Result<Simulation> {
    let mut simulation = Simulation::new(scene)?;
    if allow_unstable {
        simulation.allow_unstable();
    }
    if let Some(cloth) = scene.cloth.as_ref().filter(|_| frames > 0) {
        let stability = Stability::new(cloth, &scene.sim)?;
        if stability.is_unstable_at_rest() {
            let error = certain(&stability, cloth.ks, scene.sim.steps_per_frame);
            if !allow_unstable {
                return Err(error);
            }
            session.ui.note(&format!("warning: {error}"));
        } else if !stability.is_always_stable() {
            session.ui.note(&format!("warning: {}", possible(&stability, scene.sim.steps_per_frame)));
        }
    }
    Ok(simulation)
}

/// The error of a cloth that vibrates too fast even at rest.
fn certain(stability: &Stability, ks: f64, steps: u32) -> Error {
    let Stability { mass, dt, limit, omega_rest, .. } = *stability;
    let (found, limit_text) = apart(dt * omega_rest, limit);
    let message = format!(
        "unstable before the first step: dt·ω = {found} > {limit_text} (ks {ks} N/m, m {mass} kg, dt {dt:.4e} s)"
    );
    let fewest = stability.fewest_steps(omega_rest);
    let softer = rounded_down(ks * (limit / (dt * omega_rest)) * (limit / (dt * omega_rest)));
    let help = format!(
        "raise steps_per_frame from {steps} to at least {fewest}, or lower ks below {softer}; --allow-unstable runs on"
    );
    Error::new(Kind::Unstable, message).with_help(help)
}

/// The warning for a cloth that is stable at rest but perhaps not when it is deformed.
fn possible(stability: &Stability, steps: u32) -> String {
    let Stability { dt, limit, omega_rest, omega_safe, .. } = *stability;
    format!(
        "the cloth may become unstable when it is deformed: dt·ω is {:.3} at rest but up to {:.3}, and only below \
         {limit:.3} is stable; steps_per_frame {} instead of {steps} is stable in every configuration",
        dt * omega_rest,
        dt * omega_safe,
        stability.fewest_steps(omega_safe),
    )
}

/// Two numbers, the first not below the second, with two decimals or as many more as tell them
/// apart.
fn apart(a: f64, b: f64) -> (String, String) {
    let text = |decimals: usize| (format!("{a:.decimals$}"), format!("{b:.decimals$}"));
    (2..16).map(text).find(|(a, b)| a != b).unwrap_or_else(|| text(16))
}

/// `value` with four digits, not above it.
fn rounded_down(value: f64) -> f64 {
    // Half a unit of the last digit is at most 5e-4 of the number.
    format!("{:.3e}", value * (1.0 - 5e-4)).parse().unwrap_or(value)
}

/// Moves `simulation` on to frame `frames`; `each` sees the start and every frame. Returns the
/// wall time that took.
///
/// # Errors
/// Those of the simulation and of `each`, and [`crate::error::Kind::Signal`] between two frames.
pub(super) fn advance(
    simulation: &mut Simulation,
    frames: u64,
    session: &Session,
    mut each: impl FnMut(&Simulation) -> Result<()>,
) -> Result<Duration> {
    let started = Instant::now();
    let mut progress = Progress::new(&session.ui, "simulating", frames);
    each(simulation)?;
    while simulation.frame() < frames {
        session.signals.check()?;
        simulation.advance_frame()?;
        progress.set(simulation.frame());
        each(simulation)?;
    }
    drop(progress);
    session.signals.check()?;
    let elapsed = started.elapsed();
    session.ui.remark(&format!("simulated {frames} frames in {:.3} s", elapsed.as_secs_f64()));
    Ok(elapsed)
}
