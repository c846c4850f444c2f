//! Why no settings are within what was asked.

use super::answer::Answer;
use super::candidates;
use super::goal::Tolerance;
use super::ladder::Ladder;
use super::level::Runner;
use drape::error::Result;
use drape::scene::Scene;

/// The part of the tolerance that copies may have parted by where positions can be told.
const HORIZON: f64 = 0.5;

/// The answer where the ladder found no limit, or one that rounding decides: whether copies that differ by rounding have parted, or which settings
/// of the scene have no limit, and what can be promised nevertheless.
pub(super) fn none(
    runner: &Runner<'_>,
    scene: &Scene,
    ladder: &Ladder,
    tolerance: Tolerance,
) -> Result<Answer> {
    let last = &ladder.levels[ladder.levels.len() - 1];
    let horizon = runner.horizon(&ladder.settings(last.steps))?;
    let parted = horizon.partings.last().map_or(0.0, |parting| parting.largest(tolerance.measure));
    let moved_apart = horizon.partings.last().map_or(0.0, |parting| parting.max);
    let unit = tolerance.measure.unit();
    let asked = tolerance.value;
    let floor = match ladder.levels.as_slice() {
        [.., a, b] => tolerance.measure.distance(&a.shape, &b.shape),
        _ => f64::NAN,
    };
    let agreed =
        format!("the runs agree to {floor:.2e} {unit} ({}), but by chance", tolerance.measure.words());
    let moved = format!(
        "halving the step still moves the points by {floor:.2e} {unit} ({}) and that does not shrink, so the limit is not \
         known to the {asked:e} {unit} that were asked for",
        tolerance.measure.words()
    );
    let floor = if ladder.limit.is_some() { agreed } else { moved };
    let cause = if parted > HORIZON * asked && moved_apart > 1e6 * horizon.rounding {
        let growth = horizon
            .growth
            .map_or_else(String::new, |rate| format!(", growing by e every {:.3} s", 1.0 / rate));
        format!(
            "the motion is beyond its horizon: copies that differ by rounding, {:.1e} m, are {parted:.1e} {unit} apart{growth}",
            horizon.rounding
        )
    } else {
        let terms: Vec<&str> = without_limit(scene);
        if terms.is_empty() {
            "the rounding of the positions is reached".to_owned()
        } else {
            format!("what has no limit as the step shrinks: {}", terms.join(", "))
        }
    };
    let spread = |of: usize| {
        let values =
            ladder.levels[ladder.levels.len().saturating_sub(3)..].iter().map(|level| level.extent[of]);
        let (low, high) =
            (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
        format!("{low:.4} to {high:.4} m")
    };
    let promised = format!(
        "what runs agree on: lowest point {}, mean height {}, highest point {}",
        spread(0),
        spread(1),
        spread(2)
    );
    Ok(Answer {
        choice: None,
        candidates: candidates(ladder, None, &[]),
        springs_visited: runner.springs_visited(),
        horizon: horizon.reached(tolerance.measure, HORIZON * asked),
        model: Vec::new(),
        reason: Some(format!("{floor}\n{cause}\n{promised}")),
        measure: tolerance.measure,
    })
}

/// The settings of a scene that can have no limit as the step shrinks.
fn without_limit(scene: &Scene) -> Vec<&'static str> {
    let mut terms = Vec::new();
    if scene.needed_stretch_limit().is_some() {
        terms.push("the stretch limit, which moves springs once a step");
    }
    if scene.needed_self_collision() != drape::scene::SelfCollision::Off {
        terms.push("self-collision, which pushes points once a step");
    }
    terms
}
