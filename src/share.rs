//! Pieces of work that threads take one after the other.
//!
//! The calling thread works too, and the others of the pool help it. A parallel iterator would hand all of the
//! work to the pool and sleep: measured after a pause of 3 ms, the pool then used one of its two threads for the
//! first millisecond.

use std::sync::{Mutex, PoisonError};

/// Does `work` on each of the pieces, whose order says only which is begun first. A thread has one of `states`,
/// which are made where they are missing, for all of its pieces: memory that is used again.
pub(crate) fn share<T, S: Default + Send>(
    pieces: impl ExactSizeIterator<Item = T> + Send,
    states: &mut Vec<S>,
    work: impl Fn(&mut S, T) + Sync,
) {
    let threads = pieces.len().clamp(1, rayon::current_num_threads());
    states.resize_with(threads.max(states.len()), S::default);
    let pieces = Mutex::new(pieces);
    // The lock is let go of before the work begins. A panic of another thread is about to end all of them.
    let next = || pieces.lock().unwrap_or_else(PoisonError::into_inner).next();
    let work_on = |state: &mut S| {
        while let Some(piece) = next() {
            work(state, piece);
        }
    };
    let Some((first, others)) = states[..threads].split_first_mut() else { return };
    rayon::in_place_scope(|scope| {
        for state in others {
            scope.spawn(|_| work_on(state));
        }
        work_on(first);
    });
}

/// [`share`] without states.
pub(crate) fn share_out<T>(pieces: impl ExactSizeIterator<Item = T> + Send, work: impl Fn(T) + Sync) {
    share(pieces, &mut Vec::<()>::new(), |(), piece| work(piece));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_is_worked_on_once() {
        for (threads, count) in [(1, 100), (3, 0), (3, 1), (3, 2), (3, 1000)] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let (mut pieces, mut states) = (vec![0_u64; count], vec![5_u64]);
            let work = |states: &mut Vec<u64>, pieces: &mut Vec<u64>| {
                share(pieces.iter_mut(), states, |state, piece| {
                    *piece += 1;
                    *state += 1;
                });
            };
            pool.install(|| (0..2).for_each(|_| work(&mut states, &mut pieces)));
            assert!(pieces.iter().all(|&piece| piece == 2), "{threads} threads");
            assert!(states.len() <= threads.max(1), "a state for each thread");
            assert_eq!(states.iter().sum::<u64>(), 5 + 2 * count as u64, "states are kept");
        }
    }

    #[test]
    fn a_thread_outside_of_the_pool_works_too() {
        let thread = std::thread::current().id();
        let (seen, pieces) = (Mutex::new(0), 0..64);
        share_out(pieces, |_| {
            if std::thread::current().id() == thread {
                *seen.lock().unwrap() += 1;
            }
            std::thread::sleep(std::time::Duration::from_millis(1));
        });
        assert!(*seen.lock().unwrap() > 0);
    }
}
