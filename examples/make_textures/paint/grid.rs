//! `texture_4`: a grid that shows which way texture coordinates run. Columns A to H go with u,
//! rows 1 to 8 with v, so A1 stands in the corner (0, 0).

use super::color::{Color, hex, mix, smooth};
use super::{Picture, SIZE, paint as paint_each};

/// Cells along each side.
const CELLS: f64 = 8.0;
/// Side of a dot of a letter, texels.
const DOT: f64 = 4.0;

/// Letters A to H: seven rows of five dots, the leftmost in the highest bit.
const LETTERS: [[u8; 7]; 8] = [
    [0x0E, 0x11, 0x11, 0x1F, 0x11, 0x11, 0x11],
    [0x1E, 0x11, 0x11, 0x1E, 0x11, 0x11, 0x1E],
    [0x0E, 0x11, 0x10, 0x10, 0x10, 0x11, 0x0E],
    [0x1E, 0x11, 0x11, 0x11, 0x11, 0x11, 0x1E],
    [0x1F, 0x10, 0x10, 0x1E, 0x10, 0x10, 0x1F],
    [0x1F, 0x10, 0x10, 0x1E, 0x10, 0x10, 0x10],
    [0x0E, 0x11, 0x10, 0x17, 0x11, 0x11, 0x0E],
    [0x11, 0x11, 0x11, 0x1F, 0x11, 0x11, 0x11],
];

/// Digits 1 to 8, in the same way.
const DIGITS: [[u8; 7]; 8] = [
    [0x04, 0x0C, 0x04, 0x04, 0x04, 0x04, 0x0E],
    [0x0E, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1F],
    [0x1E, 0x01, 0x01, 0x0E, 0x01, 0x01, 0x1E],
    [0x02, 0x06, 0x0A, 0x12, 0x1F, 0x02, 0x02],
    [0x1F, 0x10, 0x1E, 0x01, 0x01, 0x11, 0x0E],
    [0x06, 0x08, 0x10, 0x1E, 0x11, 0x11, 0x0E],
    [0x1F, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08],
    [0x0E, 0x11, 0x11, 0x0E, 0x11, 0x11, 0x0E],
];

pub(super) fn paint() -> Picture {
    paint_each(|u, v| {
        let (column, row) = ((u * CELLS).floor(), (v * CELLS).floor());
        let (x, y) = (u * CELLS - column, v * CELLS - row);
        let light = (column + row) / 2.0 == ((column + row) / 2.0).floor();
        let color = field(u, v, light);
        let texels = SIZE as f64 / CELLS;
        let to_line = x.min(1.0 - x).min(y.min(1.0 - y)) * texels;
        let color = mix(color, hex(0xffffff), 0.9 * smooth(1.6, 0.9, to_line));
        let ink = if light { hex(0x22262c) } else { hex(0xf7f4ee) };
        let inked = dot(&LETTERS, column, x * texels - 10.0, y * texels - 18.0)
            || dot(&DIGITS, row, x * texels - 34.0, y * texels - 18.0);
        if inked { ink } else { color }
    })
}

/// Red, yellow, blue and green in the four corners, paler in every other cell.
fn field(u: f64, v: f64, light: bool) -> Color {
    let top = mix(hex(0xc8402f), hex(0xd9a52b), u);
    let low = mix(hex(0x2c55a8), hex(0x2f8f57), u);
    let color = mix(top, low, v);
    if light { mix(color, hex(0xffffff), 0.55) } else { color }
}

/// Whether a sign has a dot at a place given in texels from its upper left corner.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0..8, 0..5 and 0..7")]
fn dot(signs: &[[u8; 7]; 8], sign: f64, x: f64, y: f64) -> bool {
    let (x, y) = (x / DOT, y / DOT);
    (0.0..5.0).contains(&x)
        && (0.0..7.0).contains(&y)
        && signs[sign as usize][y as usize] >> (4 - x as u8) & 1 == 1
}
