//! How the points are divided into chunks for several threads.
//!
//! The chunks depend on the cloth alone, and no chunk reads what another writes, so every number of
//! threads gives the same bits.

use std::ops::Range;

use rayon::prelude::*;

use super::Points;

/// Points of a chunk: enough that handing it out costs little compared with the work on it.
pub(crate) const POINTS: usize = 2048;

/// From so many points on several threads share the work of a phase. Each phase of a smaller cloth
/// takes less than 0.1 ms, in which there is little to gain over waking them.
pub(crate) const MANY: usize = 8192;

/// The least number of chunks that a thread takes at once for a cloth of so many points: all of them if it
/// is small.
pub(crate) fn at_once(points: usize) -> usize {
    if points < MANY { usize::MAX } else { 1 }
}

/// Does `work` on a cloth of so many points inside the thread pool if several threads share in it.
/// Entering the pool takes long, and would otherwise be done in each phase of each step.
pub(crate) fn with_threads(points: usize, work: impl FnOnce() + Send) {
    if points < MANY { work() } else { rayon::scope(|_| work()) }
}

/// The entries of `all`, one a point, by chunks.
pub(crate) fn cut<T: Sync>(all: &[T]) -> impl IndexedParallelIterator<Item = &[T]> {
    all.par_chunks(POINTS).with_min_len(at_once(all.len()))
}

/// The entries of `all`, one a point, by chunks, to be changed.
pub(crate) fn cut_mut<T: Send>(all: &mut [T]) -> impl IndexedParallelIterator<Item = &mut [T]> {
    let at_once = at_once(all.len());
    all.par_chunks_mut(POINTS).with_min_len(at_once)
}

/// The parts of `runs` that lie in chunk `chunk`, counted from its start.
pub(crate) fn within(runs: &[Range<usize>], chunk: usize) -> impl Iterator<Item = Range<usize>> {
    let (start, end) = (chunk * POINTS, (chunk + 1) * POINTS);
    let parts = runs.iter().map(move |run| run.start.max(start)..run.end.min(end));
    parts.filter(|part| !part.is_empty()).map(move |part| part.start - start..part.end - start)
}

impl Points {
    /// The components by chunks.
    pub(crate) fn cut(&self) -> impl IndexedParallelIterator<Item = [&[f64]; 3]> {
        let [x, y, z] = self.components().map(cut);
        x.zip(y).zip(z).map(|((x, y), z)| [x, y, z])
    }

    /// The components by chunks, to be changed.
    pub(crate) fn cut_mut(&mut self) -> impl IndexedParallelIterator<Item = [&mut [f64]; 3]> {
        let [x, y, z] = self.components_mut().map(cut_mut);
        x.zip(y).zip(z).map(|((x, y), z)| [x, y, z])
    }
}
