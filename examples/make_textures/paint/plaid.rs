//! `texture_3`: a woven plaid, thread by thread. It joins on all sides.

use std::f64::consts::{PI, TAU};

use drape::math::sin;

use super::color::{Color, hex, mix, scale};
use super::noise::Noise;
use super::{Picture, paint as paint_each};

/// Threads along each side; each is four texels wide.
const THREADS: f64 = 128.0;

/// Half of the pattern as (threads, colour); the other half runs back.
const SETT: [(f64, u32); 9] = [
    (9.0, 0x9c1f2b),
    (2.0, 0xe8dcc0),
    (9.0, 0x9c1f2b),
    (10.0, 0x1b2c50),
    (3.0, 0x14533c),
    (2.0, 0xd9a63a),
    (13.0, 0x14533c),
    (10.0, 0x1b2c50),
    (6.0, 0x9c1f2b),
];

pub(super) fn paint() -> Picture {
    paint_each(weave)
}

/// The colour of thread number `thread`.
fn dye(thread: f64) -> Color {
    let folded = if thread < THREADS / 2.0 { thread } else { THREADS - 1.0 - thread };
    let mut end = 0.0;
    let found = SETT.iter().find(|(count, _)| {
        end += count;
        folded < end
    });
    hex(found.unwrap_or(&SETT[0]).1)
}

/// A twill: each thread runs over two and under two, one further on in each row.
fn weave(u: f64, v: f64) -> Color {
    let (across, down) = (u * THREADS, v * THREADS);
    let (warp, weft) = (across.floor(), down.floor());
    let step = warp + weft;
    let over = step - 4.0 * (step / 4.0).floor() < 2.0;
    let (thread, beside, along) =
        if over { (warp, across - warp, down) } else { (weft, down - weft, across) };
    let place = (along + if over { warp } else { weft }) / 4.0 + if over { 0.0 } else { 0.5 };
    let round = sin(PI * beside);
    let bow = sin(TAU * (place - place.floor())).max(0.0);
    let twist = sin(TAU * (along * 1.5 + beside)) * 0.06;
    let yarn = Noise::periodic(if over { 121 } else { 122 }, 128, 64).at(thread + 0.5, along * 0.5) * 0.10;
    let worn = Noise::periodic(123, 6, 6).fractal(u * 6.0, v * 6.0, 4) * 0.06;
    let light = 0.50 + 0.38 * round + 0.26 * bow + twist + yarn + worn;
    let color = scale(dye(thread), light);
    mix(color, hex(0xfff4e0), 0.05 * round * bow)
}
