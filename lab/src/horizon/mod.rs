//! For how long the positions of a simulation can be trusted at all.
//!
//! After contact the motion of a cloth is chaotic: copies of it that differ by the rounding of their start,
//! 1e-16 m, part by a factor in every frame, whatever the step. From the moment at which they have parted by
//! a millimetre on, no number of steps gives the positions of the points to a millimetre; what copies have in common,
//! such as the energy and the extent, can still be told.

mod copies;
mod page;

use serde::Serialize;

use crate::accuracy::measure::Measure;
use crate::accuracy::source::Source;
use drape::error::Result;
use drape::math;

pub use copies::COPIES;
pub use page::page;

/// Distances that are looked for, in metres, with their names.
pub const DISTANCES: [(f64, &str); 3] = [(1e-6, "1 um"), (1e-3, "1 mm"), (1e-2, "1 cm")];

/// Distances of more than this times the rounding have grown by more than adding up.
const GROWN: f64 = 1e4;

/// Fewest frames from which a growth rate is told.
const FEWEST: usize = 3;

/// How far copies have parted at the end of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Parting {
    /// Simulated time, in seconds.
    pub time: f64,
    /// Root of the mean of the squared distances from the first copy, over points and copies, in metres.
    pub rms: f64,
    /// Largest distance of a point from the same one of the first copy, in metres.
    pub max: f64,
    /// Largest distance in the picture that the camera of the scene shows, in pixels, if that is asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pixels: Option<f64>,
}

impl Parting {
    /// The largest distance of a point in the unit of `measure`; none in pixels where it was not asked for.
    pub fn largest(&self, measure: Measure) -> f64 {
        if measure == Measure::Pixels { self.pixels.unwrap_or_default() } else { self.max }
    }
}

/// Copies of a simulation beside each other.
#[derive(Clone, Debug, Serialize)]
pub struct Horizon {
    /// What the start of a copy differs by in each coordinate, in metres.
    pub rounding: f64,
    /// After each frame.
    pub partings: Vec<Parting>,
    /// The first time at which a point has parted by each of [`DISTANCES`], in seconds.
    pub times: Vec<Reached>,
    /// How fast the root mean square distance grows before it reaches the first of [`DISTANCES`], in 1/s: by the
    /// factor e in the inverse of it. `None` if it stays near the rounding, or passes both within two frames.
    pub growth: Option<f64>,
    /// The lowest and highest of the copies at the end.
    pub spread: Spread,
    /// Of each point, row by row: the largest distance of a copy at the end, in metres.
    #[serde(skip)]
    pub map: Vec<f64>,
    /// Columns and rows of points.
    #[serde(skip)]
    pub size: [usize; 2],
    /// Springs visited by all copies.
    #[serde(skip)]
    pub springs_visited: u64,
}

/// When the copies have parted by a distance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Reached {
    /// In metres.
    pub distance: f64,
    /// In seconds; `None` if not by the end.
    pub time: Option<f64>,
}

/// What copies agree on: the lowest and highest value over the copies at the end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Total energy, in J.
    pub energy: [f64; 2],
    /// Height of the lowest point, in metres.
    pub lowest: [f64; 2],
    /// Mean height of the points, in metres.
    pub mean: [f64; 2],
    /// Height of the highest point, in metres.
    pub highest: [f64; 2],
}

impl Horizon {
    /// Runs `source`, with the further changes `sets`, for `frames` frames beside copies; the distances are also those in
    /// the picture if `measure` is. `watch` is called after each frame and can end it with an error.
    ///
    /// # Errors
    /// Those of the scene, of the simulation, of the camera and of `watch`.
    pub fn of(
        source: &Source,
        sets: &[String],
        frames: u64,
        measure: Measure,
        watch: &(dyn Fn() -> Result<()> + Sync),
    ) -> Result<Self> {
        let scene = source.scene(sets)?;
        let mut copies = copies::Copies::new(&scene)?;
        let mut partings = Vec::new();
        for _ in 0..frames {
            copies.advance()?;
            watch()?;
            partings.push(copies.parting(measure)?);
        }
        let size = scene.cloth.as_ref().map_or([0, 0], |c| [c.num_width_points, c.num_height_points]);
        Ok(Self {
            rounding: copies.rounding,
            times: DISTANCES
                .map(|(distance, _)| Reached { distance, time: reached(&partings, Measure::Max, distance) })
                .to_vec(),
            growth: growth(&partings, copies.rounding),
            spread: copies.spread(),
            map: copies.map()?,
            size,
            springs_visited: copies.springs_visited(),
            partings,
        })
    }

    /// The first time at which a point has parted by `distance` in the unit of `measure`, in seconds.
    pub fn reached(&self, measure: Measure, distance: f64) -> Option<f64> {
        reached(&self.partings, measure, distance)
    }
}

fn reached(partings: &[Parting], measure: Measure, distance: f64) -> Option<f64> {
    partings.iter().find(|parting| parting.largest(measure) >= distance).map(|parting| parting.time)
}

/// The slope of a line through the logarithms of the distances, by least squares, from the last frame at which they are
/// at most [`GROWN`] times `rounding` to the first of [`DISTANCES`]. Before that a cloth in free fall carries
/// its rounding along, which grows as the time does.
fn growth(partings: &[Parting], rounding: f64) -> Option<f64> {
    let end = partings.iter().position(|p| p.rms >= DISTANCES[0].0).unwrap_or(partings.len());
    let before = &partings[..end];
    let start = before.iter().rposition(|p| p.rms <= GROWN * rounding)?;
    let points: Vec<[f64; 2]> =
        before[start..].iter().filter(|p| p.rms > 0.0).map(|p| [p.time, math::ln(p.rms)]).collect();
    if points.len() < FEWEST {
        return None;
    }
    let n = points.len() as f64;
    let mean = |i: usize| points.iter().map(|p| p[i]).sum::<f64>() / n;
    let [t, y] = [mean(0), mean(1)];
    let product =
        |i: usize, j: usize| points.iter().map(|p| [p[0] - t, p[1] - y]).map(|p| p[i] * p[j]).sum::<f64>();
    let slope = product(0, 1) / product(0, 0);
    (slope > 0.0).then_some(slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn partings(rms: impl Fn(f64) -> f64) -> Vec<Parting> {
        (1..=90)
            .map(|i| f64::from(i) / 90.0)
            .map(|time| Parting { time, rms: rms(time), max: 2.0 * rms(time), pixels: None })
            .collect()
    }

    #[test]
    fn the_growth_is_the_rate_before_a_micrometre() {
        let partings = partings(|t| 1e-16 * math::exp(30.0 * t));
        assert!((growth(&partings, 1e-16).unwrap() - 30.0).abs() < 1e-9);
        assert_eq!(reached(&partings, Measure::Max, 1e-6), Some(67.0 / 90.0));
        assert_eq!(reached(&partings, Measure::Max, 1e-2), None);
    }

    #[test]
    fn what_does_not_grow_has_no_rate() {
        assert_eq!(growth(&partings(|_| 1e-16), 1e-16), None);
        assert_eq!(growth(&partings(|_| 0.0), 1e-16), None);
        assert_eq!(growth(&partings(|_| 1e-3), 1e-16), None, "parted in the first frame");
    }

    #[test]
    fn what_falls_before_it_touches_has_the_rate_of_the_contact() {
        let before = |t: f64| 1e-14 * (1.0 + t);
        let after = |t: f64| before(0.5) * math::exp(100.0 * (t - 0.5));
        let partings = partings(|t| if t < 0.5 { before(t) } else { after(t) });
        assert!((growth(&partings, 1e-16).unwrap() - 100.0).abs() < 1e-6);
    }
}
