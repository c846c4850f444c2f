//! How many things a scene holds, by formula.

use drape::scene::Cloth;

/// Structural, shearing and bending springs of a cloth; 0 for a kind that is off.
pub(crate) fn springs(cloth: &Cloth) -> [usize; 3] {
    let (w, h) = (cloth.num_width_points, cloth.num_height_points);
    // Pairs of points that lie `n` apart along the rows and along the columns.
    let apart = |n: usize| w.saturating_sub(n) * h + w * h.saturating_sub(n);
    let kind = |on: bool, count: usize| if on { count } else { 0 };
    [
        kind(cloth.enable_structural, apart(1)),
        kind(cloth.enable_shearing, 2 * w.saturating_sub(1) * h.saturating_sub(1)),
        kind(cloth.enable_bending, apart(2)),
    ]
}
