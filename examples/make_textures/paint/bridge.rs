//! A footbridge along z: planks, railings, and frames of dark steel overhead.

use super::color::{Color, add, hex, mix, scale, smooth};
use super::environment::Ray;
use super::landscape::{SUN, dot, glow, haze};
use super::noise::Noise;

/// Heights over the eye, metres: the planks, the top of the railing, the lattice overhead.
const DECK: f64 = -1.65;
const RAIL: f64 = -0.55;
const ROOF: f64 = 5.2;
/// Half the width between the railings, and between the beams overhead, metres.
const HALF: f64 = 1.9;
const ROOF_HALF: f64 = 1.25;
/// Distance between frames, and where the first one ahead stands, metres.
const BAY: f64 = 11.0;
const FIRST: f64 = 5.0;
/// Frames that are drawn ahead and behind.
const FRAMES: i32 = 14;

/// Frames toward the sun that are tall enough to shade a place.
const SHADING: i32 = 5;

/// What a ray meets first, and how far away, metres.
pub(super) struct Hit {
    pub(super) distance: f64,
    pub(super) color: Color,
}

/// The first part of the bridge along a ray from the eye.
pub(super) fn hit(ray: Ray) -> Option<Hit> {
    let parts = [deck(ray), rail_top(ray), railing(ray), frames(ray), roof(ray)];
    parts.into_iter().flatten().min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// Where a ray meets the plane on which coordinate `axis` is `at`, if ahead.
fn meet(from: Ray, ray: Ray, axis: usize, at: f64) -> Option<(f64, Ray)> {
    let distance = (at - from[axis]) / ray[axis];
    (distance > 1e-6 && distance < 1e4).then(|| (distance, [0, 1, 2].map(|i| from[i] + ray[i] * distance)))
}

/// Distance from `x` to the nearest multiple of `step`.
fn off_grid(x: f64, step: f64) -> f64 {
    let t = x / step;
    (t - t.round()).abs() * step
}

fn deck(ray: Ray) -> Option<Hit> {
    let (distance, [x, _, z]) = meet([0.0; 3], ray, 1, DECK)?;
    if x.abs() > HALF + 0.15 {
        return None;
    }
    let width = 0.155;
    let z = z + width / 2.0;
    let plank = (z / width).floor();
    let sharp = smooth(16.0, 4.0, distance);
    let own = Noise::new(101).cell(plank, 0.5);
    let grain = Noise::new(102).fractal(x * 1.6 + own * 40.0, z * 34.0, 4) * sharp;
    let stain = Noise::new(103).fractal(x * 0.8, z * 0.5, 4);
    let tone = 0.78 + 0.30 * (own - 0.5) * smooth(40.0, 8.0, distance) + 0.16 * grain + 0.12 * stain;
    let gap = smooth(0.011, 0.005, off_grid(z, width)) * sharp;
    let nail = (off_grid(z - width / 2.0, width) - 0.04).abs() + (x.abs() - 1.62).abs();
    let wood = scale(mix(hex(0x8a6f55), hex(0x6f665d), 0.5 + 0.5 * stain), tone * (1.0 - 0.8 * gap));
    let wood = scale(wood, 1.0 - 0.6 * smooth(0.014, 0.008, nail) * sharp);
    let sun = 1.0 - shade([x, DECK, z - width / 2.0]);
    let lit = mix(scale(wood, 0.52), [wood[0] * 1.22, wood[1] * 1.10, wood[2] * 0.92], sun);
    let sheen = 1.0 + ray[1];
    let sheen = sheen * sheen * sheen * sheen * (0.25 + 0.35 * sun);
    let mirrored = gleam(ray);
    Some(Hit { distance, color: mix(lit, mirrored, sheen.clamp(0.0, 0.6)) })
}

/// The sky as a dull surface mirrors it.
fn gleam(ray: Ray) -> Color {
    let up = [ray[0], -ray[1], ray[2]];
    add(mix(haze(up), hex(0x4f86c0), smooth(0.0, 0.6, up[1])), scale(hex(0xffdfa0), 0.8 * glow(up)))
}

/// How much of the sun the bridge keeps from a place on the deck, 0..1.
fn shade(place: Ray) -> f64 {
    let rail = meet(place, SUN, 0, HALF).map_or(0.0, |(way, [_, y, z])| bars(y, z, 0.004 * way));
    let next = ((place[2] - FIRST) / BAY).ceil();
    let frame = |k: i32| {
        let z = FIRST + BAY * (next + f64::from(k));
        meet(place, SUN, 2, z).map_or(0.0, |(way, [x, y, _])| beam(x, y, 0.006 * way))
    };
    (0..SHADING).map(frame).fold(rail, f64::max) * 0.92
}

/// The railing as a drawing on its plane: 1 on a bar, 0 between, `blur` metres wide at the edges.
fn bars(y: f64, z: f64, blur: f64) -> f64 {
    if !(DECK..=RAIL + 0.1).contains(&y) {
        return 0.0;
    }
    let bar = |off: f64, half: f64| smooth(half + blur + 1e-4, half - blur, off);
    let rails = [(RAIL, 0.04), (-0.83, 0.012), (-1.07, 0.012), (-1.31, 0.012), (DECK + 0.08, 0.05)];
    let posts = bar(off_grid(z - 0.6, 1.8), 0.04);
    rails.iter().map(|&(at, half)| bar((y - at).abs(), half)).fold(posts, f64::max)
}

fn steel(light: f64) -> Color {
    mix(hex(0x14191f), hex(0x55606b), light.clamp(0.0, 1.0))
}

fn railing(ray: Ray) -> Option<Hit> {
    let side = if ray[0] < 0.0 { -HALF } else { HALF };
    let (distance, [_, y, z]) = meet([0.0; 3], ray, 0, side)?;
    (bars(y, z, 0.0) > 0.5).then(|| {
        let light = if side < 0.0 { 0.45 } else { 0.10 } + 0.35 * SUN[2] * ray[2].min(0.0).abs();
        let color = add(steel(light), scale(hex(0x302010), smooth(0.6, 1.0, dot(ray, SUN))));
        Hit { distance, color }
    })
}

/// The flat top of the railing shines toward the sun.
fn rail_top(ray: Ray) -> Option<Hit> {
    let (distance, [x, ..]) = meet([0.0; 3], ray, 1, RAIL + 0.04)?;
    ((x.abs() - HALF).abs() < 0.055).then(|| Hit { distance, color: mix(steel(0.55), gleam(ray), 0.35) })
}

/// A frame as a drawing on its plane: 1 on a beam, 0 between.
fn beam(x: f64, y: f64, blur: f64) -> f64 {
    let x = x.abs();
    if x > HALF + 0.5 || !(DECK..ROOF + 0.2).contains(&y) {
        return 0.0;
    }
    let lean = |y: f64| HALF + 0.12 + (ROOF_HALF - HALF - 0.12) * (y - DECK) / (ROOF - DECK);
    let line = |off: f64, half: f64| smooth(half + blur + 1e-4, half - blur, off.abs());
    let mut cover = line(x - lean(y), 0.11);
    if x < lean(y) {
        for (at, half) in [(1.35, 0.07), (3.25, 0.06), (ROOF, 0.12)] {
            cover = cover.max(line(y - at, half));
        }
        for (low, high) in [(1.35, 3.25), (3.25, ROOF)] {
            if (low..high).contains(&y) {
                let t = (y - low) / (high - low);
                let across = (lean(low) + (lean(high) - lean(low)) * t) * (2.0 * t - 1.0);
                cover = cover.max(line(x - across.abs(), 0.055));
            }
        }
    }
    cover
}

fn frames(ray: Ray) -> Option<Hit> {
    let ahead = (0..FRAMES)
        .map(|k| if ray[2] > 0.0 { FIRST + BAY * f64::from(k) } else { FIRST - BAY * f64::from(k + 1) });
    let mut hits = ahead.filter_map(|z| meet([0.0; 3], ray, 2, z));
    let (distance, [x, y, _]) = hits.find(|(_, [x, y, _])| beam(*x, *y, 0.0) > 0.5)?;
    let facing_sun = if ray[2] > 0.0 { 0.06 } else { 0.62 };
    let grain = Noise::new(111).fractal(x * 9.0, y * 2.0, 2) * 0.06;
    Some(Hit { distance, color: steel(facing_sun + grain) })
}

/// Two beams overhead along the bridge, with crossed bars between them.
fn roof(ray: Ray) -> Option<Hit> {
    let (distance, [x, _, z]) = meet([0.0; 3], ray, 1, ROOF)?;
    let bay = (z - FIRST) / BAY;
    let t = bay - bay.floor();
    let across = ROOF_HALF * (2.0 * (t * 2.0 - (t * 2.0).floor()) - 1.0);
    let on_beam = (x.abs() - ROOF_HALF).abs() < 0.10;
    let on_bar = x.abs() < ROOF_HALF
        && ((x - across).abs() < 0.06 || (x + across).abs() < 0.06 || off_grid(z - FIRST, BAY / 2.0) < 0.07);
    (on_beam || on_bar).then(|| Hit { distance, color: steel(0.10 + 0.1 * x) })
}
