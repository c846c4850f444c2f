//! Clipping of triangles and lines against the six planes of the view volume (Sutherland and
//! Hodgman 1974), in clip space and f64.
//!
//! The vertex where the edge (i, j) meets a plane is (dⱼ·Vᵢ - dᵢ·Vⱼ)/(dⱼ - dᵢ) with d the signed
//! distances. Swapping i and j negates both factors exactly, so two triangles that share an edge
//! get the same vertex bit for bit, and no crack opens between them.

/// A vertex of a clipped primitive: where it is and how it is made of the primitive's corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ClipVertex {
    /// Clip-space position.
    pub(super) position: [f64; 4],
    /// Weight of each corner of the unclipped primitive; they sum to 1.
    pub(super) weights: [f64; 3],
}

/// Signed distance to each plane, positive inside: near, far, left, right, bottom, top.
#[inline(always)]
fn distances([x, y, z, w]: [f64; 4]) -> [f64; 6] {
    [w + z, w - z, w + x, w - x, w + y, w - y]
}

/// Largest coordinate in clip space. With larger ones, clipping in f64 loses the digits that place
/// what is left in the window.
const LIMIT: f32 = 4_294_967_296.0;

/// The bit of [`outside`] for a coordinate that is NaN, infinite or far too large.
pub(super) const FAR: u8 = 1 << 6;

/// Which of the six planes a position lies outside of, one bit a plane; and [`FAR`].
#[inline(always)]
pub(super) fn outside(position: [f32; 4]) -> u8 {
    let [x, y, z, w] = position;
    let distances = distances([x.into(), y.into(), z.into(), w.into()]);
    let far = !position.iter().all(|c| c.abs() <= LIMIT);
    (0..6).fold(u8::from(far) << 6, |bits, plane| bits | (u8::from(distances[plane] < 0.0) << plane))
}

/// Cuts away what lies outside of the planes whose bits are set in `planes`. The polygon is left
/// in `polygon`, empty if nothing is inside.
pub(super) fn clip_polygon(polygon: &mut Vec<ClipVertex>, planes: u8) {
    let mut input = Vec::with_capacity(polygon.len() + 6);
    for plane in (0..6).filter(|plane| planes >> plane & 1 == 1) {
        input.clear();
        input.append(polygon);
        for (i, &from) in input.iter().enumerate() {
            let to = input[(i + 1) % input.len()];
            let (d_from, d_to) = (distances(from.position)[plane], distances(to.position)[plane]);
            if d_from >= 0.0 {
                polygon.push(from);
            }
            if (d_from >= 0.0) != (d_to >= 0.0) && d_from != 0.0 && d_to != 0.0 {
                polygon.push(meet(from, d_from, to, d_to));
            }
        }
    }
}

/// Cuts a line segment; `None` if nothing is inside.
pub(super) fn clip_segment(ends: [ClipVertex; 2], planes: u8) -> Option<[ClipVertex; 2]> {
    let mut ends = ends;
    for plane in (0..6).filter(|plane| planes >> plane & 1 == 1) {
        let [d0, d1] = ends.map(|end| distances(end.position)[plane]);
        match (d0 >= 0.0, d1 >= 0.0) {
            (true, true) => {}
            (false, false) => return None,
            (true, false) => ends[1] = meet(ends[0], d0, ends[1], d1),
            (false, true) => ends[0] = meet(ends[0], d0, ends[1], d1),
        }
    }
    Some(ends)
}

/// Where the edge from `a` to `b` meets the plane at signed distances `d_a` and `d_b`.
fn meet(a: ClipVertex, d_a: f64, b: ClipVertex, d_b: f64) -> ClipVertex {
    let at = |a: f64, b: f64| (d_b * a - d_a * b) / (d_b - d_a);
    ClipVertex {
        position: std::array::from_fn(|i| at(a.position[i], b.position[i])),
        weights: std::array::from_fn(|i| at(a.weights[i], b.weights[i])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::splitmix64;

    /// Vertices far and near, in front of the eye and behind it.
    fn vertex(i: u64) -> [f64; 4] {
        std::array::from_fn(|k| {
            let bits = splitmix64(4 * i + k as u64);
            #[expect(clippy::cast_precision_loss, reason = "24 bits")]
            let part = (bits >> 40) as f64 / 8_388_608.0 - 1.0;
            part * if bits & 3 == 0 { 1000.0 } else { 2.0 }
        })
    }

    fn corner(position: [f64; 4], i: usize) -> ClipVertex {
        let mut weights = [0.0; 3];
        weights[i] = 1.0;
        ClipVertex { position, weights }
    }

    /// The bits of the positions that clipping leaves of edge (0, 1) of a triangle, in order.
    fn on_shared_edge(corners: [[f64; 4]; 3]) -> Vec<[u64; 4]> {
        let mut polygon: Vec<ClipVertex> = (0..3).map(|i| corner(corners[i], i)).collect();
        clip_polygon(&mut polygon, 0b11_1111);
        let shared = polygon.iter().filter(|v| v.weights[2] == 0.0);
        let mut bits: Vec<_> = shared.map(|v| v.position.map(f64::to_bits)).collect();
        bits.sort_unstable();
        bits
    }

    #[test]
    fn an_edge_is_cut_alike_from_both_sides() {
        let mut cut = 0;
        for i in 0..20_000 {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| vertex(4 * i + k));
            let (one, other) = (on_shared_edge([a, b, c]), on_shared_edge([b, a, d]));
            assert_eq!(one, other, "{a:?} {b:?}");
            let segment =
                |ends: [[f64; 4]; 2]| clip_segment([corner(ends[0], 0), corner(ends[1], 1)], 0b11_1111);
            let backwards = segment([b, a]).map(|[to, from]| [from.position, to.position]);
            assert_eq!(segment([a, b]).map(|ends| ends.map(|end| end.position)), backwards);
            cut += one.len();
        }
        assert!(cut > 4000, "only {cut} vertices");
    }

    #[test]
    fn weights_tell_where_a_vertex_is() {
        for i in 0..20_000 {
            let corners = [0, 1, 2].map(|k| vertex(3 * i + k));
            let mut polygon: Vec<ClipVertex> = (0..3).map(|i| corner(corners[i], i)).collect();
            clip_polygon(&mut polygon, 0b11_1111);
            for ClipVertex { position, weights } in polygon {
                assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{weights:?}");
                for (k, coordinate) in position.into_iter().enumerate() {
                    let mixed: f64 = (0..3).map(|i| weights[i] * corners[i][k]).sum();
                    assert!((coordinate - mixed).abs() < 1e-9, "{coordinate} for {mixed}");
                }
                assert!(distances(position).iter().all(|&d| d > -1e-9), "{position:?} is outside");
            }
        }
    }
}
