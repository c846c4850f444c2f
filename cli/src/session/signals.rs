//! Ctrl-C and SIGTERM: the first stops the program at the next frame, the second at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use drape::error::{Error, Kind, Result};

/// The signal that arrived last.
pub(crate) struct Signals {
    number: Arc<AtomicUsize>,
}

impl Signals {
    /// Starts to catch both signals.
    ///
    /// # Errors
    /// [`Kind::Io`] when the system refuses.
    pub(crate) fn install() -> Result<Self> {
        let (number, again) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicBool::new(false)));
        for (signal, value) in [(SIGINT, 2), (SIGTERM, 15)] {
            // The order matters: the shutdown acts on the flag as earlier signals have set it.
            flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(&again))
                .and_then(|_| flag::register(signal, Arc::clone(&again)))
                .and_then(|_| flag::register_usize(signal, Arc::clone(&number), value))
                .map_err(|e| Error::new(Kind::Io, format!("cannot catch signals: {e}")))?;
        }
        Ok(Self { number })
    }

    /// Fails once a signal has arrived.
    ///
    /// # Errors
    /// [`Kind::Signal`] with the number of the signal.
    pub(crate) fn check(&self) -> Result<()> {
        match self.number.load(Ordering::Relaxed) {
            0 => Ok(()),
            number => {
                let kind = Kind::Signal(u8::try_from(number).unwrap_or(u8::MAX));
                Err(Error::new(kind, format!("stopped by signal {number}; nothing was written")))
            }
        }
    }
}
