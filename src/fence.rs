//! A fence around the code of others: its panic on a damaged file is an error of that file, not of this program.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};

thread_local! {
    static DEPTH: Cell<u32> = const { Cell::new(0) };
}

/// Whether this thread is within [`fenced`]. A hook that reports panics has nothing to report then.
pub fn is_within() -> bool {
    DEPTH.get() > 0
}

/// What `work` returns, or nothing if it panics. `work` must not start threads of its own.
///
/// # Errors
/// The sentence that stands for a panic, without a full stop.
pub fn fenced<T>(work: impl FnOnce() -> T) -> Result<T, &'static str> {
    DEPTH.set(DEPTH.get() + 1);
    // What `work` has left half done is dropped with it.
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    DEPTH.set(DEPTH.get() - 1);
    result.map_err(|_| "the decoder fails on it")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error_and_a_result_passes() {
        assert_eq!(fenced(|| (is_within(), 7)), Ok((true, 7)));
        assert!(!is_within());
        let inner = fenced(|| fenced(|| panic!("a fault of others")).map(|()| 1).unwrap_or(2));
        assert_eq!((inner, is_within()), (Ok(2), false));
    }
}
