//! `texture_2`: the height of a wall of rough stone blocks in courses, black low and white high.
//! It joins left to right and top to bottom.

use super::color::smooth;
use super::noise::Noise;
use super::{Picture, paint as paint_each};

/// Lower edge of each course, from the top. The last one ends at the lower edge of the picture.
const COURSES: [f64; 7] = [0.135, 0.305, 0.44, 0.60, 0.725, 0.875, 1.0];

/// Left edges of the blocks of each course; the last block goes on to the first.
const JOINTS: [&[f64]; 7] = [
    &[0.07, 0.30, 0.62, 0.83],
    &[0.18, 0.47, 0.71],
    &[0.02, 0.36, 0.58, 0.86],
    &[0.23, 0.43, 0.69, 0.95],
    &[0.11, 0.34, 0.53, 0.80],
    &[0.01, 0.28, 0.64],
    &[0.15, 0.40, 0.55, 0.77, 0.93],
];

pub(super) fn paint() -> Picture {
    paint_each(|u, v| [height(u, v); 3])
}

/// Noise of `cells` cells across and down the picture, with `octaves` finer ones in it.
fn noise(seed: u64, cells: i64, octaves: u32, u: f64, v: f64) -> f64 {
    Noise::periodic(seed, cells, cells).fractal(u * cells as f64, v * cells as f64, octaves)
}

/// A place in its block: which block, how far from the block's edges, and where from its middle.
struct Place {
    block: f64,
    edges: [f64; 2],
    offset: [f64; 2],
}

fn place(u: f64, v: f64) -> Place {
    let v = v - v.floor();
    let row = COURSES.partition_point(|&low| low <= v).min(6);
    let (top, low) = (if row == 0 { 0.0 } else { COURSES[row - 1] }, COURSES[row]);
    let joints = JOINTS[row];
    let turn = (u - joints[0]).floor();
    let u = u - turn;
    let column = joints.partition_point(|&left| left <= u) - 1;
    let (left, right) = (joints[column], joints.get(column + 1).copied().unwrap_or(joints[0] + 1.0));
    Place {
        block: row as f64 * 8.0 + column as f64,
        edges: [(u - left).min(right - u), (v - top).min(low - v)],
        offset: [2.0 * (u - left) / (right - left) - 1.0, 2.0 * (v - top) / (low - top) - 1.0],
    }
}

/// How deep inside its block a place is: 0 at the edge, up to 1 well inside. Corners are cut round.
fn inside(edges: [f64; 2], reach: f64) -> f64 {
    let [ex, ey] = edges.map(|edge| (1.0 - edge / reach).max(0.0));
    1.0 - (ex * ex + ey * ey).sqrt()
}

/// Height 0..1 of the wall.
fn height(u: f64, v: f64) -> f64 {
    let (coarse, fine) = (noise(51, 6, 3, u, v), noise(52, 40, 3, u, v));
    let bend = [coarse * 0.007 + fine * 0.0022, noise(53, 6, 3, u, v) * 0.006 + fine * 0.0018];
    let here = place(u + bend[0], v + bend[1]);
    let own = |k: f64| Noise::new(54).cell(here.block, k) - 0.5;

    let chips =
        0.005 * smooth(0.3, 0.8, noise(55, 22, 3, u, v)) + 0.011 * smooth(0.5, 0.8, noise(62, 9, 2, u, v));
    let edges = here.edges.map(|edge| edge - 0.0035 - chips);
    let block = smooth(0.0, 0.75, inside(edges, 0.013));
    let crown = smooth(0.0, 1.0, inside(edges, 0.05));

    let tilt = own(0.0) * here.offset[0] * 0.12 + own(1.0) * here.offset[1] * 0.14;
    let swell = noise(56, 7, 3, u, v) * 0.07;
    let slope = if own(2.0) > 0.0 { 1.0 } else { -1.0 };
    let dressed = noise(57, 18, 5, u + own(3.0), v * 2.0 + slope * u) * 0.055;
    let pits = smooth(0.35, 0.85, noise(58, 34, 2, u + own(4.0), v)) * 0.09;
    let grain = noise(60, 128, 2, u, v) * 0.02;
    let stone = 0.66 + own(5.0) * 0.14 + tilt + swell + dressed - pits + 0.07 * crown + grain;
    let mortar = 0.22 + noise(61, 44, 3, u, v) * 0.05 + grain;
    mortar + (stone - mortar) * block
}
