//! Where the texels of a look-up are, and how they are combined.

use super::Wrap;
use crate::{
    lanes::{Part, Whole},
    scene::Filter,
};

/// The pictures that the lanes look into.
pub(super) trait Pictures {
    /// The texels of a lane's picture.
    fn texels(&self, lane: usize) -> &[[f32; 4]];
}

/// One for all lanes.
pub(super) struct Picture<'a>(pub(super) &'a [[f32; 4]]);

impl Pictures for Picture<'_> {
    #[inline(always)]
    fn texels(&self, _lane: usize) -> &[[f32; 4]] {
        self.0
    }
}

/// Where the four texels around (u·w, v·h) are: the number of the first, what is added for the row below, and the
/// weights. Only if in no lane one of them is beyond an edge: that is nearly always so, and much less work.
#[inline(always)]
pub(super) fn inside<P: Part>([w, h]: [usize; 2], [u, v]: [P; 2]) -> Option<(P::Whole, u32, [P; 2])> {
    let (w, h) = (side(w), side(h));
    let (x, y) = (u * w as f32 - 0.5, v * h as f32 - 0.5);
    let (left, top) = (x.floor(), y.floor());
    let (i, j) = (left.whole_if_small(), top.whole_if_small());
    if i.within(w - 1) & j.within(h - 1) {
        Some((j * w + i, w.cast_unsigned(), [x - left, y - top]))
    } else {
        None
    }
}

/// Filters texels around (u·w, v·h) of each lane's picture.
#[inline(always)]
pub(super) fn look_up<P: Part>(
    filter: Filter,
    [u, v]: [P; 2],
    [w, h]: [usize; 2],
    [along_u, along_v]: [Wrap; 2],
    pictures: &impl Pictures,
) -> [P; 3] {
    let (w, h) = (side(w), side(h));
    let (x, y) = (u * w as f32, v * h as f32);
    match filter {
        Filter::Nearest => {
            let ([i, _], [j, _]) = (along_u.neighbors(x.floor(), w), along_v.neighbors(y.floor(), h));
            gather(x.token(), pictures, j * w + i)
        }
        Filter::Bilinear => {
            let (x, y) = (x - 0.5, y - 0.5);
            let (i, j) = (x.floor(), y.floor());
            let (fx, fy) = (x - i, y - j);
            let ([i0, i1], [j0, j1]) = (along_u.neighbors(i, w), along_v.neighbors(j, h));
            let (top, bottom) = (j0 * w, j1 * w);
            let texels = |place: P::Whole| gather(x.token(), pictures, place);
            let top = mix::<P>(texels(top + i0), texels(top + i1), fx);
            let bottom = mix::<P>(texels(bottom + i0), texels(bottom + i1), fx);
            mix(top, bottom, fy)
        }
    }
}

/// `mix(a, b, f)` as a + (b - a)·f, which gives a exactly when a = b.
#[inline(always)]
pub(super) fn mix<P: Part>(a: [P; 3], b: [P; 3], f: P) -> [P; 3] {
    let ([ar, ag, ab], [br, bg, bb]) = (a, b);
    [ar + (br - ar) * f, ag + (bg - ag) * f, ab + (bb - ab) * f]
}

/// The texel at index `place` of each lane's picture.
#[inline(always)]
fn gather<P: Part>(token: P::Token, pictures: &impl Pictures, place: P::Whole) -> [P; 3] {
    P::transpose(
        token,
        #[inline(always)]
        |lane| pictures.texels(lane)[place.lane(lane).cast_unsigned() as usize],
    )
}

/// A side of a texture as indices are counted.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "textures are at most 16384 texels wide"
)]
#[inline(always)]
pub(super) fn side(n: usize) -> i32 {
    n as i32
}

impl Wrap {
    /// The columns (or rows) i and i + 1, brought into 0..n.
    #[inline(always)]
    fn neighbors<P: Part>(self, i: P, n: i32) -> [P::Whole; 2] {
        match self {
            Self::Repeat => repeat(i.to_whole(), n),
            Self::Clamp => clamp(i.to_whole(), n),
        }
    }
}

/// The Euclidean modulus of i and of i + 1.
#[inline(always)]
fn repeat<I: Whole>(i: I, n: i32) -> [I; 2] {
    // Nearly always all are inside; a division costs more than the rest of the look-up.
    let first = if i.within(n) { i } else { each_modulo(i, n) };
    let next = first + 1;
    [first, next.select_equal(next.all(n), next.all(0), next)]
}

/// The Euclidean modulus of one lane after the other.
#[inline(always)]
fn each_modulo<I: Whole>(i: I, n: i32) -> I {
    i.each(
        #[inline(always)]
        |i| i.rem_euclid(n),
    )
}

/// i and i + 1, clamped.
#[inline(always)]
fn clamp<I: Whole>(i: I, n: i32) -> [I; 2] {
    let last = i.all(n - 1);
    let before = i.max(i.all(-1)).min(last);
    [before.max(i.all(0)), (before + 1).min(last)]
}
