//! `texture_1`: a sunset over a street with trees. It joins left to right, to go around a ball.

use super::color::{Color, add, hex, mix, ramp, scale, smooth};
use super::mask::Mask;
use super::noise::{Noise, Random};
use super::{Picture, paint as paint_each};

/// Where the far ground meets the sky, from the top.
const HORIZON: f64 = 0.745;
const SUN: [f64; 2] = [0.545, 0.685];

pub(super) fn paint() -> Picture {
    let trees = trees();
    paint_each(|u, v| {
        let mut color = sky(u, v);
        color = mix(color, hex(0x1a0f0c), trees.cover(u, v));
        color = mix(color, hex(0x140d10), smooth(HORIZON - 0.001, HORIZON + 0.001, v));
        color
    })
}

/// Distance around the picture, -0.5..0.5.
fn around(u: f64, from: f64) -> f64 {
    let d = u - from;
    d - d.round()
}

fn clear_sky(u: f64, v: f64) -> Color {
    let base = ramp(
        &[
            (0.0, hex(0x6b4a4c)),
            (0.18, hex(0xa9683f)),
            (0.38, hex(0xd98432)),
            (0.56, hex(0xf6a034)),
            (0.66, hex(0xffb545)),
            (0.76, hex(0xf27a1e)),
        ],
        v,
    );
    let (dx, dy) = (around(u, SUN[0]), (v - SUN[1]) * 1.25);
    let near = (dx * dx + dy * dy).sqrt();
    let glow = 1.0 / (1.0 + near * near * 160.0);
    add(base, scale([0.5, 0.32, 0.12], glow))
}

/// How thick the clouds are at a place, 0..1. Rows crowd toward the horizon, as seen from below.
fn clouds(u: f64, v: f64) -> f64 {
    let depth = 0.55 / (HORIZON + 0.13 - v);
    let warp = Noise::periodic(11, 4, 1 << 20).fractal(u * 4.0, depth * 3.0, 3);
    let thick = Noise::periodic(12, 6, 1 << 20).fractal(u * 6.0 + warp * 0.45, depth * 7.0 + warp * 0.5, 6);
    let banks = Noise::periodic(13, 2, 1 << 20).fractal(u * 2.0, depth * 3.5, 2);
    smooth(-0.15, 0.75, thick + banks * 0.7)
}

fn sky(u: f64, v: f64) -> Color {
    let clear = clear_sky(u, v);
    let here = clouds(u, v);
    let below = clouds(u + around(SUN[0], u) * 0.02, v + 0.012);
    let lit = (0.45 + (here - below) * 2.2).clamp(0.0, 1.0);
    let dark = mix(hex(0x5a3230), hex(0x9a4a22), v);
    let bright = mix(hex(0xf0a050), hex(0xffd070), smooth(0.2, 0.65, v));
    mix(clear, mix(dark, bright, lit), here * 0.8)
}

fn trees() -> Mask {
    let mut mask = Mask::new();
    let mut random = Random::new(1);
    branch(&mut mask, &mut random, [0.45, HORIZON + 0.01], [0.0, -0.06], 0.008, 7);
    mask
}

fn branch(mask: &mut Mask, random: &mut Random, from: [f64; 2], along: [f64; 2], width: f64, depth: u32) {
    let to = [from[0] + along[0], from[1] + along[1]];
    mask.stroke(from, to, width, width * 0.7);
    if depth == 0 {
        return;
    }
    for _ in 0..3 {
        let turn = random.between(-0.8, 0.8);
        let grow = random.between(0.6, 0.85);
        let next = [(along[0] - along[1] * turn) * grow, (along[1] + along[0] * turn) * grow];
        branch(mask, random, to, next, width * 0.66, depth - 1);
    }
}
