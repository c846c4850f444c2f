//! The objects of a scene, each with its mesh, its place in the world and its programs.

use super::{Renderer, Shading};
use crate::{
    camera::Columns,
    cloth::Points,
    glsl::Exponent,
    lanes::F64,
    mesh::{Attributes, Mesh, Placement, SpringKinds, spring_lines},
    raster::{DrawCall, FragmentProgram, Primitives, VertexProgram},
    scene::{Material, Needs, Scene, Shader, Vec3},
    shader::{
        Uniforms, bump, custom, diffuse, displacement, mirror, normal, phong,
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

    fn call<'b, F: FragmentProgram<N> + 'b, const N: usize>(
        &'b self,
        shading: Shading,
        vertex: impl VertexProgram<Attributes, F::Varyings<f32>> + 'b,
        fragment: F,
    ) -> DrawCall<'b> {
        let primitives = match &self.lines {
            Some(lines) => Primitives::Lines(lines),
            None => Primitives::Triangles(&self.mesh.triangles),
        };
        let (count, attributes) = (self.mesh.positions.len(), |i| self.mesh.vertex(i));
        match shading {
            Shading::F32 => DrawCall::new(primitives, count, attributes, vertex, fragment),
            Shading::F64 => {
                DrawCall::one_by_one::<F64, _, _, N>(primitives, count, attributes, vertex, fragment)
            }
        }
    }
}

impl Renderer {
    /// The draw call of an object: its mesh with the programs of its material.
    pub(super) fn draw_call<'a>(&'a self, object: &'a Object<'a>, shading: Shading) -> DrawCall<'a> {
        let u = self.uniforms(object);
        let material = object.material;
        let u_texture_1 = || self.sampler(&material.texture);
        let u_texture_2 = || self.sampler(&material.height_map);
        let u_texture_cubemap = || self.sampler_cube(&material.environment);
        match material.shader {
            Shader::Wireframe => object.call(shading, wireframe::vertex(&u), wireframe::Fragment { u }),
            Shader::Normal => object.call(shading, normal::vertex(&u), normal::Fragment {}),
            Shader::Diffuse => object.call(shading, diffuse::vertex(&u), diffuse::Fragment { u }),
            Shader::Phong => object.call(shading, phong::vertex(&u), phong::Fragment { u }),
            Shader::Texture => {
                let fragment = texture::Fragment { u_texture_1: u_texture_1() };
                object.call(shading, texture::vertex(&u), fragment)
            }
            Shader::Mirror => {
                let fragment = mirror::Fragment { u, u_texture_cubemap: u_texture_cubemap() };
                object.call(shading, mirror::vertex(&u), fragment)
            }
            Shader::Bump => {
                let fragment = bump::Fragment { u, u_texture_2: u_texture_2() };
                object.call(shading, bump::vertex(&u), fragment)
            }
            Shader::Displacement => {
                let fragment = displacement::Fragment { u, u_texture_2: u_texture_2() };
                object.call(shading, displacement::vertex(&u, u_texture_2()), fragment)
            }
            Shader::Custom => {
                let fragment = custom::Fragment {
                    u,
                    u_texture_1: u_texture_1(),
                    u_texture_2: u_texture_2(),
                    u_texture_cubemap: u_texture_cubemap(),
                };
                object.call(shading, custom::vertex(&u, u_texture_2()), fragment)
            }
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
