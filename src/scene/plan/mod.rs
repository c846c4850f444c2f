//! What a scene needs and why, so that nothing else is allocated, read or run.

mod images;
mod phases;

use super::{ColliderKind, Material, Needs, Scene};
use phases::Decision;

pub use images::Images;

/// One thing that a scene needs or that is left out, with the reason.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Item {
    /// What it is, such as `bending springs`.
    pub name: String,
    /// Whether it is needed.
    pub needed: bool,
    /// Why, or why not.
    pub reason: String,
}

/// Everything that a scene can need, in the order of the work: springs, phases of a step, what the shader of
/// each object reads, images.
pub fn plan(scene: &Scene) -> Vec<Item> {
    let springs = [
        ("structural springs", phases::springs(scene, "structural", |cloth| cloth.enable_structural)),
        ("shearing springs", phases::springs(scene, "shearing", |cloth| cloth.enable_shearing)),
        ("bending springs", phases::springs(scene, "bending", |cloth| cloth.enable_bending)),
        ("self-collision", phases::self_collision(scene)),
    ];
    let mut items: Vec<Item> = springs.map(|(name, decision)| item(name, decision)).into();
    for &kind in ColliderKind::ALL {
        items.push(item(format!("collision with {}", kind.plural()), phases::collision(scene, kind)));
    }
    items.push(item("stretch limit", phases::stretch_limit(scene)));
    let drawn: Vec<_> = names(scene).into_iter().zip(scene.materials()).collect();
    items.extend(drawn.iter().flat_map(|(name, material)| attributes(name, material)));
    let Images { textures, environments } = Images::of(scene);
    items.extend(images("texture", textures, |name| {
        readers(&drawn, |needs, m| {
            (needs.texture && m.texture == name) || (needs.height_map && m.height_map == name)
        })
    }));
    items.extend(images("cube map", environments, |name| {
        readers(&drawn, |needs, m| needs.environment && m.environment == name)
    }));
    items
}

fn item(name: impl Into<String>, decision: Decision) -> Item {
    let needed = decision.is_ok();
    Item { name: name.into(), needed, reason: decision.unwrap_or_else(|why_not| why_not) }
}

/// The dotted paths of what is drawn, in draw order: a collider has a number if there are several of its kind.
fn names(scene: &Scene) -> Vec<String> {
    let mut names: Vec<String> = scene.cloth.iter().map(|_| "cloth".into()).collect();
    for &kind in ColliderKind::ALL {
        let count = scene.collider_counts()[kind];
        let name = |i| if count > 1 { format!("{}.{i}", kind.key()) } else { kind.key().into() };
        names.extend((0..count).map(name));
    }
    names
}

/// What the shader of the object `name` reads.
fn attributes(name: &str, material: &Material) -> impl Iterator<Item = Item> {
    let shader = material.shader.name();
    Needs::of(material.shader).named().into_iter().map(move |(what, needed)| {
        let (read, not_read) =
            (format!("read by the {shader} shader"), format!("not read by the {shader} shader"));
        item(format!("{name} {what}"), if needed { Ok(read) } else { Err(not_read) })
    })
}

/// Images of one kind with the objects that read them.
fn images(kind: &str, names: Vec<String>, readers: impl Fn(&str) -> String) -> Vec<Item> {
    if names.is_empty() {
        return vec![item(format!("{kind}s"), Err("no shader reads one".into()))];
    }
    let read = |name: &String| item(format!("{kind} {name}"), Ok(format!("read by {}", readers(name))));
    names.iter().map(read).collect()
}

/// The objects that read something.
fn readers(drawn: &[(String, &Material)], reads: impl Fn(Needs, &Material) -> bool) -> String {
    let reading = drawn.iter().filter(|(_, material)| reads(Needs::of(material.shader), material));
    reading.map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests;
