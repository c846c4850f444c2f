//! What is said about a step that is too long for the springs, and which values it allows.

use super::stability::Stability;
use crate::error::{Error, Kind};

/// The error of a step that is too long for the springs even at rest.
pub fn unstable_at_rest(stability: &Stability, ks: f64, steps: u32) -> Error {
    let Stability { mass, dt, limit, omega_rest, .. } = *stability;
    let (found, limit_text) = apart(dt * omega_rest, limit);
    let message = format!(
        "unstable before the first step: dt·ω = {found} > {limit_text} (ks {ks} N/m, m {mass} kg, dt {dt:.4e} s)"
    );
    let [fewest, fewest_worst] = [stability.fewest_steps_rest(), stability.fewest_steps_worst()];
    let [softer, softer_worst] = largest_ks(stability, ks);
    let help = format!(
        "raise steps_per_frame from {steps} to at least {fewest} at rest, {fewest_worst} at worst (any deformation): \
         --set sim.steps_per_frame={fewest_worst}\n(with more steps, damping per step acts more often)\nor lower ks \
         to at most {softer} at rest, {softer_worst} at worst: --set cloth.ks={softer_worst}\nor simulate all the \
         same with --allow-unstable"
    );
    Error::new(Kind::Unstable, message).with_help(help)
}

/// Two numbers with two decimals, or with as many as it takes for them to differ.
fn apart(a: f64, b: f64) -> (String, String) {
    let text = |decimals: usize| (format!("{a:.decimals$}"), format!("{b:.decimals$}"));
    (2..16).map(text).find(|(a, b)| a != b).unwrap_or_else(|| text(16))
}

/// The largest ks of four digits, in N/m, for which the step is stable at rest and at worst; not finite if the
/// springs have no stiffness.
pub fn largest_ks(stability: &Stability, ks: f64) -> [f64; 2] {
    let Stability { dt, limit, limit_worst, omega_rest, omega_safe, .. } = *stability;
    [limit / (dt * omega_rest), limit_worst / (dt * omega_safe)].map(|part| {
        // The bound itself is not stable, and ω of another ks is rounded differently.
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
