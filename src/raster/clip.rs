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
fn distances([x, y, z, w]: [f64; 4]) -> [f64; 6] {
    [w + z, w - z, w + x, w - x, w + y, w - y]
}

/// Which of the six planes a position lies outside of, one bit a plane.
pub(super) fn outside(position: [f32; 4]) -> u8 {
    let distances = distances(position.map(f64::from));
    (0..6).fold(0, |bits, plane| bits | (u8::from(distances[plane] < 0.0) << plane))
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
