//! What can no longer be told: after contact, rounding alone grows until it hides everything else.

use super::case::{Case, Ours, ROUNDING, largest};
use super::trials::WINDOW;
use super::watch::{Event, Watch};
use drape::cloth::{Counters, Points};
use drape::error::{Kind, Result};
use drape::math::splitmix64;
use drape::simulation::Simulation;

/// How much farther from ours another program may be than ours is from itself with one rounding changed: it
/// rounds anew in every step.
const MARGIN: f64 = 1e5;

/// Whether rounding makes distances as large as these from the first state on: our own method, started from
/// points of which each has another last bit, is as far from itself, but for a margin.
///
/// # Errors
/// Those of the simulation, and of `watch`.
pub(super) fn reaches(case: &Case<'_>, distances: &[f64], watch: Watch<'_>) -> Result<bool> {
    let start = Simulation::starting_at(case.scene, case.start.as_ref())?.positions().clone();
    let mut twin = Simulation::starting_at(case.scene, Some(&nudged(&start)))?;
    twin.allow_unstable();
    let last = case.frame(distances.len().saturating_sub(1));
    watch(Event::Stage("running the method with another rounding, frames".into(), last))?;
    let mut most = f64::EPSILON;
    for (k, &distance) in distances.iter().enumerate() {
        while twin.frame() < case.frame(k) {
            watch(Event::Frames(1))?;
            match twin.advance_frame() {
                Err(error) if error.kind == Kind::Unstable => return Ok(true),
                ended => ended?,
            }
        }
        let positions = twin.positions();
        let theirs: Vec<[f64; 3]> = (0..positions.len()).map(|p| positions.get(p).into()).collect();
        most = largest(&case.ours[k].positions, &theirs).max(most);
        if distance > ROUNDING && distance > MARGIN * most {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The points with the last bit of each coordinate up or down.
fn nudged(start: &Points) -> Points {
    let nudge = |axis: u64, values: &[f64]| {
        let up = |p: usize| splitmix64(3 * p as u64 + axis) & 1 == 0;
        let factor = |p: usize| if up(p) { 1.0 + f64::EPSILON } else { 1.0 - f64::EPSILON };
        values.iter().enumerate().map(|(p, value)| value * factor(p)).collect()
    };
    Points { x: nudge(0, &start.x), y: nudge(1, &start.y), z: nudge(2, &start.z) }
}

/// How many points or springs a phase has moved.
type Moves = fn(&Counters) -> u64;

/// The verdict on a difference that grew out of rounding and is clear at state `k`: up to when the programs agree, and
/// what was not tested by then.
pub(super) fn words(case: &Case<'_>, k: usize) -> String {
    let frame = case.frame(k);
    let grew = "this grew out of rounding without a jump, as it does after contact: up to then it is the same method with \
                its operations in another order";
    let phases: [(&str, Moves); 3] = [
        ("self-collision", |counters| counters.self_collision_moves),
        ("collision with objects", |counters| counters.object_moves),
        ("the stretch limit", |counters| counters.springs_limited),
    ];
    let untested: Vec<String> = phases
        .iter()
        .filter_map(|(name, moves)| {
            let first = case.ours.iter().position(|Ours { counters, .. }| moves(counters) > 0)?;
            (first + WINDOW > k).then(|| format!("{name} (first in frame {})", case.frame(first)))
        })
        .collect();
    let late = match untested.as_slice() {
        [] => String::new(),
        names => format!(", which acted too late for that: {}", names.join(", ")),
    };
    format!(
        "{grew}. From frame {frame} on nothing can be told: there rounding alone is larger than 1 µm, and a mistake that \
         first acts then looks the same{late}. To test it, compare a scene in which it acts sooner, or a smaller cloth"
    )
}
