//! What stands before the sunset: trees, houses, lamps, a street and parked cars, mostly black.

use super::color::{Color, add, hex, mix, scale, smooth};
use super::mask::Mask;
use super::noise::{Noise, Random};
use super::sunset::HORIZON;

/// The far and the near edge of the street, from the top.
const STREET: [f64; 2] = [0.80, 0.93];

/// Trees as (u of the foot, v of the foot, height, half width).
const TREES: [[f64; 4]; 6] = [
    [0.420, 0.785, 0.260, 0.150],
    [0.855, 0.775, 0.190, 0.105],
    [0.690, 0.765, 0.080, 0.045],
    [0.130, 0.770, 0.150, 0.090],
    [0.745, 0.768, 0.115, 0.050],
    [0.990, 0.765, 0.090, 0.060],
];

/// Cars as (u of the middle, v of the road under it, length, -1 or 1 for the way it faces).
const CARS: [[f64; 4]; 4] = [
    [0.400, 0.895, 0.185, 1.0],
    [0.600, 0.888, 0.165, 1.0],
    [0.850, 0.895, 0.180, -1.0],
    [0.120, 0.890, 0.170, 1.0],
];

/// Lit windows, lamps and rear lights as (u, v, radius, colour).
type Light = (f64, f64, f64, u32);

/// All shapes of the foreground, each a mask.
pub(super) struct Street {
    houses: Mask,
    trees: Mask,
    poles: Mask,
    shadows: Mask,
    cars: Mask,
    wheels: Mask,
    glass: Mask,
    edges: Mask,
    windows: Mask,
    lights: Vec<Light>,
}

impl Street {
    /// Draws the shapes.
    pub(super) fn new() -> Self {
        let empty = Mask::new;
        let mut street = Self {
            houses: empty(),
            trees: empty(),
            poles: empty(),
            shadows: empty(),
            cars: empty(),
            wheels: empty(),
            glass: empty(),
            edges: empty(),
            windows: empty(),
            lights: Vec::new(),
        };
        for (u, width, height) in
            [(0.245, 0.085, 0.052), (0.525, 0.065, 0.038), (0.775, 0.075, 0.047), (0.05, 0.08, 0.046)]
        {
            street.house(u, width, height);
        }
        for (seed, [u, v, height, spread]) in (1..).zip(TREES) {
            tree(&mut street.trees, &mut Random::new(seed), [u, v], height, spread);
        }
        street.lamp(0.296, 0.80, 0.250, -1.0);
        street.lamp(0.930, 0.795, 0.200, -1.0);
        for car in CARS {
            street.car(car);
        }
        street
    }

    /// The foreground over the `sky` color.
    pub(super) fn over(&self, sky: Color, u: f64, v: f64, shine: f64) -> Color {
        let mut color = mix(sky, ground(u, v, shine), smooth(HORIZON - 0.002, HORIZON + 0.004, v));
        color = mix(color, mix(hex(0x1e1413), hex(0x3a1c10), shine), self.houses.cover(u, v));
        color = mix(color, hex(0xffb860), self.windows.cover(u, v) * 0.85);
        color = mix(color, mix(hex(0x120c0c), hex(0x381908), shine), self.trees.cover(u, v));
        color = mix(color, hex(0x0d0a0b), self.poles.cover(u, v));
        color = mix(color, hex(0x0c090b), self.shadows.cover(u, v) * 0.8);
        let paint = mix(hex(0x2c2228), hex(0x0e0b0e), smooth(0.845, 0.885, v));
        color = mix(color, add(paint, scale(hex(0x301a10), shine * 2.0)), self.cars.cover(u, v));
        color = mix(color, hex(0x0a0809), self.wheels.cover(u, v));
        color =
            mix(color, mix(hex(0x9a5a34), hex(0x3c2018), smooth(0.835, 0.862, v)), self.glass.cover(u, v));
        color = mix(color, hex(0xd98038), self.edges.cover(u, v) * 0.75);
        for &(lu, lv, radius, rgb) in &self.lights {
            let square = ((u - lu) * (u - lu) + (v - lv) * (v - lv)) / (radius * radius);
            color = add(color, scale(hex(rgb), 1.0 / (1.0 + square * square)));
        }
        color
    }

    fn house(&mut self, u: f64, width: f64, height: f64) {
        let (foot, eaves) = (HORIZON + 0.03, HORIZON + 0.03 - height);
        let (left, right) = (u - width / 2.0, u + width / 2.0);
        self.houses.polygon(&[[left, foot], [left, eaves], [right, eaves], [right, foot]]);
        let over = width * 0.07;
        let ridge = eaves - height * 0.55;
        self.houses.polygon(&[
            [left - over, eaves],
            [u - width * 0.2, ridge],
            [u + width * 0.3, ridge],
            [right + over, eaves],
        ]);
        let chimney = u + width * 0.15;
        self.houses.polygon(&[
            [chimney, ridge + 0.01],
            [chimney, ridge - 0.012],
            [chimney + 0.009, ridge - 0.012],
            [chimney + 0.009, ridge + 0.01],
        ]);
        for place in [0.18, 0.55, 0.75] {
            let (x, y) = (left + width * place, eaves + height * 0.22);
            self.windows.polygon(&[[x, y], [x + 0.011, y], [x + 0.011, y + 0.012], [x, y + 0.012]]);
        }
    }

    fn lamp(&mut self, u: f64, foot: f64, height: f64, side: f64) {
        let top = foot - height;
        self.poles.stroke([u, foot], [u, top], 0.0028, 0.0014);
        self.poles.stroke([u, top], [u + side * 0.02, top - 0.008], 0.0013, 0.0012);
        self.poles.stroke([u + side * 0.02, top - 0.008], [u + side * 0.036, top - 0.007], 0.0028, 0.0022);
        self.lights.push((u + side * 0.03, top - 0.004, 0.0035, 0xfff0d0));
    }

    /// A saloon from the side, in units of its length from the middle of the road under it.
    fn car(&mut self, [u, v, length, faces]: [f64; 4]) {
        let at = |x: f64, y: f64| [u + faces * x * length, v - y * length];
        let points = |list: &[[f64; 2]]| list.iter().map(|p| at(p[0], p[1])).collect::<Vec<_>>();
        let body = [
            [-0.50, 0.10],
            [-0.50, 0.20],
            [-0.47, 0.245],
            [-0.36, 0.26],
            [-0.22, 0.385],
            [-0.05, 0.405],
            [0.09, 0.385],
            [0.23, 0.265],
            [0.42, 0.235],
            [0.49, 0.19],
            [0.50, 0.10],
            [0.45, 0.06],
            [-0.46, 0.06],
        ];
        self.shadows.stroke(at(-0.42, 0.0), at(0.46, 0.0), 0.035 * length, 0.03 * length);
        self.cars.polygon(&points(&body));
        for wheel in [-0.31, 0.31] {
            self.wheels.stroke(at(wheel, 0.075), at(wheel, 0.075), 0.085 * length, 0.085 * length);
        }
        self.glass.polygon(&points(&[[-0.30, 0.275], [-0.205, 0.362], [-0.08, 0.375], [-0.08, 0.27]]));
        self.glass.polygon(&points(&[[-0.055, 0.27], [-0.055, 0.376], [0.07, 0.36], [0.17, 0.268]]));
        let rim = points(&body[2..10]);
        for pair in rim.windows(2) {
            self.edges.stroke(pair[0], pair[1], 0.0011, 0.0011);
        }
        let [lu, lv] = at(-0.485, 0.205);
        self.lights.push((lu, lv, 0.0038, 0xe02010));
    }
}

/// Grass, pavement and street with the glow of the sky on it.
fn ground(u: f64, v: f64, shine: f64) -> Color {
    let grain = Noise::periodic(41, 64, 1 << 20).fractal(u * 64.0, v * 200.0, 3);
    let grass = scale(hex(0x1d1512), 1.0 + 0.18 * grain);
    let sheen = 0.35 + 0.65 * smooth(0.25, 0.0, (u - 0.596).abs());
    let street = add(hex(0x1d171b), scale(hex(0x6e4028), sheen * smooth(STREET[1], STREET[0], v) * 0.7));
    let street = scale(street, 1.0 + 0.10 * grain);
    let on_street =
        smooth(STREET[0] - 0.001, STREET[0] + 0.001, v) * smooth(STREET[1] + 0.001, STREET[1] - 0.001, v);
    let mut color = mix(grass, street, on_street);
    for edge in STREET {
        color = mix(color, hex(0x6b4630), 0.7 * smooth(0.004, 0.002, (v - edge).abs()));
    }
    let dash = u * 14.0 - (u * 14.0).floor();
    let line = smooth(0.0035, 0.002, (v - 0.913).abs()) * smooth(0.55, 0.53, dash);
    color = mix(color, hex(0x8a6248), 0.6 * line);
    add(color, scale(hex(0x402010), shine * 0.4))
}

/// A broad tree: a trunk that divides until its twigs carry leaves.
fn tree(mask: &mut Mask, random: &mut Random, foot: [f64; 2], height: f64, spread: f64) {
    let trunk = height * 0.26;
    let fork = [foot[0] + random.between(-0.1, 0.1) * trunk, foot[1] - trunk];
    mask.stroke([foot[0], foot[1]], fork, height * 0.042, height * 0.030);
    let limbs = 6;
    for limb in 0..limbs {
        let side = (f64::from(limb) + random.between(0.1, 0.9)) / f64::from(limbs) * 2.0 - 1.0;
        let rise = (1.0 - 0.75 * side * side) * (height - trunk) * 0.42;
        let start = [fork[0], fork[1] + trunk * random.between(0.0, 0.35)];
        branch(mask, random, start, [side * spread * 0.42, -rise], height * 0.019, 5);
    }
}

fn branch(mask: &mut Mask, random: &mut Random, from: [f64; 2], along: [f64; 2], width: f64, depth: u32) {
    let to = [from[0] + along[0], from[1] + along[1]];
    mask.stroke(from, to, width, width * 0.7);
    if depth <= 2 {
        leaves(mask, random, from, to);
    }
    if depth == 0 {
        return;
    }
    for _ in 0..3 {
        let turn = random.between(-0.75, 0.75);
        let grow = random.between(0.52, 0.80);
        let next = [(along[0] - along[1] * turn) * grow, (along[1] + along[0] * turn) * grow];
        branch(mask, random, to, next, width * 0.62, depth - 1);
    }
}

/// Small leaves along a twig.
fn leaves(mask: &mut Mask, random: &mut Random, from: [f64; 2], to: [f64; 2]) {
    for _ in 0..5 {
        let t = random.between(0.2, 1.2);
        let place = |axis: usize| from[axis] + (to[axis] - from[axis]) * t;
        let leaf = [place(0) + random.between(-0.004, 0.004), place(1) + random.between(-0.004, 0.004)];
        let tip = [leaf[0] + random.between(-0.0045, 0.0045), leaf[1] + random.between(-0.0035, 0.0035)];
        mask.stroke(leaf, tip, 0.0015, 0.0006);
    }
}
