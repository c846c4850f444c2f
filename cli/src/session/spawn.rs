//! Threads that are started only where there is memory for them.

use std::io;
use std::thread::Builder;

use drape::diagnostics::memory::check_available;

/// The stack of a thread, in bytes.
pub(crate) const STACK: usize = 2 << 20;

/// What starts a thread, with [`STACK`] whatever the variable `RUST_MIN_STACK` says.
///
/// # Errors
/// Where there is no memory for its stack and half as much again: a thread that finds none for the little that it
/// takes besides its stack ends the process.
pub(crate) fn builder() -> io::Result<Builder> {
    match check_available((STACK + STACK / 2) as u64, "a thread") {
        Ok(()) => Ok(Builder::new().stack_size(STACK)),
        Err(error) => Err(io::Error::new(io::ErrorKind::OutOfMemory, error.message)),
    }
}
