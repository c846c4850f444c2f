//! Another program that this one runs. It is ended with this one, however this one ends.

use std::io;
use std::process::{Child, Command, ExitStatus};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

use super::leftovers::{self, Leftover, Listed, locked};

/// How often [`Program::wait`] looks.
const PERIOD: Duration = Duration::from_millis(5);

/// A program that runs, ended when this is dropped.
pub(crate) struct Program {
    child: Arc<Mutex<Child>>,
    _listed: Listed,
}

impl Program {
    /// Starts it.
    pub(crate) fn start(command: &mut Command) -> io::Result<Self> {
        let child = Arc::new(Mutex::new(command.spawn()?));
        let listed = leftovers::list(Leftover::Program(Arc::clone(&child)));
        Ok(Self { child, _listed: listed })
    }

    /// Its standard input, the first time that it is asked for.
    pub(crate) fn input(&self) -> Option<std::process::ChildStdin> {
        locked(&self.child).stdin.take()
    }

    /// Waits for its end. The lock is free in between, for whoever has to end it.
    pub(crate) fn wait(&self) -> io::Result<ExitStatus> {
        loop {
            if let Some(status) = locked(&self.child).try_wait()? {
                return Ok(status);
            }
            thread::sleep(PERIOD);
        }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let mut child = locked(&self.child);
        // It may have ended by itself.
        let _ = child.kill();
        let _ = child.wait();
    }
}
