//! The argument for what a file says of itself.

use std::path::Path;

use clap::ValueEnum;

use crate::session::ui::Ui;
use drape::output::provenance::{Arguments, Provenance};
use drape::scene::Loaded;

/// How much a file says of itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Detail {
    /// Version, hashes, what options changed, and the scene itself: `drape verify FILE` needs nothing else
    Scene,
    /// The same without the scene: `drape verify FILE SCENE` needs its file
    Hashes,
    /// As `scene`, and the command line as it was typed, with the paths in it
    Command,
}

/// What a file says of itself.
#[derive(clap::Args)]
pub(crate) struct ProvenanceArgs {
    /// What the file says of itself, for `drape verify` (default: scene)
    #[arg(long, value_name = "WHAT")]
    provenance: Option<Detail>,
}

impl ProvenanceArgs {
    /// What a file of the scene in `loaded` says of itself; `arguments` is what is shown of it.
    pub(crate) fn of(&self, loaded: &Loaded, arguments: Arguments) -> Provenance {
        self.provenance.unwrap_or(Detail::Scene).of(loaded, arguments)
    }

    /// Warns that the option has no effect, if it is given where no file is written.
    pub(crate) fn caution_of_no_file(&self, ui: &Ui) {
        if self.provenance.is_some() {
            ui.caution("--provenance has no effect: no file is written that it could stand in", "");
        }
    }

    /// Warns that the option has no effect, if it is given and `path` has no place for what a file says.
    pub(crate) fn caution(&self, path: &Path, has_place: bool, ui: &Ui) {
        if self.provenance.is_some() && !has_place {
            let message = format!("--provenance has no effect: `{}` has no place for it", path.display());
            ui.caution(&message, "PNG, animated PNG, GIF and .glb files have one");
        }
    }
}

impl Detail {
    /// As [`ProvenanceArgs::of`].
    pub(crate) fn of(self, loaded: &Loaded, arguments: Arguments) -> Provenance {
        let all = Provenance::new(loaded, arguments);
        match self {
            Self::Scene => all,
            Self::Hashes => Provenance { scene_json: None, ..all },
            Self::Command => Provenance { command: Some(command_line()), ..all },
        }
    }
}

/// The words of the command line.
fn command_line() -> Vec<String> {
    let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    ["drape".to_owned()].into_iter().chain(words).collect()
}
