//! Promise: whatever is wrong in a scene is named with its place, all of it at once, and nothing
//! that can be read makes the reader panic.

mod changes;
mod rendered;
mod text;
mod values;

use drape::error::{Diagnostic, Error};
use drape::scene::{Overrides, load_text};

/// A cloth that is valid.
const CLOTH: &str = r#""cloth": {"width": 1, "height": 1, "num_width_points": 5, "num_height_points": 5,
"thickness": 0, "orientation": 0, "damping": 0.2, "density": 150, "ks": 5000,
"enable_structural": true, "enable_shearing": true, "enable_bending": true}"#;

fn sets(sets: &[&str]) -> Overrides {
    Overrides { sets: sets.iter().map(ToString::to_string).collect(), ..Overrides::default() }
}

fn error(text: &str, set: &[&str]) -> Error {
    load_text("scene.json", text, &sets(set)).expect_err("the scene must be refused")
}

fn rendered(diagnostics: &[Diagnostic]) -> String {
    diagnostics.iter().map(|d| format!("{}\n\n", d.rendered)).collect()
}

/// `CODE LINE:COLUMN KEY` of every diagnostic.
fn summary(error: &Error) -> Vec<String> {
    error.diagnostics.iter().map(|d| format!("{} {}:{} {}", d.code, d.line, d.column, d.key)).collect()
}
