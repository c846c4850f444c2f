//! `texture_2`: the height of a wall of rough stone blocks in courses, black low and white high.
//! It joins left to right and top to bottom.

use super::color::smooth;
use super::noise::Noise;
use super::{Picture, paint as paint_each};

pub(super) fn paint() -> Picture {
    paint_each(|u, v| [height(u, v); 3])
}

fn height(u: f64, v: f64) -> f64 {
    let row = (v * 6.0).floor();
    let x = u * 4.0 + row * 0.5;
    let (fx, fy) = (x - x.floor(), v * 6.0 - row);
    let edge = (fx.min(1.0 - fx) * 1.5).min(fy.min(1.0 - fy));
    let rough = Noise::periodic(21, 16, 16).fractal(u * 16.0, v * 16.0, 5);
    0.2 + 0.5 * smooth(0.03, 0.1, edge + rough * 0.01) + rough * 0.05
}
