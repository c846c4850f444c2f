//! Look-ups in cube maps.

use super::{
    SamplerCube, Wrap,
    look_up::{Pictures, inside, look_up, mix, side},
};
use crate::{
    cubemap::Cubemap,
    glsl::{Vec3, dot},
    lanes::{Lane, MAX_WIDTH, Part, Whole},
    scene::Filter,
};

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
    let size = [sampler.cubemap.size(); 2];
    if sampler.filter == Filter::Bilinear
        && let Some((face, coordinates)) = one_face(direction)
        && let Some((places, down, weights)) = inside(size, coordinates)
    {
        return P::bilinear(sampler.cubemap.faces()[face].for_look_ups(P::PACKED), places, down, weights);
    }
    let (face, s, t) = cube_face(direction);
    if sampler.seamless && sampler.filter == Filter::Bilinear {
        return seamless(sampler.cubemap, face, [s, t]);
    }
    let faces = Faces::of(sampler.cubemap, face);
    look_up(sampler.filter, [s, t], size, [Wrap::Clamp; 2], &faces)
}

/// A face of a cube for each lane.
struct Faces<'a>([&'a [[f32; 4]]; MAX_WIDTH]);

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

/// What [`cube_face`] gives if all lanes look at the same face, and no direction is near zero or NaN, without selecting
/// lane by lane.
#[inline(always)]
fn one_face<P: Part>(r: Vec3<P>) -> Option<(usize, [P; 2])> {
    // Of three lengths that add up to more, the square of the longest is not 0.
    const TINY: f32 = 1e-15;
    let (ax, ay, az) = (r.x.abs(), r.y.abs(), r.z.abs());
    let of_x_and_y = ax.max(ay);
    let (x_is_longer, z_is_shorter) = (ay.lanes_less(ax), az.lanes_less(of_x_and_y));
    let (axis, component, length) = match (z_is_shorter, x_is_longer) {
        (0, _) => (2, r.z, az),
        (all, 0) if all == P::ALL_LANES => (1, r.y, ay),
        (all, x) if all == P::ALL_LANES && x == all => (0, r.x, ax),
        _ => return None,
    };
    let negative = component.lanes_less(component.all(0.0));
    if length.all(TINY).lanes_less(ax + ay + az) != P::ALL_LANES
        || (negative != 0 && negative != P::ALL_LANES)
    {
        return None;
    }
    let (sc, tc) = match (axis, negative) {
        (0, 0) => (-r.z, -r.y),
        (0, _) => (r.z, -r.y),
        (1, 0) => (r.x, r.z),
        (1, _) => (r.x, -r.z),
        (_, 0) => (r.x, -r.y),
        _ => (-r.x, -r.y),
    };
    let coordinate = |c: P| (c / length + 1.0) * 0.5;
    Some((2 * axis + usize::from(negative != 0), [coordinate(sc), coordinate(tc)]))
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
