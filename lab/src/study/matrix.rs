//! The matrix of runs: method × steps per second × stiffness.

use super::extent::Extent;
use super::method::{LARGE_STEPS, METHODS, Rates, run_name};
use super::rates::{clock, rates_around, springs_in};
use crate::accuracy::source::Source;
use drape::cloth::Params;
use drape::diagnostics::stability::Stability;
use drape::error::{Error, Kind, Result};
use drape::scene::{Integrator, Scene};

/// The cells of one stiffness.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Mass per area, in kg/m².
    pub density: f64,
    /// The density as a fraction of the scene's.
    pub part: f64,
    /// Stiffness of a structural spring over the mass of a point, in 1/s².
    pub k_over_m: f64,
    /// The fewest steps per second that are stable at worst: in every shape of the cloth.
    pub stable_rate: f64,
    /// The cells, method by method, in order of their steps.
    pub cells: Vec<Cell>,
    /// Steps per second of the reference's first run: the most of any cell, whether or not it is selected.
    pub finest: u32,
    /// The changes that turn the scene into the model at this density, without the steps.
    pub sets: Vec<String>,
}

/// One run of the matrix.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Index of the method in [`METHODS`].
    pub method: usize,
    /// Steps per second.
    pub rate: u32,
    /// The scene to run.
    pub scene: Scene,
}

impl Panel {
    /// The name of a cell, such as `k/m 8.33e4: BDF2 at 600 steps/s`.
    pub fn name(&self, cell: &Cell) -> String {
        format!("k/m {:.2e}: {}", self.k_over_m, run_name(cell.method, cell.rate))
    }

    /// The cloth compared with the scene's: `the scene's cloth`, or `1/1000 of the scene's density`.
    pub fn cloth(&self) -> String {
        if self.part == 1.0 {
            return "the scene's cloth".to_owned();
        }
        format!("1/{:.0} of the scene's density", 1.0 / self.part)
    }

    /// Whether `text` selects a cell: it is part of the cell's name, in upper or lower case, or the name of
    /// its integrator.
    fn is_selected(&self, cell: &Cell, text: &str) -> bool {
        let text = text.to_lowercase();
        self.name(cell).to_lowercase().contains(&text) || cell.scene.sim.integrator.name() == text
    }

    /// Keeps the cells that one of `texts` selects.
    fn select(&mut self, texts: &[String]) {
        let mut cells = std::mem::take(&mut self.cells);
        cells.retain(|cell| texts.iter().any(|text| self.is_selected(cell, text)));
        self.cells = cells;
    }
}

/// The panels of `source`; one whose reference would take too long has no cells. Where [`Extent::only`]
/// selects runs, panels without any of them are left out.
///
/// # Errors
/// [`Kind::Nothing`] when the scene has no cloth, [`Kind::Usage`] when no run is selected; otherwise
/// as [`Source::scene`].
pub fn panels(source: &Source, extent: &Extent) -> Result<Vec<Panel>> {
    let scene = source.scene(&[])?;
    let Some(cloth) = &scene.cloth else {
        return Err(Error::new(Kind::Nothing, "the scene has no cloth to study"));
    };
    let panels =
        extent.densities.iter().map(|part| panel(source, &scene, [cloth.density * part, *part], extent));
    let mut panels = panels.collect::<Result<Vec<_>>>()?;
    if let Some([part, of]) = extent.part {
        let mut numbers = 0..;
        panels
            .iter_mut()
            .for_each(|panel| panel.cells.retain(|_| numbers.next().is_some_and(|n| n % of == part)));
    }
    if extent.only.is_empty() {
        return Ok(panels);
    }
    let names = names(&panels);
    panels.iter_mut().for_each(|panel| panel.select(&extent.only));
    panels.retain(|panel| !panel.cells.is_empty());
    if panels.is_empty() {
        let error = Error::new(Kind::Usage, format!("no run is named `{}`", extent.only.join("` or `")));
        return Err(error.with_help(names));
    }
    Ok(panels)
}

/// The names that select runs of `panels`.
fn names(panels: &[Panel]) -> String {
    let stiffness = panels.iter().map(|panel| format!("`k/m {:.2e}`", panel.k_over_m));
    let methods: Vec<_> = METHODS.iter().map(|method| format!("`{}`", method.name)).collect();
    let integrators: Vec<_> = Integrator::NAMES.iter().map(|(name, _)| format!("`{name}`")).collect();
    let example = panels.iter().find_map(|panel| Some(panel.name(panel.cells.last()?)));
    format!(
        "the stiffnesses of this scene are {}; the methods are {}; an example of a full name is `{}`; the integrators \
         are {}",
        stiffness.collect::<Vec<_>>().join(", "),
        methods.join(", "),
        example.unwrap_or_default(),
        integrators.join(", "),
    )
}

/// The panel of `density`, which is this `part` of the density of the scene `stock`.
fn panel(source: &Source, stock: &Scene, [density, part]: [f64; 2], extent: &Extent) -> Result<Panel> {
    let mut sets: Vec<String> = extent.model().iter().map(ToString::to_string).collect();
    sets.push(format!("cloth.density={density:?}"));
    let scene = source.scene(&sets)?;
    let Some(cloth) = &scene.cloth else {
        return Err(Error::new(Kind::Internal, "the scene lost its cloth"));
    };
    let mass = Params::new(cloth, &scene.sim).mass;
    let Stability { omega_safe, limit_worst, .. } = Stability::new(cloth, &scene.sim)?;
    let stable_rate = (omega_safe / limit_worst).max(50.0);
    let rates = rates_around(stock, stable_rate, cloth, extent);
    let finest = rates.last().copied().unwrap_or(0);
    let k_over_m = cloth.ks / mass;
    let mut panel = Panel { density, part, k_over_m, stable_rate, cells: Vec::new(), finest, sets };
    let is_too_long = springs_in(cloth, finest, extent) * 16.0 > extent.most_reference;
    if f64::from(finest) >= stable_rate && !is_too_long {
        panel.cells = cells(source, stock, &panel.sets, &rates, extent)?;
    }
    Ok(panel)
}

/// The cells of the scene with the changes `sets`; `rates` are those around the rate that is stable under
/// Verlet's scheme.
fn cells(
    source: &Source,
    stock: &Scene,
    sets: &[String],
    rates: &[u32],
    extent: &Extent,
) -> Result<Vec<Cell>> {
    let mut cells = Vec::new();
    for (number, method) in METHODS.iter().enumerate() {
        let changed = |more: &[String]| source.scene(&[sets, method.sets.as_slice(), more].concat());
        let own = match method.rates {
            Rates::OfVerlet => rates.to_vec(),
            Rates::Given(rates) => rates.to_vec(),
            Rates::OfIntegrator => own_rates(stock, &changed(&[])?, extent)?,
        };
        for rate in own {
            let scene = changed(&clock(stock.sim.fps, rate))?;
            cells.push(Cell { method: number, rate, scene });
        }
    }
    Ok(cells)
}

/// Steps per second around the rate that is stable under the integrator of `scene`.
fn own_rates(stock: &Scene, scene: &Scene, extent: &Extent) -> Result<Vec<u32>> {
    let Some(cloth) = &scene.cloth else { return Ok(Vec::new()) };
    Ok(match Stability::of_bounded(cloth, &scene.sim)? {
        Some(own) => rates_around(stock, own.omega_safe / own.limit_worst, cloth, extent),
        None => LARGE_STEPS.to_vec(),
    })
}
