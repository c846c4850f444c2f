//! The warning about a step that exceeds the stability bound of an explicit integrator in some deformation.

use super::warning::Warning;
use drape::diagnostics::stability::Stability;

/// The warning of a step that is stable at rest, but not in every deformation.
pub(super) fn may_deform(stability: &Stability, steps: u32) -> Warning {
    let Stability { dt, limit_worst, omega_rest, omega_safe, .. } = *stability;
    let undamped = if limit_worst < stability.limit { " without damping" } else { "" };
    let [rest, worst] = [dt * omega_rest, dt * omega_safe];
    let message = format!(
        "the cloth may become unstable in motion: dt·ω is {rest:.3} at rest and {worst:.3} at worst (any \
         deformation), and must be below {limit_worst:.3}{undamped}"
    );
    let steps_worst = stability.fewest_steps_worst();
    Warning { message, help: format!("raise steps_per_frame from {steps} to at least {steps_worst}") }
}
