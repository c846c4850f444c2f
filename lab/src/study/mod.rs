//! Speed against accuracy, measured: the matrix method × steps per second × stiffness of a scene's
//! cloth against a self-converged reference, the ways to draw the scene against a converged picture,
//! and the advice that follows: the best choice within a budget.

pub mod method;
pub mod extent;
mod rates;
pub mod matrix;
pub mod trajectory;
pub mod reference;
pub mod runs;
pub mod pareto;
pub mod pictures;
mod findings;
mod results;
mod page;

use rayon::prelude::*;

use crate::accuracy::source::Source;
use crate::store::Store;
use drape::error::Result;
use drape::texture_source::TextureSource;
use extent::Extent;
use matrix::{Panel, panels};
use reference::{RUNGS, converge};

pub use findings::{Cost, PanelStudy, Study};
pub use page::page;
pub use results::{Results, csv};

/// The number of steps that [`run`] tells `watch`, without those of references that need more than five
/// runs.
///
/// # Errors
/// As [`matrix::panels`].
pub fn steps(source: &Source, extent: &Extent) -> Result<u64> {
    let repeats = extent.repeats as u64;
    let tenths = |rate: u32| u64::from(rate / 10 * extent.last());
    let of = |panel: &Panel| {
        let cells: u64 = panel.cells.iter().map(|cell| tenths(cell.rate)).sum();
        cells * repeats + if panel.cells.is_empty() { 0 } else { u64::from(RUNGS) * tenths(panel.finest) }
    };
    Ok(panels(source, extent)?.iter().map(of).sum())
}

/// Runs what `store` does not have. `watch` is told the number of steps since its last call, from several
/// threads, and can end the study with an error.
///
/// # Errors
/// Those of the scene, of the simulations, of the renderer, of the store and of `watch`.
pub fn run(
    source: &Source,
    textures: &TextureSource,
    extent: &Extent,
    store: &Store,
    watch: &(dyn Fn(u32) -> Result<()> + Sync),
) -> Result<Study> {
    // References run side by side, since they are not timed.
    let (panels, left_out): (Vec<Panel>, Vec<Panel>) =
        panels(source, extent)?.into_iter().partition(|panel| !panel.cells.is_empty());
    let with_reference = |panel: Panel| {
        let reference = converge(source, &panel, extent, store, watch)?;
        Ok((panel, reference))
    };
    let panels = panels.into_par_iter().map(with_reference).collect::<Result<Vec<_>>>()?;
    let measured = runs::measure(source, &panels, extent, store, watch)?;
    let panels = panels
        .into_iter()
        .zip(measured)
        .map(|((panel, reference), cells)| PanelStudy { panel, reference, cells })
        .collect();
    let pictures = match extent.only.is_empty() && extent.part.is_none() {
        true => pictures::measure(&source.scene(&[])?, textures, extent, store, watch)?,
        false => None,
    };
    let left_out = left_out.iter().map(|panel| panel.k_over_m).collect();
    Ok(Study { extent: extent.clone(), panels, left_out, pictures })
}
