//! Two files of positions compared with each other.

use serde::Serialize;

use super::case::distance;
use super::states::Numbers;
use drape::error::{Error, Kind, Result};

/// How two files of positions differ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pair {
    /// Points in each file, of all states together.
    pub points: usize,
    /// Points that are farther apart than the tolerance, or that have other bits if it is 0.
    pub differing: usize,
    /// The first of them, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first: Option<Place>,
    /// Largest distance of two points, in metres; absent where a position is no number.
    pub largest: Option<f64>,
    /// Root of the mean square of the distances, in metres.
    pub rms: Option<f64>,
}

/// A point that differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Place {
    /// Its number in the file, from 0.
    pub point: usize,
    /// Its column and row, if a file says how many columns there are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column_row: Option<[usize; 2]>,
    /// Distance of the two, in metres.
    pub distance: Option<f64>,
}

impl Pair {
    /// Compares two files; points at most `tolerance` metres apart are alike, and 0 asks for equal bits.
    ///
    /// # Errors
    /// [`Kind::Io`] when they do not hold as many points, or not whole points.
    pub fn new(a: &Numbers, b: &Numbers, tolerance: f64) -> Result<Self> {
        let [left, right] = [a, b].map(|file| file.numbers.as_chunks::<3>());
        if a.numbers.len() != b.numbers.len() || !left.1.is_empty() || left.0.is_empty() {
            let [a, b] = [a, b].map(|file| file.numbers.len());
            let message = format!("one file holds {a} numbers, the other {b}; both must hold as many points");
            return Err(Error::new(Kind::Io, message).with_help("a point is three numbers, x y z"));
        }
        let finite = |value: f64| value.is_finite().then_some(value);
        let (mut largest, mut squares, mut differing, mut first) = (0.0_f64, 0.0, 0, None);
        let columns = a.shape.as_ref().or(b.shape.as_ref()).map(|[width, _]| *width);
        for (point, (&a, &b)) in left.0.iter().zip(right.0).enumerate() {
            let apart = distance(a, b);
            largest = if apart.is_finite() { largest.max(apart) } else { f64::INFINITY };
            squares += apart * apart;
            let within = tolerance > 0.0 && apart <= tolerance;
            if a.map(f64::to_bits) != b.map(f64::to_bits) && !within {
                differing += 1;
                let column_row = columns.map(|columns| [point % columns, point / columns]);
                first.get_or_insert(Place { point, column_row, distance: finite(apart) });
            }
        }
        let points = left.0.len();
        let rms = finite((squares / points as f64).sqrt());
        Ok(Self { points, differing, first, largest: finite(largest), rms })
    }

    /// The result as text.
    pub fn text(&self) -> String {
        let metres = |value: Option<f64>| value.map_or("no number".to_owned(), |m| format!("{m:.3e} m"));
        let first = self.first.as_ref().map_or_else(String::new, |Place { point, column_row, distance }| {
            let place = column_row.map_or_else(String::new, |[i, j]| format!(" (column {i}, row {j})"));
            format!("parts at    point {point}{place}, {}\n", metres(*distance))
        });
        format!(
            "points      {}, of which {} differ\n{first}largest     {}\nrms         {}\n",
            self.points,
            self.differing,
            metres(self.largest),
            metres(self.rms),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_tells_the_first_point_and_the_distances() {
        let file = |numbers: &[f64], shape| Numbers { numbers: numbers.to_vec(), shape };
        let a = file(&[0.0, 0.0, 0.0, 1.0, 1.0, 1.0], Some([1, 2]));
        let b = file(&[0.0, 0.0, 0.0, 1.0, 4.0, 5.0], None);
        let pair = Pair::new(&a, &b, 0.0).unwrap();
        let first = Some(Place { point: 1, column_row: Some([0, 1]), distance: Some(5.0) });
        assert_eq!(
            pair,
            Pair { points: 2, differing: 1, first, largest: Some(5.0), rms: Some(12.5_f64.sqrt()) }
        );
        assert_eq!(Pair::new(&a, &b, 5.0).unwrap().differing, 0);
        let nan = file(&[f64::NAN, 0.0, 0.0, 1.0, 1.0, 1.0], None);
        let pair = Pair::new(&a, &nan, 1.0).unwrap();
        assert_eq!((pair.differing, pair.largest, pair.rms), (1, None, None));
        assert!(Pair::new(&a, &file(&[1.0; 3], None), 0.0).is_err());
        assert!(Pair::new(&file(&[1.0; 2], None), &file(&[1.0; 2], None), 0.0).is_err());
    }
}
