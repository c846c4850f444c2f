//! What every command shares: how it speaks, when it stops, where it writes.

pub(crate) mod atomic;
pub(crate) mod guard;
pub(crate) mod outputs;
pub(crate) mod progress;
pub(crate) mod signals;
pub(crate) mod staged;
pub(crate) mod ui;

use drape::error::{Error, Kind, Result};
use serde::Serialize;

use signals::Signals;
use ui::Ui;

/// What every command shares.
pub(crate) struct Session {
    pub(crate) ui: Ui,
    pub(crate) signals: Signals,
}

impl Session {
    /// Prints a result: as JSON if asked for, else as text.
    pub(crate) fn print(&self, value: &impl Serialize, text: &str) -> Result<()> {
        if self.ui.json { self.print_json(value) } else { atomic::write_stdout(text.as_bytes()) }
    }

    /// Prints a result that is always JSON: one object on one line.
    pub(crate) fn print_json(&self, value: &impl Serialize) -> Result<()> {
        let json = serde_json::to_string(value)
            .map_err(|e| Error::new(Kind::Internal, format!("cannot write JSON: {e}")))?;
        atomic::write_stdout((json + "\n").as_bytes())
    }
}

/// Tells the error, if any. A reader that has gone wants no message and no failure.
pub(crate) fn exit_code(ui: &Ui, result: Result<()>) -> u8 {
    match result {
        Ok(()) => 0,
        Err(error) if error.kind == Kind::Signal(atomic::SIGPIPE) => 0,
        Err(error) => {
            ui.error(&error);
            error.kind.exit_code()
        }
    }
}
