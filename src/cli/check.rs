//! `drape check`: everything that is wrong in scene files, nothing run.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::Session;
use super::scene::Changes;
use super::ui::paint;
use crate::error::{Diagnostic, Error, Kind, Result};
use crate::scene;

/// What `check` takes.
#[derive(clap::Args)]
pub(super) struct Args {
    /// The scene files (JSON)
    #[arg(value_name = "SCENE", required = true)]
    paths: Vec<PathBuf>,
    #[command(flatten)]
    changes: Changes,
}

/// What was found in all files.
#[derive(Serialize)]
struct Report {
    files: Vec<Findings>,
}

/// What was found in one file.
#[derive(Serialize)]
struct Findings {
    file: String,
    errors: Vec<Diagnostic>,
    warnings: Vec<Diagnostic>,
    /// Why the file could not be checked, if so.
    #[serde(skip_serializing_if = "Option::is_none")]
    failure: Option<String>,
    #[serde(skip)]
    kind: Option<Kind>,
}

/// Prints what was found; the worst of it decides the exit code.
pub(super) fn run(args: &Args, session: &Session) -> Result<()> {
    let mut files = Vec::new();
    for path in &args.paths {
        session.signals.check()?;
        files.push(check(path, &args.changes));
    }
    let colored = session.ui.color.applies(std::io::stdout().is_terminal());
    let text = files.iter().map(|file| file.text(colored)).collect::<String>();
    let count = files.iter().filter(|file| file.kind.is_some()).count();
    let worst = files.iter().filter_map(|file| file.kind).reduce(worse);
    let total = files.len();
    session.print(&Report { files }, &text)?;
    match worst {
        None => Ok(()),
        Some(kind) => Err(Error::new(kind, format!("{count} of {total} scenes are not valid"))),
    }
}

/// A wrong scene counts before a file that cannot be read.
fn worse(a: Kind, b: Kind) -> Kind {
    if a == Kind::Scene { a } else { b }
}

fn check(path: &Path, changes: &Changes) -> Findings {
    let mut findings = Findings {
        file: path.display().to_string(),
        errors: Vec::new(),
        warnings: Vec::new(),
        failure: None,
        kind: None,
    };
    match scene::load(path, &changes.overrides()) {
        Ok(loaded) => findings.warnings = loaded.warnings,
        Err(error) => {
            findings.kind = Some(error.kind);
            findings.failure = error.diagnostics.is_empty().then(|| error.to_string());
            findings.errors = error.diagnostics;
        }
    }
    findings
}

impl Findings {
    fn text(&self, colored: bool) -> String {
        let mut blocks: Vec<String> =
            self.errors.iter().chain(&self.warnings).map(|found| paint(&found.rendered, colored)).collect();
        blocks.extend(self.failure.as_ref().map(|failure| paint(&format!("error: {failure}"), colored)));
        if self.kind.is_none() {
            blocks.push(format!("{}: valid", self.file));
        }
        blocks.join("\n\n") + "\n"
    }
}
