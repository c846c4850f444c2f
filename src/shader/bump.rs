//! `bump`: Blinn-Phong with the normal that the height map's slope gives (Blinn 1978).

use super::{
    Uniforms,
    glsl::{Vec3, cross, normalize, vec3},
    phong::blinn_phong,
    sampler::{Sampler2d, texture},
};
use crate::lanes::Lane;

pub use super::default::all as vertex;

/// `bumped_normal` of `bump.frag`: the unit normal over the height map.
#[inline(always)]
pub(super) fn bumped_normal<L: Lane>(
    u: &Uniforms,
    u_texture_2: Sampler2d<'_>,
    v_normal: Vec3<L>,
    v_tangent: Vec3<L>,
    v_uv: [L; 2],
) -> Vec3<L> {
    let one = L::splat(1.0);
    let [x, y] = v_uv;
    let n = normalize(v_normal);
    let t = normalize(v_tangent);
    let b = cross(n, t);
    let k = L::splat(u.u_height_scaling * u.u_normal_scaling);
    let right = x + one / texels(u_texture_2.texture.width());
    let above = y + one / texels(u_texture_2.texture.height());
    // A loop, because three look-ups in a row are three times as much to compile, and no faster.
    let mut heights = [one; 3];
    for (height, [u, v]) in heights.iter_mut().zip([[x, y], [right, y], [x, above]]) {
        *height = texture(u_texture_2, u, v).x;
    }
    let [h0, h_u, h_v] = heights;
    let (d_u, d_v) = ((h_u - h0) * k, (h_v - h0) * k);
    let local = normalize(vec3(-d_u, -d_v, one));
    normalize(t * local.x + b * local.y + n * local.z)
}

/// `bump.frag`
pub fn fragment<'a, L: Lane>(
    u: &Uniforms,
    u_texture_2: Sampler2d<'a>,
) -> impl Fn(&[L; 11]) -> Vec3<L> + use<'a, L> {
    let u = *u;
    #[inline(always)]
    move |&[x, y, z, nx, ny, nz, tx, ty, tz, s, t]| {
        let (v_position, v_normal, v_tangent) = (vec3(x, y, z), vec3(nx, ny, nz), vec3(tx, ty, tz));
        let v_uv = [s, t];
        let n = bumped_normal(&u, u_texture_2, v_normal, v_tangent, v_uv);
        blinn_phong(&u, v_position, n)
    }
}

#[expect(clippy::cast_precision_loss, reason = "textures are at most 16384 texels wide")]
fn texels<L: Lane>(n: usize) -> L {
    L::splat(n as f32)
}
