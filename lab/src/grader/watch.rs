//! What the search for a cause tells of itself while it runs.

use std::sync::atomic::{AtomicU64, Ordering};

use drape::error::Result;

/// What a search tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// It begins to do something that takes at most so many frames.
    Stage(String, u64),
    /// So many more frames are simulated, or are not needed.
    Frames(u64),
}

/// Hears of events, from several threads; an error that it returns ends the search.
pub type Watch<'a> = &'a (dyn Fn(Event) -> Result<()> + Sync);

/// A run that takes at most so many frames.
pub(super) struct Run<'a> {
    watch: Watch<'a>,
    left: AtomicU64,
}

impl<'a> Run<'a> {
    /// A run of at most `frames` frames, of which `watch` hears.
    pub(super) fn new(watch: Watch<'a>, frames: u64) -> Self {
        Self { watch, left: AtomicU64::new(frames) }
    }

    /// Another frame is simulated.
    ///
    /// # Errors
    /// Those of the watch.
    pub(super) fn frame(&self) -> Result<()> {
        let left = self.left.load(Ordering::Relaxed);
        self.left.store(left.saturating_sub(1), Ordering::Relaxed);
        (self.watch)(Event::Frames(left.min(1)))
    }

    /// The run is over: the frames that are left are not needed.
    ///
    /// # Errors
    /// Those of the watch.
    pub(super) fn finish(self) -> Result<()> {
        (self.watch)(Event::Frames(self.left.into_inner()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_tells_as_many_frames_as_it_announced() {
        for (announced, simulated) in [(5, 3), (5, 5), (3, 5), (0, 1)] {
            let told = AtomicU64::new(0);
            let watch = |event| {
                let Event::Frames(frames) = event else { return Ok(()) };
                told.fetch_add(frames, Ordering::Relaxed);
                Ok(())
            };
            let run = Run::new(&watch, announced);
            (0..simulated).for_each(|_| run.frame().unwrap());
            run.finish().unwrap();
            assert_eq!(told.into_inner(), announced);
        }
    }
}
