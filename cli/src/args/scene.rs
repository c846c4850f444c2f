//! The arguments for a scene: its file, changes to it, and the moment to simulate to.

use std::path::PathBuf;

use super::flag::seconds;
use super::frames::frame;
use crate::run::advance::Until;
use crate::session::Session;
use crate::session::ui::Ui;
use drape::error::{Error, Kind, Result};
use drape::scene::{self, Flag, Loaded, Overrides, Scene};
use drape_lab::page::live::Live;

/// A scene file and changes to it.
#[derive(clap::Args)]
pub(crate) struct SceneArgs {
    /// The scene file (JSON); `-` for standard input
    #[arg(value_name = "SCENE")]
    pub(crate) path: PathBuf,
    #[command(flatten)]
    changes: Changes,
}

/// Changes to a scene file.
#[derive(clap::Args)]
pub(crate) struct Changes {
    /// Change the scene by a JSON merge patch (RFC 7396); repeatable. Patches are applied before --set
    #[arg(long = "patch", value_name = "FILE")]
    patches: Vec<PathBuf>,
    /// Change one value of the scene, such as cloth.ks=500; repeatable. Quote brackets: 'light.color=[1,0,0]'
    #[arg(long = "set", value_name = "PATH=JSON")]
    sets: Vec<String>,
}

impl SceneArgs {
    /// Reads the scene and prints its warnings.
    pub(crate) fn load(&self, session: &Session) -> Result<Scene> {
        self.load_with_flags(&[], session).map(|loaded| loaded.scene)
    }

    /// As [`SceneArgs::load`], with the changes of `flags`; also the scene without any changes.
    pub(crate) fn load_with_flags(&self, flags: &[Flag], session: &Session) -> Result<Loaded> {
        let loaded = scene::load(&self.path, &self.changes.with(flags))?;
        loaded.warnings.iter().for_each(|warning| session.ui.warn(warning));
        Ok(loaded)
    }

    /// The changes as the loader takes them.
    pub(crate) fn overrides(&self) -> Overrides {
        self.changes.overrides()
    }

    /// Reads the scene with `sets` as further changes; its warnings are not printed again.
    pub(crate) fn load_with(&self, sets: &[&str]) -> Result<Scene> {
        let mut overrides = self.changes.overrides();
        overrides.sets.extend(sets.iter().map(|&set| set.to_owned()));
        scene::load(&self.path, &overrides).map(|loaded| loaded.scene)
    }

    /// Reads a scene file that is built into the program, by its path in the repository, with the changes of
    /// `flags`.
    pub(crate) fn load_stock(&self, flags: &[Flag]) -> Result<Loaded> {
        scene::load_stock(&self.path, &self.changes.with(flags))
    }

    /// The live page at `url` with this scene and its changes in every link.
    ///
    /// # Errors
    /// [`Kind::Io`] when the file cannot be read; [`Kind::Usage`] with patches, which a link cannot hold.
    pub(crate) fn live(&self, url: &str) -> Result<Live> {
        if !self.changes.patches.is_empty() {
            return Err(Error::new(Kind::Usage, "a link to the live page cannot hold a --patch")
                .with_help("put the changes into the scene file, or use --set"));
        }
        let text = scene::read_text(&self.path)?;
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        let sets = self.changes.sets.iter().map(|set| ("set", set.as_str()));
        let scene = [("scene", name.as_ref()), ("text", text.as_str())];
        Ok(Live::at(url).with(scene.into_iter().chain(sets)))
    }

    /// The arguments of `--set`.
    pub(super) fn sets(&self) -> &[String] {
        &self.changes.sets
    }

    /// Whether the scene is changed by options.
    pub(crate) fn is_changed(&self) -> bool {
        !self.changes.sets.is_empty() || !self.changes.patches.is_empty()
    }

    /// Every file that [`SceneArgs::load`] reads.
    pub(crate) fn inputs(&self) -> Vec<PathBuf> {
        let files = [&self.path].into_iter().chain(&self.changes.patches);
        files.filter(|path| path.as_os_str() != "-").cloned().collect()
    }
}

impl Changes {
    /// The changes as the loader takes them.
    pub(crate) fn overrides(&self) -> Overrides {
        self.with(&[])
    }

    /// The changes, and then those of `flags`.
    fn with(&self, flags: &[Flag]) -> Overrides {
        Overrides { patches: self.patches.clone(), sets: self.sets.clone(), flags: flags.to_vec() }
    }
}

/// The moment to simulate to.
#[derive(clap::Args)]
pub(crate) struct Moment {
    /// Simulated time in seconds, rounded to the nearest frame (default: the scene's render.time)
    #[arg(long, value_name = "S", value_parser = seconds, conflicts_with = "frame")]
    time: Option<f64>,
    /// Number of the frame, instead of --time; 0 is the start
    #[arg(long, value_name = "N", value_parser = frame)]
    frame: Option<u64>,
    /// Simulate until the cloth is at rest, at most until --time or --frame (default: 60 s). If it is not at rest by
    /// then, the results are written and the exit code is 1
    #[arg(long)]
    until_rest: bool,
    #[command(flatten)]
    pub(crate) stability: StabilityArgs,
}

/// The default limit of `--until-rest`, in simulated seconds.
pub(crate) const REST_TIME: f64 = 60.0;

/// Whether the checks for stability are errors.
#[derive(clap::Args)]
pub(crate) struct StabilityArgs {
    /// Simulate even if the step is too long for the springs, or the energy grows
    #[arg(long)]
    pub(crate) allow_unstable: bool,
}

impl Moment {
    /// Warns of a moment in the scene that the options replace.
    pub(crate) fn caution(&self, scene: &SceneArgs, ui: &Ui) {
        let options = [
            ("--time", self.time.is_some()),
            ("--frame", self.frame.is_some()),
            ("--until-rest", self.until_rest),
        ];
        scene.caution_of_moment(&options, ui);
    }

    /// The last frame, and whether the cloth must come to rest by then.
    pub(crate) fn until(&self, scene: &Scene) -> Until {
        let time = self.time.or(self.until_rest.then_some(REST_TIME));
        Until {
            frames: self.frame.unwrap_or_else(|| frame_at(time, scene)),
            rest: self.until_rest,
            ..Until::default()
        }
    }
}

/// The frame nearest to `time`, or to the scene's own time, in seconds.
pub(crate) fn frame_at(time: Option<f64>, scene: &Scene) -> u64 {
    let frame = time.unwrap_or(scene.render.time) * scene.sim.fps;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most 1e6 s * 1e9 a second"
    )]
    let frame = frame.round() as u64;
    frame
}
