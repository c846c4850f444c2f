//! Workers: the cases that have no record are run, each thread one after the other.
//!
//! A worker takes the cases in the order of the plan. One that another worker has claimed comes last: by then it has a
//! record, or the other one is slow or gone, and it is run all the same. So no case waits for a worker that was killed,
//! and at worst a case is run twice, with the same bytes.

use std::sync::Mutex;

use super::case::Case;
use super::plan::Plan;
use super::run;
use crate::store::Entry;
use drape::error::Result;

/// What a worker tells while it works.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A frame of a case was simulated; the worker can be stopped here.
    Frame,
    /// A case has a record.
    Finished,
    /// A record was damaged, and its case is run again.
    Damaged(String),
}

/// Hears of events from many threads, and can stop the worker with an error.
pub type Watch<'a> = &'a (dyn Fn(Event) -> Result<()> + Sync);

/// A worker.
struct Worker<'a> {
    plan: &'a Plan,
    watch: Watch<'a>,
    /// Cases that other workers have claimed.
    claimed: Mutex<Vec<Case>>,
    /// The first error.
    failed: Mutex<Option<drape::error::Error>>,
}

/// Runs the cases of `plan` whose numbers `takes` accepts and that have no record, on all threads. `seed` decides
/// where it begins among cases that others have claimed, so that workers with different ones seldom meet.
///
/// # Errors
/// [`drape::error::Kind::Io`] when cases cannot be read or records not be written; those of `watch`.
pub fn work(
    plan: &Plan,
    takes: impl Fn(u64) -> bool + Send + Sync,
    seed: u64,
    watch: Watch<'_>,
) -> Result<()> {
    let worker = Worker { plan, watch, claimed: Mutex::default(), failed: Mutex::default() };
    let cases = plan.cases()?.filter(|case| case.as_ref().map_or(true, |case| takes(case.number)));
    worker.share(cases, true);
    worker.check()?;
    let mut claimed = std::mem::take(&mut *locked(&worker.claimed));
    #[expect(clippy::cast_possible_truncation, reason = "any place will do")]
    let first = seed as usize % claimed.len().max(1);
    claimed.rotate_left(first);
    worker.share(claimed.into_iter().map(Ok), false);
    worker.check()
}

impl Worker<'_> {
    /// Lets every thread take one case after the other.
    fn share(&self, cases: impl Iterator<Item = Result<Case>> + Send, heeds_claims: bool) {
        let cases = Mutex::new(cases);
        let next = || locked(&cases).next();
        rayon::broadcast(|_| {
            while locked(&self.failed).is_none() {
                let Some(case) = next() else { return };
                if let Err(error) = case.and_then(|case| self.handle(case, heeds_claims)) {
                    locked(&self.failed).get_or_insert(error);
                }
            }
        });
    }

    /// The first error, if there was one.
    fn check(&self) -> Result<()> {
        locked(&self.failed).take().map_or(Ok(()), Err)
    }

    /// Runs a case that has no record.
    fn handle(&self, case: Case, heeds_claims: bool) -> Result<()> {
        let Self { plan, watch, .. } = self;
        let store = &plan.store;
        match store.record(case.address) {
            Entry::Whole(_) => return watch(Event::Frame),
            Entry::Damaged => {
                watch(Event::Damaged(format!("the result of case {} is damaged", case.address)))?
            }
            Entry::Missing => {}
        }
        if !store.claim(case.address)? && heeds_claims {
            locked(&self.claimed).push(case);
            return Ok(());
        }
        let ran = run::run(plan, &case, &|| watch(Event::Frame));
        let stored =
            ran.and_then(|(record, picture)| store.put_record(case.address, record, picture.as_deref()));
        store.release(case.address);
        stored?;
        watch(Event::Finished)
    }
}

/// The content of a lock; a panic of another thread is about to end the program anyway.
fn locked<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}
