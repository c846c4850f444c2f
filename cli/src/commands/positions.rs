//! `--positions`: the points of one frame or of many, as raw numbers or for numpy.

use std::path::{Path, PathBuf};

use crate::animation::pattern::Pattern;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use drape::error::Result;
use drape::output::raw;
use drape::scene::Scene;
use drape::simulation::Simulation;
use drape_lab::npy;

/// Where positions are written.
#[derive(clap::Args)]
pub(super) struct PositionsArgs {
    /// Write the last positions to this file: x y z of each point, row by row, f64 little-endian (`-` for standard
    /// output); with the ending .npy in numpy's format, as an array of shape (rows, columns, 3). A name with %04d in
    /// it, such as dump/%04d.npy, means a file for each frame from the start on, numbered by frame
    #[arg(long, value_name = "FILE")]
    pub(super) positions: Option<PathBuf>,
    /// With %04d in --positions, write only every Nth frame
    #[arg(long, value_name = "N", default_value_t = 1, requires = "positions",
          value_parser = clap::value_parser!(u64).range(1..))]
    every: u64,
}

impl PositionsArgs {
    /// The names of the files, if each frame has one.
    fn pattern(&self) -> Option<Pattern> {
        self.positions.as_deref().and_then(Pattern::parse)
    }

    /// The file that is written first.
    ///
    /// # Errors
    /// [`drape::error::Kind::Io`] when the folder of numbered files cannot be made.
    pub(super) fn output(&self) -> Result<Option<(PathBuf, Content)>> {
        let Some(pattern) = self.pattern() else {
            return Ok(self.positions.clone().map(|path| (path, Content::Binary)));
        };
        if !pattern.folder().as_os_str().is_empty() {
            outputs::make_folder(pattern.folder())?;
        }
        Ok(Some((pattern.path(0), Content::Binary)))
    }

    /// Writes the positions after a frame, where each has a file.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(super) fn after_frame(&self, scene: &Scene, simulation: &Simulation) -> Result<()> {
        let frame = simulation.frame();
        match self.pattern() {
            Some(pattern) if frame.is_multiple_of(self.every) => {
                write(&pattern.path(frame), scene, simulation)
            }
            _ => Ok(()),
        }
    }

    /// Writes the last positions, where there is one file.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(super) fn finish(&self, scene: &Scene, simulation: &Simulation) -> Result<()> {
        match &self.positions {
            Some(path) if self.pattern().is_none() => write(path, scene, simulation),
            _ => Ok(()),
        }
    }
}

fn write(path: &Path, scene: &Scene, simulation: &Simulation) -> Result<()> {
    let points = simulation.positions();
    let numpy = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npy"));
    let bytes = if numpy {
        let grid =
            scene.cloth.as_ref().map_or([0, 0], |cloth| [cloth.num_width_points, cloth.num_height_points]);
        npy::encode(points, grid)
    } else {
        raw::points(&points.x, &points.y, &points.z)
    };
    atomic::write(path, &bytes)
}
