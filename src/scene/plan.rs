//! What a scene needs and why, so that nothing else is allocated, read or run.

use super::{Cloth, ColliderKind, Contact, Material, Scene, SelfCollision, Shader};

/// What a scene needs. Everything that is `false` or absent here can be left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// How self-collision is found; off when the phase is left out.
    pub self_collision: SelfCollision,
    /// The strain that the stretch limit leaves, if it runs.
    pub stretch_limit: Option<f64>,
    /// What is drawn, in draw order: the cloth, then the colliders.
    pub objects: Vec<ObjectPlan>,
    /// The textures and height maps to read, each once, in order of first use.
    pub textures: Vec<String>,
    /// The cube maps to read, each once, in order of first use.
    pub environments: Vec<String>,
    /// Every decision above with its reason.
    pub items: Vec<Item>,
}

/// What one drawn object needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObjectPlan {
    /// The object's key in the file: `cloth`, `sphere`, or `sphere.1` if there are several.
    pub name: String,
    /// What its shader reads.
    pub needs: Needs,
}

/// What a shader reads besides the position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Vertex normals.
    pub normal: bool,
    /// Vertex tangents.
    pub tangent: bool,
    /// Texture coordinates.
    pub uv: bool,
    /// The colour texture.
    pub texture: bool,
    /// The height map.
    pub height_map: bool,
    /// The cube map.
    pub environment: bool,
}

/// One thing that is needed or left out, for people.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Item {
    /// What it is, such as `bending springs`.
    pub name: String,
    /// Whether it is needed.
    pub needed: bool,
    /// Why, or why not.
    pub reason: String,
}

impl Needs {
    /// What `shader` reads.
    pub fn of(shader: Shader) -> Self {
        let nothing = Self::default();
        let normal = Self { normal: true, ..nothing };
        let relief = Self { normal: true, tangent: true, uv: true, height_map: true, ..nothing };
        match shader {
            Shader::Wireframe => nothing,
            Shader::Normal | Shader::Diffuse | Shader::Phong => normal,
            Shader::Texture => Self { uv: true, texture: true, ..nothing },
            Shader::Bump | Shader::Displacement => relief,
            Shader::Mirror => Self { environment: true, ..normal },
            Shader::Custom => Self { texture: true, environment: true, ..relief },
        }
    }

    /// Each thing a shader can read, with its name and whether it is read.
    fn named(self) -> [(&'static str, bool); 6] {
        [
            ("normals", self.normal),
            ("tangents", self.tangent),
            ("texture coordinates", self.uv),
            ("texture", self.texture),
            ("height map", self.height_map),
            ("environment", self.environment),
        ]
    }
}

impl Plan {
    /// The plan of `scene`.
    pub fn of(scene: &Scene) -> Self {
        let items = &mut Vec::new();
        // The springs build themselves from the same three keys of the cloth.
        let any_spring =
            note(items, "structural springs", spring(scene, "structural", |c| c.enable_structural))
                | note(items, "shearing springs", spring(scene, "shearing", |c| c.enable_shearing))
                | note(items, "bending springs", spring(scene, "bending", |c| c.enable_bending));
        let collides_itself = note(items, "self-collision", self_collision(scene));
        for &kind in ColliderKind::ALL {
            note(items, &format!("collision with {}", kind.plural()), collision(scene, kind));
        }
        let limited = note(items, "stretch limit", stretch_limit(scene, any_spring));
        let drawn = drawn(scene);
        let objects = drawn.iter().map(|(name, material)| object(name, material, items)).collect();
        let [textures, environments] = images(&drawn);
        let textures = textures.names("texture", items);
        let environments = environments.names("cube map", items);
        let items = std::mem::take(items);
        Self {
            self_collision: if collides_itself { scene.sim.self_collision } else { SelfCollision::Off },
            stretch_limit: scene.sim.stretch_limit.filter(|_| limited),
            objects,
            textures,
            environments,
            items,
        }
    }

    /// Each thing that is needed or left out, one line each, with the reason.
    pub fn lines(&self) -> impl Iterator<Item = String> + '_ {
        self.items.iter().map(|item| {
            let verdict = if item.needed { "needed" } else { "left out" };
            format!("{}: {verdict}: {}", item.name, item.reason)
        })
    }
}

/// Why something is needed, or why it is left out.
type Decision = Result<String, String>;

fn note(items: &mut Vec<Item>, name: &str, decision: Decision) -> bool {
    let needed = decision.is_ok();
    let reason = decision.unwrap_or_else(|why_not| why_not);
    items.push(Item { name: name.into(), needed, reason });
    needed
}

fn cloth(scene: &Scene) -> Result<&Cloth, String> {
    scene.cloth.as_ref().ok_or_else(|| "the scene has no cloth".into())
}

fn spring(scene: &Scene, kind: &str, enabled: impl Fn(&Cloth) -> bool) -> Decision {
    let enabled = enabled(cloth(scene)?);
    let reason = format!("cloth.enable_{kind} is {enabled}");
    if enabled { Ok(reason) } else { Err(reason) }
}

fn self_collision(scene: &Scene) -> Decision {
    let cloth = cloth(scene)?;
    if scene.sim.self_collision == SelfCollision::Off {
        return Err("sim.self_collision is off".into());
    }
    if cloth.thickness == 0.0 {
        return Err("cloth.thickness is 0".into());
    }
    let whole = scene.sim.self_collision == SelfCollision::Neighbors;
    let seen = if whole { ", and sim.self_collision is neighbors: all pairs are seen" } else { "" };
    Ok(format!("cloth.thickness is {} m{seen}", cloth.thickness))
}

fn collision(scene: &Scene, kind: ColliderKind) -> Decision {
    cloth(scene)?;
    match scene.collider_counts()[kind] {
        0 => Err(format!("the scene has no {}", kind.key())),
        count => {
            let name = if count == 1 { kind.key() } else { kind.plural() };
            let outside = scene.sim.contact == Contact::Outside;
            let kept = if outside { ", and sim.contact is outside: points are kept out" } else { "" };
            Ok(format!("the scene has {count} {name}{kept}"))
        }
    }
}

fn stretch_limit(scene: &Scene, any_spring: bool) -> Decision {
    cloth(scene)?;
    if !any_spring {
        return Err("there are no springs".into());
    }
    let limit = scene.sim.stretch_limit.ok_or("sim.stretch_limit is null")?;
    Ok(format!("sim.stretch_limit is {limit}"))
}

/// The drawn objects by name, in draw order.
fn drawn(scene: &Scene) -> Vec<(String, &Material)> {
    let cloth = scene.cloth.iter().map(|cloth| ("cloth".into(), &cloth.material));
    let colliders = (0..scene.colliders.len()).map(|i| (name(scene, i), scene.colliders[i].material()));
    cloth.chain(colliders).collect()
}

/// The dotted path of collider `i`: its kind, with a number if there are several of that kind.
fn name(scene: &Scene, i: usize) -> String {
    let kind = scene.colliders[i].kind();
    let key = kind.key();
    let before = |end| scene.colliders[..end].iter().filter(|other| other.kind() == kind).count();
    if before(scene.colliders.len()) > 1 { format!("{key}.{}", before(i)) } else { key.into() }
}

fn object(name: &str, material: &Material, items: &mut Vec<Item>) -> ObjectPlan {
    let needs = Needs::of(material.shader);
    let shader = material.shader.name();
    for (what, needed) in needs.named() {
        let decision = if needed {
            Ok(format!("read by the {shader} shader"))
        } else {
            Err(format!("not read by the {shader} shader"))
        };
        note(items, &format!("{name} {what}"), decision);
    }
    ObjectPlan { name: name.into(), needs }
}

/// Images of one kind with the objects that read them, in order of first use.
#[derive(Default)]
struct Images(Vec<(String, Vec<String>)>);

impl Images {
    fn add(&mut self, needed: bool, image: &str, object: &str) {
        if !needed {
            return;
        }
        match self.0.iter_mut().find(|(name, _)| name == image) {
            Some((_, objects)) if objects.iter().any(|name| name == object) => {}
            Some((_, objects)) => objects.push(object.into()),
            None => self.0.push((image.into(), vec![object.into()])),
        }
    }

    /// The names, each noted with its readers.
    fn names(self, kind: &str, items: &mut Vec<Item>) -> Vec<String> {
        if self.0.is_empty() {
            note(items, &format!("{kind}s"), Err("no shader reads one".into()));
        }
        for (image, objects) in &self.0 {
            note(items, &format!("{kind} {image}"), Ok(format!("read by {}", objects.join(", "))));
        }
        self.0.into_iter().map(|(image, _)| image).collect()
    }
}

/// The textures with the height maps, and the cube maps.
fn images(drawn: &[(String, &Material)]) -> [Images; 2] {
    let [mut textures, mut environments] = [Images::default(), Images::default()];
    for (object, material) in drawn {
        let needs = Needs::of(material.shader);
        textures.add(needs.texture, &material.texture, object);
        textures.add(needs.height_map, &material.height_map, object);
        environments.add(needs.environment, &material.environment, object);
    }
    [textures, environments]
}

#[cfg(test)]
mod tests;
