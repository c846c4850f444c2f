//! How far long work is: a bar on a terminal, else at most a line every five seconds.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::session::ui::{self, Ui};

/// Time between two lines where there is no terminal.
const PAUSE: Duration = Duration::from_secs(5);

/// The progress of work that is done in equal pieces.
pub(crate) struct Progress<'a> {
    ui: &'a Ui,
    what: &'static str,
    total: u64,
    bar: Option<ProgressBar>,
    started: Instant,
    told: Instant,
}

impl<'a> Progress<'a> {
    /// Begins to show work called `what`, such as `simulating`, in `total` pieces.
    pub(crate) fn new(ui: &'a Ui, what: &'static str, total: u64) -> Self {
        let now = Instant::now();
        let bar = (ui.shows_progress() && ui::stderr_is_terminal()).then(|| bar(what, total));
        Self { ui, what, total, bar, started: now, told: now }
    }

    /// Says that `done` pieces are done.
    pub(crate) fn set(&mut self, done: u64) {
        if let Some(bar) = &self.bar {
            bar.set_position(done);
        } else if self.told.elapsed() >= PAUSE {
            self.told = Instant::now();
            self.ui.note(&line(self.what, done, self.total, self.started.elapsed()));
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

/// The progress of work whose pieces end on any thread.
pub(crate) struct Tally<'a>(Mutex<(Progress<'a>, u64)>);

impl<'a> Tally<'a> {
    /// As [`Progress::new`].
    pub(crate) fn new(ui: &'a Ui, what: &'static str, total: u64) -> Self {
        Self(Mutex::new((Progress::new(ui, what, total), 0)))
    }

    /// Says that `pieces` more are done; never more than all are shown.
    pub(crate) fn add(&self, pieces: u64) {
        // A thread that panicked took the whole program with it.
        if let Ok(mut guard) = self.0.lock() {
            let (progress, done) = &mut *guard;
            *done = (*done + pieces).min(progress.total);
            progress.set(*done);
        }
    }
}

fn bar(what: &'static str, total: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
    // The template is a constant; should it not parse, the default style does as well.
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len}, {eta} left") {
        bar.set_style(style);
    }
    bar.with_message(what)
}

/// Part of the work before which its speed says nothing.
const EARLY: u64 = 20;

/// `done` of `total` and, after the first twentieth, the seconds left if the rest goes as fast.
fn line(what: &str, done: u64, total: u64, elapsed: Duration) -> String {
    let left = total.saturating_sub(done);
    if left == 0 || done < total / EARLY {
        return format!("{what}: {done} of {total}");
    }
    #[expect(clippy::cast_precision_loss, reason = "an estimate for people")]
    let seconds = elapsed.as_secs_f64() * left as f64 / done.max(1) as f64;
    format!("{what}: {done} of {total}, about {seconds:.0} s left")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_estimates_the_rest() {
        assert_eq!(
            line("simulating", 20, 80, Duration::from_secs(10)),
            "simulating: 20 of 80, about 30 s left"
        );
        assert_eq!(line("x", 0, 0, Duration::ZERO), "x: 0 of 0");
        assert_eq!(line("x", 4, 100, Duration::from_secs(9)), "x: 4 of 100");
        assert_eq!(line("x", 5, 100, Duration::from_secs(1)), "x: 5 of 100, about 19 s left");
        assert_eq!(line("x", 100, 100, Duration::from_secs(9)), "x: 100 of 100");
    }
}
