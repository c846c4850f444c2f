//! Set-up: from clip space to the window, snapped for coverage, unsnapped for everything else.

use super::{
    samples,
    tiling::{SNAPPED_LIMIT, SUBPIXELS},
};

/// The part of the window that pictures use.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewport {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) samples: usize,
    /// Lowest and highest position of a sample in its pixel along x and y, in 1/256 pixel.
    pub(super) spread: [[i32; 2]; 2],
}

/// A vertex in the window: x right, y up (both in pixels, unsnapped), depth, and 1/w.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct WindowVertex {
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) z: f32,
    pub(super) r: f32,
}

/// A vertex as triangles need it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Corner {
    pub(super) window: WindowVertex,
    /// The position in 1/256 pixel, x right, y down, or [`NOWHERE`]: an `Option` would take a third as much again.
    grid: [i32; 2],
}

/// Of a vertex that is NaN, infinite or beyond the grid.
const NOWHERE: [i32; 2] = [i32::MIN; 2];

impl Corner {
    /// The position in 1/256 pixel, x right, y down; absent if it is NaN, infinite or beyond the grid.
    #[inline(always)]
    pub(super) fn snapped(&self) -> Option<[i32; 2]> {
        (self.grid[0] != NOWHERE[0]).then_some(self.grid)
    }
}

/// A triangle ready for the tiles. Its corners are ordered so that its snapped area is positive
/// with y down.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// The number of each corner (see `assemble::Chunk::corner`).
    pub(super) vertices: [u32; 3],
    /// Number of the triangle in its mesh.
    pub(super) source: u32,
    pub(super) bounds: Bounds,
    /// 1 / `window_area`.
    pub(super) scale: f64,
}

/// A line ready for the tiles: from the first point up to, not including, the last.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) window: [WindowVertex; 2],
    pub(super) snapped: [[i32; 2]; 2],
    pub(super) source: u32,
    pub(super) bounds: Bounds,
}

/// Pixels that a primitive may touch: first and last column and row, inclusive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Bounds {
    pub(super) x: [u16; 2],
    pub(super) y: [u16; 2],
}

/// Why a primitive is not drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dropped {
    /// A coordinate is NaN, infinite, or too large for the snapping grid.
    NonFinite,
    /// Its snapped corners span no area.
    Degenerate,
    /// It lies between the samples.
    NoSample,
}

impl Viewport {
    /// A part of `width` × `height` pixels with `samples` samples each.
    pub(super) fn new(width: usize, height: usize, samples: usize) -> Self {
        let spread = [0, 1].map(|axis| {
            let offsets =
                samples::positions(samples).iter().map(|position| position[axis] * (SUBPIXELS / 16));
            offsets.fold([SUBPIXELS, 0], |[low, high], s| [low.min(s), high.max(s)])
        });
        Self { width, height, samples, spread }
    }

    /// A vertex from its clip-space position.
    #[inline(always)]
    pub(super) fn corner(&self, position: [f32; 4]) -> Corner {
        let window = self.window(position);
        Corner { window, grid: self.snap(window) }
    }

    /// The window position of a clip-space position, as GL defines it: r = 1/w, ndc = clip·r.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "window coordinates are f32 by definition")]
    fn window(&self, [x, y, z, w]: [f32; 4]) -> WindowVertex {
        let r = 1.0 / w;
        let half = |extent: usize| extent as f64 / 2.0;
        let to_window = |ndc: f32, extent: usize| (f64::from(ndc) * half(extent) + half(extent)) as f32;
        WindowVertex {
            x: to_window(x * r, self.width),
            y: to_window(y * r, self.height),
            z: z * r * 0.5 + 0.5,
            r,
        }
    }

    /// The position on the snapping grid, rounded half to even; y turned down.
    #[inline(always)]
    fn snap(&self, v: WindowVertex) -> [i32; 2] {
        let finite = v.z.is_finite() && v.r.is_finite();
        let grid = |c: f32| (c * SUBPIXELS as f32).round_ties_even();
        let (x, y) = (grid(v.x), grid(v.y));
        #[expect(clippy::cast_possible_truncation, reason = "only used where it is within the limit")]
        let snapped = || [x as i32, self.flip(y as i32)];
        let limit = SNAPPED_LIMIT as f32;
        if finite && x.abs() <= limit && y.abs() <= limit { snapped() } else { NOWHERE }
    }

    /// Turns a snapped y up into y down, and back.
    #[expect(clippy::cast_possible_truncation, reason = "pictures are at most 16384 pixels high")]
    fn flip(&self, y: i32) -> i32 {
        self.height as i32 * SUBPIXELS - y
    }

    /// A corner moved to its position on the snapping grid.
    pub(super) fn on_grid(&self, corner: Corner) -> Corner {
        let Some([x, y]) = corner.snapped() else { return corner };
        let [x, y] = [x, self.flip(y)].map(|c| c as f32 / SUBPIXELS as f32);
        Corner { window: WindowVertex { x, y, ..corner.window }, ..corner }
    }

    /// Sets up a triangle from its corners. Inlined, because a result handed back through memory took half as
    /// long again.
    #[inline(always)]
    pub(super) fn triangle(
        &self,
        [a, b, c]: [Corner; 3],
        vertices: [u32; 3],
        source: u32,
    ) -> Result<Triangle, Dropped> {
        let snapped = [snapped(a)?, snapped(b)?, snapped(c)?];
        let area = area(snapped);
        if area == 0 {
            return Err(Dropped::Degenerate);
        }
        let bounds = self.bounds(&snapped)?;
        let (mut window, mut vertices) = ([a.window, b.window, c.window], vertices);
        if area < 0 {
            window.swap(1, 2);
            vertices.swap(1, 2);
        }
        Ok(Triangle { vertices, source, bounds, scale: 1.0 / window_area(&window) })
    }

    /// Sets up a line from its ends.
    pub(super) fn line(&self, ends: [Corner; 2], source: u32) -> Result<Line, Dropped> {
        let snapped = [snapped(ends[0])?, snapped(ends[1])?];
        let [x, y] = [0, 1].map(|axis| {
            let [a, b] = snapped.map(|corner| corner[axis].div_euclid(SUBPIXELS));
            [a.min(b) - 1, a.max(b) + 1]
        });
        Ok(Line { window: ends.map(|end| end.window), snapped, source, bounds: self.inside(x, y)? })
    }

    /// The pixels of which at least one sample may lie inside the corners' box.
    fn bounds(&self, snapped: &[[i32; 2]; 3]) -> Result<Bounds, Dropped> {
        let range = |axis: usize| {
            let (mut first, mut last) = (i32::MAX, i32::MIN);
            for corner in snapped {
                (first, last) = (first.min(corner[axis]), last.max(corner[axis]));
            }
            // A sample at offset s of pixel p lies in first..=last iff first - s <= 256 p <= last - s.
            let [low, high] = self.spread[axis];
            [(first - high + SUBPIXELS - 1).div_euclid(SUBPIXELS), (last - low).div_euclid(SUBPIXELS)]
        };
        self.inside(range(0), range(1))
    }

    /// The part of a pixel range that lies in the picture.
    fn inside(&self, x: [i32; 2], y: [i32; 2]) -> Result<Bounds, Dropped> {
        let within = |[first, last]: [i32; 2], extent: usize| {
            let last = usize::try_from(last).ok()?.min(extent.checked_sub(1)?);
            let first = usize::try_from(first.max(0)).ok()?;
            #[expect(clippy::cast_possible_truncation, reason = "pictures are at most 16384 pixels wide")]
            (first <= last).then_some([first as u16, last as u16])
        };
        match (within(x, self.width), within(y, self.height)) {
            (Some(x), Some(y)) => Ok(Bounds { x, y }),
            _ => Err(Dropped::NoSample),
        }
    }
}

/// The position of a corner on the snapping grid.
fn snapped(corner: Corner) -> Result<[i32; 2], Dropped> {
    corner.snapped().ok_or(Dropped::NonFinite)
}

/// Twice the signed area, in (1/256 pixel)², positive when the corners turn right with y down.
fn area([a, b, c]: [[i32; 2]; 3]) -> i64 {
    let [abx, aby] = [b[0] - a[0], b[1] - a[1]].map(i64::from);
    let [acx, acy] = [c[0] - a[0], c[1] - a[1]].map(i64::from);
    abx * acy - aby * acx
}

/// Twice the signed area of the unsnapped corners, in pixels², y up.
pub(super) fn window_area([a, b, c]: &[WindowVertex; 3]) -> f64 {
    let d = |to: f32, from: f32| f64::from(to) - f64::from(from);
    d(b.x, a.x) * d(c.y, a.y) - d(b.y, a.y) * d(c.x, a.x)
}
