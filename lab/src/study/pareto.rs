//! The Pareto front of cost and error, and the advice that follows from it.

use serde::Serialize;

/// The indices of the points `[cost, error]` on the Pareto front, in order of their cost: no other point is
/// at least as good in both and better in one. Of equal points the first counts; points with a number that
/// is not finite are left out.
pub fn front(points: &[[f64; 2]]) -> Vec<usize> {
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

/// The best choice within a budget.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Advice {
    /// The most that may be paid.
    pub budget: f64,
    /// The index of the point with the smallest error within the budget.
    pub use_point: usize,
}

/// For budgets of 1, 2 and 5 times a power of ten the best of the `points` `[cost, error]` that the budget
/// allows. A budget that allows nothing better than the one before it is left out.
pub fn advice(points: &[[f64; 2]]) -> Vec<Advice> {
    let front = front(points);
    let mut advice: Vec<Advice> = Vec::new();
    for budget in budgets() {
        if let Some(&use_point) = front.iter().rev().find(|&&i| points[i][0] <= budget)
            && advice.last().is_none_or(|last| last.use_point != use_point)
        {
            advice.push(Advice { budget, use_point });
        }
    }
    advice
}

/// 1e-6, 2e-6, 5e-6, ... 5e14: from a microsecond to more springs than any run visits.
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
    fn the_front_holds_what_no_point_beats() {
        assert_eq!(front(&POINTS), [1, 3, 0]);
        assert_eq!(front(&[[1.0, 1.0], [1.0, 0.5], [2.0, 0.5]]), [1]);
        assert_eq!(front(&[]), Vec::<usize>::new());
    }

    #[test]
    fn advice_names_the_best_within_each_budget_and_repeats_nothing() {
        let found: Vec<_> = advice(&POINTS).iter().map(|a| (a.budget, a.use_point)).collect();
        assert_eq!(found, [(1.0, 1), (2.0, 3), (5.0, 0)]);
        assert_eq!(advice(&[[0.3, 1.0]]), [Advice { budget: 0.5, use_point: 0 }]);
    }
}
