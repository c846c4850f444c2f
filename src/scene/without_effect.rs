//! Keys that are given and change nothing: one table, from which the warnings come.

use super::render::Filter;
use super::{
    Camera, Collider, Contact, Damping, Integrator, Material, Needs, Scene, SelfCollision, Shader, Sim,
};
use crate::math;

/// A key that has an effect only with others.
pub(super) struct Key {
    /// Its path, such as `sim.iterations`.
    pub(super) path: &'static str,
    /// Whether the scene's value is the default, which asks for nothing.
    pub(super) is_default: fn(&Scene) -> bool,
    /// Whether it has an effect.
    pub(super) acts: fn(&Scene) -> bool,
    /// What it takes, for a message: "only ... reads it".
    pub(super) needs: &'static str,
}

/// The keys of a scene outside of its materials.
pub(super) const KEYS: &[Key] = &[
    Key {
        path: "sim.iterations",
        is_default: |scene| scene.sim.iterations == 1,
        acts: |scene| scene.sim.integrator == Integrator::Xpbd,
        needs: "only the integrator `xpbd` reads it",
    },
    Key {
        path: "sim.tolerance",
        is_default: |_| false,
        acts: |scene| matches!(scene.sim.integrator, Integrator::ImplicitEuler | Integrator::Bdf2),
        needs: "only the integrators `implicit_euler` and `bdf2` read it",
    },
    Key {
        path: "sim",
        is_default: |scene| scene.sim == Sim { fps: scene.sim.fps, ..Sim::default() },
        acts: |scene| scene.cloth.is_some(),
        needs: "the scene has no cloth, so nothing moves",
    },
    Key {
        path: "sim.contact",
        is_default: |scene| scene.sim.contact == Contact::Report,
        acts: |scene| scene.cloth.is_none() || !scene.colliders.is_empty(),
        needs: "the scene has no object that the cloth could touch",
    },
    Key {
        path: "sim.self_collision",
        is_default: |scene| scene.sim.self_collision == SelfCollision::SameBox,
        acts: |scene| {
            let apart = scene.cloth.as_ref().is_none_or(|cloth| cloth.thickness > 0.0);
            apart || scene.sim.self_collision == SelfCollision::Off
        },
        needs: "`cloth.thickness` is 0, which turns self-collision off",
    },
    Key {
        path: "sim.damping",
        is_default: |scene| scene.sim.damping == Damping::PerStep,
        acts: |scene| scene.cloth.as_ref().is_none_or(|cloth| cloth.damping > 0.0),
        needs: "`cloth.damping` is 0",
    },
    Key {
        path: "sim.stretch_passes",
        is_default: |scene| scene.sim.stretch_passes == 1,
        acts: |scene| scene.sim.stretch_limit.is_some(),
        needs: "`sim.stretch_limit` is null, so there are no passes",
    },
    Key {
        path: "render.samples",
        is_default: |scene| scene.render.samples == 1,
        acts: |scene| !scene.colliders.is_empty() || !has(scene, |shader| shader == Shader::Wireframe),
        needs: "it smooths triangles, and `wireframe` draws the cloth as lines",
    },
    Key {
        path: "render.filter",
        is_default: |scene| scene.render.filter == Filter::Bilinear,
        acts: |scene| {
            let reads = |needs: Needs| needs.texture || needs.height_map || needs.environment;
            has(scene, |shader| reads(Needs::of(shader)))
        },
        needs: "no shader of the scene reads a picture",
    },
    Key {
        path: "render.seamless",
        is_default: |scene| !scene.render.seamless,
        acts: |scene| {
            scene.render.filter == Filter::Bilinear && has(scene, |shader| Needs::of(shader).environment)
        },
        needs: "only the bilinear look-ups of `mirror` and `custom` read it",
    },
    Key {
        path: "light.position",
        is_default: |_| false,
        acts: |scene| has(scene, |shader| reads(shader, "kd")),
        needs: "no shader of the scene is lit",
    },
    Key {
        path: "light.intensity",
        is_default: |_| false,
        acts: |scene| has(scene, |shader| reads(shader, "kd")),
        needs: "no shader of the scene is lit",
    },
    Key {
        path: "light.color",
        is_default: |_| false,
        acts: |scene| has(scene, |shader| shader == Shader::Custom),
        needs: "only the shader `custom` reads it; `light.intensity` has a number for each channel",
    },
    Key {
        path: "camera.hfov",
        is_default: |scene| scene.camera.hfov == Camera::default().hfov,
        acts: |scene| {
            let [by_width, by_height] = half_heights(scene);
            by_width >= by_height
        },
        needs: "`camera.vfov` shows more in a picture of this shape, and the wider view is drawn",
    },
    Key {
        path: "camera.vfov",
        is_default: |scene| scene.camera.vfov == Camera::default().vfov,
        acts: |scene| {
            let [by_width, by_height] = half_heights(scene);
            by_height >= by_width
        },
        needs: "`camera.hfov` shows more in a picture of this shape, and the wider view is drawn",
    },
    Key {
        path: "camera.target",
        is_default: |scene| scene.camera.target.is_none(),
        acts: |scene| !scene.camera.fit,
        needs: "`camera.fit` chooses it",
    },
    Key {
        path: "camera.distance",
        is_default: |scene| scene.camera.distance.is_none(),
        acts: |scene| !scene.camera.fit,
        needs: "`camera.fit` chooses it",
    },
];

/// The keys of a material, each with the shaders that read it.
const MATERIAL: [(&str, &[Shader]); 13] = {
    use Shader::{Bump, Custom, Diffuse, Displacement, Mirror, Phong, Texture, Wireframe};
    [
        ("color", &[Wireframe, Diffuse, Phong, Bump, Displacement]),
        ("ka", &[Phong, Bump, Displacement, Custom]),
        ("kd", &[Diffuse, Phong, Bump, Displacement, Custom]),
        ("ks", &[Phong, Bump, Displacement, Custom]),
        ("shininess", &[Phong, Bump, Displacement, Custom]),
        ("km", &[Custom]),
        ("normal_scaling", &[Bump, Displacement, Custom]),
        ("height_scaling", &[Bump, Displacement, Custom]),
        ("texture", &[Texture, Custom]),
        ("height_map", &[Bump, Displacement, Custom]),
        ("environment", &[Mirror, Custom]),
        ("bitangent", &[Bump, Displacement, Custom]),
        ("two_sided", &[Diffuse, Phong, Bump, Displacement, Custom]),
    ]
};

/// The keys of a material that a shader may read.
pub(super) fn material_keys() -> impl Iterator<Item = &'static str> {
    MATERIAL.iter().map(|(key, _)| *key)
}

/// Whether `shader` reads a key of its material; every object has a shader.
pub(super) fn reads(shader: Shader, key: &str) -> bool {
    key == "shader" || MATERIAL.iter().any(|(of, shaders)| *of == key && shaders.contains(&shader))
}

/// The shaders that read a key, for a message.
pub(super) fn readers(key: &str) -> String {
    let row = MATERIAL.iter().find(|(of, _)| *of == key);
    let names: Vec<String> = row
        .into_iter()
        .flat_map(|(_, shaders)| shaders.iter())
        .map(|shader| format!("`{}`", shader.name()))
        .collect();
    match names.as_slice() {
        [name] => format!("only the shader {name} reads it"),
        names => format!("only the shaders {} read it", super::json::text::enumerated(names, "and")),
    }
}

/// Half of the height that is seen at a distance of 1 m, by either field of view.
fn half_heights(scene: &Scene) -> [f64; 2] {
    let half = |degrees: f64| math::tan(degrees * (std::f64::consts::PI / 360.0));
    let [width, height] = scene.render.size.map(f64::from);
    [half(scene.camera.hfov) / (width / height), half(scene.camera.vfov)]
}

/// Whether one of the objects has a shader for which `holds`.
fn has(scene: &Scene, holds: impl Fn(Shader) -> bool) -> bool {
    scene.materials().any(|material| holds(material.shader))
}

/// Every material of a scene, with the paths in a document under which its own keys may stand.
pub(super) fn owners(scene: &Scene) -> Vec<(Vec<String>, &Material)> {
    let cloth = scene.cloth.iter().map(|cloth| (vec!["cloth.material".to_owned()], &cloth.material));
    let mut owners: Vec<_> = cloth.collect();
    let mut before = super::PerKind::<usize>::default();
    for collider in &scene.colliders {
        let (kind, material) = (collider.kind(), Collider::material(collider));
        let number = before[kind];
        before[kind] += 1;
        let mut paths = vec![format!("{}.{number}.material", kind.key())];
        if number == 0 {
            paths.push(format!("{}.material", kind.key()));
        }
        owners.push((paths, material));
    }
    owners
}
