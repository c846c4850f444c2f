//! `texture_3`: a woven plaid. It joins on all sides.

use super::color::{Color, hex, mix};
use super::{Picture, paint as paint_each};

pub(super) fn paint() -> Picture {
    paint_each(|u, v| mix(band(u), band(v), 0.5))
}

fn band(x: f64) -> Color {
    let place = x * 4.0 - (x * 4.0).floor();
    if place < 0.5 { hex(0x8c1c2a) } else { hex(0x16264a) }
}
