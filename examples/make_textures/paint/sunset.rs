//! `texture_1`: a sunset over a street with trees. It joins left to right, to go around a ball.

use std::f64::consts::TAU;

use drape::math::sin;

use super::color::{Color, add, hex, mix, ramp, scale, smooth};
use super::mask::Mask;
use super::noise::Noise;
use super::{Picture, paint as paint_each, street};

/// Where the ground meets the sky, from the top.
pub(super) const HORIZON: f64 = 0.745;
/// The middle of the sun, (u, v).
const SUN: [f64; 2] = [0.596, 0.676];
/// Rows of clouds never repeat; columns do after a whole number of cells.
const ROWS: i64 = 1 << 20;

/// Where the far trees begin, from the top.
fn treeline(u: f64) -> f64 {
    let bushes = Noise::periodic(31, 18, ROWS).fractal(u * 18.0, 0.5, 5);
    let woods = Noise::periodic(32, 5, ROWS).at(u * 5.0, 0.5);
    HORIZON - 0.022 - 0.018 * woods - 0.012 * bushes
}

pub(super) fn paint() -> Picture {
    let street = street::Street::new();
    let mut woods = Mask::new();
    woods.fill([0.0, 0.6], [0.9999, HORIZON + 0.02], |u, v| v > treeline(u));
    paint_each(|u, v| {
        let shine = shine(u, v);
        let mut color = sky(u, v);
        color = mix(color, mix(hex(0x3a1d12), hex(0x6b3316), shine), woods.cover(u, v));
        color = street.over(color, u, v, shine);
        let glare = add(color, scale([0.42, 0.22, 0.07], shine * shine * 0.5));
        let grain = 1.0 + 0.02 * (Noise::new(7).cell(u * 512.0, v * 512.0) - 0.5);
        scale(glare, grain)
    })
}

/// The way around the picture from `from` to `to`, -0.5..0.5.
fn around(from: f64, to: f64) -> f64 {
    let way = to - from;
    way - way.round()
}

/// How much the sun dazzles at a place, 0..1.
fn shine(u: f64, v: f64) -> f64 {
    let (du, dv) = (around(SUN[0], u), (v - SUN[1]) * 1.3);
    1.0 / (1.0 + (du * du + dv * dv) * 130.0)
}

fn clear_sky(u: f64, v: f64) -> Color {
    let stops = [
        (0.0, hex(0x664650)),
        (0.15, hex(0xa06044)),
        (0.34, hex(0xd07c38)),
        (0.52, hex(0xf39a30)),
        (0.64, hex(0xffb23c)),
        (0.76, hex(0xee6f1c)),
    ];
    let (du, dv) = (around(SUN[0], u), (v - SUN[1]) * 1.05);
    let disc = smooth(0.025, 0.021, (du * du + dv * dv).sqrt());
    let glow = shine(u, v);
    let haze = add(ramp(&stops, v), scale([0.45, 0.33, 0.13], glow));
    mix(haze, hex(0xfff6cf), disc)
}

/// How thick a sheet of clouds is at a place, about -1..1, seen from below: it crowds toward the
/// horizon. `columns` cells go around, `rows` says how flat the clouds are.
fn sheet(seed: u64, columns: i64, rows: f64, u: f64, v: f64) -> f64 {
    let depth = 0.6 / (HORIZON + 0.14 - v);
    let across = u * columns as f64;
    let warp = Noise::periodic(seed, columns, ROWS).fractal(across, depth * rows * 0.4, 3);
    Noise::periodic(seed + 1, columns, ROWS).fractal(across + warp * 0.5, depth * rows + warp * 0.4, 6)
}

/// Puts clouds of the given thickness before the sky. They are lit from the sun's side, that is
/// from below and from where the sun stands; `contrast` tells lit from dark.
fn lit_clouds(behind: Color, u: f64, v: f64, contrast: f64, thick: impl Fn(f64, f64) -> f64) -> Color {
    let here = thick(u, v);
    let toward_sun = thick(u + 0.016 * sin(TAU * (SUN[0] - u)), v + 0.019);
    let light = (0.48 + (here - toward_sun) * contrast).clamp(0.0, 1.0);
    let dark = mix(hex(0x6e3c40), hex(0xa8501e), smooth(0.1, 0.7, v));
    let bright = mix(hex(0xf0985a), hex(0xffdc84), smooth(0.1, 0.55, v));
    mix(behind, mix(dark, bright, light), here)
}

/// Soft veils high up, ranks of small clouds in the middle, thin bars over the horizon.
fn sky(u: f64, v: f64) -> Color {
    let veils = |u: f64, v: f64| 0.6 * smooth(-0.5, 1.1, sheet(11, 4, 7.0, u, v));
    let ranks = |u: f64, v: f64| {
        let rank = smooth(0.08, 0.30, v) * smooth(0.62, 0.42, v);
        let gaps = Noise::periodic(20, 3, ROWS).fractal(u * 3.0, v * 7.0, 3);
        0.92 * smooth(0.05, 0.75, sheet(14, 7, 13.0, u, v) * 0.8 + 0.9 * rank - 0.55 + 0.7 * gaps)
    };
    let bars = sheet(17, 3, 8.0, u, v) + 0.5 * smooth(0.5, 0.66, v) - 0.28;
    let color = lit_clouds(clear_sky(u, v), u, v, 1.3, veils);
    let color = lit_clouds(color, u, v, 1.15, ranks);
    mix(
        color,
        mix(hex(0x8c4020), hex(0xffc468), shine(u, v)),
        0.7 * smooth(0.1, 0.7, bars) * smooth(0.25, 0.45, v),
    )
}
