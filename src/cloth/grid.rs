//! The grid of points: its size, where it starts, and which of its points are held.

use std::iter;
use std::ops::Range;

use super::{Points, filled, too_large};
use crate::error::{Error, Kind, Result};
use crate::math::splitmix64;
use crate::scene::{Cloth, Orientation, Vec3};

/// The size of a grid: `width` × `height` points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Grid {
    /// Points along x: `W`.
    pub width: usize,
    /// Points along y: `H`.
    pub height: usize,
}

impl Grid {
    /// The grid of `cloth`.
    ///
    /// # Errors
    /// [`Kind::Scene`] when a side has fewer than two points, or when their positions do not fit in memory.
    pub fn new(cloth: &Cloth) -> Result<Self> {
        let (width, height) = (cloth.num_width_points, cloth.num_height_points);
        if width < 2 || height < 2 {
            let message = format!("the cloth has {width} x {height} points, not at least 2 x 2");
            return Err(Error::new(Kind::Scene, message));
        }
        let numbers =
            width.checked_mul(height).and_then(|points| points.checked_mul(3)).ok_or_else(too_large)?;
        Vec::<f64>::new().try_reserve_exact(numbers).map_err(|_| too_large())?;
        Ok(Self { width, height })
    }

    /// How many points the grid has.
    pub fn len(self) -> usize {
        self.width * self.height
    }

    /// Whether the grid has no point.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// Column and row (i, j) of point `index`.
    pub fn column_row(self, index: usize) -> (usize, usize) {
        (index % self.width, index / self.width)
    }
}

/// Where the points of `cloth` start, in metres: in the plane y = 1, or upright in the plane
/// z = 0 but for at most 1 mm per point, without which an upright cloth would fall flat; moved by
/// the offset of the cloth.
///
/// # Errors
/// [`Kind::Scene`] when the points do not fit in memory.
pub fn start(cloth: &Cloth, grid: Grid) -> Result<Points> {
    let mut points = Points::zeros(grid.len())?;
    (0..grid.len()).for_each(|index| points.set(index, start_of(cloth, grid, index)));
    Ok(points)
}

/// Where point `index` of `cloth` starts, as [`start`].
pub fn start_of(cloth: &Cloth, grid: Grid, index: usize) -> Vec3 {
    let (i, j) = grid.column_row(index);
    let u = cloth.width * i as f64 / (grid.width - 1) as f64;
    let v = cloth.height * j as f64 / (grid.height - 1) as f64;
    let place = match cloth.orientation {
        Orientation::Horizontal => Vec3::new(u, 1.0, v),
        Orientation::Vertical => Vec3::new(u, v, depth(index)),
    };
    place + cloth.offset
}

/// How far point `index` of an upright cloth stands out of its plane, -0.001..=0.001 m.
fn depth(index: usize) -> f64 {
    let r = (splitmix64(index as u64) >> 11) as f64 / 9_007_199_254_740_992.0;
    (2.0 * r - 1.0) / 1000.0
}

/// Which points never move.
#[derive(Clone, Debug, Default)]
pub struct Pins {
    /// Whether a point is pinned, one entry per point.
    pub pinned: Vec<bool>,
    /// The unpinned points in index order, as runs of consecutive ones.
    pub free: Vec<Range<usize>>,
}

impl Pins {
    /// The pins of `cloth`.
    ///
    /// # Errors
    /// [`Kind::Scene`] when a pin lies outside the grid.
    pub fn new(cloth: &Cloth, grid: Grid) -> Result<Self> {
        let mut pinned = filled(grid.len(), false)?;
        for &[i, j] in &cloth.pinned {
            if i >= grid.width || j >= grid.height {
                let message = format!("pin [{i}, {j}] lies outside {} x {} points", grid.width, grid.height);
                return Err(Error::new(Kind::Scene, message));
            }
            pinned[j * grid.width + i] = true;
        }
        Ok(Self::of(pinned))
    }

    /// The pins of points of which `pinned` says whether each is.
    pub(crate) fn of(pinned: Vec<bool>) -> Self {
        let free = free_runs(&pinned);
        Self { pinned, free }
    }

    /// The pinned points in index order.
    pub fn held(&self) -> impl Iterator<Item = usize> {
        let ends = self.free.iter().map(|run| run.end);
        let starts = self.free.iter().map(|run| run.start).chain([self.pinned.len()]);
        iter::once(0).chain(ends).zip(starts).flat_map(|(start, end)| start..end)
    }

    /// How many points are not pinned.
    pub fn free_points(&self) -> u64 {
        self.free.iter().map(|run| run.len() as u64).sum()
    }
}

/// The maximal runs of `false` in `pinned`.
fn free_runs(pinned: &[bool]) -> Vec<Range<usize>> {
    let mut start = 0;
    let mut runs = Vec::new();
    for run in pinned.split(|&pinned| pinned) {
        if !run.is_empty() {
            runs.push(start..start + run.len());
        }
        start += run.len() + 1;
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_runs_are_the_gaps_between_pins() {
        let pinned = [true, false, false, true, true, false, true];
        assert_eq!(free_runs(&pinned), [1..3, 5..6]);
        assert_eq!(free_runs(&[false, false, true]), vec![0..2]);
        assert!(free_runs(&[true]).is_empty(), "a pinned point is in no run");
    }
}
