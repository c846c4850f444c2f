//! One primitive of a scene, drawn alone by `drape::raster`: where it is and how deep, whatever
//! stands in front of it.

use drape::camera::Camera;
use drape::lanes::Wide;
use drape::mesh::Attributes;
use drape::raster::{self, DrawCall, Framebuffer, Primitives};
use drape::scene::{Scene, Shader};
use drape::shader::glsl::{Exponent, VertexProgram};
use drape::shader::sampler::Sampler2d;
use drape::shader::{Uniforms, default, displacement, wireframe};
use drape::texture_source::TextureSource;

use super::object::{Object, f32_of};

/// The depths of primitive `number` of `object` in the whole picture; 1 where it is not.
pub(crate) fn depth_alone(scene: &Scene, camera: &Camera, object: &Object<'_>, number: usize) -> Vec<f32> {
    let uniforms = uniforms(object, camera);
    if matches!(object.material.shader, Shader::Displacement | Shader::Custom) {
        let texture = TextureSource::BuiltIn.texture(&object.material.height_map).unwrap();
        let sampler = Sampler2d { texture: &texture, filter: scene.render.filter };
        draw(scene, object, number, displacement::vertex(&uniforms, sampler), &uniforms)
    } else {
        draw(scene, object, number, default::all(&uniforms), &uniforms)
    }
}

fn draw(
    scene: &Scene,
    object: &Object<'_>,
    number: usize,
    program: impl VertexProgram<11>,
    uniforms: &Uniforms,
) -> Vec<f32> {
    let [width, height] = scene.render.size;
    let mut framebuffer = Framebuffer::new(width, height, 1);
    let position = |a: &Attributes| (program(a).0, []);
    let vertex = |corner: u32| object.mesh.vertex(corner as usize);
    let (primitives, corners) = match &object.lines {
        Some(lines) => (Primitives::Lines(&[[0, 1]]), lines[number].to_vec()),
        None => (Primitives::Triangles(&[[0, 1, 2]]), object.mesh.triangles[number].to_vec()),
    };
    let attributes = |i: usize| vertex(corners[i]);
    let fragment = wireframe::fragment::<Wide<f32>>(uniforms);
    let call = DrawCall::new(primitives, corners.len(), attributes, position, fragment);
    raster::draw(&mut framebuffer, [0.0; 3], &[call], false);
    framebuffer.depth()
}

/// What the vertex stage reads.
fn uniforms(object: &Object<'_>, camera: &Camera) -> Uniforms {
    Uniforms {
        u_model: object.model,
        u_view_projection: camera.view_projection,
        u_cam_pos: camera.position,
        u_color: [1.0; 3],
        u_light_pos: [0.0; 3],
        u_light_intensity: [0.0; 3],
        u_light_color: [0.0; 3],
        u_ka: 0.0,
        u_kd: 0.0,
        u_ks: 0.0,
        u_shininess: Exponent::Whole(1),
        u_km: 0.0,
        u_normal_scaling: 0.0,
        u_height_scaling: f32_of(object.material.height_scaling),
    }
}
