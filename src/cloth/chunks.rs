//! How the points are divided into chunks for several threads.
//!
//! The chunks depend on the cloth alone, and no chunk reads what another writes, so every number of
//! threads gives the same bits.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::{hint, thread};

use rayon::prelude::*;

use super::Points;

/// Points of a chunk: enough that handing it out costs little compared with the work on it.
pub(crate) const POINTS: usize = 2048;

/// From so many points on several threads share the work of a phase. Each phase of a smaller cloth
/// takes less than 0.1 ms, in which there is little to gain over waking them.
pub(crate) const MANY: usize = 8192;

/// How often a thread looks for work before it also offers its CPU to other programs,
const SPINS: u32 = 1000;

/// and before it leaves: 7 ms where nothing else runs (measured on an EPYC with Zen 5).
const PATIENCE: u32 = 20_000;

/// The least number of chunks that a thread takes at once for a cloth of so many points: all of them if it
/// is small.
pub(crate) fn at_once(points: usize) -> usize {
    if points < MANY { usize::MAX } else { 1 }
}

/// Does `work` on a cloth of so many points inside the thread pool if several threads share in it.
/// Entering the pool takes long, and would otherwise be done in each phase of each step. The other threads stay awake
/// until the work ends: to wake one takes longer than some phases.
pub(crate) fn with_threads(points: usize, work: impl FnOnce() + Send) {
    if points < MANY {
        return work();
    }
    let at_work = &AtomicBool::new(true);
    rayon::scope(|scope| {
        let worker = rayon::current_thread_index();
        for _ in 1..rayon::current_num_threads() {
            scope.spawn(move |_| help(worker, at_work));
        }
        let _ends = Ends(at_work);
        work();
    });
}

/// Does what there is to do in the pool while `at_work`, but leaves when there was nothing for long: below on the stack
/// of its thread there may be a piece of work that another one waits for. On the thread `worker` it would wait for itself.
fn help(worker: Option<usize>, at_work: &AtomicBool) {
    let mut idle = 0;
    while rayon::current_thread_index() != worker && at_work.load(Ordering::Acquire) && idle < PATIENCE {
        idle += 1;
        match rayon::yield_now() {
            Some(rayon::Yield::Executed) => idle = 0,
            _ if idle < SPINS => hint::spin_loop(),
            _ => thread::yield_now(),
        }
    }
}

/// Ends the work when it goes, also when the work panics.
struct Ends<'a>(&'a AtomicBool);

impl Drop for Ends<'_> {
    fn drop(&mut self) {
        self.0.store(false, Ordering::Release);
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn helpers_end_with_the_work() {
        for threads in [1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            for points in [MANY - 1, MANY] {
                let sum = pool.install(|| {
                    let mut all = vec![1_u64; points];
                    with_threads(points, || {
                        for _ in 0..20 {
                            cut_mut(&mut all).for_each(|chunk| chunk.iter_mut().for_each(|n| *n += 1));
                        }
                    });
                    all.iter().sum::<u64>()
                });
                assert_eq!(sum, 21 * points as u64);
            }
            let panics = || pool.install(|| with_threads(MANY, || panic!("the work")));
            assert!(std::panic::catch_unwind(std::panic::AssertUnwindSafe(panics)).is_err());
        }
    }
}
