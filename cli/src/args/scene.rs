//! The scene that a command works on: its file, changes from outside, and the moment.

use std::path::{Path, PathBuf};

use crate::run::advance::Until;
use crate::session::Session;
use drape::error::Result;
use drape::scene::{self, Overrides, Scene};

/// A scene file and changes to it.
#[derive(clap::Args)]
pub(crate) struct SceneArgs {
    /// The scene file (JSON)
    #[arg(value_name = "SCENE")]
    pub(crate) path: PathBuf,
    #[command(flatten)]
    changes: Changes,
}

/// Changes to a scene from outside its file.
#[derive(clap::Args)]
pub(crate) struct Changes {
    /// Change the scene by a JSON merge patch (RFC 7396), repeatable; patches come before sets
    #[arg(long = "patch", value_name = "FILE")]
    patches: Vec<PathBuf>,
    /// Change one value of the scene, such as cloth.ks=500, repeatable; quote what has brackets
    #[arg(long = "set", value_name = "PATH=JSON")]
    sets: Vec<String>,
}

impl SceneArgs {
    /// The scene; its warnings are told.
    pub(crate) fn load(&self, session: &Session) -> Result<Scene> {
        let loaded = scene::load(&self.path, &self.changes.overrides())?;
        loaded.warnings.iter().for_each(|warning| session.ui.warn(warning));
        Ok(loaded.scene)
    }

    /// The changes as the loader takes them.
    pub(crate) fn overrides(&self) -> Overrides {
        self.changes.overrides()
    }

    /// The scene changed further by `sets`; its warnings are not told again.
    pub(crate) fn load_with(&self, sets: &[&str]) -> Result<Scene> {
        let mut overrides = self.changes.overrides();
        overrides.sets.extend(sets.iter().map(|&set| set.to_owned()));
        scene::load(&self.path, &overrides).map(|loaded| loaded.scene)
    }

    /// The scene of the files built into the program, called as they are in the repository.
    pub(crate) fn load_stock(&self) -> Result<Scene> {
        scene::load_stock(&self.path, &self.changes.overrides()).map(|loaded| loaded.scene)
    }

    /// Every file that is read.
    pub(crate) fn inputs(&self) -> Vec<&Path> {
        [&self.path].into_iter().chain(&self.changes.patches).map(PathBuf::as_path).collect()
    }
}

impl Changes {
    /// The changes as the loader takes them.
    pub(crate) fn overrides(&self) -> Overrides {
        Overrides { patches: self.patches.clone(), sets: self.sets.clone() }
    }
}

/// A moment of the simulation.
#[derive(clap::Args)]
pub(crate) struct Moment {
    /// Simulated time in seconds, rounded to a frame (default: the scene's render.time)
    #[arg(long, value_name = "S", value_parser = seconds, conflicts_with = "frame")]
    time: Option<f64>,
    /// Frame number; 0 is the start
    #[arg(long, value_name = "N")]
    frame: Option<u64>,
    /// Go on until the cloth is at rest, at most to --time or --frame (default: 60 s); exit code 1, after the results, if it is not
    #[arg(long)]
    until_rest: bool,
    #[command(flatten)]
    pub(crate) leniency: Leniency,
}

/// Simulated time in which a cloth has to come to rest, in seconds.
pub(crate) const REST_TIME: f64 = 60.0;

/// Which checks are left out.
#[derive(clap::Args)]
pub(crate) struct Leniency {
    /// Simulate even a cloth whose steps are too large to be stable
    #[arg(long)]
    pub(crate) allow_unstable: bool,
}

impl Moment {
    /// The frame, or the last one in which the cloth may come to rest.
    pub(crate) fn until(&self, scene: &Scene) -> Until {
        let time = self.time.or(self.until_rest.then_some(REST_TIME));
        Until { frames: self.frame.unwrap_or_else(|| frame_at(time, scene)), rest: self.until_rest }
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

/// Reads a time with the bounds of `render.time`, in seconds.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|seconds| (0.0..=1e6).contains(seconds));
    number.ok_or_else(|| "a time is a number of seconds from 0 to 1000000".to_owned())
}
