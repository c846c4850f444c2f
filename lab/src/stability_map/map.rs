//! The map: a run for each stiffness, density and number of steps, and the bounds of each stiffness and
//! density.
//!
//! A bound is `steps a second = ω / limit`, with the limit at rest or at worst and ω² from 8 ks/m (the
//! fastest vibration of the lattice at rest), 12 ks/m (the fastest in any shape) or 17.6 ks/m
//! (Gershgorin's circles, which use nothing but the stiffness that meets in a point);
//! `src/diagnostics/stability.rs` derives the first two and the limit. Cells and columns do not depend on each
//! other: they are spread over threads, and the map is the same for every number of threads.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::outcome::{Run, run};
use super::threshold::{at_rest, frames, in_motion};
use crate::store::{Store, key};
use drape::cloth::springs::SpringKind;
use drape::diagnostics::stability::Stability;
use drape::error::Result;
use drape::scene::{Cloth, Scene};

/// The values of a map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axes {
    /// Stiffness of structural and shearing springs, in N/m, rising.
    pub ks: Vec<f64>,
    /// Mass per area, in kg/m², rising.
    pub density: Vec<f64>,
    /// Steps per frame, rising.
    pub steps: Vec<u32>,
    /// Simulated time of each run, in seconds.
    pub time: f64,
}

/// One run of the map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// In kg/m².
    pub density: f64,
    /// In N/m.
    pub ks: f64,
    /// Steps per frame.
    pub steps: u32,
    /// The result.
    #[serde(flatten)]
    pub run: Run,
}

/// The steps a second from which a stiffness and density is stable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// In kg/m².
    pub density: f64,
    /// In N/m.
    pub ks: f64,
    /// Steps a second by theory: at rest, at worst, and by Gershgorin.
    pub theory: [f64; 3],
    /// Steps a second found by bisection at rest ([`at_rest`]).
    pub at_rest: Option<f64>,
    /// Steps a second found by bisection in motion ([`in_motion`]).
    pub in_motion: Option<f64>,
}

/// A finished map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Map {
    /// The values that were run.
    pub axes: Axes,
    /// Frames per second of the scene.
    pub fps: f64,
    /// By density, then stiffness, then steps.
    pub cells: Vec<Cell>,
    /// By density, then stiffness.
    pub columns: Vec<Column>,
}

impl Axes {
    /// The pieces of the map: a cell or a column each.
    pub fn pieces(&self) -> usize {
        self.density.len() * self.ks.len() * (self.steps.len() + 1)
    }

    /// Every density with every stiffness and number of steps.
    fn runs(&self) -> Vec<([f64; 2], u32)> {
        self.materials().flat_map(|material| self.steps.iter().map(move |&steps| (material, steps))).collect()
    }

    /// Every density with every stiffness.
    fn materials(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.density.iter().flat_map(|&density| self.ks.iter().map(move |&ks| [density, ks]))
    }
}

impl Map {
    /// The map of `axes` with the other values of `scene`, whose cloth is `cloth`: runs the cells and columns that
    /// `store` does not have. `done` is called after each of them, from any thread, and can end the work with an error.
    ///
    /// # Errors
    /// Those of `done`, of the store and of [`drape::simulation::Simulation::new`].
    pub fn new(
        scene: &Scene,
        cloth: &Cloth,
        axes: Axes,
        store: &Store,
        done: &(dyn Fn() -> Result<()> + Sync),
    ) -> Result<Self> {
        let materials: Vec<[f64; 2]> = axes.materials().collect();
        let columns = materials.par_iter().map(|&material| {
            let column = Column::kept(scene, cloth, material, axes.time, store)?;
            done().map(|()| column)
        });
        let columns = columns.collect::<Result<_>>()?;
        let cells = axes.runs().into_par_iter().map(|(material, steps)| {
            let cell = Cell::kept(scene, cloth, material, steps, axes.time, store)?;
            done().map(|()| cell)
        });
        let cells = cells.collect::<Result<_>>()?;
        Ok(Self { fps: scene.sim.fps, cells, columns, axes })
    }

    /// Runs the pieces that `takes` accepts by their number, from 0, and that `store` does not have.
    ///
    /// # Errors
    /// As [`Map::new`].
    pub fn share(
        scene: &Scene,
        cloth: &Cloth,
        axes: &Axes,
        store: &Store,
        takes: &(dyn Fn(u64) -> bool + Sync),
        done: &(dyn Fn() -> Result<()> + Sync),
    ) -> Result<()> {
        let materials: Vec<[f64; 2]> = axes.materials().collect();
        let columns = (0_u64..).zip(materials).collect::<Vec<_>>();
        let cells = (columns.len() as u64..).zip(axes.runs()).collect::<Vec<_>>();
        columns.into_par_iter().filter(|(number, _)| takes(*number)).try_for_each(|(_, material)| {
            Column::kept(scene, cloth, material, axes.time, store)?;
            done()
        })?;
        cells.into_par_iter().filter(|(number, _)| takes(*number)).try_for_each(|(_, (material, steps))| {
            Cell::kept(scene, cloth, material, steps, axes.time, store)?;
            done()
        })
    }

    /// The cells of one density, by stiffness, then steps.
    pub fn panel(&self, density: f64) -> impl Iterator<Item = &Cell> {
        self.cells.iter().filter(move |cell| cell.density == density)
    }
}

impl Cell {
    /// The cell in `store`, or one that is run and put there.
    fn kept(
        scene: &Scene,
        cloth: &Cloth,
        material: [f64; 2],
        steps: u32,
        time: f64,
        store: &Store,
    ) -> Result<Self> {
        let key = key("stability cell", &(scene, material, steps, time));
        store.kept(key, || Self::new(scene, cloth, material, steps, time))
    }

    fn new(scene: &Scene, cloth: &Cloth, material: [f64; 2], steps: u32, time: f64) -> Result<Self> {
        let mut scene = made_of(scene, cloth, material);
        scene.sim.steps_per_frame = steps;
        let run = run(&scene, frames(time, scene.sim.fps))?;
        let [density, ks] = material;
        Ok(Self { density, ks, steps, run })
    }
}

impl Column {
    /// The column in `store`, or one that is found and put there.
    fn kept(scene: &Scene, cloth: &Cloth, material: [f64; 2], time: f64, store: &Store) -> Result<Self> {
        let key = key("stability column", &(scene, material, time));
        store.kept(key, || Self::new(scene, cloth, material, time))
    }

    fn new(scene: &Scene, cloth: &Cloth, material: [f64; 2], time: f64) -> Result<Self> {
        let scene = made_of(scene, cloth, material);
        let cloth = scene.cloth.as_ref().unwrap_or(cloth);
        let Stability { omega_rest, omega_safe, limit, limit_worst, mass, .. } =
            Stability::new(cloth, &scene.sim)?;
        let omega_gershgorin = (gershgorin(cloth) / mass).sqrt();
        let [density, ks] = material;
        Ok(Self {
            density,
            ks,
            theory: [omega_rest / limit, omega_safe / limit_worst, omega_gershgorin / limit_worst],
            at_rest: at_rest(&scene, cloth)?,
            in_motion: in_motion(&scene, cloth, time)?,
        })
    }
}

/// `scene` with `cloth` of another density and stiffness.
fn made_of(scene: &Scene, cloth: &Cloth, [density, ks]: [f64; 2]) -> Scene {
    Scene { cloth: Some(Cloth { density, ks, ..cloth.clone() }), ..scene.clone() }
}

/// Twice the stiffness that meets in a point with every spring, in N/m: 17.6 ks for all kinds.
fn gershgorin(cloth: &Cloth) -> f64 {
    let kinds = SpringKind::ALL.into_iter().filter(|kind| kind.is_enabled(cloth));
    2.0 * cloth.ks * kinds.map(|kind| 4.0 * kind.relative_stiffness()).sum::<f64>()
}
