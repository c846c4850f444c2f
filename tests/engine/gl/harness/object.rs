//! What is drawn: meshes, programs and uniforms of a scene, in draw order. Written from the text
//! of the specification, not from `drape::render`, so that a slip there shows as a difference.

use drape::camera::{Camera, Columns};
use drape::cloth::Points;
use drape::glsl::Exponent;
use drape::mesh::{Mesh, SpringKinds, spring_lines};
use drape::scene::{Bitangent, Collider, Material, Needs, Scene, Shader, Vec3};
use drape::shader::Uniforms;
use drape::shader::sampler::Wrap;
use drape::texture::Texture;
use drape::texture_source::TextureSource;

/// One draw call.
pub(crate) struct Object<'a> {
    pub(crate) mesh: Mesh,
    pub(crate) lines: Option<Vec<[u32; 2]>>,
    pub(crate) model: Columns,
    pub(crate) material: &'a Material,
    /// Whether its textures end at v = 0 and v = 1.
    pub(crate) is_ball: bool,
}

/// The cloth, then the colliders.
pub(crate) fn objects<'a>(scene: &'a Scene, points: &Points) -> Vec<Object<'a>> {
    let cloth = scene.cloth.iter().map(|cloth| {
        let mesh = Mesh::cloth(cloth, points, Needs::of(cloth.material.shader));
        let wireframe = cloth.material.shader == Shader::Wireframe;
        let lines = wireframe.then(|| spring_lines(cloth, SpringKinds::of(cloth)));
        Object { mesh, lines, model: model(Vec3::zeros(), 1.0), material: &cloth.material, is_ball: false }
    });
    let colliders = scene.colliders.iter().map(|collider| {
        let material = collider.material();
        let needs = Needs::of(material.shader);
        let (mesh, model) = match collider {
            Collider::Plane(plane) => (Mesh::plane(plane, needs), model(Vec3::zeros(), 1.0)),
            Collider::Cuboid(cuboid) => (Mesh::cuboid(cuboid, needs), model(Vec3::zeros(), 1.0)),
            Collider::Sphere(sphere) => {
                (Mesh::sphere(sphere, needs), model(sphere.origin, sphere.radius * 0.92))
            }
        };
        let is_ball = matches!(collider, Collider::Sphere(_));
        Object { mesh, lines: None, model, material, is_ball }
    });
    cloth.chain(colliders).collect()
}

impl Object<'_> {
    /// Every uniform but the textures.
    pub(crate) fn uniforms(&self, scene: &Scene, camera: &Camera) -> Uniforms {
        let (material, light) = (self.material, &scene.light);
        Uniforms {
            u_model: self.model,
            u_view_projection: camera.view_projection,
            u_cam_pos: camera.position,
            u_color: vec3(material.color),
            u_light_pos: vec3(light.position),
            u_light_intensity: vec3(light.intensity),
            u_light_color: vec3(light.color),
            u_ka: material.ka as f32,
            u_kd: material.kd as f32,
            u_ks: material.ks as f32,
            u_shininess: Exponent::of(material.shininess as f32),
            u_km: material.km as f32,
            u_normal_scaling: material.normal_scaling as f32,
            u_height_scaling: material.height_scaling as f32,
            u_bitangent: if material.bitangent == Bitangent::Uv { -1.0 } else { 1.0 },
            u_two_sided: if material.two_sided { 1.0 } else { 0.0 },
        }
    }

    /// What lies beyond the first and last rows of its textures.
    pub(crate) fn wrap_v(&self) -> Wrap {
        if self.is_ball { Wrap::Clamp } else { Wrap::Repeat }
    }

    /// The height map, if the vertex stage reads one.
    pub(crate) fn height_map(&self) -> Option<Texture> {
        matches!(self.material.shader, Shader::Displacement | Shader::Custom)
            .then(|| TextureSource::BuiltIn.texture(&self.material.height_map).unwrap())
    }
}

fn model(origin: Vec3, scale: f64) -> Columns {
    let s = scale as f32;
    let [x, y, z] = vec3(origin);
    [[s, 0.0, 0.0, 0.0], [0.0, s, 0.0, 0.0], [0.0, 0.0, s, 0.0], [x, y, z, 1.0]]
}

/// A triple of f64 as GLSL holds it.
pub(crate) fn vec3(v: Vec3) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}
