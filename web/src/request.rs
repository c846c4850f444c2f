//! What the page asks to see: a scene with changes, as the command line takes them.

use std::path::{Path, PathBuf};

use drape::error::{Error, Kind, Result};
use drape::mesh::SpringKinds;
use drape::render::Options;
use drape::scene::{ColliderKind, Flag, Loaded, Overrides, load_stock, load_text};
use serde::Deserialize;

/// A scene and its changes.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Request {
    /// The name of a stock scene, such as `sphere`; with a text, the name of its file.
    pub(crate) scene: String,
    /// The text of a scene of the user's own.
    pub(crate) text: Option<String>,
    /// Built-in patches, such as `scenes/look/draped.json` (`--patch`).
    pub(crate) patches: Vec<String>,
    /// Changes `PATH=JSON` (`--set`).
    pub(crate) sets: Vec<String>,
    /// The shader of every object (`--shader`).
    pub(crate) shader: Option<String>,
    /// Width and height, such as `320x250` (`--size`).
    pub(crate) size: Option<String>,
    /// The springs that a wireframe shows, such as `structural,shearing` (`--springs`).
    pub(crate) springs: Option<String>,
    /// Whether the cloth may become unstable (`--allow-unstable`).
    pub(crate) allow_unstable: bool,
    /// Whether the energy ledger is recorded; the cloth moves as without.
    pub(crate) ledger: bool,
}

impl Request {
    /// Reads a request.
    ///
    /// # Errors
    /// [`Kind::Usage`] if it is none.
    pub(crate) fn parse(json: &str) -> Result<Self> {
        serde_json::from_str(json).map_err(|error| Error::new(Kind::Usage, error.to_string()))
    }

    /// The path of the scene file: in the repository, or the name of the user's own file.
    pub(crate) fn path(&self) -> String {
        match self.text {
            Some(_) => self.scene.clone(),
            None => format!("scenes/{}.json", self.scene),
        }
    }

    /// The scene with all changes.
    ///
    /// # Errors
    /// Those of the scene reader, as on the command line.
    pub(crate) fn read(&self) -> Result<Loaded> {
        let patches = self.patches.iter().map(PathBuf::from).collect();
        let overrides = Overrides { patches, sets: self.sets.clone(), flags: self.flags() };
        match &self.text {
            Some(text) => load_text(&self.path(), text, &overrides),
            None => load_stock(Path::new(&self.path()), &overrides),
        }
    }

    /// What is asked of the picture besides the scene.
    ///
    /// # Errors
    /// [`Kind::Usage`] if there are no springs of a name.
    pub(crate) fn options(&self) -> Result<Options> {
        let springs = self.springs.as_deref().map(spring_kinds).transpose()?;
        Ok(Options { springs, ..Options::default() })
    }

    fn flags(&self) -> Vec<Flag> {
        let shader = self.shader.iter().flat_map(|shader| {
            let objects = ["cloth"].into_iter().chain(ColliderKind::ALL.iter().map(|kind| kind.key()));
            objects.map(move |object| Flag {
                name: "--shader",
                set: format!("{object}.*.material.shader={shader}"),
            })
        });
        let list = |size: &String| format!("render.size=[{}]", size.replace('x', ","));
        let size = self.size.iter().map(|size| Flag { name: "--size", set: list(size) });
        shader.chain(size).collect()
    }
}

fn spring_kinds(text: &str) -> Result<SpringKinds> {
    let mut kinds = SpringKinds { structural: false, shearing: false, bending: false };
    for name in text.split(',') {
        *match name {
            "structural" => &mut kinds.structural,
            "shearing" => &mut kinds.shearing,
            "bending" => &mut kinds.bending,
            _ => {
                let message = format!("`{name}` is not structural, shearing or bending");
                return Err(Error::new(Kind::Usage, message));
            }
        } = true;
    }
    Ok(kinds)
}
