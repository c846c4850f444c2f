//! The cube map `cube`: a footbridge over a lake, low sun. Every colour follows from a direction.

use super::color::{Color, hex, ramp};
use super::{Picture, paint as paint_each};

/// The faces with the direction of their middle, of rising s and of rising t (OpenGL 4.6, table 8.19).
const FACES: [(&str, [[f64; 3]; 3]); 6] = [
    ("cube/posx", [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, -1.0, 0.0]]),
    ("cube/negx", [[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]),
    ("cube/posy", [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
    ("cube/negy", [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]),
    ("cube/posz", [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]),
    ("cube/negz", [[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]),
];

pub(super) fn paint() -> [(&'static str, Picture); 6] {
    FACES.map(|(name, axes)| (name, paint_each(|u, v| seen(direction(axes, u, v)))))
}

/// The direction through a place of a face, of length 1.
fn direction([middle, right, down]: [[f64; 3]; 3], u: f64, v: f64) -> [f64; 3] {
    let (s, t) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let length = (1.0 + s * s + t * t).sqrt();
    [0, 1, 2].map(|i| (middle[i] + right[i] * s + down[i] * t) / length)
}

fn seen(ray: [f64; 3]) -> Color {
    ramp(&[(-1.0, hex(0x403020)), (0.0, hex(0x8090a0)), (0.02, hex(0xc0d8f0)), (1.0, hex(0x204080))], ray[1])
}
