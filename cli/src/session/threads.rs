//! The threads that all parallel work shares.

use std::num::NonZero;
use std::sync::Mutex;
use std::thread;

use rayon::{ThreadPoolBuildError, ThreadPoolBuilder};

use super::Session;
use drape::diagnostics::memory::check_available;
use drape::error::{Error, Kind, Result};

/// Starts `asked` threads, or one for each core for 0. Where the system allows fewer it starts as many as it can, at
/// worst none besides the present one: the results are the same.
///
/// # Errors
/// [`Kind::Io`] when not even that can be done.
pub(crate) fn start(asked: usize, session: &Session) -> Result<()> {
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let asked = if asked == 0 { cores } else { asked };
    let halves = std::iter::successors(Some(asked), |count| Some(count / 2));
    let room = halves.take_while(|&count| count > 1).find(|&count| has_room(count)).unwrap_or(1);
    let count = startable(room);
    if count == asked {
        return ThreadPoolBuilder::new().num_threads(asked).build_global().map_err(|e| failed(&e));
    }
    // The present thread is one of them, which needs no start.
    let count = count.max(1);
    ThreadPoolBuilder::new()
        .num_threads(count)
        .use_current_thread()
        .build_global()
        .map_err(|e| failed(&e))?;
    let message = format!("only {count} of {asked} threads could be started");
    session.ui.caution(&message, "the results are the same, later; the system limits them (ulimit -u, -v)");
    Ok(())
}

/// Whether there is memory for the stacks of `count` threads and as much again.
fn has_room(count: usize) -> bool {
    const STACK: u64 = 2 << 20;
    check_available(2 * STACK * count as u64, "threads").is_ok()
}

/// How many threads of `asked` can run at once. It is found by trying, since the pool of the process can be built
/// only once.
fn startable(asked: usize) -> usize {
    let held = Mutex::new(());
    let hold = held.lock();
    thread::scope(|scope| {
        let wait = || drop(held.lock());
        let started = (0..asked).map_while(|_| thread::Builder::new().spawn_scoped(scope, wait).ok()).count();
        drop(hold);
        started
    })
}

fn failed(cause: &ThreadPoolBuildError) -> Error {
    Error::new(Kind::Io, format!("cannot start the threads: {cause}")).with_help("lower --threads")
}
