//! Writes a file so that a reader sees either the old file or the complete new one.
//!
//! The bytes go to a temporary file in the same folder, which is synced and then renamed. Standard output,
//! devices and pipes are written directly.

use std::fs::OpenOptions;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

use super::target::{Content, Target, failed, folder, target};
use super::temporary::Temporary;
use drape::error::{Error, Kind, Result};

/// Writes `bytes` to `path` as one complete file.
///
/// # Errors
/// [`Kind::Io`] when the folder is missing or not writable or the disk is full; no new file is
/// left and an old one is unchanged. [`Kind::Signal`] when the reader of a pipe has closed it.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    match target(path)? {
        Target::Stdout => write_stdout(bytes),
        Target::Stream(stream) => {
            let written = OpenOptions::new().write(true).open(stream).and_then(|mut f| f.write_all(bytes));
            written.map_err(|e| failed(path, &e))
        }
        Target::File(file) => replace(&file, bytes).map_err(|e| failed(path, &e)),
    }
}

/// Writes `bytes` to standard output and flushes it.
///
/// # Errors
/// As [`write()`].
pub(crate) fn write_stdout(bytes: &[u8]) -> Result<()> {
    let mut stdout = io::stdout().lock();
    let written = stdout.write_all(bytes).and_then(|()| stdout.flush());
    written.map_err(|e| failed(Path::new("standard output"), &e))
}

/// Checks, before long work, that [`write()`] can succeed at `path`. Changes nothing.
///
/// # Errors
/// [`Kind::Io`] when the folder is missing or not writable or `path` is a folder;
/// [`Kind::Usage`] when binary content would go to a terminal.
pub(crate) fn check_writable(path: &Path, content: Content) -> Result<()> {
    match target(path)? {
        Target::Stdout if content == Content::Binary && io::stdout().is_terminal() => {
            Err(Error::new(Kind::Usage, "binary data is not written to a terminal")
                .with_help("redirect standard output, or name a file instead of `-`"))
        }
        Target::Stdout | Target::Stream(_) => Ok(()),
        Target::File(file) => probe(&file).map_err(|e| failed(path, &e)),
    }
}

fn probe(file: &Path) -> io::Result<()> {
    if file.exists() {
        OpenOptions::new().write(true).open(file)?;
    }
    tempfile::tempfile_in(folder(file)).map(drop)
}

fn replace(file: &Path, bytes: &[u8]) -> io::Result<()> {
    let temporary = Temporary::beside(file)?;
    temporary.as_file().write_all(bytes)?;
    temporary.persist(file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn names(dir: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(dir)
            .unwrap()
            .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_new_and_an_old_file_get_the_bytes_and_nothing_else_stays() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("out.bin");
        write(&file, b"first, longer").unwrap();
        write(&file, b"second").unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"second");
        assert_eq!(names(dir.path()), ["out.bin"]);
    }

    #[test]
    fn the_probe_leaves_no_trace() {
        let dir = tempfile::tempdir().unwrap();
        check_writable(&dir.path().join("new"), Content::Binary).unwrap();
        assert!(names(dir.path()).is_empty());
        let old = dir.path().join("old");
        fs::write(&old, "kept").unwrap();
        check_writable(&old, Content::Binary).unwrap();
        assert_eq!(fs::read(&old).unwrap(), b"kept");
    }

    #[test]
    fn a_missing_folder_and_a_folder_are_named_by_probe_and_write() {
        let dir = tempfile::tempdir().unwrap();
        let missing = dir.path().join("no/such/out.png");
        let slash = dir.path().join("new/");
        for path in [missing.as_path(), dir.path(), slash.as_path()] {
            for result in [check_writable(path, Content::Text), write(path, b"x")] {
                let error = result.unwrap_err();
                assert_eq!(error.kind, Kind::Io);
                assert!(error.message.contains(&*path.to_string_lossy()), "{error}");
                assert!(!error.help.is_empty(), "{error}");
            }
        }
        assert!(names(dir.path()).is_empty());
    }

    #[test]
    fn a_failed_rename_leaves_no_temporary_file() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("out");
        // As if the target became a folder while the temporary file was written.
        fs::create_dir(&file).unwrap();
        fs::write(file.join("inside"), "kept").unwrap();
        assert!(replace(&file, b"new").is_err());
        assert_eq!(names(dir.path()), ["out"]);
        assert_eq!(fs::read(file.join("inside")).unwrap(), b"kept");
    }

    #[cfg(unix)]
    #[test]
    fn links_keep_pointing_at_the_file_that_is_written() {
        let dir = tempfile::tempdir().unwrap();
        let (real, link) = (dir.path().join("real"), dir.path().join("link"));
        std::os::unix::fs::symlink("real", &link).unwrap();
        for bytes in [b"made", b"more"] {
            write(&link, bytes).unwrap();
            assert_eq!(fs::read(&real).unwrap(), bytes);
            assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        }
        let ring = dir.path().join("ring");
        std::os::unix::fs::symlink("ring", &ring).unwrap();
        assert_eq!(check_writable(&ring, Content::Text).unwrap_err().kind, Kind::Io);
    }

    #[cfg(unix)]
    #[test]
    fn permissions_are_those_of_any_new_file_or_of_the_old_one() {
        use std::os::unix::fs::PermissionsExt;
        let dir = tempfile::tempdir().unwrap();
        let (file, plain) = (dir.path().join("out"), dir.path().join("plain"));
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
        fs::write(&plain, "x").unwrap();
        write(&file, b"x").unwrap();
        assert_eq!(mode(&file), mode(&plain));
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        write(&file, b"y").unwrap();
        assert_eq!(mode(&file), 0o640);
    }

    #[cfg(unix)]
    #[test]
    fn a_pipe_is_written_and_not_replaced() {
        let dir = tempfile::tempdir().unwrap();
        let pipe = dir.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let (sender, received) = std::sync::mpsc::channel();
        let from = pipe.clone();
        std::thread::spawn(move || sender.send(fs::read(from).unwrap()));
        std::thread::spawn(move || {
            check_writable(&pipe, Content::Binary).unwrap();
            write(&pipe, b"through").unwrap();
        });
        // The reader of a pipe that was replaced would wait for ever.
        let bytes = received.recv_timeout(std::time::Duration::from_secs(10));
        assert_eq!(bytes, Ok(b"through".to_vec()));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_device_is_an_error() {
        let error = write(Path::new("/dev/full"), b"x").unwrap_err();
        assert_eq!(error.kind, Kind::Io);
        write(Path::new("/dev/null"), b"x").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file(), "a device is never replaced");
    }
}
