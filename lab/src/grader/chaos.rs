//! What can no longer be told: after contact, rounding alone grows until it hides everything else.

use super::case::{Case, Ours, ROUNDING, largest};
use super::trials::WINDOW;
use super::watch::{Event, Run, Watch};
use drape::cloth::{Counters, Points};
use drape::error::{Kind, Result};
use drape::math::splitmix64;
use drape::scene::Integrator;
use drape::simulation::Simulation;

/// How much farther from ours another program may be than ours is from itself with other roundings: it rounds anew in
/// each operation of each step, and the copy once a frame.
const MARGIN: f64 = 1e5;

/// The largest factor by which a difference of rounding grows from one frame to the next where nothing hits hard.
const GROWTH: f64 = 1e4;

/// How rounding alone grows: distances of our own method from itself, where each point has another last bit at the start
/// and after each frame. They are as many as were asked for; infinite from where the copy is unstable.
pub(super) struct Twin {
    distances: Vec<f64>,
}

impl Twin {
    /// Runs the copy for the first `count` states.
    ///
    /// # Errors
    /// Those of the simulation, and of `watch`.
    pub(super) fn new(case: &Case<'_>, count: usize, watch: Watch<'_>) -> Result<Self> {
        let start = Simulation::starting_at(case.scene, case.start.as_ref())?.positions().clone();
        let mut twin = Simulation::starting_at(case.scene, Some(&nudged(&start, 0)))?;
        twin.allow_unstable();
        let last = case.frame(count.saturating_sub(1));
        watch(Event::Stage("running the method with other roundings, frames".into(), last))?;
        let run = Run::new(watch, last);
        let mut distances = Vec::new();
        'states: for (k, Ours { positions: ours, .. }) in case.ours.iter().enumerate().take(count) {
            while twin.frame() < case.frame(k) {
                run.frame()?;
                match twin.advance_frame() {
                    Err(error) if error.kind == Kind::Unstable => break 'states,
                    ended => ended?,
                }
                // Other integrators remember more than two positions, and would begin anew.
                if case.scene.sim.integrator == Integrator::Verlet {
                    let moved = nudged(twin.positions(), twin.frame());
                    twin.set_state(moved, twin.last_positions().clone())?;
                }
            }
            let positions = twin.positions();
            let theirs: Vec<[f64; 3]> = (0..positions.len()).map(|p| positions.get(p).into()).collect();
            distances.push(largest(ours, &theirs));
        }
        run.finish()?;
        distances.resize(count, f64::INFINITY);
        Ok(Self { distances })
    }

    /// Whether rounding makes `distances` as large as these from the first state on.
    pub(super) fn reaches(&self, distances: &[f64]) -> bool {
        let mut most = f64::EPSILON;
        distances.iter().zip(&self.distances).all(|(&theirs, &twin)| {
            most = twin.max(most);
            theirs <= ROUNDING || theirs <= MARGIN * most
        })
    }

    /// Whether every jump of `distances` from one state to the next is where the copy jumps too, as in a hard contact.
    pub(super) fn jumps_with(&self, distances: &[f64]) -> bool {
        let floor = |distance: f64| distance.max(f64::EPSILON);
        let jump = |pair: &[f64]| (floor(pair[1]) / floor(pair[0])).max(1.0);
        let pairs = distances.windows(2).zip(self.distances.windows(2));
        distances.first().is_none_or(|&first| first <= ROUNDING)
            && pairs.into_iter().all(|(theirs, twin)| jump(theirs) <= GROWTH * jump(twin))
    }
}

/// Whether distances grew from those of rounding over some frames, without a jump.
pub(super) fn grew(distances: &[f64]) -> bool {
    let seen: Vec<f64> = distances.iter().copied().skip_while(|&distance| distance == 0.0).collect();
    let starts_small = seen.first().is_some_and(|&first| first <= ROUNDING);
    let slowly = seen.as_slice().windows(2).all(|pair| pair[1] <= GROWTH * pair[0]);
    starts_small && slowly && seen.len() > 2
}

/// The points with the last bit of each coordinate up or down, another way for each frame.
fn nudged(start: &Points, frame: u64) -> Points {
    let nudge = |axis: u64, values: &[f64]| {
        let seed = splitmix64(frame);
        let up = |p: usize| splitmix64(seed ^ (3 * p as u64 + axis)) & 1 == 0;
        let factor = |p: usize| if up(p) { 1.0 + f64::EPSILON } else { 1.0 - f64::EPSILON };
        values.iter().enumerate().map(|(p, value)| value * factor(p)).collect()
    };
    Points { x: nudge(0, &start.x), y: nudge(1, &start.y), z: nudge(2, &start.z) }
}

/// How many points or springs a phase has moved.
type Moves = fn(&Counters) -> u64;

/// The verdict on a difference that `grew` out of rounding and is clear at state `k`: up to when the programs agree,
/// and what was not tested by then.
pub(super) fn words(case: &Case<'_>, k: usize, grew: &str) -> String {
    let frame = case.frame(k);
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
        "{grew}: up to then it is the same method with its operations in another order. From frame {frame} on nothing can be told: there rounding alone is larger than 1 µm, and a mistake that \
         first acts then looks the same{late}. To test it, compare a scene in which it acts sooner, or a smaller cloth"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_grows_and_mistakes_jump() {
        assert!(grew(&[0.0, 1e-16, 1e-14, 3e-13, 2e-10, 1e-7, 1e-5]));
        assert!(!grew(&[1e-16, 1e-14, 3e-13, 1e-5]), "a jump");
        assert!(!grew(&[0.0, 1e-16, 0.0, 1e-5]), "a jump from nothing");
        assert!(!grew(&[1e-9, 1e-8, 1e-7, 1e-5]), "too large at first");
        assert!(!grew(&[1e-12, 1e-5]), "too few");
    }

    #[test]
    fn a_jump_of_rounding_is_one_of_the_copy_too() {
        let twin = Twin { distances: vec![1e-16, 2e-16, 1e-8, 1e-7] };
        assert!(twin.jumps_with(&[0.0, 0.0, 1e-6]), "where the copy jumps");
        assert!(!twin.jumps_with(&[0.0, 1e-6, 1e-5]), "before it");
        assert!(!twin.jumps_with(&[0.0, 0.0, 1e-16, 1e-5]), "behind it");
        assert!(!twin.jumps_with(&[1e-9, 1e-8]), "from the start on");
    }
}
