//! Texture lookup: nearest and bilinear, REPEAT on pictures (CLAMP_TO_EDGE along v on a ball, whose poles are
//! not neighbours), CLAMP_TO_EDGE within a cube face, or over its edges where that is asked for.
//!
//! Bilinear weights are exact: x = u·w - 0.5, i = floor(x), f = x - i, then mix along x and y.
//! For texture coordinates in -1..=2, a lookup in f32 is within (w + h + 2)·2⁻²² of the same formula
//! in f64: that is what the rounding of u·w - 0.5 can move the weights by. It is exact for
//! coordinates in 0..=2 where both sides are powers of two, and what is left is 2⁻²¹ (tested).

use crate::{
    cubemap::Cubemap,
    glsl::{Vec3, dot},
    lanes::{Lane, MAX_WIDTH, Part, Whole},
    raster::Uniform,
    scene::Filter,
    texture::Texture,
};

/// `sampler2D` with REPEAT along u; the first row of the picture is at v = 0.
#[derive(Clone, Copy, Debug)]
pub struct Sampler2d<'a> {
    /// The texels.
    pub texture: &'a Texture,
    /// How texels are combined.
    pub filter: Filter,
    /// What lies above the first row and below the last.
    pub wrap_v: Wrap,
}

/// What lies beyond the edge of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The picture again (REPEAT).
    Repeat,
    /// Its last texel (CLAMP_TO_EDGE).
    Clamp,
}

/// `samplerCube` with CLAMP_TO_EDGE.
#[derive(Clone, Copy, Debug)]
pub struct SamplerCube<'a> {
    /// The six faces.
    pub cubemap: &'a Cubemap,
    /// How texels are combined.
    pub filter: Filter,
    /// Whether the texels beyond an edge are those of the next face (TEXTURE_CUBE_MAP_SEAMLESS).
    pub seamless: bool,
}

impl<'a> Uniform for Sampler2d<'a> {
    type In<L: Lane> = Self;
    #[inline(always)]
    fn in_lanes<L: Lane>(&self, _token: L::Token) -> Self {
        *self
    }
}

impl<'a> Uniform for SamplerCube<'a> {
    type In<L: Lane> = Self;
    #[inline(always)]
    fn in_lanes<L: Lane>(&self, _token: L::Token) -> Self {
        *self
    }
}

/// `texture(sampler2D, vec2(u, v)).rgb`
#[inline(always)]
pub fn texture<L: Lane>(sampler: Sampler2d<'_>, [u, v]: [L; 2]) -> Vec3<L> {
    let Sampler2d { texture, filter, wrap_v } = sampler;
    let wrap = [Wrap::Repeat, wrap_v];
    let size = [texture.width(), texture.height()];
    let rgb = L::map_parts(
        [u, v, v],
        #[inline(always)]
        |[u, v, _]| look_up(filter, [u, v], size, wrap, &Picture(texture.texels())),
    );
    Vec3::from(rgb)
}

/// `texture(samplerCube, direction).rgb`. Ties between axes: z before y before x. The zero
/// direction (and NaN, and one whose squared length is 0 in f32) reads the middle of the +x face.
#[inline(always)]
pub fn texture_cube<L: Lane>(sampler: SamplerCube<'_>, direction: Vec3<L>) -> Vec3<L> {
    let rgb = L::map_parts(
        direction.into(),
        #[inline(always)]
        |direction| cube_texel(sampler, Vec3::from(direction)),
    );
    Vec3::from(rgb)
}

/// `texture_cube` of one part.
#[inline(always)]
fn cube_texel<P: Part>(sampler: SamplerCube<'_>, direction: Vec3<P>) -> [P; 3] {
    let (face, s, t) = cube_face(direction);
    if sampler.seamless && sampler.filter == Filter::Bilinear {
        return seamless(sampler.cubemap, face, [s, t]);
    }
    let faces = Faces::of(sampler.cubemap, face);
    look_up(sampler.filter, [s, t], [sampler.cubemap.size(); 2], [Wrap::Clamp; 2], &faces)
}

/// The pictures that the lanes look into.
trait Pictures {
    /// The texels of a lane's picture.
    fn texels(&self, lane: usize) -> &[[f32; 4]];
}

/// One for all lanes.
struct Picture<'a>(&'a [[f32; 4]]);

/// A face of a cube for each lane.
struct Faces<'a>([&'a [[f32; 4]]; MAX_WIDTH]);

impl Pictures for Picture<'_> {
    #[inline(always)]
    fn texels(&self, _lane: usize) -> &[[f32; 4]] {
        self.0
    }
}

impl Pictures for Faces<'_> {
    #[inline(always)]
    fn texels(&self, lane: usize) -> &[[f32; 4]] {
        self.0[lane]
    }
}

impl<'a> Faces<'a> {
    #[inline(always)]
    fn of<P: Part>(cubemap: &'a Cubemap, face: P) -> Self {
        let (faces, face) = (cubemap.faces(), face.to_whole());
        let mut texels = [faces[0].texels(); MAX_WIDTH];
        for (lane, texels) in texels.iter_mut().enumerate().take(P::WIDTH) {
            *texels = faces[face.lane(lane).cast_unsigned() as usize].texels();
        }
        Self(texels)
    }
}

/// Face number (posx, negx, posy, negy, posz, negz) and coordinates (s, t) in 0..=1 of a direction.
#[inline(always)]
fn cube_face<P: Part>(r: Vec3<P>) -> (P, P, P) {
    let number = |value: f32| r.x.all(value);
    let zero = number(0.0);
    let (ax, ay, az) = (r.x.abs(), r.y.abs(), r.z.abs());
    // First +x / -x, then y where it is at least as long, then z where it is as long as both.
    let positive = |component: P, yes: P, no: P| component.select_less(zero, no, yes);
    let mut face = positive(r.x, number(0.0), number(1.0));
    let (mut sc, mut tc, mut ma) = (positive(r.x, -r.z, r.z), -r.y, ax);
    let (y_face, y_tc) = (positive(r.y, number(2.0), number(3.0)), positive(r.y, r.z, -r.z));
    let on_y = |y: P, x: P| ay.select_less(ax, x, y);
    (face, sc, tc, ma) = (on_y(y_face, face), on_y(r.x, sc), on_y(y_tc, tc), on_y(ay, ma));
    let (z_face, z_sc) = (positive(r.z, number(4.0), number(5.0)), positive(r.z, r.x, -r.x));
    let on_z = |z: P, other: P| az.select_less(ma, other, z);
    (face, sc, tc, ma) = (on_z(z_face, face), on_z(z_sc, sc), on_z(-r.y, tc), on_z(az, ma));
    let length = dot(r, r);
    let or_middle = |value: P, middle: P| zero.select_less(length, value, middle);
    let coordinate = |c: P| or_middle((c / ma + 1.0) * 0.5, number(0.5));
    (or_middle(face, zero), coordinate(sc), coordinate(tc))
}

/// Filters four texels, of which some may lie beyond an edge of the face.
#[inline(always)]
fn seamless<P: Part>(cubemap: &Cubemap, face: P, [s, t]: [P; 2]) -> [P; 3] {
    let n = side(cubemap.size()) as f32;
    let (x, y) = (s * n - 0.5, t * n - 0.5);
    let (i, j) = (x.floor(), y.floor());
    let (fx, fy) = (x - i, y - j);
    let (face, i, j) = (face.to_whole(), i.to_whole(), j.to_whole());
    let texels = |right: i32, down: i32| {
        P::transpose(
            x.token(),
            #[inline(always)]
            |lane| {
                cubemap.texel_around(
                    face.lane(lane).cast_unsigned() as usize,
                    [i.lane(lane) + right, j.lane(lane) + down],
                )
            },
        )
    };
    let top = mix::<P>(texels(0, 0), texels(1, 0), fx);
    let bottom = mix::<P>(texels(0, 1), texels(1, 1), fx);
    mix(top, bottom, fy)
}

/// Filters texels around (u·w, v·h) of each lane's picture.
#[inline(always)]
fn look_up<P: Part>(
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
fn mix<P: Part>(a: [P; 3], b: [P; 3], f: P) -> [P; 3] {
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
fn side(n: usize) -> i32 {
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
