//! `--positions`: the points of one frame or of many, as raw numbers or for numpy.

use std::path::{Path, PathBuf};

use crate::animation::pattern::Pattern;
use crate::args::provenance::Detail;
use crate::session::files::atomic;
use crate::session::files::numbered::one;
use crate::session::files::outputs;
use crate::session::files::target::{Content, is_stdout};
use crate::session::ui::Ui;
use drape::error::{Error, Kind, Result};
use drape::output::provenance::{Arguments, Provenance};
use drape::output::raw;
use drape::scene::{Loaded, Scene};
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
    /// Write beside each file of positions, as FILE.json, of what it is. The formats have no place for it
    #[arg(long, value_name = "WHAT", requires = "positions")]
    provenance: Option<Detail>,
}

impl PositionsArgs {
    /// The names of the files, if each frame has one.
    ///
    /// # Errors
    /// As [`Pattern::parse`].
    fn pattern(&self) -> Result<Option<Pattern>> {
        self.positions.as_deref().map_or(Ok(None), Pattern::parse)
    }

    /// The one file, if the frames have none each.
    ///
    /// # Errors
    /// As [`one`].
    fn file(&self) -> Result<Option<PathBuf>> {
        self.positions.as_deref().map(one).transpose()
    }

    /// What each file says of itself, if that was asked for.
    ///
    /// # Errors
    /// [`Kind::Usage`] when there is nothing that it could stand beside.
    pub(super) fn provenance(&self, loaded: &Loaded) -> Result<Option<Provenance>> {
        if self.provenance.is_some() && self.positions.as_deref().is_some_and(is_stdout) {
            let message = "--provenance writes beside a file, and standard output is none";
            return Err(Error::new(Kind::Usage, message).with_help("name a file: --positions FILE"));
        }
        Ok(self.provenance.map(|detail| detail.of(loaded, Arguments::default())))
    }

    /// Warns of an option that changes nothing.
    pub(super) fn caution(&self, ui: &Ui) {
        if let (2.., Ok(Some(_))) = (self.every, self.file()) {
            ui.caution(
                "--every has no effect: --positions names one file, of the last frame",
                "a name with a place for a number, such as dump/%04d.npy, means a file for each frame",
            );
        }
    }

    /// The files that are written first.
    ///
    /// # Errors
    /// [`Kind::Io`] when the folder of numbered files cannot be made; as [`Pattern::parse`].
    pub(super) fn outputs(&self) -> Result<Vec<(PathBuf, Content)>> {
        let pattern = self.pattern()?;
        if let Some(pattern) = pattern.as_ref().filter(|pattern| !pattern.folder().as_os_str().is_empty()) {
            outputs::make_folder(pattern.folder())?;
        }
        let path = match pattern {
            Some(pattern) => Some(pattern.path(0)),
            None => self.file()?,
        };
        let Some(path) = path else { return Ok(Vec::new()) };
        let beside = self.provenance.map(|_| (beside(&path), Content::Text));
        Ok([(path, Content::Binary)].into_iter().chain(beside).collect())
    }

    /// Writes the positions after a frame, where each has a file.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(super) fn after_frame(
        &self,
        scene: &Scene,
        provenance: Option<&Provenance>,
        simulation: &Simulation,
    ) -> Result<()> {
        let frame = simulation.frame();
        match self.pattern()? {
            Some(pattern) if frame.is_multiple_of(self.every) => {
                write(&pattern.path(frame), scene, provenance, simulation)
            }
            _ => Ok(()),
        }
    }

    /// Writes the last positions, where there is one file; of many, warns of those that an earlier run has left.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(super) fn finish(
        &self,
        scene: &Scene,
        provenance: Option<&Provenance>,
        simulation: &Simulation,
        ui: &Ui,
    ) -> Result<()> {
        if let Some(pattern) = self.pattern()? {
            // Those of earlier frames belong to a run that this one may have gone on from.
            pattern.caution(|frame| frame > simulation.frame() || !frame.is_multiple_of(self.every), ui);
        } else if let Some(path) = self.file()? {
            write(&path, scene, provenance, simulation)?;
        }
        Ok(())
    }
}

fn write(path: &Path, scene: &Scene, provenance: Option<&Provenance>, simulation: &Simulation) -> Result<()> {
    let points = simulation.positions();
    let numpy = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npy"));
    let numbers = raw::points(&points.x, &points.y, &points.z);
    if let Some(provenance) = provenance {
        let mut said = provenance.of_content(simulation.state_hash(), &numbers);
        said.arguments.frame = Some(simulation.frame());
        atomic::write(&beside(path), (said.to_json().to_string() + "\n").as_bytes())?;
    }
    let grid =
        || scene.cloth.as_ref().map_or([0, 0], |cloth| [cloth.num_width_points, cloth.num_height_points]);
    atomic::write(path, &if numpy { npy::encode(points, grid()) } else { numbers })
}

/// The file beside `path`: `p.npy.json` for `p.npy`.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".json");
    name.into()
}
