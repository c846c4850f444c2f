//! What a difference comes from, as far as can be told.
//!
//! Another order of operations moves points by 1e-16 m at first, and contact makes that grow a
//! thousandfold in a hundred frames; a mistake moves them by more at once. So what is looked into is
//! the first state with a difference that rounding does not make.

use rayon::prelude::*;
use serde::Serialize;

use super::mistakes::{self, Mistake};
use super::numbers::{NUMBERS, Target};
use super::parting::{Ours, ROUNDING, largest};
use super::states::State;
use crate::args::scene::frame_at;
use crate::session::Session;
use crate::session::progress::Tally;
use drape::cloth::{Counters, Points};
use drape::error::{Kind, Result};
use drape::scene::{Cloth, ColliderKind, Orientation, Scene};
use drape::simulation::Simulation;

/// A difference that rounding does not make before contact, in metres.
const CLEAR: f64 = 1e-6;

/// By how much a difference that rounding made may grow from one frame to the next.
const GROWTH: f64 = 1e4;

/// How many states from the first clear difference a mistake is held against. Further on chaos hides it.
const WINDOW: usize = 10;

/// A mistake that leaves less than this part of the difference does what the other program does.
const EXPLAINS: f64 = 1e-3;

/// A mistake that leaves less than this part of the difference does about the same.
const RESEMBLES: f64 = 0.3;

/// Two programs' states of the same frames.
pub(crate) struct Case<'a> {
    pub(crate) scene: &'a Scene,
    /// That of the scene.
    pub(crate) cloth: &'a Cloth,
    /// The frame of the first states.
    pub(crate) first_frame: u64,
    /// Where the cloth starts, if not where the method lets it start.
    pub(crate) start: Option<Points>,
    pub(crate) ours: &'a [Ours],
    pub(crate) theirs: &'a [State],
}

/// What was found out.
pub(crate) struct Verdict {
    pub(crate) words: String,
    /// The mistakes that were run, the best first.
    pub(crate) mistakes: Vec<Tried>,
}

/// A mistake that was run.
#[derive(Serialize)]
pub(crate) struct Tried {
    mistake: String,
    /// 0: the mistake explains everything, 1: nothing; the largest number there is: it led nowhere.
    pub(crate) left: f64,
}

impl Verdict {
    /// A verdict for which no mistake was run.
    pub(crate) fn only(words: impl Into<String>) -> Self {
        Self { words: words.into(), mistakes: Vec::new() }
    }
}

impl Tried {
    /// The mistake as a line of the report.
    pub(crate) fn line(&self) -> String {
        let Self { mistake, left } = self;
        if *left <= EXPLAINS {
            return format!("tried       explains it all: {mistake}\n");
        }
        format!("tried       leaves {:.1} % of the difference: {mistake}\n", left * 100.0)
    }
}

impl Case<'_> {
    /// Finds out what a difference comes from.
    pub(crate) fn judge(&self, tolerance: f64, session: &Session) -> Result<Verdict> {
        let apart = self.apart(0..self.theirs.len(), self.ours);
        let Some(k) = apart.iter().position(|&distance| distance > CLEAR.max(tolerance)) else {
            return Ok(Verdict::only(self.too_near(&apart)));
        };
        if let Some(words) = self.no_number(k).or_else(|| self.misread(k)) {
            return Ok(Verdict::only(words));
        }
        if let Some(frame) = self.frame_like(k, session)? {
            return Ok(Verdict::only(self.moved_on(k, frame)));
        }
        if grew(&apart[..=k]) {
            return Ok(Verdict::only(
                "this grew out of rounding without a jump, as it does after contact: the same method with its \
                 operations in another order",
            ));
        }
        let mut mistakes = self.try_all(&mistakes::all(self.scene), k, session)?;
        if mistakes.first().is_none_or(|best| best.left > EXPLAINS) {
            mistakes.extend(self.try_all(&self.wrong_numbers(k, session)?, k, session)?);
            mistakes.sort_by(|a, b| a.left.total_cmp(&b.left));
        }
        let words = match mistakes.first() {
            Some(best) if best.left <= EXPLAINS => {
                let all = mistakes.iter().take_while(|tried| tried.left <= EXPLAINS);
                let names: Vec<&str> = all.map(|tried| tried.mistake.as_str()).collect();
                format!("this behaves like the mistake: {}", names.join("; or: "))
            }
            Some(best) if best.left <= RESEMBLES => {
                format!("this is most like the mistake: {}", best.mistake)
            }
            _ => self.suspects(self.ours[k].counters),
        };
        Ok(Verdict { words, mistakes })
    }

    /// What no clear difference means.
    fn too_near(&self, apart: &[f64]) -> String {
        let rounding = "this looks like rounding: the same method with its operations in another order, or written \
                        with fewer than 17 digits";
        let grown = apart.last().is_some_and(|&last| last > ROUNDING) && apart.len() < WINDOW;
        let few = if grown {
            "; a mistake that has hardly acted yet looks so too, and more frames would tell"
        } else {
            ""
        };
        format!("{rounding}{few}")
    }

    /// The largest distance of each of the states `window`, if ours are `ours`.
    fn apart(&self, window: std::ops::Range<usize>, ours: &[Ours]) -> Vec<f64> {
        let theirs = &self.theirs[window];
        ours.iter().zip(theirs).map(|(ours, theirs)| largest(&ours.positions, theirs)).collect()
    }

    /// Says which point of state `k` is no number.
    fn no_number(&self, k: usize) -> Option<String> {
        let p = self.theirs[k].iter().position(|point| !point.iter().all(|value| value.is_finite()))?;
        let (width, frame) = (self.cloth.num_width_points, self.first_frame + k as u64);
        Some(format!(
            "the point of column {}, row {} is no number at frame {frame}: look for a division by 0, such as by \
             the length of a spring or the distance of two points at one place, or a step so long that positions \
             grow without end",
            p % width,
            p / width
        ))
    }

    /// Says how state `k` was written, if it is ours in another order.
    fn misread(&self, k: usize) -> Option<String> {
        let (theirs, ours) = (&self.theirs[k], &self.ours[k].positions);
        let (width, height) = (self.cloth.num_width_points, self.cloth.num_height_points);
        let by_columns = |p: usize| theirs[(p % width) * height + p / width];
        let orders: [(&str, Vec<[f64; 3]>); 3] = [
            ("column by column, not row by row", (0..theirs.len()).map(by_columns).collect()),
            ("from the last row to the first", theirs.chunks(width).rev().flatten().copied().collect()),
            ("as x z y, not x y z", theirs.iter().map(|&[x, z, y]| [x, y, z]).collect()),
        ];
        let right = orders.iter().find(|(_, state)| largest(ours, state) <= CLEAR)?;
        Some(format!("the positions are those of the method, but written {}", right.0))
    }

    /// Another frame of ours that is state `k`.
    fn frame_like(&self, k: usize, session: &Session) -> Result<Option<u64>> {
        let end = frame_at(None, self.scene).max(self.first_frame + self.theirs.len() as u64);
        let mut simulation = Simulation::starting_at(self.scene, self.start.as_ref())?;
        simulation.allow_unstable();
        let near = |simulation: &Simulation, state: &State| largest(simulation.positions(), state) <= CLEAR;
        while simulation.frame() <= end {
            session.signals.check()?;
            let (frame, here) = (simulation.frame(), near(&simulation, &self.theirs[k]));
            let ended = simulation.advance_frame().is_err();
            let next = self.theirs.get(k + 1).is_none_or(|next| near(&simulation, next));
            if here && next {
                return Ok(Some(frame));
            }
            if ended {
                break;
            }
        }
        Ok(None)
    }

    /// Says that state `k` is that of another frame of ours.
    fn moved_on(&self, k: usize, frame: u64) -> String {
        let given = self.first_frame + k as u64;
        let text = format!("state {k} of the file is that of frame {frame}, not {given}");
        match frame.checked_sub(k as u64) {
            Some(first) => {
                format!("{text}: compare with --frames {first}..{}", first + self.theirs.len() as u64)
            }
            None => text,
        }
    }

    /// Runs every mistake over some states from `k` on; the one that comes nearest to theirs first.
    fn try_all(&self, mistakes: &[Mistake], k: usize, session: &Session) -> Result<Vec<Tried>> {
        let ahead = self.theirs[k..].iter().take(WINDOW);
        let window =
            k..k + ahead.take_while(|state| state.as_flattened().iter().all(|x| x.is_finite())).count();
        let error = |ours: &[Ours]| self.apart(window.clone(), ours).iter().sum::<f64>();
        let without = error(&self.ours[window.clone()]);
        let progress = Tally::new(&session.ui, "trying mistakes", mistakes.len() as u64);
        let first = self.first_frame + k as u64;
        let tried = mistakes.par_iter().map(|mistake| {
            let states = mistake.simulation(self.start.as_ref()).and_then(|simulation| {
                Ours::simulate(simulation, first, window.len(), |_| session.signals.check())
            });
            progress.add(1);
            match states {
                // A mistake that leads nowhere is not the one that was made.
                Err(error) if error.kind == Kind::Unstable => Ok(f64::MAX),
                Err(error) => Err(error),
                Ok(states) => Ok(error(&states) / without),
            }
        });
        let left = tried.collect::<Result<Vec<f64>>>()?;
        let tried = mistakes.iter().zip(left);
        let mut tried: Vec<Tried> = tried
            .map(|(mistake, left)| Tried {
                mistake: mistake.name.clone(),
                left: if left.is_finite() { left } else { f64::MAX },
            })
            .collect();
        tried.sort_by(|a, b| a.left.total_cmp(&b.left));
        Ok(tried)
    }

    /// The scene's numbers with the values that fit state `k` best, each as a mistake.
    fn wrong_numbers(&self, k: usize, session: &Session) -> Result<Vec<Mistake>> {
        let (state, frame) = (&self.theirs[k], self.first_frame + k as u64);
        let target =
            Target { scene: self.scene, cloth: self.cloth, start: self.start.as_ref(), frame, state };
        let watch = || session.signals.check();
        let fitted = NUMBERS.par_iter().map(|number| number.fit(&target, &watch));
        Ok(fitted.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect())
    }

    /// What no run can tell apart, but acted before the positions parted.
    fn suspects(&self, counters: Counters) -> String {
        let touched = counters.object_moves > 0;
        let counts = self.scene.collider_counts();
        let collided = ColliderKind::ALL.iter().filter(|&&kind| touched && counts[kind] > 0);
        let with_itself =
            (counters.self_collision_moves > 0).then_some("self-collision (order of points, of cells)");
        let with_objects = collided.map(|kind| match kind {
            ColliderKind::Plane => "collision with planes (its side, friction)",
            ColliderKind::Sphere => "collision with spheres (friction, the centre)",
        });
        let limited = (counters.springs_limited > 0).then_some("the stretch limit (its order, pinned ends)");
        let names: Vec<&str> = with_itself.into_iter().chain(with_objects).chain(limited).collect();
        let always = "the start, the forces, the mass of a point, the step, damping";
        let acted = if names.is_empty() { String::new() } else { format!("; {}", names.join("; ")) };
        let single = if self.theirs.len() == 1 && !names.is_empty() {
            ". After contact rounding grows: an earlier frame, or every frame in one file, tells more"
        } else {
            ""
        };
        let depths = if self.cloth.orientation == Orientation::Vertical && self.first_frame > 0 {
            ". The depths at which a vertical cloth starts are random: with frame 0 in the file ours would start from them"
        } else {
            ""
        };
        format!(
            "none of the mistakes that can be run, or two at once. What had acted by then, so where to look: \
             {always}{acted}{single}{depths}"
        )
    }
}

/// Whether distances grew from those of rounding over some frames, without a jump.
fn grew(apart: &[f64]) -> bool {
    let seen: Vec<f64> = apart.iter().copied().skip_while(|&distance| distance == 0.0).collect();
    let starts_small = seen.first().is_some_and(|&first| first <= ROUNDING);
    let slowly = seen.as_slice().windows(2).all(|pair| pair[1] <= GROWTH * pair[0]);
    starts_small && slowly && seen.len() > 2
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
}
