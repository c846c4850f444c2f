//! The number of a cell as one integer, so that cells are compared at once and those around one are found by adding.
//!
//! Each of the three numbers of a cell has 21 bits, the last one lowest. They are counted from an origin near the cloth, and
//! cut off at nearly ±2²⁰, which leaves room for one more and one less. Up to there the order of the numbers is that of
//! cells. Cells that are neighbours stay so, or become one.
//! So whoever looks for the neighbours of a point finds them all, and beyond that distance others too.

use super::cell_list::CellKey;

/// Bits of each of the three numbers.
const BITS: u32 = 21;

/// Half of what fits in so many bits.
const HALF: i64 = 1 << (BITS - 1);

/// What is beyond is cut off.
const LIMIT: i64 = HALF - 2;

/// Greater than the number of every cell, and of those around it.
pub(super) const END: u64 = u64::MAX;

/// What a number has more than that of the cell before in the same column: cells with the same first two numbers.
pub(super) const NEXT: u64 = 1;

/// Cells of a column that are around another cell.
pub(super) const COLUMN: u64 = 3;

/// What the numbers of the cells at the middle of those columns have more that are around a cell and come after it,
/// but for its own.
pub(super) const AHEAD: [u64; 4] =
    [difference(0, 1, 0), difference(1, -1, 0), difference(1, 0, 0), difference(1, 1, 0)];

/// The number of a cell, counted from the cell `origin`.
pub(super) fn number((x, y, z): CellKey, origin: CellKey) -> u64 {
    let part = |n: i64, origin: i64| {
        let (lowest, highest) = (origin.saturating_sub(LIMIT), origin.saturating_add(LIMIT));
        (n.max(lowest).min(highest) - origin + HALF).cast_unsigned()
    };
    (part(x, origin.0) << BITS | part(y, origin.1)) << BITS | part(z, origin.2)
}

/// What the number of a cell has more than that of another.
const fn difference(x: i64, y: i64, z: i64) -> u64 {
    // In two's complement: to add it is right where it is negative too.
    ((x << (2 * BITS)) + (y << BITS) + z).cast_unsigned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_stay_neighbours_and_cells_that_are_not_cut_off_keep_their_order() {
        let ends = [i64::MIN, i64::MIN + 1, -LIMIT - 2, -LIMIT - 1, -LIMIT, -LIMIT + 1, -1, 0, 1];
        let numbers: Vec<i64> = ends.into_iter().chain(ends.map(|n| -1 - n)).collect();
        let around = |n: i64| [n.saturating_sub(1), n, n.saturating_add(1)];
        for origin in [(0, 0, 0), (i64::MIN, i64::MAX, 7), (i64::MAX, i64::MIN, -LIMIT)] {
            for &x in &numbers {
                for &y in &numbers {
                    let at = number((x, y, 0), origin);
                    assert!(at < END);
                    for (dx, dy) in around(x).into_iter().flat_map(|x| around(y).map(|y| (x, y))) {
                        let other = number((dx, dy, 0), origin);
                        let columns =
                            AHEAD.iter().flat_map(|ahead| [*ahead, ahead.wrapping_neg()]).chain([0]);
                        let is_near = columns.into_iter().any(|column| other == at.wrapping_add(column));
                        assert!(is_near, "({dx}, {dy}) beside ({x}, {y}), from {origin:?}");
                        let is_cut = [x, dx]
                            .iter()
                            .any(|x| x.saturating_sub(origin.0).unsigned_abs() > LIMIT.unsigned_abs());
                        assert!(is_cut || (dx, dy) < (x, y) || other >= at, "({dx}, {dy}) after ({x}, {y})");
                    }
                }
            }
        }
        assert_eq!(number((1, -2, 3), (1, -2, 4)) + NEXT, number((1, -2, 4), (1, -2, 4)));
    }
}
