//! Sky, sun, clouds, hills and a lake, as seen along a ray.

use drape::math::exp;

use super::color::{Color, add, hex, mix, ramp, scale, smooth};
use super::environment::Ray;
use super::noise::Noise;

/// Toward the sun: low over the lake, from +z a little toward +x. Of length 1.
pub(super) const SUN: Ray = [0.222_5, 0.148, 0.963_6];
/// Depth of the lake's surface below the eye, metres.
const LAKE: f64 = 6.0;

pub(super) fn dot(a: Ray, b: Ray) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// What is seen of the landscape.
pub(super) fn seen(ray: Ray) -> Color {
    if ray[1] < 0.0 { lake(ray) } else { above(ray) }
}

/// The air at the horizon: pale, and golden toward the sun.
pub(super) fn haze(ray: Ray) -> Color {
    let flat = (ray[0] * ray[0] + ray[2] * ray[2]).sqrt().max(1e-9);
    let toward = (ray[0] * SUN[0] + ray[2] * SUN[2]) / flat;
    mix(hex(0xb4cbdd), hex(0xffe2b0), smooth(0.2, 1.0, toward))
}

/// The glow of the sun through the air, as strong as 1 close to it.
pub(super) fn glow(ray: Ray) -> f64 {
    let square = (2.0 - 2.0 * dot(ray, SUN)).max(0.0);
    exp(-square * 160.0) * 0.55 + exp(-square.sqrt() * 4.5) * 0.42
}

/// The clear sky with the sun.
fn clear(ray: Ray) -> Color {
    let up = ray[1].max(0.0).sqrt();
    let blue =
        ramp(&[(0.0, hex(0xb4cbdd)), (0.3, hex(0x86b3de)), (0.6, hex(0x3f7fc6)), (1.0, hex(0x153f86))], up);
    let sky = mix(haze(ray), blue, smooth(0.0, 0.32, up));
    let angle = (2.0 - 2.0 * dot(ray, SUN)).max(0.0).sqrt();
    let disc = smooth(0.040, 0.030, angle);
    add(sky, add(scale(hex(0xffdfa0), glow(ray)), scale([2.0, 1.9, 1.6], disc)))
}

/// How thick the clouds are over a place of their layer, with `octaves` of detail.
fn cover(x: f64, z: f64, octaves: u32) -> f64 {
    let warp = Noise::new(71).fractal(x * 0.8, z * 0.8, 3);
    let heaps = Noise::new(72).fractal(x * 1.25 + warp * 0.3, z * 1.5 - warp * 0.25, octaves);
    let fields = Noise::new(76).at(x * 0.34, z * 0.34);
    heaps + fields * 0.7
}

/// Everything above the horizon.
pub(super) fn above(ray: Ray) -> Color {
    let up = ray[1].max(0.0);
    let mut color = clear(ray);
    let far = 1.0 / (up + 0.09);
    let (x, z) = (ray[0] * far, ray[2] * far);
    let here = cover(x, z, 6);
    let toward_sun = cover(x + SUN[0] * 0.14, z + SUN[2] * 0.14, 4);
    let before_sun = smooth(0.975, 0.995, dot(ray, SUN));
    let thick = smooth(0.02, 0.75, here) * (1.0 - 0.85 * before_sun);
    let light = (0.72 + 0.75 * (here - toward_sun) - 0.25 * thick).clamp(0.0, 1.0);
    let near_sun = smooth(0.5, 1.0, dot(ray, SUN));
    let lit = mix(hex(0xf6f7fa), hex(0xfff0d2), near_sun);
    let cloud = mix(mix(hex(0x6d8199), hex(0xa9957c), near_sun), lit, light);
    color = mix(color, cloud, thick * 0.92 * smooth(0.01, 0.14, up));
    hills(color, ray)
}

/// Three rows of hills before the sky, the nearer the darker.
fn hills(sky: Color, ray: Ray) -> Color {
    let flat = (ray[0] * ray[0] + ray[2] * ray[2]).sqrt().max(1e-9);
    let (x, z, slope) = (ray[0] / flat, ray[2] / flat, ray[1] / flat);
    if slope > 0.16 {
        return sky;
    }
    let low_ahead = 1.0 - 0.75 * smooth(0.80, 1.0, z);
    let mut color = sky;
    for (seed, height, cells, octaves, haze_part) in
        [(81, 0.085, 3.0, 5, 0.72), (82, 0.052, 5.0, 6, 0.45), (83, 0.026, 9.0, 7, 0.12)]
    {
        let ridge = 0.55 + 0.6 * Noise::new(seed).fractal(x * cells, z * cells, octaves);
        let top = height * ridge.max(0.08) * low_ahead;
        let leaves = Noise::new(84).fractal(x * 60.0, z * 60.0 + slope * 180.0, 3);
        let green =
            mix(hex(0x1d3324), hex(0x3e5a35), (0.4 + 0.5 * leaves + slope / height * 0.4).clamp(0.0, 1.0));
        color = mix(color, mix(green, haze(ray), haze_part), smooth(top + 0.0015, top - 0.0005, slope));
    }
    color
}

/// The lake: waves that mirror the sky, more so the flatter the view.
fn lake(ray: Ray) -> Color {
    let far = LAKE / (-ray[1]).max(1e-4);
    let (x, z) = (ray[0] * far, ray[2] * far);
    let calm = 1.0 / (1.0 + far / 60.0);
    let wave = |seed: u64| {
        let swell = Noise::new(seed).fractal(x * 0.16, z * 0.22, 2);
        let ripples = Noise::new(seed + 1).fractal(x * 0.9, z * 1.2, 3);
        (swell * 0.07 + ripples * 0.13) * calm
    };
    let (tilt_x, tilt_z) = (wave(91), wave(95));
    let mirror = [ray[0] - 2.0 * ray[1] * tilt_x, -ray[1], ray[2] - 2.0 * ray[1] * tilt_z];
    let length = dot(mirror, mirror).sqrt();
    let mirror = mirror.map(|part| part / length);
    let facing = (-ray[1]).clamp(0.0, 1.0);
    let bounced = 0.04 + 0.96 * (1.0 - facing) * (1.0 - facing) * (1.0 - facing);
    let deep = mix(hex(0x0c2c40), hex(0x164a58), facing);
    let color = mix(deep, scale(above(mirror), 0.88), bounced);
    add(color, scale(hex(0xfff0c8), glitter(ray, x, z, calm)))
}

/// Sparks of the sun on waves that happen to tilt the right way.
fn glitter(ray: Ray, x: f64, z: f64, calm: f64) -> f64 {
    let half = [SUN[0] - ray[0], SUN[1] - ray[1], SUN[2] - ray[2]];
    let tilt = (half[0] * half[0] + half[2] * half[2]) / (half[1] * half[1]).max(1e-9);
    let sparks = smooth(0.0, 0.9, Noise::new(99).fractal(x * 1.3, z * 0.7, 4));
    exp(-tilt * 28.0) * (0.35 + (1.5 * sparks - 0.2) * calm.sqrt()).max(0.0)
}
