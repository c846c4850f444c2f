//! The argument for what a file says of itself.

use clap::ValueEnum;

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
    /// What the file says of itself, for `drape verify`
    #[arg(long, value_name = "WHAT", default_value = "scene")]
    provenance: Detail,
}

impl ProvenanceArgs {
    /// What a file of the scene in `loaded` says of itself; `arguments` is what is shown of it.
    pub(crate) fn of(&self, loaded: &Loaded, arguments: Arguments) -> Provenance {
        self.provenance.of(loaded, arguments)
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
