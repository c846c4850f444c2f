//! Threads that are started only where there is memory for them.

use std::io;
use std::thread::Builder;

use drape::diagnostics::memory::check_available;

/// The stack of a thread, in bytes.
pub(crate) const STACK: u64 = 2 << 20;

/// What starts a thread.
///
/// # Errors
/// Where there is no memory for its stack and half as much again: a thread that finds none for the little that it
/// takes besides its stack ends the process.
pub(crate) fn builder() -> io::Result<Builder> {
    match check_available(STACK + STACK / 2, "a thread") {
        Ok(()) => Ok(Builder::new()),
        Err(error) => Err(io::Error::new(io::ErrorKind::OutOfMemory, error.message)),
    }
}
