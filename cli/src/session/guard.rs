//! A panic, which is a fault of this program, becomes one line and exit code 70.

use std::any::Any;
use std::panic::{self, AssertUnwindSafe};

use crate::session::ui::Ui;
use drape::error::{Error, Kind};
use drape::fence;

/// Runs `work` and returns its exit code. A panic in it, on any thread, is printed as an internal error
/// without a backtrace and returns 70.
pub(crate) fn guarded(json: bool, work: impl FnOnce() -> u8) -> u8 {
    panic::set_hook(Box::new(move |panic| {
        // It becomes the error of a file, which is reported as such.
        if fence::is_within() {
            return;
        }
        let place = panic.location().map(|l| format!(" at {}:{}", l.file(), l.line())).unwrap_or_default();
        let cause = message(panic.payload()).replace('\n', " ");
        let error = Error::new(Kind::Internal, format!("internal error: {cause}{place}"));
        Ui::before_parsing(json).error(&error.with_help("this is a bug in drape; please report it"));
    }));
    panic::catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| Kind::Internal.exit_code())
}

/// The message of a panic: `panic!` carries a text of one of these two types.
fn message(payload: &dyn Any) -> &str {
    let owned = || payload.downcast_ref::<String>().map(String::as_str);
    payload.downcast_ref::<&str>().copied().or_else(owned).unwrap_or("unknown cause")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_exit_code_70_and_a_result_passes() {
        assert_eq!(guarded(false, || 3), 3);
        assert_eq!(guarded(false, || panic!("a fault\nof two lines")), 70);
        assert_eq!(guarded(true, || rayon::join(|| panic!("on a thread"), || 0).1), 70);
        let _ = panic::take_hook();
    }
}
