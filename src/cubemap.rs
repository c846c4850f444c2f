//! Six square pictures that surround the scene.

use crate::error::{Error, Kind, Result};
use crate::texture::Texture;

/// Names of the faces, in the order in which they are kept: +x, -x, +y, -y, +z, -z.
pub const FACES: [&str; 6] = ["posx", "negx", "posy", "negy", "posz", "negz"];

/// An environment: one square texture for each side of a cube seen from its middle.
///
/// Faces are laid out by table 8.19 of the OpenGL 4.6 specification (section 8.13); the first row
/// of a face is t = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Cubemap {
    faces: [Texture; 6],
    size: usize,
}

impl Cubemap {
    /// A cube map called `name` of `faces` in the order of [`FACES`].
    ///
    /// # Errors
    /// [`Kind::Scene`] if a face is not square or differs in size from the first.
    pub fn new(name: &str, faces: [Texture; 6]) -> Result<Self> {
        let size = faces[0].width();
        for (face, texture) in FACES.iter().zip(&faces) {
            let (width, height) = (texture.width(), texture.height());
            if width != height {
                return Err(invalid(name, face, width, height, "not square"));
            }
            if width != size {
                let why = format!("differs from {}, which is {size} x {size}", FACES[0]);
                return Err(invalid(name, face, width, height, &why));
            }
        }
        Ok(Self { faces, size })
    }

    /// The faces, in the order of [`FACES`].
    pub fn faces(&self) -> &[Texture; 6] {
        &self.faces
    }

    /// The texel in column and row `[i, j]` of a face, of which one or both may be one beyond the edge: there it is
    /// the texel of the next face that touches the edge at that place, and beyond a corner the mean of the three
    /// texels that meet there (OpenGL 4.6 specification, section 8.14.1).
    pub fn texel_around(&self, face: usize, [i, j]: [i32; 2]) -> [f32; 4] {
        let n = side(self.size);
        let inside = |k: i32| (0..n).contains(&k);
        match (inside(i), inside(j)) {
            (true, true) => self.texel_inside(face, [i, j]),
            (false, false) => {
                let corner = [i, j].map(|k| k.clamp(0, n - 1));
                let meet = [
                    self.texel_inside(face, corner),
                    self.texel_beyond(face, [i, corner[1]]),
                    self.texel_beyond(face, [corner[0], j]),
                ];
                std::array::from_fn(|c| (meet[0][c] + meet[1][c] + meet[2][c]) / 3.0)
            }
            _ => self.texel_beyond(face, [i, j]),
        }
    }

    fn texel_inside(&self, face: usize, [i, j]: [i32; 2]) -> [f32; 4] {
        self.faces[face].texel(i.cast_unsigned() as usize, j.cast_unsigned() as usize)
    }

    /// The texel beyond one edge of a face. Coordinates are counted in half texels from the middle of the cube, whose
    /// sides are at `n`: a texel beyond the edge lies at `n + 1` there, and folds over the edge to `n - 1` on the side
    /// of the next face.
    fn texel_beyond(&self, face: usize, place: [i32; 2]) -> [f32; 4] {
        let n = side(self.size);
        let [s, t] = place.map(|k| 2 * k + 1 - n);
        let mut r = direction(face, [s, t], n);
        let old = face / 2;
        let new = (0..3).find(|&axis| axis != old && r[axis].abs() > n).unwrap_or(old);
        r[old] = r[old].signum() * (n - 1);
        r[new] = r[new].signum() * n;
        let next = 2 * new + usize::from(r[new] < 0);
        let place = coordinates(next, r).map(|c| (c + n - 1) / 2);
        self.texel_inside(next, place)
    }

    /// Texels along each side of each face, at least 1.
    pub fn size(&self) -> usize {
        self.size
    }
}

/// The point of a face at (s, t), by the table of the specification; the faces are `n` from the middle.
fn direction(face: usize, [s, t]: [i32; 2], n: i32) -> [i32; 3] {
    match face {
        0 => [n, -t, -s],
        1 => [-n, -t, s],
        2 => [s, n, t],
        3 => [s, -n, -t],
        4 => [s, -t, n],
        _ => [-s, -t, -n],
    }
}

/// The inverse of [`direction`].
fn coordinates(face: usize, [x, y, z]: [i32; 3]) -> [i32; 2] {
    match face {
        0 => [-z, -y],
        1 => [z, -y],
        2 => [x, z],
        3 => [x, -z],
        4 => [x, -y],
        _ => [-x, -y],
    }
}

/// A side of a face as texels are counted.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "textures are at most 16384 texels wide"
)]
fn side(n: usize) -> i32 {
    n as i32
}

fn invalid(name: &str, face: &str, width: usize, height: usize, why: &str) -> Error {
    let message = format!("cube map {name}: face {face} is {width} x {height}: {why}");
    Error::new(Kind::Scene, message).with_help("all six faces must be square and of one size")
}
