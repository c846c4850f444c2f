//! `bump`: Blinn-Phong with the normal that the height map's slope gives (Blinn 1978).

use super::{
    Uniforms,
    default::Relief,
    phong::{blinn_phong, facing},
    sampler::{Sampler2d, texture_red},
};
use crate::{
    glsl::{Vec3, cross, float, normalize, vec3},
    lanes::{Lane, Part},
};

pub use super::default::all as vertex;

/// `bumped_normal` of `bump.frag`: the unit normal over the height map.
#[inline(always)]
pub(super) fn bumped_normal<L: Lane>(
    u: &Uniforms<L, Vec3<L>>,
    u_texture_2: Sampler2d<'_>,
    v_normal: Vec3<L>,
    v_tangent: Vec3<L>,
    v_uv: [L; 2],
) -> Vec3<L> {
    let n = normalize(v_normal);
    let t = normalize(v_tangent);
    let b = cross(n, t) * u.u_bitangent;
    let k = u.u_height_scaling * u.u_normal_scaling;
    let [x, y] = v_uv;
    let [h0, h_u, h_v] = L::map_parts(
        [x, y, y],
        #[inline(always)]
        |[x, y, _]| heights(u_texture_2, [x, y]),
    );
    let (d_u, d_v) = ((h_u - h0) * k, (h_v - h0) * k);
    let local = normalize(vec3(-d_u, -d_v, x.all(1.0)));
    normalize(t * local.x + b * local.y + n * local.z)
}

/// The heights at `v_uv`, a texel to the right and a texel above.
#[inline(always)]
fn heights<P: Part>(u_texture_2: Sampler2d<'_>, v_uv: [P; 2]) -> [P; 3] {
    let u_texture_2_size = [u_texture_2.texture.width(), u_texture_2.texture.height()].map(texels);
    let [x, y] = v_uv;
    let right = x + float(1.0) / x.all(u_texture_2_size[0]);
    let above = y + float(1.0) / y.all(u_texture_2_size[1]);
    let (us, vs) = ([x, right, x], [y, y, above]);
    // A loop, because three look-ups in a row are three times as much to compile, and no faster.
    let mut heights = [x; 3];
    for (i, height) in heights.iter_mut().enumerate() {
        *height = texture_red(u_texture_2, [us[i], vs[i]]);
    }
    heights
}

crate::fragment_program! {
    /// `bump.frag`
    pub struct Fragment<'a> { u: Uniforms, u_texture_2: Sampler2d<'a> }
    |Relief { v_position, v_normal, v_tangent, v_uv }| {
        let n = bumped_normal(&u, u_texture_2, v_normal, v_tangent, v_uv);
        let n = facing(&u, n, v_normal, v_position);
        blinn_phong(&u, v_position, n)
    }
}

#[expect(clippy::cast_precision_loss, reason = "textures are at most 16384 texels wide")]
fn texels(n: usize) -> f32 {
    n as f32
}
