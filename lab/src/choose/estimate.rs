//! The limit of ever smaller steps, estimated from runs at n, 2 n and 4 n steps a frame.
//!
//! Where the error falls as `C n⁻ᵖ`, the differences of successive runs are parallel and each is `2ᵖ` times
//! the next. The order p is read off their lengths, and the limit is `x₃ - (x₂ - x₃) / (2ᵖ - 1)`
//! (Richardson's extrapolation). What the three runs say against that, the part of the first difference that
//! is not `2ᵖ` times the second, is the uncertainty, with a tenth of the correction. Where contact, self-collision
//! or the stretch limit moved a point, three runs can follow a law that the next does not, since these act once a
//! step: there four runs have to show an order, and all of the correction is uncertain.
//!
//! Where they are not parallel, or the order is not between [`LOWEST`] and [`HIGHEST`], no order is seen and
//! nothing is extrapolated: the limit is taken to be the last run, uncertain by [`DOUBT`] times the larger of
//! the last difference and half of the one before it, which a method of first order would show. Where the lengths of the
//! last three differences fall steadily, each to [`STEADY`] of the one before or less, the uncertainty is [`LESS_DOUBT`]
//! times that: what is left of such a series is at most 1.5 times its last term.
//!
//! Fewer runs show no order, but where they agree far better than is asked for, they need not: the uncertainty is
//! [`OF_THREE`] times the last difference of three rough runs, as above, and of two runs [`OF_TWO`] times their difference,
//! or [`OF_TWO_ROUGH`] times.

use crate::accuracy::measure::{Measure, Shape, difference};
use drape::math;

/// The lowest and highest order that is believed: contact and the stretch limit are of first order, Verlet's
/// scheme of second.
const LOWEST: f64 = 0.7;
const HIGHEST: f64 = 2.6;

/// The least cosine of the angle between successive differences where an order is believed.
const PARALLEL: f64 = 0.9;

/// Uncertainty over correction, where nothing but springs moved the points.
const SMOOTH: f64 = 0.1;

/// Uncertainty over difference, where no order is seen.
const DOUBT: f64 = 3.0;

/// The same where the differences fall steadily.
const LESS_DOUBT: f64 = 2.0;

/// Uncertainty over difference of three runs where four have to show an order.
const OF_THREE: f64 = 10.0;

/// Uncertainty over the difference of two runs in which only springs moved the points.
const OF_TWO: f64 = 10.0;

/// Uncertainty over the difference of two other runs.
const OF_TWO_ROUGH: f64 = 30.0;

/// The most that a difference is of the one before it where they fall steadily.
const STEADY: f64 = 0.6;

/// What the last runs of a ladder say of the limit.
#[derive(Clone, Debug)]
pub(super) struct Limit {
    /// The observed order, if one is seen.
    pub(super) order: Option<f64>,
    /// Where the points are in the limit.
    pub(super) shape: Shape,
    /// How it is measured.
    pub(super) measure: Measure,
    /// How far the limit may be from there, in the unit of the measure.
    pub(super) uncertainty: f64,
}

impl Limit {
    /// From the states at n, 2 n, 4 n, ... steps a frame, if there are enough; `rough` if anything but springs moved
    /// points.
    pub(super) fn new(states: &[&Shape], rough: bool, measure: Measure) -> Option<Self> {
        let (earlier, last) = match *states {
            [.., x0, x1, x2, x3] if rough => (Some([x0, x1, x2]), [x1, x2, x3]),
            [.., x1, x2, x3] if !rough => (None, [x1, x2, x3]),
            [.., x1, x2, x3] => {
                let [first, second] = [measure.distance(x1, x2), measure.distance(x2, x3)];
                return Some(Self::agreed(x3, OF_THREE * second.max(0.5 * first), measure));
            }
            [x1, x2] => {
                let part = if rough { OF_TWO_ROUGH } else { OF_TWO };
                return Some(Self::agreed(x2, part * measure.distance(x1, x2), measure));
            }
            _ => return None,
        };
        let [x1, x2, x3] = last;
        let (first, second) = (difference(x1, x2), difference(x2, x3));
        let confirmed = earlier.is_none_or(|[a, b, c]| order(&difference(a, b), &difference(b, c)).is_some());
        let Some(order) = order(&first, &second).filter(|_| confirmed) else {
            let [first, second] = [&first, &second].map(|d| measure.size(d));
            let before = states.iter().rev().nth(3).map(|x0| measure.distance(x0, x1));
            let is_steady = before.is_some_and(|before| first <= STEADY * before && second <= STEADY * first);
            let doubt = if is_steady { LESS_DOUBT } else { DOUBT };
            return Some(Self::agreed(x3, doubt * second.max(0.5 * first), measure));
        };
        let ratio = math::pow(2.0, order);
        let combined = |f: &dyn Fn(f64, f64) -> f64, a: &Shape, b: &Shape| -> Shape {
            a.iter().zip(b).map(|(a, b)| [0, 1, 2].map(|i| f(a[i], b[i]))).collect()
        };
        let against = combined(&|a, b| a / ratio - b, &first, &second);
        let shape = combined(&|x, d| x - d / (ratio - 1.0), x3, &second);
        let part = if rough { 1.0 } else { SMOOTH };
        let uncertainty = (measure.size(&against) + part * measure.size(&second)) / (ratio - 1.0);
        Some(Self { order: Some(order), shape, measure, uncertainty })
    }

    /// The last run stands for the limit.
    fn agreed(last: &Shape, uncertainty: f64, measure: Measure) -> Self {
        Self { order: None, shape: last.clone(), measure, uncertainty }
    }
}

/// The order that successive differences show, if they show one.
fn order(first: &Shape, second: &Shape) -> Option<f64> {
    let dot = |a: &Shape, b: &Shape| -> f64 {
        a.iter().zip(b).map(|(a, b)| a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).sum()
    };
    let [a, b] = [dot(first, first).sqrt(), dot(second, second).sqrt()];
    let cosine = dot(first, second) / (a * b);
    let order = math::ln(a / b) / math::ln(2.0);
    // Comparisons with NaN, of differences of length 0, are false.
    (cosine >= PARALLEL && (LOWEST..=HIGHEST).contains(&order)).then_some(order)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points at `limit + c n⁻ᵖ`, n = 1, 2, 4, 8, the second of which is off by `turned` times that at n = 4.
    fn runs(order: i32, turned: f64) -> [Shape; 4] {
        [1.0_f64, 2.0, 4.0, 8.0].map(|n| {
            let error = (0..order).fold(1.0, |error, _| error / n);
            let off = if n == 4.0 { turned * error } else { 0.0 };
            vec![[1.0 + 0.3 * error, 2.0, 0.0], [0.0, 5.0 - error, off]]
        })
    }

    fn limit(runs: &[Shape], rough: bool, measure: Measure) -> Option<Limit> {
        Limit::new(&runs.iter().collect::<Vec<_>>(), rough, measure)
    }

    #[test]
    fn a_seen_order_gives_the_limit() {
        for order in [1, 2] {
            let runs = runs(order, 0.0);
            let smooth = limit(&runs[..3], false, Measure::Max).unwrap();
            assert!((smooth.order.unwrap() - f64::from(order)).abs() < 1e-12);
            assert!(Measure::Max.distance(&smooth.shape, &vec![[1.0, 2.0, 0.0], [0.0, 5.0, 0.0]]) < 1e-14);
            let correction = Measure::Max.distance(&smooth.shape, &runs[2]);
            assert!((smooth.uncertainty - 0.1 * correction).abs() < 1e-14);
            let rough = limit(&runs, true, Measure::Max).unwrap();
            let correction = Measure::Max.distance(&rough.shape, &runs[3]);
            assert!(rough.order.is_some() && (rough.uncertainty - correction).abs() < 1e-14);
        }
    }

    #[test]
    fn fewer_runs_show_no_order_and_leave_more_doubt() {
        let runs = runs(1, 0.0);
        assert!(limit(&runs[..1], false, Measure::Max).is_none());
        let [first, second] = [0, 1].map(|i| Measure::Max.distance(&runs[i], &runs[i + 1]));
        for (of, rough, last, doubt) in
            [(2, false, 1, 10.0 * first), (2, true, 1, 30.0 * first), (3, true, 2, 10.0 * second)]
        {
            let limit = limit(&runs[..of], rough, Measure::Max).unwrap();
            assert_eq!((limit.order, &limit.shape, limit.uncertainty), (None, &runs[last], doubt));
        }
    }

    #[test]
    fn where_no_order_is_seen_nothing_is_extrapolated() {
        for runs in [runs(0, 0.0), runs(3, 0.0)] {
            let limit = limit(&runs, false, Measure::Rms).unwrap();
            assert_eq!((limit.order, &limit.shape), (None, &runs[3]));
        }
        let runs = runs(1, 2.0);
        let limit = limit(&runs, true, Measure::Max).unwrap();
        assert_eq!(limit.order, None, "differences that are not parallel");
        let [first, second] = [1, 2].map(|i| Measure::Max.distance(&runs[i], &runs[i + 1]));
        assert_eq!(limit.uncertainty, 3.0 * second.max(0.5 * first));
    }

    #[test]
    fn differences_that_fall_steadily_leave_less_doubt() {
        // Each difference is half as long as the one before, and at a right angle to it.
        let runs = [[0.0, 0.0], [8.0, 0.0], [8.0, 4.0], [10.0, 4.0]].map(|[x, y]| vec![[x, y, 0.0]]);
        let of = |runs: &[Shape]| limit(runs, false, Measure::Max).unwrap();
        assert_eq!((of(&runs).order, of(&runs).uncertainty), (None, 4.0));
        assert_eq!(
            (of(&runs[1..]).order, of(&runs[1..]).uncertainty),
            (None, 6.0),
            "three runs show no series"
        );
    }
}
