//! Test: what is compiled for AVX2 gives the same bits as what is compiled for the baseline.

use std::sync::atomic::Ordering;

use super::{DrawCall, Framebuffer, Primitives, Stats, draw};
use crate::{
    dispatch::BASELINE_ONLY,
    lanes::Wide,
    math::splitmix64,
    mesh::Attributes,
    scene::Filter,
    shader::{Uniforms, bump, glsl::Exponent, phong, sampler::Sampler2d, wireframe},
    texture::Texture,
};

const IDENTITY: [[f32; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

const UNIFORMS: Uniforms = Uniforms {
    u_model: IDENTITY,
    u_view_projection: IDENTITY,
    u_cam_pos: [0.1, 0.2, 3.0],
    u_color: [0.9, 0.8, 0.7],
    u_light_pos: [1.0, 2.0, 2.0],
    u_light_intensity: [3.0; 3],
    u_light_color: [1.0; 3],
    u_ka: 0.1,
    u_kd: 0.7,
    u_ks: 1.0,
    u_shininess: Exponent::Real(37.5),
    u_km: 0.25,
    u_normal_scaling: 2.0,
    u_height_scaling: 0.1,
};

#[expect(clippy::cast_precision_loss, reason = "24 bits")]
fn random(i: usize) -> f32 {
    (splitmix64(i as u64) >> 40) as f32 / 8_388_608.0 - 1.0
}

/// A vertex somewhere around the picture.
fn vertex(i: usize) -> Attributes {
    let [x, y, z] = [0, 1, 2].map(|k| random(11 * i + k));
    Attributes {
        in_position: [1.5 * x, 1.5 * y, z],
        in_normal: [3, 4, 5].map(|k| random(11 * i + k)),
        in_tangent: [6, 7, 8].map(|k| random(11 * i + k)),
        in_uv: [9, 10].map(|k| random(11 * i + k)),
    }
}

/// Colours and the bits of depths of triangles of two programs and of lines.
fn picture(samples: u32) -> (Vec<u8>, Vec<u32>, Stats) {
    let texels: Vec<[f32; 3]> = (0..64).map(|i| [random(i).abs(); 3]).collect();
    let texture = Texture::from_rgb(8, 8, &texels).unwrap();
    let heights = Sampler2d { texture: &texture, filter: Filter::Bilinear };
    let triangles: Vec<[u32; 3]> = (0..60).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let (lit, bumped) = triangles.split_at(30);
    let (u, lines) = (&UNIFORMS, [[0, 7], [50, 3], [12, 100]]);
    let calls = [
        DrawCall::new(
            Primitives::Triangles(lit),
            180,
            vertex,
            phong::vertex(u),
            phong::fragment::<Wide<f32>>(u),
        ),
        DrawCall::new(
            Primitives::Triangles(bumped),
            180,
            vertex,
            bump::vertex(u),
            bump::fragment::<Wide<f32>>(u, heights),
        ),
        DrawCall::new(
            Primitives::Lines(&lines),
            180,
            vertex,
            wireframe::vertex(u),
            wireframe::fragment::<Wide<f32>>(u),
        ),
    ];
    let mut framebuffer = Framebuffer::new(200, 100, samples);
    let (stats, _) = draw(&mut framebuffer, [0.2; 3], &calls, false);
    (framebuffer.rgb(), framebuffer.depth().into_iter().map(f32::to_bits).collect(), stats)
}

#[test]
fn the_copy_for_avx2_gives_the_same_bits_as_the_baseline() {
    for samples in [1, 4] {
        BASELINE_ONLY.store(true, Ordering::Relaxed);
        let baseline = picture(samples);
        BASELINE_ONLY.store(false, Ordering::Relaxed);
        assert_eq!(baseline, picture(samples), "{samples} samples");
        assert!(baseline.2.fragments > 10_000, "{:?}", baseline.2);
    }
}
