//! A scene as a document that says all of it, and how two scenes differ.

use std::collections::BTreeSet;

use serde_json::{Map, Value};

use super::json::key::Listed;
use super::json::text::join;
use super::{Collider, Material, PerKind, Scene};

/// A key that two scenes do not share; `None` where there is no such object.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Its dotted path, such as `sphere.0.radius`; that of a whole object or list where only one scene has it.
    pub path: String,
    /// Its value in the first scene and in the second.
    pub values: [Option<Value>; 2],
}

impl Difference {
    /// The change `PATH=JSON` that makes the second scene of the first; `null` removes an object.
    pub fn set(&self) -> String {
        let [_, value] = &self.values;
        format!("{}={}", self.path, value.as_ref().unwrap_or(&Value::Null))
    }
}

impl Scene {
    /// The scene file that says every key, with defaults filled in and the colliders of a kind as a list. Scenes that
    /// are equal have the same document, and loading it gives this scene.
    pub fn document(&self) -> Map<String, Value> {
        let mut document = Map::new();
        if let Some(cloth) = &self.cloth {
            let object = with_material(|list| cloth.list("", list), &cloth.material);
            document.insert("cloth".to_owned(), object);
        }
        let mut lists = PerKind::<Vec<Value>>::default();
        for collider in &self.colliders {
            let object = with_material(|list| Collider::list(collider, "", list), collider.material());
            lists[collider.kind()].push(object);
        }
        for kind in super::ColliderKind::ALL {
            let list = std::mem::take(&mut lists[*kind]);
            if !list.is_empty() {
                document.insert(kind.key().to_owned(), Value::Array(list));
            }
        }
        let groups: [(&str, &dyn Listed); 4] =
            [("sim", &self.sim), ("camera", &self.camera), ("light", &self.light), ("render", &self.render)];
        for (name, group) in groups {
            document.insert(name.to_owned(), Value::Object(object(|list| group.list("", list))));
        }
        document
    }
}

/// An object of the keys that `list` adds.
fn object(list: impl FnOnce(&mut Vec<(String, Value)>)) -> Map<String, Value> {
    let mut keys = Vec::new();
    list(&mut keys);
    // In an order of its own, whatever that of the map is.
    keys.sort_by(|(a, _), (b, _)| a.cmp(b));
    keys.into_iter().collect()
}

/// The same with the material of the object.
fn with_material(list: impl FnOnce(&mut Vec<(String, Value)>), material: &Material) -> Value {
    let material = Value::Object(object(|keys| material.list("", keys)));
    Value::Object(object(|keys| {
        list(keys);
        keys.push(("material".to_owned(), material));
    }))
}

/// The keys in which two documents differ, in the order of their paths.
pub fn differences(a: &Map<String, Value>, b: &Map<String, Value>) -> Vec<Difference> {
    let mut found = Vec::new();
    compare_objects("", a, b, &mut found);
    found
}

fn compare_objects(path: &str, a: &Map<String, Value>, b: &Map<String, Value>, found: &mut Vec<Difference>) {
    let names: BTreeSet<&String> = a.keys().chain(b.keys()).collect();
    for name in names {
        compare(join(path, name), [a.get(name), b.get(name)], found);
    }
}

fn compare(path: String, values: [Option<&Value>; 2], found: &mut Vec<Difference>) {
    match values {
        [Some(Value::Object(a)), Some(Value::Object(b))] => compare_objects(&path, a, b, found),
        [Some(Value::Array(a)), Some(Value::Array(b))] if a.len() == b.len() && are_objects(a) => {
            for (i, (a, b)) in a.iter().zip(b).enumerate() {
                compare(format!("{path}.{i}"), [Some(a), Some(b)], found);
            }
        }
        [Some(a), Some(b)] if text(a) == text(b) => {}
        values => found.push(Difference { path, values: values.map(Option::<&Value>::cloned) }),
    }
}

/// A value as it is written: as numbers, 0 and -0 would be equal.
fn text(value: &Value) -> String {
    value.to_string()
}

fn are_objects(list: &[Value]) -> bool {
    list.first().is_some_and(Value::is_object)
}

#[cfg(test)]
mod tests {
    use super::super::{Overrides, load_text, stock};
    use super::*;

    fn load(text: &str, sets: &[String]) -> Scene {
        load_text("a.json", text, &Overrides { sets: sets.to_vec(), ..Overrides::default() }).unwrap().scene
    }

    fn scenes() -> Vec<&'static str> {
        stock::SCENES.iter().map(|(_, text)| *text).chain(["{}"]).collect()
    }

    #[test]
    fn loading_a_document_gives_the_scene_and_the_same_document() {
        let odd = [
            "sim.gravity=[-0.0,-9.8,1e-300]",
            "camera.target=[0.1,0.2,0.30000000000000004]",
            "material.texture=a-b",
            "sim.stretch_limit=null",
        ];
        for text in scenes() {
            let scene = load(text, &odd.map(str::to_owned));
            let document = Value::Object(scene.document()).to_string();
            assert!(document.contains("[-0.0,-9.8,1e-300]"), "{document}");
            let again = load(&document, &[]);
            assert_eq!(again, scene);
            assert_eq!(Value::Object(again.document()).to_string(), document);
        }
    }

    #[test]
    fn the_changes_make_every_scene_of_every_other() {
        for from in scenes() {
            for to in scenes() {
                let (a, b) = (load(from, &[]), load(to, &[]));
                let sets: Vec<String> =
                    differences(&a.document(), &b.document()).iter().map(Difference::set).collect();
                assert_eq!(load(from, &sets), b, "{sets:?}");
                assert_eq!(sets.is_empty(), a == b);
            }
        }
    }

    #[test]
    fn a_change_names_the_key() {
        let sphere = include_str!("../../scenes/sphere.json");
        let set = ["sphere.radius=0.25".to_owned(), "plane=null".to_owned(), "sim.fps=90".to_owned()];
        let found = differences(&load(sphere, &[]).document(), &load(sphere, &set).document());
        assert_eq!(found.iter().map(Difference::set).collect::<Vec<_>>(), ["sphere.0.radius=0.25"]);
    }
}
