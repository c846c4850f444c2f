//! Pictures made by the real program.

use std::path::{Path, PathBuf};
use std::process::Command;

use drape::output::png::{self, Pixels};

/// A picture to draw: its name, the file in `scenes/`, and arguments of `render`.
pub(crate) type Case = (&'static str, &'static str, &'static str);

/// The top folder of the repository.
pub(crate) fn repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Draws `case` with `threads` threads into `file` and reads it back.
///
/// # Errors
/// What the program said when it failed, or why the picture cannot be read.
pub(crate) fn draw(case: Case, threads: usize, file: &Path) -> Result<Pixels, String> {
    let (_, scene, arguments) = case;
    let output = Command::new(assert_cmd::cargo::cargo_bin!("drape"))
        .current_dir(repository())
        .arg("render")
        .arg(repository().join("scenes").join(scene))
        .arg(file)
        .args(arguments.split_whitespace())
        .args(["--quiet", "--threads", &threads.to_string()])
        .output()
        .map_err(|e| e.to_string())?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    png::read(file).map_err(|e| e.to_string())
}
