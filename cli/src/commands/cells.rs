//! The store of finished results that commands keep in the folder of their output.

use std::path::Path;

use crate::session::Session;
use crate::session::files::atomic;
use drape::error::Result;
use drape_lab::store::Store;

/// The store in the folder `out`, whose parents are created where they are missing.
pub(super) fn open(out: &Path) -> Result<Store> {
    Store::new(&out.join("cells"), atomic::write)
}

/// Fails once the command has to end, of work that goes on where it was.
///
/// # Errors
/// As [`Stop::check`](crate::session::stop::Stop::check).
pub(super) fn check_stop(session: &Session) -> Result<()> {
    session.stop.check_keeping("finished results")
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
