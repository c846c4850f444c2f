//! What is allowed in a scene but probably not meant: warnings that involve more than one key.

use super::json::diagnostic::Diagnostics;
use super::json::finding::Finding;
use super::json::node::Node;
use super::json::span::Span;
use super::{Material, Scene, without_effect};

/// Part by which neighbouring depths of 32 bits differ.
const DEPTH_STEP: f64 = 1.0 / 16_777_216.0;

/// Part of the camera's distance in which depths at the target must be told apart.
const MOST_STEP: f64 = 1e-3;

/// So much nearer than the target is a near plane that does.
const NEAR_PART: f64 = 1000.0;

/// Warns of what is doubtful in `scene`, read from `document`.
pub(super) fn warn(diagnostics: &mut Diagnostics, document: &Node, scene: &Scene) {
    let mut doubts = Doubts { diagnostics, document, scene };
    doubts.seen_range();
    doubts.without_effect();
}

/// A scene that was read from `document`.
struct Doubts<'a> {
    diagnostics: &'a mut Diagnostics,
    document: &'a Node,
    scene: &'a Scene,
}

impl Doubts<'_> {
    /// Warns of planes near and far between which the target is not seen, or not told apart from what is beside it.
    fn seen_range(&mut self) {
        let camera = &self.scene.camera;
        if camera.fit || !["camera", "cloth"].iter().all(|key| self.diagnostics.clean(key)) {
            return;
        }
        let distance = self.scene.camera_distance();
        let step = distance * distance * DEPTH_STEP / camera.near;
        let (key, message, fits) = if camera.near >= distance {
            let message =
                format!("the target, {distance} m away, lies before the near plane at {} m", camera.near);
            ("camera.near", message, distance / NEAR_PART)
        } else if camera.far <= distance {
            let message =
                format!("the target, {distance} m away, lies behind the far plane at {} m", camera.far);
            ("camera.far", message, distance * 10.0)
        } else if step > MOST_STEP * distance {
            let message = format!(
                "with the near plane at {} m, depths {distance} m away are told apart only in steps of {step:.1e} m",
                camera.near
            );
            ("camera.near", message, distance / NEAR_PART)
        } else {
            return;
        };
        // One digit is enough.
        let fits: f64 = format!("{fits:.0e}").parse().unwrap_or(fits);
        let beyond = if key == "camera.near" { ", if everything that is seen lies beyond that" } else { "" };
        let help = format!("`--set {key}={fits}` does{beyond}");
        let finding = Finding::new("scene::seen_range", message).key(key).help(help);
        let place = ["camera.near", "camera.far", "camera.distance"].iter().find_map(|key| self.span(key));
        self.warn(place, "given here", finding);
    }

    /// Warns of keys that are given and change nothing.
    fn without_effect(&mut self) {
        let scene = self.scene;
        for key in without_effect::KEYS {
            let given = self.span(key.path).filter(|_| self.diagnostics.clean(key.path));
            if given.is_some() && !(key.is_default)(scene) && !(key.acts)(scene) {
                self.ineffective(given, key.path, key.needs);
            }
        }
        let owners = without_effect::owners(scene);
        for key in std::iter::once("shader").chain(without_effect::material_keys()) {
            self.shared(key, &owners);
            for (paths, material) in &owners {
                let unread = paths.iter().filter(|_| !without_effect::reads(material.shader, key));
                for path in unread.map(|path| format!("{path}.{key}")) {
                    if let Some(place) = self.span(&path) {
                        self.ineffective(Some(place), &path, &without_effect::readers(key));
                    }
                }
            }
        }
    }

    /// Warns of a key of the scene's material that no object takes from there.
    fn shared(&mut self, key: &str, owners: &[(Vec<String>, &Material)]) {
        let path = format!("material.{key}");
        let Some(place) = self.span(&path) else { return };
        let mut readers =
            owners.iter().filter(|(_, material)| without_effect::reads(material.shader, key)).peekable();
        let why = if owners.is_empty() {
            "the scene has no object".to_owned()
        } else if readers.peek().is_none() {
            without_effect::readers(key)
        } else if readers.all(|(paths, _)| paths.iter().any(|path| self.has_own(&format!("{path}.{key}")))) {
            "each object that it is for has its own".to_owned()
        } else {
            return;
        };
        self.ineffective(Some(place), &path, &why);
    }

    /// Whether an object has a key of its own; what an option gives to every object is meant to replace the rest.
    fn has_own(&self, path: &str) -> bool {
        let source = self.span(path).and_then(|span| self.diagnostics.sources.get(span.source));
        source.is_some_and(|source| !source.name.starts_with("--shader"))
    }

    fn ineffective(&mut self, place: Option<Span>, path: &str, needs: &str) {
        let finding =
            Finding::new("scene::without_effect", format!("`{path}` has no effect: {needs}")).key(path);
        self.warn(place, "changes nothing", finding);
    }

    fn warn(&mut self, place: Option<Span>, label: &str, finding: Finding) {
        self.diagnostics.warn(match place {
            Some(place) => finding.at(place, label),
            None => finding,
        });
    }

    fn span(&self, path: &str) -> Option<Span> {
        self.document.get(path).map(|node| node.span)
    }
}
