//! Where the four texels of a bilinear look-up are, found for several parts before any texel is read: a CPU starts
//! operations on vectors in their order, so that parts would otherwise wait for each other's texels.

use super::look_up::side;
use crate::{
    glsl::{Vec3, vec3},
    lanes::{Lane, MAX_PARTS, MAX_WIDTH, Part, Places, Whole},
};

/// Where (u·w, v·h) lies, counted from the middle of the first texel.
#[inline(always)]
pub(super) fn from_first<L: Lane>([w, h]: [usize; 2], [u, v]: [L; 2]) -> [L; 2] {
    [u * side(w) as f32 - 0.5, v * side(h) as f32 - 0.5]
}

/// The first of the four texels around places, and the weights of the right and of the lower ones; whether in no lane one
/// of them is beyond an edge.
#[inline(always)]
pub(super) fn first_of_four<P: Part>(
    [w, h]: [usize; 2],
    [x, y]: [P; 2],
    places: &mut Places,
) -> (bool, [P; 2]) {
    let (w, h) = (side(w), side(h));
    let (left, top) = (x.floor(), y.floor());
    let (i, j) = (left.whole_if_small(), top.whole_if_small());
    (j * w + i).store(places);
    (i.within(w - 1) & j.within(h - 1), [x - left, y - top])
}

/// Where the four texels around (u·w, v·h) are, for all parts.
pub(super) struct Around<P> {
    /// A bit for each part: 1 if in none of its lanes a texel is beyond an edge. That is nearly always so, and much less
    /// work.
    pub(super) inside: u32,
    /// The first of the four.
    pub(super) places: [Places; MAX_PARTS],
    /// What is added for the row below.
    pub(super) down: u32,
    /// Those of the right texels and of the lower ones.
    pub(super) weights: [[P; 2]; MAX_PARTS],
}

impl<P: Part> Around<P> {
    /// Finds those of the coordinates `u` and `v`. In place, because the compiler copies what is handed back.
    #[inline(always)]
    pub(super) fn find<L: Lane<Part = P, Token = P::Token>>(&mut self, size: [usize; 2], [u, v]: [L; 2]) {
        let mut part = 0;
        self.down = side(size[0]).cast_unsigned();
        let [x, y] = from_first(size, [u, v]);
        L::map_parts(
            [x, y, v],
            #[inline(always)]
            |[x, y, v]| {
                let (inside, weights) = first_of_four(size, [x, y], &mut self.places[part]);
                self.inside |= u32::from(inside) << part;
                self.weights[part] = weights;
                part += 1;
                [x, y, v]
            },
        );
        // So that they are read from memory, and not taken out of vectors one by one.
        std::hint::black_box(&mut self.places);
    }

    /// Where no part is inside.
    #[inline(always)]
    pub(super) fn nowhere(token: P::Token) -> Self {
        let weights = [[P::splat(token, 0.0); 2]; MAX_PARTS];
        Self { inside: 0, places: [[0; MAX_WIDTH]; MAX_PARTS], down: 0, weights }
    }

    /// Whether a part is inside.
    #[inline(always)]
    pub(super) fn holds(&self, part: usize) -> bool {
        self.inside >> part & 1 == 1
    }
}

/// Red, green and blue between packed texels, if all parts are inside and have some. All are read before the first are
/// mixed. No loop goes through the parts, because what it goes through would be written to memory.
#[inline(always)]
pub(super) fn between_packed<'a, L: Lane>(
    size: [usize; 2],
    [u, v]: [L; 2],
    texels: impl Fn(usize) -> Option<&'a [u32]>,
) -> Option<[L; 3]> {
    let token = u.token();
    let mut around = Around::<L::Part>::nowhere(token);
    around.find(size, [u, v]);
    if around.inside != (1 << L::PARTS) - 1 {
        return None;
    }
    let zero = L::Part::splat(token, 0.0).whole_if_small();
    let (mut texels_around, mut part, mut missing) = ([[zero; 4]; MAX_PARTS], 0, false);
    L::map_parts(
        [u, v, v],
        #[inline(always)]
        |values| {
            match texels(part) {
                Some(texels) => {
                    texels_around[part] =
                        L::Part::packed_around(token, texels, &around.places[part], around.down);
                }
                None => missing = true,
            }
            part += 1;
            values
        },
    );
    if missing {
        return None;
    }
    let mut part = 0;
    Some(L::map_parts(
        [u, v, v],
        #[inline(always)]
        |_| {
            part += 1;
            L::Part::bilinear_packed(texels_around[part - 1], around.weights[part - 1])
        },
    ))
}

/// Three values of their parts.
#[inline(always)]
pub(super) fn join<L: Lane>(parts: &[[L::Part; 3]; MAX_PARTS]) -> Vec3<L> {
    vec3(number_of_parts(parts, 0), number_of_parts(parts, 1), number_of_parts(parts, 2))
}

/// Number `k` of each part.
#[inline(always)]
fn number_of_parts<L: Lane>(parts: &[[L::Part; 3]; MAX_PARTS], k: usize) -> L {
    L::from_parts(
        #[inline(always)]
        |part| parts[part][k],
    )
}

/// Three values by parts.
#[inline(always)]
pub(super) fn split<L: Lane>(values: [L; 3]) -> [[L::Part; 3]; MAX_PARTS] {
    let mut parts = [[L::Part::splat(values[0].token(), 0.0); 3]; MAX_PARTS];
    for (k, value) in values.into_iter().enumerate() {
        value.each_part(
            #[inline(always)]
            |part, value| parts[part][k] = value,
        );
    }
    parts
}
