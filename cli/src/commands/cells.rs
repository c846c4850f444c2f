//! The store of finished results that commands keep in the folder of their output.

use std::path::Path;

use crate::session::Session;
use crate::session::files::atomic;
use drape::error::{Error, Result};
use drape_lab::store::Store;

/// The store in the folder `out`, whose parents are created where they are missing.
pub(super) fn open(out: &Path) -> Result<Store> {
    Store::new(&out.join("cells"), atomic::write)
}

/// Fails once a signal has arrived, of work that goes on where it was.
///
/// # Errors
/// As [`Signals::check`](crate::session::signals::Signals::check).
pub(super) fn check_signals(session: &Session) -> Result<()> {
    session.signals.check().map_err(|error| {
        Error { message: "stopped; what is finished is kept".to_owned(), ..error }
            .with_help("run the same command again to do the rest")
    })
}

/// Says which results were damaged.
pub(super) fn warn_of_damaged(store: &Store, session: &Session) {
    for file in store.take_damaged() {
        session.ui.caution(&format!("the result `{}` was damaged", file.display()), "it was made again");
    }
}

/// Says what a part of the work in the folder `out` did.
pub(super) fn finish_part(store: &Store, out: &Path, session: &Session) {
    warn_of_damaged(store, session);
    let [made, found] = store.counts();
    session.ui.note(&format!("{}: {made} results made, {found} found", out.display()));
}
