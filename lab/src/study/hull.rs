//! The Pareto hull: what no other beats in both cost and error; and the advice that follows.

use serde::Serialize;

/// The indices of the points `[cost, error]` that no other point beats: none is as cheap and as accurate,
/// and better in one of the two. In order of their cost. Of equal points the first
/// counts; points with a number that is not finite do not.
pub fn hull(points: &[[f64; 2]]) -> Vec<usize> {
    let mut order: Vec<usize> =
        (0..points.len()).filter(|&i| points[i].iter().all(|c| c.is_finite())).collect();
    order.sort_by(|&a, &b| {
        let [[ca, ea], [cb, eb]] = [points[a], points[b]];
        ca.total_cmp(&cb).then(ea.total_cmp(&eb)).then(a.cmp(&b))
    });
    let mut best = f64::INFINITY;
    order.retain(|&i| {
        let better = points[i][1] < best;
        best = best.min(points[i][1]);
        better
    });
    order
}

/// What to use if so much can be paid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Advice {
    /// What can be paid at least.
    pub budget: f64,
    /// The index of the point with the smallest error at that price.
    pub use_point: usize,
}

/// For budgets 1, 2 and 5 times a power of ten the best of the `points` `[cost, error]` that can be
/// paid. A budget that buys nothing better than the one before it is left out.
pub fn advice(points: &[[f64; 2]]) -> Vec<Advice> {
    let hull = hull(points);
    let mut advice: Vec<Advice> = Vec::new();
    for budget in budgets() {
        if let Some(&use_point) = hull.iter().rev().find(|&&i| points[i][0] <= budget)
            && advice.last().is_none_or(|last| last.use_point != use_point)
        {
            advice.push(Advice { budget, use_point });
        }
    }
    advice
}

/// 1e-6, 2e-6, 5e-6, ... 5e14: from a microsecond to more springs than can be paid.
fn budgets() -> impl Iterator<Item = f64> {
    // The text of the number is read exactly.
    (-6..15).flat_map(|e| [1, 2, 5].map(|n| format!("{n}e{e}").parse().unwrap_or(f64::NAN)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [[f64; 2]; 8] = [
        [4.0, 1.0],
        [1.0, 8.0],
        [2.0, 9.0],
        [2.0, 3.0],
        [2.0, 3.0],
        [3.0, 3.0],
        [f64::NAN, 0.0],
        [0.5, f64::INFINITY],
    ];

    #[test]
    fn the_hull_holds_what_no_point_beats() {
        assert_eq!(hull(&POINTS), [1, 3, 0]);
        assert_eq!(hull(&[[1.0, 1.0], [1.0, 0.5], [2.0, 0.5]]), [1]);
        assert_eq!(hull(&[]), Vec::<usize>::new());
    }

    #[test]
    fn advice_names_the_best_that_can_be_paid_and_repeats_nothing() {
        let found: Vec<_> = advice(&POINTS).iter().map(|a| (a.budget, a.use_point)).collect();
        assert_eq!(found, [(1.0, 1), (2.0, 3), (5.0, 0)]);
        assert_eq!(advice(&[[0.3, 1.0]]), [Advice { budget: 0.5, use_point: 0 }]);
    }
}
