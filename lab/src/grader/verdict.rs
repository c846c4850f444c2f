//! The cause of a difference, as far as it can be found.
//!
//! Another order of operations moves points by 1e-16 m at first, and contact multiplies that by a
//! thousand in a hundred frames; a mistake moves them by more at once. So the first state is examined
//! whose difference is too large for rounding.

use super::case::{Case, ROUNDING, largest_beyond};
use super::chaos::{self, Twin};
use super::mistakes::{self, Mistake};
use super::numbers::{NUMBERS, Target};
use super::precision::Precision;
use super::states::State;
use super::trials::{self, Tried, WINDOW};
use super::watch::{Event, Run, Watch};
use drape::cloth::Counters;
use drape::error::Result;
use drape::scene::{ColliderKind, Orientation};
use drape::simulation::Simulation;
use rayon::prelude::*;

/// The smallest difference that rounding cannot make before contact, in metres.
const CLEAR: f64 = 1e-6;

/// A mistake that leaves less than this part of the difference is similar to what the other program does.
const RESEMBLES: f64 = 0.3;

/// The cause of a difference.
pub(super) struct Verdict {
    /// In words.
    pub(super) words: String,
    /// The mistakes that were run, the best first.
    pub(super) mistakes: Vec<Tried>,
}

impl Verdict {
    /// A verdict for which no mistake was run.
    pub(super) fn only(words: impl Into<String>) -> Self {
        Self { words: words.into(), mistakes: Vec::new() }
    }

    /// The cause of the differences of `case` beyond `tolerance`, in metres. `watch` hears how far
    /// the search is.
    ///
    /// # Errors
    /// Those of the simulations and of `watch`.
    pub(super) fn of(case: &Case<'_>, tolerance: f64, watch: Watch<'_>) -> Result<Self> {
        let precision = &Precision::of(case.theirs);
        let distances = case.distances(0..case.theirs.len(), case.ours, precision);
        let Some(k) = distances.iter().position(|&distance| distance > CLEAR.max(tolerance)) else {
            return Ok(Self::only(rounding(&distances, precision)));
        };
        if let Some(words) = not_a_number(case, k).or_else(|| other_order(case, k, precision)) {
            return Ok(Self::only(words));
        }
        if let Some(words) = other_frame(case, k, precision, watch)? {
            return Ok(Self::only(words));
        }
        let seen = &distances[..=k];
        if chaos::grew(seen) && Twin::new(case, seen.len(), watch)?.reaches(seen) {
            let grew = "this grew out of rounding without a jump, as it does after contact";
            return Ok(Self::only(chaos::words(case, k, grew)));
        }
        Self::by_trials(case, seen, precision, watch)
    }

    /// The verdict on the last state of `seen`, the first that is clearly off, after running the mistakes.
    fn by_trials(case: &Case<'_>, seen: &[f64], precision: &Precision, watch: Watch<'_>) -> Result<Self> {
        let k = seen.len() - 1;
        let mut mistakes =
            trials::run("known mistakes", case, &mistakes::all(case.scene), k, precision, watch)?;
        if mistakes.first().is_none_or(|best| !best.explains()) {
            let numbers = wrong_numbers(case, k, watch)?;
            mistakes.extend(trials::run("wrong numbers", case, &numbers, k, precision, watch)?);
            mistakes.sort_by(|a, b| a.left.total_cmp(&b.left));
        }
        let words = match mistakes.first() {
            Some(best) if best.explains() => {
                let all = mistakes.iter().take_while(|tried| tried.explains());
                let names: Vec<&str> = all.map(|tried| tried.mistake.as_str()).collect();
                format!("this behaves like the mistake: {}", names.join("; or: "))
            }
            best => unexplained(case, seen, best, precision, watch)?,
        };
        Ok(Self { words, mistakes })
    }
}

/// The verdict on differences that are small enough for rounding.
fn rounding(distances: &[f64], precision: &Precision) -> String {
    if let Some(digits) = precision.words().filter(|_| distances.iter().all(|&distance| distance == 0.0)) {
        return format!(
            "every difference is rounding to the {digits} of the file: as far as they tell, the positions are those of \
             the method. What is smaller is not seen: write 17 digits (%.17g) to compare every bit"
        );
    }
    let rounding = "this looks like rounding: the same method with its operations in another order, or written with \
                    fewer than 17 digits";
    let grown = distances.last().is_some_and(|&last| last > ROUNDING) && distances.len() < WINDOW;
    let few =
        if grown { "; a mistake with little effect so far looks the same: compare more frames" } else { "" };
    format!("{rounding}{few}")
}

/// The verdict on a state `k` with a point that is not a number.
fn not_a_number(case: &Case<'_>, k: usize) -> Option<String> {
    let p = case.theirs[k].iter().position(|point| !point.iter().all(|value| value.is_finite()))?;
    let width = case.cloth.num_width_points;
    Some(format!(
        "the point of column {}, row {} is no number at frame {}: look for a division by 0, such as by the length of \
         a spring or the distance of two points at one place, or a step so long that positions grow without end",
        p % width,
        p / width,
        case.frame(k),
    ))
}

/// The verdict on a state `k` that is ours, written in another order.
fn other_order(case: &Case<'_>, k: usize, precision: &Precision) -> Option<String> {
    let (theirs, ours) = (&case.theirs[k], &case.ours[k].positions);
    let (width, height) = (case.cloth.num_width_points, case.cloth.num_height_points);
    let by_columns = |p: usize| theirs[(p % width) * height + p / width];
    let orders: [(&str, Vec<[f64; 3]>); 3] = [
        ("column by column, not row by row", (0..theirs.len()).map(by_columns).collect()),
        ("from the last row to the first", theirs.chunks(width).rev().flatten().copied().collect()),
        ("as x z y, not x y z", theirs.iter().map(|&[x, z, y]| [x, y, z]).collect()),
    ];
    let right = orders.iter().find(|(_, state)| largest_beyond(ours, state, precision) <= CLEAR)?;
    Some(format!("the positions are those of the method, but written {}", right.0))
}

/// The verdict on a state `k` that is ours of another frame.
fn other_frame(case: &Case<'_>, k: usize, precision: &Precision, watch: Watch<'_>) -> Result<Option<String>> {
    let mut simulation = Simulation::starting_at(case.scene, case.start.as_ref())?;
    simulation.allow_unstable();
    watch(Event::Stage("looking for the state among all frames".into(), case.last_frame + 1))?;
    let near = |simulation: &Simulation, state: &State| {
        largest_beyond(simulation.positions(), state, precision) <= CLEAR
    };
    while simulation.frame() <= case.last_frame {
        watch(Event::Frames(1))?;
        let (frame, here) = (simulation.frame(), near(&simulation, &case.theirs[k]));
        let ended = simulation.advance_frame().is_err();
        let next = case.theirs.get(k + 1).is_none_or(|next| near(&simulation, next));
        if here && next {
            return Ok(Some(moved_on(case, k, frame)));
        }
        if ended {
            break;
        }
    }
    Ok(None)
}

/// Says that state `k` is that of our frame `frame`.
fn moved_on(case: &Case<'_>, k: usize, frame: u64) -> String {
    let text = format!("state {k} of the file is that of frame {frame}, not {}", case.frame(k));
    match frame.checked_sub(k as u64) {
        Some(first) => {
            format!("{text}: compare with --frames {first}..{}", first + case.theirs.len() as u64)
        }
        None => text,
    }
}

/// The scene's numbers with the values that fit state `k` best, each as a mistake.
fn wrong_numbers(case: &Case<'_>, k: usize, watch: Watch<'_>) -> Result<Vec<Mistake>> {
    let Case { scene, cloth, .. } = *case;
    let target =
        Target { scene, cloth, start: case.start.as_ref(), frame: case.frame(k), state: &case.theirs[k] };
    let frames = target.most_frames();
    let stage = format!("fitting {} numbers of the scene, frames at most", NUMBERS.len());
    watch(Event::Stage(stage, frames * NUMBERS.len() as u64))?;
    let fitted = NUMBERS.par_iter().map(|number| {
        let run = Run::new(watch, frames);
        let fitted = number.fit(&target, &|| run.frame());
        run.finish().and(fitted)
    });
    Ok(fitted.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect())
}

/// The verdict on the last state of `seen` when no mistake explains it: rounding, where a hard contact makes it as large
/// at once, or else a mistake that is like the `best`, or another one.
fn unexplained(
    case: &Case<'_>,
    seen: &[f64],
    best: Option<&Tried>,
    precision: &Precision,
    watch: Watch<'_>,
) -> Result<String> {
    let k = seen.len() - 1;
    // What grew without a jump was held against the copy before.
    if !chaos::grew(seen) {
        let twin = Twin::new(case, seen.len(), watch)?;
        if twin.reaches(seen) && twin.jumps_with(seen) {
            let grew = "none of the known mistakes explains the difference, and rounding alone grows as fast in such \
                        a contact";
            return Ok(chaos::words(case, k, grew));
        }
    }
    Ok(match best {
        Some(best) if best.left <= RESEMBLES => format!("this is most like the mistake: {}", best.mistake),
        _ => suspects(case, case.ours[k].counters) + &hidden(case, k, precision),
    })
}

/// The verdict when no mistake explains the difference: what had acted on the cloth before it.
fn suspects(case: &Case<'_>, counters: Counters) -> String {
    let touched = counters.object_moves > 0;
    let counts = case.scene.collider_counts();
    let collided = ColliderKind::ALL.iter().filter(|&&kind| touched && counts[kind] > 0);
    let with_itself =
        (counters.self_collision_moves > 0).then_some("self-collision (order of points, of cells)");
    let with_objects = collided.map(|kind| match kind {
        ColliderKind::Plane => "collision with planes (its side, friction)",
        ColliderKind::Sphere => "collision with spheres (friction, the centre)",
        ColliderKind::Cuboid => "collision with boxes (friction, the nearest face)",
    });
    let limited = (counters.springs_limited > 0).then_some("the stretch limit (its order, pinned ends)");
    let names: Vec<&str> = with_itself.into_iter().chain(with_objects).chain(limited).collect();
    let always = "the start, the forces, the mass of a point, the step, damping";
    let acted = if names.is_empty() { String::new() } else { format!("; {}", names.join("; ")) };
    let single = if case.theirs.len() == 1 && !names.is_empty() {
        ". After contact rounding errors grow: compare an earlier frame, or a file with every frame"
    } else {
        ""
    };
    let depths = if case.cloth.orientation == Orientation::Vertical && case.first_frame > 0 {
        ". A vertical cloth starts at random depths: add frame 0 to the file, and ours starts from its depths"
    } else {
        ""
    };
    format!(
        "none of the known mistakes explains the difference; it may be another one, or two at once. It is in what had \
         acted by then: {always}{acted}{single}{depths}"
    )
}

/// What the digits of the file hide, if a difference may have grown behind them.
fn hidden(case: &Case<'_>, k: usize, precision: &Precision) -> String {
    let collided = case.ours[k].counters.object_moves + case.ours[k].counters.self_collision_moves > 0;
    let Some(digits) = precision.words().filter(|_| collided && k > 0) else { return String::new() };
    format!(
        ". The file has {digits}, behind which rounding may have grown since the first contact: write 17 digits \
         (%.17g) to tell it from a mistake"
    )
}
