//! The objects of a scene, each with its mesh, its place in the world and its programs.

use super::Renderer;
use crate::{
    camera::Columns,
    cloth::Points,
    lanes::Lane,
    mesh::{Mesh, Placement, SpringKinds, spring_lines},
    raster::{DrawCall, Primitives},
    scene::{Material, Needs, Scene, Shader, Vec3},
    shader::{
        Uniforms, bump, custom, diffuse, displacement,
        glsl::{Exponent, FragmentProgram, VertexProgram},
        mirror, normal, phong,
        sampler::{Sampler2d, SamplerCube},
        texture, wireframe,
    },
};

/// A mesh in the world, and what it looks like.
pub(super) struct Object<'a> {
    mesh: Mesh,
    lines: Option<Vec<[u32; 2]>>,
    model: Columns,
    material: &'a Material,
}

impl<'a> Object<'a> {
    /// What is drawn, in order: the cloth, then the colliders.
    pub(super) fn all(scene: &'a Scene, points: &Points, springs: Option<SpringKinds>) -> Vec<Self> {
        let mut objects = Vec::new();
        if let Some(cloth) = &scene.cloth {
            let lines = (cloth.material.shader == Shader::Wireframe)
                .then(|| spring_lines(cloth, springs.unwrap_or_else(|| SpringKinds::of(cloth))));
            let mesh = Mesh::cloth(cloth, points, Needs::of(cloth.material.shader));
            objects.push(Self { mesh, lines, model: model(Placement::WORLD), material: &cloth.material });
        }
        for collider in &scene.colliders {
            let material = collider.material();
            let (mesh, placement) = Mesh::collider(collider, Needs::of(material.shader));
            objects.push(Self { mesh, lines: None, model: model(placement), material });
        }
        objects
    }

    fn call<'b, L: Lane, const N: usize>(
        &'b self,
        vertex: impl VertexProgram<N> + 'b,
        fragment: impl FragmentProgram<L, N> + 'b,
    ) -> DrawCall<'b> {
        let primitives = match &self.lines {
            Some(lines) => Primitives::Lines(lines),
            None => Primitives::Triangles(&self.mesh.triangles),
        };
        DrawCall::new(primitives, self.mesh.positions.len(), |i| self.mesh.vertex(i), vertex, fragment)
    }
}

impl Renderer {
    /// The draw call of an object: its mesh with the programs of its material.
    pub(super) fn draw_call<'a, L: Lane + 'a>(&'a self, object: &'a Object<'a>) -> DrawCall<'a> {
        let u = &self.uniforms(object);
        let material = object.material;
        let texture_1 = || self.sampler(&material.texture);
        let texture_2 = || self.sampler(&material.height_map);
        let environment = || self.sampler_cube(&material.environment);
        match material.shader {
            Shader::Wireframe => object.call(wireframe::vertex(u), wireframe::fragment::<L>(u)),
            Shader::Normal => object.call(normal::vertex(u), normal::fragment::<L>(u)),
            Shader::Diffuse => object.call(diffuse::vertex(u), diffuse::fragment::<L>(u)),
            Shader::Phong => object.call(phong::vertex(u), phong::fragment::<L>(u)),
            Shader::Texture => object.call(texture::vertex(u), texture::fragment::<L>(u, texture_1())),
            Shader::Mirror => object.call(mirror::vertex(u), mirror::fragment::<L>(u, environment())),
            Shader::Bump => object.call(bump::vertex(u), bump::fragment::<L>(u, texture_2())),
            Shader::Displacement => {
                object.call(displacement::vertex(u, texture_2()), displacement::fragment::<L>(u, texture_2()))
            }
            Shader::Custom => object.call(
                custom::vertex(u, texture_2()),
                custom::fragment::<L>(u, texture_1(), texture_2(), environment()),
            ),
        }
    }

    fn uniforms(&self, object: &Object<'_>) -> Uniforms {
        let (material, light) = (object.material, &self.scene.light);
        Uniforms {
            u_model: object.model,
            u_view_projection: self.camera.view_projection,
            u_cam_pos: self.camera.position,
            u_color: round(material.color),
            u_light_pos: round(light.position),
            u_light_intensity: round(light.intensity),
            u_light_color: round(light.color),
            u_ka: to_f32(material.ka),
            u_kd: to_f32(material.kd),
            u_ks: to_f32(material.ks),
            u_shininess: Exponent::of(to_f32(material.shininess)),
            u_km: to_f32(material.km),
            u_normal_scaling: to_f32(material.normal_scaling),
            u_height_scaling: to_f32(material.height_scaling),
        }
    }

    fn sampler(&self, name: &str) -> Sampler2d<'_> {
        Sampler2d { texture: find(&self.textures, name).expect(LOADED), filter: self.scene.render.filter }
    }

    fn sampler_cube(&self, name: &str) -> SamplerCube<'_> {
        SamplerCube { cubemap: find(&self.cubemaps, name).expect(LOADED), filter: self.scene.render.filter }
    }
}

/// `Renderer::new` reads exactly what `draw_call` asks for: both go by [`Needs::of`].
const LOADED: &str = "the renderer reads all textures of its materials";

fn find<'a, T>(named: &'a [(String, T)], name: &str) -> Option<&'a T> {
    named.iter().find(|(other, _)| other == name).map(|(_, value)| value)
}

/// The placement as a matrix.
fn model(Placement { origin, scale }: Placement) -> Columns {
    let s = to_f32(scale);
    let [x, y, z] = round(origin);
    [[s, 0.0, 0.0, 0.0], [0.0, s, 0.0, 0.0], [0.0, 0.0, s, 0.0], [x, y, z, 1.0]]
}

pub(super) fn round(v: Vec3) -> [f32; 3] {
    [v.x, v.y, v.z].map(to_f32)
}

#[expect(clippy::cast_possible_truncation, reason = "uniforms are f32")]
fn to_f32(value: f64) -> f32 {
    value as f32
}
