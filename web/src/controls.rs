//! What the controls of the page show: the values of a scene, and what can be chosen.

use drape::camera::Camera;
use drape::error::Result;
use drape::math::Vec3;
use drape::scene::{ColliderKind, Material, Scene, Shape, keys};
use serde_json::{Map, Value, json};

/// The names of the built-in textures.
const TEXTURES: [&str; 4] = ["texture_1", "texture_2", "texture_3", "texture_4"];

/// For each key that is a choice, its values with their meanings; and the names of the built-in textures.
pub(crate) fn choices() -> Value {
    let mut choices = Map::new();
    for key in keys() {
        if let Shape::Value { choices: values, .. } = &key.shape
            && !values.is_empty()
        {
            choices.insert(key.path(), json!(values));
        }
    }
    json!({ "keys": choices, "textures": TEXTURES })
}

/// The values of `scene`, by their paths.
///
/// # Errors
/// As [`Camera::target_and_distance`].
pub(crate) fn values(scene: &Scene) -> Result<Value> {
    let mut values = Map::new();
    let mut put = |path: &str, value: Value| values.insert(path.to_owned(), value);
    if let Some(cloth) = &scene.cloth {
        put("cloth.ks", json!(cloth.ks));
        put("cloth.density", json!(cloth.density));
        put("cloth.damping", json!(cloth.damping));
        put("cloth.enable_structural", json!(cloth.enable_structural));
        put("cloth.enable_shearing", json!(cloth.enable_shearing));
        put("cloth.enable_bending", json!(cloth.enable_bending));
    }
    let sim = &scene.sim;
    put("sim.gravity", list(sim.gravity));
    put("sim.steps_per_frame", json!(sim.steps_per_frame));
    put("sim.fps", json!(sim.fps));
    put("sim.integrator", json!(sim.integrator.name()));
    put("sim.contact", json!(sim.contact.name()));
    put("sim.self_collision", json!(sim.self_collision.name()));
    put("sim.stretch_limit", json!(sim.stretch_limit));
    let (target, distance) = Camera::target_and_distance(scene)?;
    put("camera.target", list(target));
    put("camera.distance", json!(distance));
    put("camera.polar", json!(scene.camera.polar));
    put("camera.azimuth", json!(scene.camera.azimuth));
    put("light.position", list(scene.light.position));
    put("light.intensity", list(scene.light.intensity));
    put("render.size", json!(scene.render.size));
    put("render.samples", json!(scene.render.samples));
    Ok(Value::Object(values))
}

/// What each drawn object looks like, in draw order, with the path of its material.
pub(crate) fn objects(scene: &Scene) -> Vec<Value> {
    let mut paths: Vec<String> = scene.cloth.iter().map(|_| "cloth".into()).collect();
    for &kind in ColliderKind::ALL {
        let count = scene.collider_counts()[kind];
        let path = |i| if count > 1 { format!("{}.{i}", kind.key()) } else { kind.key().into() };
        paths.extend((0..count).map(path));
    }
    paths.iter().zip(scene.materials()).map(|(path, material)| object(path, material)).collect()
}

fn object(path: &str, material: &Material) -> Value {
    let Material { ka, kd, ks, shininess, km, normal_scaling, height_scaling, .. } = material;
    json!({
        "path": path,
        "shader": material.shader.name(),
        "color": list(material.color),
        "ka": ka, "kd": kd, "ks": ks, "shininess": shininess, "km": km,
        "normal_scaling": normal_scaling, "height_scaling": height_scaling,
        "texture": material.texture, "height_map": material.height_map, "environment": material.environment,
    })
}

fn list(v: Vec3) -> Value {
    json!([v.x, v.y, v.z])
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape::texture_source::is_built_in_texture;

    #[test]
    fn the_textures_to_choose_are_built_in() {
        assert!(TEXTURES.iter().all(|name| is_built_in_texture(name)));
    }

    #[test]
    fn what_can_be_chosen_is_what_a_scene_allows() {
        let choices = choices();
        for path in ["sim.integrator", "sim.contact", "sim.self_collision", "material.shader"] {
            assert!(choices["keys"][path].as_array().is_some_and(|values| values.len() >= 2), "{path}");
        }
        assert_eq!(choices["keys"]["material.shader"].as_array().unwrap().len(), 9);
    }
}
