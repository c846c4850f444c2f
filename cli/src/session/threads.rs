//! The threads that all parallel work shares.

use std::num::NonZero;
use std::sync::Mutex;
use std::thread;

use rayon::{ThreadPoolBuildError, ThreadPoolBuilder};

use super::Session;
use super::spawn::{self, STACK};
use drape::diagnostics::memory::check_available;
use drape::error::{Error, Kind, Result};

/// Starts `asked` threads, or one for each core for 0. Where the system allows fewer, or has memory for their
/// stacks only, it starts fewer, at worst none besides the present one: the results are the same.
///
/// # Errors
/// [`Kind::Io`] when not even that can be done.
pub(crate) fn start(asked: usize, session: &Session) -> Result<()> {
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let asked = if asked == 0 { cores } else { asked };
    let halves = std::iter::successors(Some(asked), |count| Some(count / 2));
    let room = halves.take_while(|&count| count > 0).find(|&count| has_room(count)).unwrap_or(0);
    let count = startable(room);
    if count == asked {
        return pool(asked).build_global().map_err(|e| failed(&e));
    }
    // The present thread is one of them, which needs no start.
    let count = count.max(1);
    pool(count).use_current_thread().build_global().map_err(|e| failed(&e))?;
    if count < asked {
        let message = format!("only {count} of {asked} threads could be started");
        session
            .ui
            .caution(&message, "the results are the same, later; the system limits them (ulimit -u, -v)");
    }
    Ok(())
}

fn pool(count: usize) -> ThreadPoolBuilder {
    ThreadPoolBuilder::new().num_threads(count).stack_size(STACK)
}

/// Whether there is memory for the stacks of `count` more threads and three times as much for what they do.
fn has_room(count: usize) -> bool {
    check_available(4 * (STACK * count) as u64, "threads").is_ok()
}

/// Whether the present thread does all parallel work. Another thread that has such work waits while this one does
/// anything else, so neither may wait for the other.
pub(crate) fn is_the_only_one() -> bool {
    rayon::current_num_threads() == 1 && rayon::current_thread_index().is_some()
}

/// How many threads of `asked` can run at once. It is found by trying, since the pool of the process can be built
/// only once.
fn startable(asked: usize) -> usize {
    let held = Mutex::new(());
    let hold = held.lock();
    thread::scope(|scope| {
        let wait = || drop(held.lock());
        let start = || spawn::builder().and_then(|thread| thread.spawn_scoped(scope, wait));
        let started = (0..asked).map_while(|_| start().ok()).count();
        drop(hold);
        started
    })
}

fn failed(cause: &ThreadPoolBuildError) -> Error {
    Error::new(Kind::Io, format!("cannot start the threads: {cause}")).with_help("lower --threads")
}
