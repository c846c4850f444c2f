//! A temporary file beside the file that it becomes.
//!
//! It is locked as long as it is in use, by which a later run tells the file of a process that was killed from that of
//! a process that runs: [`Temporary::beside`] removes what dead processes have left in the folder.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use tempfile::NamedTempFile;

use super::target::folder;
use crate::session::leftovers::{self, Leftover, Listed, locked};

/// How the names of temporary files begin, and how many letters and digits follow.
const PREFIX: &str = ".drape-";
const RANDOM: usize = 6;

/// A temporary file, removed when it is dropped or the process is stopped.
#[derive(Debug)]
pub(crate) struct Temporary {
    file: NamedTempFile,
    _listed: Listed,
}

impl Temporary {
    /// An empty file next to `file`, with the permissions that `file` has or would be created with.
    pub(crate) fn beside(file: &Path) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let temporary = Self::create(&mut builder, folder(file))?;
        if let Ok(old) = File::open(file).and_then(|f| f.metadata()) {
            temporary.as_file().set_permissions(old.permissions())?;
        }
        Ok(temporary)
    }

    /// An empty file in the system's folder for temporary files, which only this user can read.
    pub(crate) fn in_system_folder() -> io::Result<Self> {
        Self::create(&mut tempfile::Builder::new(), &std::env::temp_dir())
    }

    fn create(builder: &mut tempfile::Builder<'_, '_>, folder: &Path) -> io::Result<Self> {
        remove_of_dead_processes(folder);
        loop {
            let file = builder.prefix(PREFIX).rand_bytes(RANDOM).tempfile_in(folder)?;
            let listed = leftovers::list(Leftover::File(file.path().to_owned()));
            // Where a file system has no locks, nothing is removed either.
            let locked = file.as_file().lock().is_ok();
            // Before it was locked, another process may have taken it for one of a dead process.
            if !locked || file.path().exists() {
                return Ok(Self { file, _listed: listed });
            }
        }
    }

    /// The open file.
    pub(crate) fn as_file(&self) -> &File {
        self.file.as_file()
    }

    /// Its path.
    pub(crate) fn path(&self) -> &Path {
        self.file.path()
    }

    /// The file opened once more.
    pub(crate) fn reopen(&self) -> io::Result<File> {
        self.file.reopen()
    }

    /// Syncs the complete file, gives it the name `file`, and syncs the folder, so that neither content nor name is
    /// lost with the power.
    pub(crate) fn persist(self, file: &Path) -> io::Result<()> {
        self.as_file().sync_all()?;
        self.file.persist(file).map_err(|e| e.error)?;
        sync_folder(folder(file))
    }
}

/// Syncs the names in a folder.
fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(not(unix)) {
        return Ok(());
    }
    match File::open(folder).and_then(|folder| folder.sync_all()) {
        // Some file systems cannot sync a folder, and one that may be written need not be readable.
        Err(e) if matches!(e.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) => Ok(()),
        Err(e) if e.kind() == io::ErrorKind::PermissionDenied => Ok(()),
        result => result,
    }
}

/// Removes the temporary files in `folder` that no process has locked, once in each folder.
fn remove_of_dead_processes(folder: &Path) {
    static DONE: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    if locked(&DONE).insert(folder.to_owned()) {
        clean(folder);
    }
}

fn clean(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if is_temporary(&entry.file_name().to_string_lossy())
            && entry.file_type().is_ok_and(|kind| kind.is_file())
        {
            remove_unlocked(&entry.path());
        }
    }
}

fn is_temporary(name: &str) -> bool {
    let random = name.strip_prefix(PREFIX);
    random.is_some_and(|random| random.len() == RANDOM && random.bytes().all(|b| b.is_ascii_alphanumeric()))
}

fn remove_unlocked(path: &Path) {
    if let Ok(file) = OpenOptions::new().write(true).open(path)
        && file.try_lock().is_ok()
    {
        // Removed under the lock: its maker, if it is just making it, finds it gone.
        let _ = fs::remove_file(path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_dead_processes_are_removed_and_those_in_use_stay() {
        let dir = tempfile::tempdir().unwrap();
        let at = |name: &str| dir.path().join(name);
        let used = Temporary::beside(&at("a")).unwrap();
        for name in [".drape-dead00", ".drape-settings", ".drape-a.json", "drape-kept01"] {
            fs::write(at(name), "x").unwrap();
        }
        fs::create_dir(at(".drape-folder")).unwrap();
        clean(dir.path());
        let there = |name: &str| at(name).exists();
        assert!(used.path().exists() && !there(".drape-dead00"));
        assert!([".drape-settings", ".drape-a.json", "drape-kept01", ".drape-folder"].into_iter().all(there));
        used.persist(&at("a")).unwrap();
        assert!(there("a"));
    }
}
