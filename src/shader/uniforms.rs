//! The uniforms that programs share.

use crate::{
    camera::Columns,
    glsl::{Exponent, Vec3},
    lanes::Lane,
    raster::Uniform,
};

/// The uniforms of all programs but the samplers, named as in the GLSL files; what only fragment programs
/// read is plain, or (`F`, `V`) in lanes. A program that reads a texture has its sampler besides, so none can be missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniforms<F = f32, V = [f32; 3]> {
    /// Model space to world space.
    pub u_model: Columns,
    /// World space to clip space.
    pub u_view_projection: Columns,
    /// Eye, world space, metres.
    pub u_cam_pos: V,
    /// Surface colour c.
    pub u_color: V,
    /// Light position, world space, metres.
    pub u_light_pos: V,
    /// Light intensity I per channel.
    pub u_light_intensity: V,
    /// Colour of the light, for the glossy ceramic.
    pub u_light_color: V,
    /// Ambient weight.
    pub u_ka: F,
    /// Diffuse weight.
    pub u_kd: F,
    /// Specular weight.
    pub u_ks: F,
    /// Specular exponent p.
    pub u_shininess: Exponent,
    /// Mirror weight.
    pub u_km: F,
    /// kn: scales the slope of the height map.
    pub u_normal_scaling: f32,
    /// kh: height of a white texel, model units.
    pub u_height_scaling: f32,
    /// 1 for the bitangent n × t, -1 for t × n.
    pub u_bitangent: F,
    /// 1 to light the side that faces the camera, 0 to light that of the normal.
    pub u_two_sided: f32,
}

impl Uniform for Uniforms {
    type In<L: Lane> = Uniforms<L, Vec3<L>>;

    #[inline(always)]
    fn in_lanes<L: Lane>(&self, token: L::Token) -> Uniforms<L, Vec3<L>> {
        Uniforms {
            u_model: self.u_model,
            u_view_projection: self.u_view_projection,
            u_cam_pos: self.u_cam_pos.in_lanes::<L>(token),
            u_color: self.u_color.in_lanes::<L>(token),
            u_light_pos: self.u_light_pos.in_lanes::<L>(token),
            u_light_intensity: self.u_light_intensity.in_lanes::<L>(token),
            u_light_color: self.u_light_color.in_lanes::<L>(token),
            u_ka: self.u_ka.in_lanes::<L>(token),
            u_kd: self.u_kd.in_lanes::<L>(token),
            u_ks: self.u_ks.in_lanes::<L>(token),
            u_shininess: self.u_shininess,
            u_km: self.u_km.in_lanes::<L>(token),
            u_normal_scaling: self.u_normal_scaling,
            u_height_scaling: self.u_height_scaling,
            u_bitangent: self.u_bitangent.in_lanes::<L>(token),
            u_two_sided: self.u_two_sided,
        }
    }
}
