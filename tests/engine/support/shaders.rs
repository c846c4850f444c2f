//! Uniforms and textures for tests of the shader programs.

use drape::{
    cubemap::Cubemap,
    glsl::Exponent,
    math::splitmix64,
    scene::Filter,
    shader::{
        Uniforms,
        sampler::{Sampler2d, SamplerCube, Wrap},
    },
    texture::Texture,
};

/// Model space is world space, and world space is clip space.
pub(crate) const IDENTITY: [[f32; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// The defaults of a scene, but for colours that differ in every channel.
pub(crate) fn uniforms() -> Uniforms {
    Uniforms {
        u_model: IDENTITY,
        u_view_projection: IDENTITY,
        u_cam_pos: [0.4, 0.7, 2.5],
        u_color: [1.0, 0.9, 0.6],
        u_light_pos: [0.5, 2.0, 2.0],
        u_light_intensity: [3.0, 2.5, 2.0],
        u_light_color: [1.0, 0.85, 0.7],
        u_ka: 0.1,
        u_kd: 0.7,
        u_ks: 1.0,
        u_shininess: Exponent::of(64.0),
        u_km: 0.25,
        u_normal_scaling: 2.0,
        u_height_scaling: 0.1,
        u_bitangent: 1.0,
        u_two_sided: 0.0,
    }
}

/// Texels of noise, different in each channel.
pub(crate) fn noise(width: usize, height: usize, seed: u64) -> Texture {
    let texel = |i: u64| {
        let [r, g, b, ..] = splitmix64(splitmix64(seed) ^ i).to_le_bytes();
        [r, g, b].map(|c| f32::from(c) / 255.0)
    };
    let texels: Vec<[f32; 3]> = (0..(width * height) as u64).map(texel).collect();
    Texture::from_rgb(width, height, &texels).unwrap()
}

/// A texture of one colour.
pub(crate) fn plain(size: usize, color: [f32; 3]) -> Texture {
    Texture::from_rgb(size, size, &vec![color; size * size]).unwrap()
}

/// A cube map of six faces made by `face`.
pub(crate) fn cube(face: impl FnMut(usize) -> Texture) -> Cubemap {
    Cubemap::new("test", std::array::from_fn(face)).unwrap()
}

/// Bilinear lookups.
pub(crate) fn smooth(texture: &Texture) -> Sampler2d<'_> {
    Sampler2d { texture, filter: Filter::Bilinear, wrap_v: Wrap::Repeat }
}

/// Bilinear lookups within the faces.
pub(crate) fn smooth_cube(cubemap: &Cubemap) -> SamplerCube<'_> {
    SamplerCube { cubemap, filter: Filter::Bilinear, seamless: false }
}

/// Any number in -1..1, the same for the same `i`.
pub(crate) fn random(i: u64) -> f32 {
    (splitmix64(i) >> 40) as f32 / 8_388_608.0 - 1.0
}

/// Varyings of a fragment on the unit ball or near it: `v_position`, `v_normal`, `v_tangent`, `v_uv`,
/// neither normal nor tangent of length 1, as after interpolation.
pub(crate) fn fragment(i: u64) -> [f32; 11] {
    let mut v: [f32; 11] = std::array::from_fn(|k| random(11 * i + k as u64));
    // Turned towards the light and the camera more often than not.
    v[5] += 0.8;
    v[9] *= 2.0;
    v
}
