//! The progress of long work: a bar on a terminal, otherwise at most a line every five seconds.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::session::leftovers::locked;
use crate::session::ui::{self, Ui};

/// Shortest time between two lines where there is no terminal.
const PAUSE: Duration = Duration::from_secs(5);

/// How far the command has come, for the message of one that ends before its time.
static REACHED: Mutex<Option<Reached>> = Mutex::new(None);

struct Reached {
    what: String,
    done: u64,
    total: u64,
}

/// How far the command has come, such as `simulating: 20 of 80`, once it has begun long work.
pub(crate) fn reached() -> Option<String> {
    locked(&REACHED).as_ref().map(|Reached { what, done, total }| count(what, *done, *total))
}

/// The progress of work on one thread.
pub(crate) struct Progress<'a> {
    ui: &'a Ui,
    what: String,
    total: u64,
    /// What was done before it started.
    before: u64,
    bar: Option<ProgressBar>,
    started: Instant,
    told: Instant,
}

impl<'a> Progress<'a> {
    /// Starts to show work named `what`, such as `simulating`, of `total` equal pieces.
    pub(crate) fn new(ui: &'a Ui, what: impl Into<String>, total: u64) -> Self {
        Self::starting_at(ui, what, total, 0)
    }

    /// As [`Progress::new`], where `before` pieces are done already.
    pub(crate) fn starting_at(ui: &'a Ui, what: impl Into<String>, total: u64, before: u64) -> Self {
        let (what, now) = (what.into(), Instant::now());
        let bar = (ui.shows_progress() && ui::stderr_is_terminal()).then(|| bar(what.clone(), total));
        bar.iter().for_each(|bar| bar.set_position(before));
        bar.iter().for_each(ProgressBar::reset_eta);
        *locked(&REACHED) = Some(Reached { what: what.clone(), done: before, total });
        Self { ui, what, total, before, bar, started: now, told: now }
    }

    /// Shows that `done` pieces are done.
    pub(crate) fn set(&mut self, done: u64) {
        if let Some(reached) = &mut *locked(&REACHED) {
            (reached.done, reached.total) = (done, self.total);
        }
        if let Some(bar) = &self.bar {
            bar.set_position(done);
        } else if self.told.elapsed() >= PAUSE {
            self.told = Instant::now();
            self.ui.note(&line(&self.what, [self.before, done], self.total, self.started.elapsed()));
        }
    }
}

impl Drop for Progress<'_> {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// The progress of work on several threads.
pub(crate) struct Tally<'a>(Mutex<(Progress<'a>, u64)>);

impl<'a> Tally<'a> {
    /// As [`Progress::new`].
    pub(crate) fn new(ui: &'a Ui, what: impl Into<String>, total: u64) -> Self {
        Self(Mutex::new((Progress::new(ui, what, total), 0)))
    }

    /// Shows that `pieces` more are done, at most `total` in all.
    pub(crate) fn add(&self, pieces: u64) {
        // The lock is poisoned only when a panic is about to end the program.
        if let Ok(mut guard) = self.0.lock() {
            let (progress, done) = &mut *guard;
            *done = (*done + pieces).min(progress.total);
            progress.set(*done);
        }
    }
}

/// The progress of work in stages of which each is known only when it begins, on several threads.
pub(crate) struct Stages<'a> {
    ui: &'a Ui,
    now: Mutex<Option<Tally<'a>>>,
}

impl<'a> Stages<'a> {
    /// Before the first stage.
    pub(crate) fn new(ui: &'a Ui) -> Self {
        Self { ui, now: Mutex::new(None) }
    }

    /// The stage named `what`, of `total` pieces, begins.
    pub(crate) fn begin(&self, what: String, total: u64) {
        // The lock is poisoned only when a panic is about to end the program.
        if let Ok(mut now) = self.now.lock() {
            // The bar of the last stage goes before the next one is drawn.
            drop(now.take());
            *now = Some(Tally::new(self.ui, what, total));
        }
    }

    /// Shows that `pieces` more of this stage are done.
    pub(crate) fn add(&self, pieces: u64) {
        if let Ok(now) = self.now.lock() {
            now.iter().for_each(|stage| stage.add(pieces));
        }
    }
}

fn bar(what: String, total: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
    // The template is constant; if it did not parse, the default style would do.
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len}, {eta} left") {
        bar.set_style(style);
    }
    bar.with_message(what)
}

/// The remaining time is estimated after this fraction of the work, one in `EARLY`.
const EARLY: u64 = 20;

/// `done` of `total` and, after a twentieth of what was not done `before`, the seconds left at the same speed.
fn line(what: &str, [before, done]: [u64; 2], total: u64, elapsed: Duration) -> String {
    let (left, new) = (total.saturating_sub(done), done.saturating_sub(before));
    if total == u64::MAX || left == 0 || new < (total.saturating_sub(before)) / EARLY {
        return count(what, done, total);
    }
    #[expect(clippy::cast_precision_loss, reason = "an estimate for people")]
    let seconds = elapsed.as_secs_f64() * left as f64 / new.max(1) as f64;
    format!("{}, about {seconds:.0} s left", count(what, done, total))
}

/// `done` of `total`, where anyone knows that.
fn count(what: &str, done: u64, total: u64) -> String {
    if total == u64::MAX { format!("{what}: {done}") } else { format!("{what}: {done} of {total}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_estimates_the_rest() {
        assert_eq!(
            line("simulating", [0, 20], 80, Duration::from_secs(10)),
            "simulating: 20 of 80, about 30 s left"
        );
        assert_eq!(line("x", [0, 0], 0, Duration::ZERO), "x: 0 of 0");
        assert_eq!(line("x", [0, 4], 100, Duration::from_secs(9)), "x: 4 of 100");
        assert_eq!(line("x", [0, 5], 100, Duration::from_secs(1)), "x: 5 of 100, about 19 s left");
        assert_eq!(line("x", [40, 60], 100, Duration::from_secs(10)), "x: 60 of 100, about 20 s left");
        assert_eq!(line("x", [0, 100], 100, Duration::from_secs(9)), "x: 100 of 100");
    }
}
