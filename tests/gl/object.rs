//! What is drawn: meshes, programs and uniforms of a scene, in draw order. Written from the text
//! of the specification, not from `drape::render`, so that a slip there shows as a difference.

use drape::camera::{Camera, Columns};
use drape::cloth::Points;
use drape::mesh::{Mesh, SpringKinds, spring_lines};
use drape::scene::{Material, Needs, Scene, Shader, Vec3};

/// One draw call.
pub(crate) struct Object<'a> {
    pub(crate) mesh: Mesh,
    pub(crate) lines: Option<Vec<[u32; 2]>>,
    pub(crate) model: Columns,
    pub(crate) material: &'a Material,
}

/// The value of a uniform.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Uniform {
    Float(f32),
    Vec3([f32; 3]),
    Mat4(Columns),
}

/// The cloth, the planes, the spheres.
pub(crate) fn objects<'a>(scene: &'a Scene, points: &Points) -> Vec<Object<'a>> {
    let cloth = scene.cloth.iter().map(|cloth| {
        let mesh = Mesh::cloth(cloth, points, Needs::of(cloth.material.shader));
        let wireframe = cloth.material.shader == Shader::Wireframe;
        let lines = wireframe.then(|| spring_lines(cloth, SpringKinds::of(cloth)));
        Object { mesh, lines, model: model(Vec3::zeros(), 1.0), material: &cloth.material }
    });
    let planes = scene.planes.iter().map(|plane| {
        let mesh = Mesh::plane(plane, Needs::of(plane.material.shader));
        Object { mesh, lines: None, model: model(Vec3::zeros(), 1.0), material: &plane.material }
    });
    let spheres = scene.spheres.iter().map(|sphere| {
        let mesh = Mesh::sphere(sphere, Needs::of(sphere.material.shader));
        let model = model(sphere.origin, sphere.radius * 0.92);
        Object { mesh, lines: None, model, material: &sphere.material }
    });
    cloth.chain(planes).chain(spheres).collect()
}

impl Object<'_> {
    /// Every uniform but the textures, by its name in the GLSL files.
    pub(crate) fn uniforms(&self, scene: &Scene, camera: &Camera) -> [(&'static str, Uniform); 14] {
        let material = self.material;
        let triple = |v: Vec3| Uniform::Vec3(vec3(v));
        let float = |v: f64| Uniform::Float(f32_of(v));
        [
            ("u_model", Uniform::Mat4(self.model)),
            ("u_view_projection", Uniform::Mat4(camera.view_projection)),
            ("u_cam_pos", Uniform::Vec3(camera.position)),
            ("u_color", triple(material.color)),
            ("u_light_pos", triple(scene.light.position)),
            ("u_light_intensity", triple(scene.light.intensity)),
            ("u_light_color", triple(scene.light.color)),
            ("u_ka", float(material.ka)),
            ("u_kd", float(material.kd)),
            ("u_ks", float(material.ks)),
            ("u_shininess", float(material.shininess)),
            ("u_km", float(material.km)),
            ("u_normal_scaling", float(material.normal_scaling)),
            ("u_height_scaling", float(material.height_scaling)),
        ]
    }
}

fn model(origin: Vec3, scale: f64) -> Columns {
    let s = f32_of(scale);
    let [x, y, z] = vec3(origin);
    [[s, 0.0, 0.0, 0.0], [0.0, s, 0.0, 0.0], [0.0, 0.0, s, 0.0], [x, y, z, 1.0]]
}

/// A triple of f64 as GLSL holds it.
pub(crate) fn vec3(v: Vec3) -> [f32; 3] {
    [v.x, v.y, v.z].map(f32_of)
}

pub(crate) fn f32_of(value: f64) -> f32 {
    value as f32
}
