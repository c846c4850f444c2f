//! Pictures made by the real program.

use std::path::{Path, PathBuf};
use std::process::Command;

use drape::output::png::{self, Pixels};
use serde_json::Value;

/// A picture to draw: its name, the file in `scenes/`, and arguments of `render`.
pub(crate) type Case = (&'static str, &'static str, &'static str);

/// The top folder of the repository.
pub(crate) fn repository() -> PathBuf {
    crate::repository::path("")
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

/// A picture of the gallery: its name, the hash of the cloth's state, the picture.
pub(crate) struct Figure {
    pub(crate) name: String,
    pub(crate) state: String,
    pub(crate) picture: Pixels,
}

/// Every picture of the gallery, 256 pixels wide, made with `threads` threads in `folder`.
///
/// # Errors
/// As [`draw`].
pub(crate) fn gallery(threads: usize, folder: &Path) -> Result<Vec<Figure>, String> {
    // Nothing of the repository is there: the scenes are those in the program.
    let output = Command::new(assert_cmd::cargo::cargo_bin!("drape"))
        .current_dir(folder)
        .args(["gallery", "out", "--pictures", "--size", "256x200", "--json"])
        .args(["--threads", &threads.to_string()])
        .output()
        .map_err(|e| e.to_string())?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    let summary: Value = serde_json::from_slice(&output.stdout).map_err(|e| e.to_string())?;
    let pictures = summary["pictures"].as_array().ok_or("no pictures")?;
    let text = |picture: &Value, key: &str| picture[key].as_str().unwrap_or_default().to_owned();
    let figure = |picture: &Value| {
        let name = text(picture, "name");
        let file = folder.join("out").join(format!("{name}.png"));
        let pixels = png::read(&file).map_err(|e| e.to_string())?;
        Ok(Figure { name, state: text(picture, "state_hash"), picture: pixels })
    };
    pictures.iter().map(figure).collect()
}
