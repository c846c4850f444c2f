//! The box: a point inside it is put on its nearest face.

use super::contact::{Entry, Shape, may_reach_box};
use crate::scene::{self, Vec3};

/// A box, ready for the step.
#[derive(Clone, Debug)]
pub(super) struct Cuboid {
    /// The corners with the smallest and the largest coordinates.
    lower: Vec3,
    upper: Vec3,
    friction: f64,
}

/// A face: the axis that it is at right angles to, and whether it is the upper one of the two.
#[derive(Clone, Copy)]
struct Face {
    axis: usize,
    upper: bool,
}

/// Every face. Of those that are equally near the first counts: from the very centre of a cube a point goes
/// straight up, as from that of a ball.
const FACES: [Face; 6] = [
    Face { axis: 1, upper: true },
    Face { axis: 1, upper: false },
    Face { axis: 0, upper: true },
    Face { axis: 0, upper: false },
    Face { axis: 2, upper: true },
    Face { axis: 2, upper: false },
];

impl Cuboid {
    /// The box of a scene.
    pub(super) fn new(cuboid: &scene::Cuboid) -> Self {
        let [lower, upper] = cuboid.corners();
        Self { lower, upper, friction: cuboid.friction }
    }

    /// Whether `x` is inside; a point of a face is not.
    #[inline(always)]
    fn contains(&self, x: Vec3) -> bool {
        let Self { lower, upper, .. } = self;
        (lower.x < x.x)
            & (x.x < upper.x)
            & (lower.y < x.y)
            & (x.y < upper.y)
            & (lower.z < x.z)
            & (x.z < upper.z)
    }

    /// The coordinate at which a face lies.
    fn place(&self, face: Face) -> f64 {
        if face.upper { self.upper[face.axis] } else { self.lower[face.axis] }
    }

    /// The face that a point at `x`, inside, is nearest to.
    fn nearest_face(&self, x: Vec3) -> Face {
        let depth = |face: Face| (self.place(face) - x[face.axis]).abs();
        FACES[1..].iter().fold(FACES[0], |near, &face| if depth(face) < depth(near) { face } else { near })
    }

    /// `x` with the coordinate that puts it on a face.
    fn on_face(&self, mut x: Vec3, face: Face) -> Vec3 {
        x[face.axis] = self.place(face);
        x
    }

    /// Of a way that starts outside: the part of it before it enters the box, and the face. The way is inside from
    /// where it has passed the first of both faces of every axis until it passes the second of one (Kay and
    /// Kajiya 1986).
    fn first_face(&self, from: Vec3, way: Vec3) -> Option<(f64, Face)> {
        let mut entry: Option<(f64, Face)> = None;
        let mut leaves = 1.0_f64;
        for axis in 0..3 {
            if way[axis] == 0.0 {
                if from[axis] <= self.lower[axis] || from[axis] >= self.upper[axis] {
                    return None;
                }
                continue;
            }
            let upper = way[axis] < 0.0;
            let face = Face { axis, upper };
            let part = (self.place(face) - from[axis]) / way[axis];
            leaves = leaves.min((self.place(Face { axis, upper: !upper }) - from[axis]) / way[axis]);
            if entry.is_none_or(|(before, _)| part > before) {
                entry = Some((part, face));
            }
        }
        entry.filter(|(part, _)| *part >= 0.0 && *part < leaves)
    }
}

impl Face {
    /// The outward normal.
    fn normal(self) -> Vec3 {
        let mut normal = Vec3::zeros();
        normal[self.axis] = if self.upper { 1.0 } else { -1.0 };
        normal
    }
}

impl Shape for Cuboid {
    #[inline(always)]
    fn hit(&self, x: Vec3, _last: Vec3) -> bool {
        self.contains(x)
    }

    fn resolve(&self, x: Vec3, last: Vec3) -> Vec3 {
        let target = self.on_face(x, self.nearest_face(x));
        last + (target - last) * (1.0 - self.friction)
    }

    fn depenetrate(&self, _p: usize, x: Vec3) -> Option<Vec3> {
        self.contains(x).then(|| self.on_face(x, self.nearest_face(x)))
    }

    fn enter(&self, _p: usize, from: Vec3, way: Vec3) -> Option<Entry> {
        let (part, face) = if self.contains(from) {
            Some((0.0, self.nearest_face(from)))
        } else {
            self.first_face(from, way)
        }?;
        let normal = face.normal();
        (way[face.axis] * normal[face.axis] < 0.0).then(|| {
            let point = self.on_face(from + way * part, face);
            Entry { part, point, normal }
        })
    }

    #[inline(always)]
    fn is_near(&self, _p: usize, from: Vec3, to: Vec3) -> bool {
        may_reach_box(from, to, self.lower, self.upper)
    }

    fn friction(&self) -> f64 {
        self.friction
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From -1 to 1 along x and z, from 0 to 0.5 along y.
    fn slab() -> Cuboid {
        let (lower, upper) = (Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 0.5, 1.0));
        Cuboid { lower, upper, friction: 0.25 }
    }

    fn entry(from: [f64; 3], to: [f64; 3]) -> Option<(f64, [f64; 3], [f64; 3])> {
        let (from, to) = (Vec3::from(from), Vec3::from(to));
        slab().enter(0, from, to - from).map(|entry| (entry.part, entry.point.into(), entry.normal.into()))
    }

    #[test]
    fn a_point_inside_goes_to_the_nearest_face() {
        let out = |x: [f64; 3]| slab().depenetrate(0, Vec3::from(x)).map(<[f64; 3]>::from);
        assert_eq!(out([0.0, 0.4, 0.0]), Some([0.0, 0.5, 0.0]));
        assert_eq!(out([0.0, 0.25, 0.0]), Some([0.0, 0.5, 0.0]), "up, of two that are equally near");
        assert_eq!(out([0.0, 0.1, 0.9]), Some([0.0, 0.1, 1.0]));
        assert_eq!(out([-0.95, 0.2, 0.9]), Some([-1.0, 0.2, 0.9]));
        assert_eq!(out([0.0, 0.5, 0.0]), None, "on a face");
        assert_eq!(out([0.0, 0.6, 0.0]), None);
        let (x, last) = (Vec3::new(0.0, 0.4, 0.0), Vec3::new(0.0, 0.9, 0.0));
        assert_eq!(slab().resolve(x, last), Vec3::new(0.0, 0.9 - 0.4 * 0.75, 0.0), "friction as for a ball");
    }

    #[test]
    fn a_way_enters_through_the_first_face_that_it_meets() {
        assert_eq!(entry([0.0, 1.0, 0.0], [0.0, -1.0, 0.0]), Some((0.25, [0.0, 0.5, 0.0], [0.0, 1.0, 0.0])));
        assert_eq!(entry([-3.0, 0.25, 0.0], [5.0, 0.25, 0.0]).unwrap().2, [-1.0, 0.0, 0.0], "right through");
        assert_eq!(entry([0.0, 1.0, 0.0], [0.0, 0.75, 0.0]), None, "too short");
        assert_eq!(entry([2.0, 1.0, 0.0], [3.0, -1.0, 0.0]), None, "beside");
        assert_eq!(entry([1.0, 1.0, 0.0], [1.0, -1.0, 0.0]), None, "along a face");
        assert_eq!(entry([0.0, 0.5, 0.0], [0.5, 0.5, 0.0]), None, "along the top");
        assert_eq!(entry([0.0, 0.5, 0.0], [0.5, 0.6, 0.0]), None, "away from the top");
        let top = entry([0.0, 0.5, 0.0], [0.5, 0.4, 0.0]);
        assert_eq!(top, Some((0.0, [0.0, 0.5, 0.0], [0.0, 1.0, 0.0])), "into the top");
        // Over the edge at x = 1: the way enters through the face that it meets last.
        assert_eq!(
            entry([2.0, 1.0, 0.0], [0.0, 0.0, 0.0]).unwrap().2,
            [1.0, 0.0, 0.0],
            "of two at once the first axis"
        );
        assert_eq!(entry([2.0, 0.9, 0.0], [0.0, -0.1, 0.0]).unwrap().2, [1.0, 0.0, 0.0]);
        assert_eq!(entry([2.0, 1.2, 0.0], [0.0, 0.2, 0.0]).unwrap().2, [0.0, 1.0, 0.0]);
    }
}
