//! What every command shares: messages on standard error, progress, what stops it, and the files it writes.

pub(crate) mod one_arena;
pub(crate) mod spawn;
pub(crate) mod leftovers;
pub(crate) mod memory;
pub(crate) mod program;
pub(crate) mod ui;
pub(crate) mod progress;
pub(crate) mod stop;
pub(crate) mod guard;
pub(crate) mod files;
pub(crate) mod threads;

use serde::Serialize;

use drape::error::{Error, Kind, Result};
use drape_lab::printable;
use files::atomic;
use files::target::SIGPIPE;
use stop::Stop;
use ui::Ui;

/// What every command is given besides its arguments.
pub(crate) struct Session {
    pub(crate) ui: Ui,
    pub(crate) stop: Stop,
}

impl Session {
    /// Prints a result to standard output: as JSON with `--json`, otherwise as text.
    pub(crate) fn print(&self, value: &impl Serialize, text: &str) -> Result<()> {
        if self.ui.json { self.print_json(value) } else { self.print_text(printable::lines(text)) }
    }

    /// Prints a result that is always JSON: one object on one line.
    pub(crate) fn print_json(&self, value: &impl Serialize) -> Result<()> {
        let json = serde_json::to_string(value).map_err(|e| json_failed(&e))?;
        self.print_text(printable::json(&json) + "\n")
    }

    /// Prints a result that is always text.
    pub(crate) fn print_text(&self, text: impl AsRef<[u8]>) -> Result<()> {
        atomic::write_stdout(text.as_ref())
    }

    /// Reports the files that a command has written: with `--json` as an object on standard output,
    /// otherwise as a line on standard error.
    pub(crate) fn report(&self, value: &impl Serialize, line: &str) -> Result<()> {
        self.ui.note(line);
        if self.ui.json { self.print_json(value) } else { Ok(()) }
    }
}

/// The error of a value that cannot be written as JSON.
pub(crate) fn json_failed(cause: &serde_json::Error) -> Error {
    Error::new(Kind::Internal, format!("cannot write JSON: {cause}"))
}

/// Reports the error, if any, and returns its exit code. A reader that closed the pipe needs neither
/// a message nor a failure.
pub(crate) fn exit_code(ui: &Ui, result: Result<()>) -> u8 {
    match result {
        Ok(()) => 0,
        Err(error) if error.kind == Kind::Signal(SIGPIPE) => 0,
        Err(error) => {
            ui.error(&error);
            error.kind.exit_code()
        }
    }
}
