//! What is asked for: how far from the limit the points may be, and how that is measured.

use std::str::FromStr;

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

/// The distance that is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// In the unit of `measure`.
    pub value: f64,
    /// How it is measured.
    pub measure: Measure,
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
        let squares = difference.iter().map(|d| d.iter().map(|d| d * d).sum::<f64>());
        match self {
            Self::Rms => {
                let sum: f64 = squares.sum();
                (sum / difference.len().max(1) as f64).sqrt()
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
pub(super) fn difference(a: &Shape, b: &Shape) -> Shape {
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

/// The units of a length, in metres.
const UNITS: [(&str, f64); 5] = [("um", 1e-6), ("µm", 1e-6), ("mm", 1e-3), ("cm", 1e-2), ("m", 1.0)];

impl FromStr for Tolerance {
    type Err = String;

    /// A length, `1mm`, `0.1mm` or `2e-4m`, or a part of the picture, `0.5px`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "`{text}` is no length: write a number above 0 and its unit, um, mm, cm, m or px, such as 1mm or 0.5px"
            )
        };
        let units = UNITS.map(|(unit, factor)| (unit, factor, Measure::Rms));
        let units = [("px", 1.0, Measure::Pixels)].into_iter().chain(units);
        for (unit, factor, measure) in units {
            let number = text.strip_suffix(unit).and_then(|number| number.trim_end().parse::<f64>().ok());
            if let Some(number) = number {
                let value = number * factor;
                return if value.is_normal() && value > 0.0 {
                    Ok(Self { value, measure })
                } else {
                    Err(wrong())
                };
            }
        }
        Err(wrong())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tolerance_is_a_number_with_a_unit() {
        let read = |text: &str| text.parse::<Tolerance>().map(|t| (t.value, t.measure));
        assert_eq!(read("1mm"), Ok((1e-3, Measure::Rms)));
        assert_eq!(read("2e-4m"), Ok((2e-4, Measure::Rms)));
        assert_eq!(read("3 um"), Ok((3e-6, Measure::Rms)));
        assert_eq!(read("0.5px"), Ok((0.5, Measure::Pixels)));
        for text in ["", "1", "mm", "-1mm", "0mm", "nanm", "infpx", "1km", "1e-400m", "1 inch"] {
            assert!(read(text).is_err(), "{text}");
        }
    }

    #[test]
    fn sizes_are_root_mean_square_or_largest() {
        let d = vec![[3.0, 0.0, 4.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
        assert_eq!([Measure::Rms, Measure::Max, Measure::Pixels].map(|m| m.size(&d)), [2.5, 5.0, 5.0]);
    }
}
