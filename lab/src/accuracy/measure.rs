//! How far apart two states of a cloth are.

use drape::camera::Camera;
use drape::cloth::Points;
use drape::error::Result;
use drape::scene::Scene;

/// How the distance of two states of a cloth is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Root of the mean of the squared distances of the points, in metres.
    Rms,
    /// Largest distance of a point, in metres.
    Max,
    /// Largest distance of a point in the picture that the camera of the scene shows, in pixels.
    Pixels,
}

/// Where the points of a cloth are: x y z in metres, or, in pixels, the place in the picture and 0.
pub type Shape = Vec<[f64; 3]>;

impl Measure {
    /// The unit.
    pub fn unit(self) -> &'static str {
        if self == Self::Pixels { "px" } else { "m" }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Rms => "root mean square over the points",
            Self::Max | Self::Pixels => "largest of a point",
        }
    }

    /// Where the points `x` of `scene` are.
    ///
    /// # Errors
    /// In pixels, those of the camera.
    pub fn shape(self, scene: &Scene, x: &Points) -> Result<Shape> {
        let points = (0..x.len()).map(|p| x.get(p));
        if self != Self::Pixels {
            return Ok(points.map(|x| [x.x, x.y, x.z]).collect());
        }
        let camera = Camera::of(scene)?;
        let size = scene.render.size.map(f64::from);
        Ok(points.map(|x| pixel(&camera, size, [x.x, x.y, x.z])).collect())
    }

    /// The length of `difference`, one entry a point.
    pub fn size(self, difference: &[[f64; 3]]) -> f64 {
        self.of_squares(difference.iter().map(|d| d.iter().map(|d| d * d).sum::<f64>()))
    }

    /// The length of a difference whose points are this far apart, squared.
    pub fn of_squares(self, squares: impl ExactSizeIterator<Item = f64>) -> f64 {
        match self {
            Self::Rms => {
                let points = squares.len().max(1);
                let sum: f64 = squares.sum();
                (sum / points as f64).sqrt()
            }
            Self::Max | Self::Pixels => squares.fold(0.0, f64::max).sqrt(),
        }
    }

    /// The distance of `a` and `b`, the same points in two states.
    pub fn distance(self, a: &Shape, b: &Shape) -> f64 {
        self.size(&difference(a, b))
    }
}

/// `a - b`, point by point.
pub fn difference(a: &Shape, b: &Shape) -> Shape {
    a.iter().zip(b).map(|(a, b)| [a[0] - b[0], a[1] - b[1], a[2] - b[2]]).collect()
}

/// The place in a picture of `size` pixels at which a point is seen. The numbers of the camera are those of
/// the shaders, rounded to f32, which moves a picture as a whole by less than a thousandth of a pixel.
fn pixel(camera: &Camera, size: [f64; 2], x: [f64; 3]) -> [f64; 3] {
    let row = |row: usize| {
        let m = |column: usize| f64::from(camera.view_projection[column][row]);
        m(0) * x[0] + m(1) * x[1] + m(2) * x[2] + m(3)
    };
    let w = row(3);
    [0.5 * size[0] * (row(0) / w), -0.5 * size[1] * (row(1) / w), 0.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_root_mean_square_or_largest() {
        let d = vec![[3.0, 0.0, 4.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
        assert_eq!([Measure::Rms, Measure::Max, Measure::Pixels].map(|m| m.size(&d)), [2.5, 5.0, 5.0]);
    }
}
