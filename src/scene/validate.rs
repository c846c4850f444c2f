//! Checks that involve more than one key.

use std::collections::BTreeMap;
use std::iter;

use super::doubtful;
use super::json::diagnostic::Diagnostics;
use super::json::finding::Finding;
use super::json::node::Node;
use super::json::span::Span;
use super::json::text::enumerated;
use super::{
    Cloth, ColliderKind, Contact, Damping, Integrator, MAX_POINTS, PerKind, Precision, Scene, SelfCollision,
    Start,
};

/// Most objects of a scene: they are numbered in 8 bits, and 0 is the background.
pub const MAX_OBJECTS: usize = 255;

/// Most samples of a picture: 16384 x 16384 pixels of one sample, which take 3 GiB.
pub const MAX_SAMPLES: u64 = 1 << 28;

/// Makes every check of `scene`, read from `document`, whose values were read without an error.
pub(super) fn validate(diagnostics: &mut Diagnostics, document: &Node, scene: &Scene) {
    Checks { diagnostics, document, scene }.run();
    doubtful::warn(diagnostics, document, scene);
}

/// A scene that was read from `document`, under check.
struct Checks<'a> {
    diagnostics: &'a mut Diagnostics,
    document: &'a Node,
    scene: &'a Scene,
}

impl Checks<'_> {
    fn run(mut self) {
        if let Some(cloth) = &self.scene.cloth {
            self.point_count(cloth);
            self.pins(cloth);
            self.thickness(cloth);
            self.damping(cloth);
        }
        self.only_verlet();
        self.friction();
        self.near_and_far();
        self.sample_count();
        self.object_count();
    }

    fn point_count(&mut self, cloth: &Cloth) {
        let (w, h) = (cloth.num_width_points, cloth.num_height_points);
        let points = w.checked_mul(h);
        if !self.clean(&[W, H]) || points.is_some_and(|points| points <= MAX_POINTS) {
            return;
        }
        let place = self.span(W);
        let finding =
            Finding::new("scene::too_many_points", format!("a cloth of {w} x {h} points is too large"))
                .key(W)
                .also(self.span(H), "times this")
                .help(format!("their product may be at most {MAX_POINTS}"));
        self.error(place, "points along x", finding);
    }

    fn pins(&mut self, cloth: &Cloth) {
        if !self.clean(&["cloth.pinned"]) {
            return;
        }
        let mut first = BTreeMap::new();
        for (i, &[x, y]) in cloth.pinned.iter().enumerate() {
            if self.diagnostics.is_full() {
                return;
            }
            let on_grid = self.pin_on_axis(i, 0, x, cloth.num_width_points, W)
                & self.pin_on_axis(i, 1, y, cloth.num_height_points, H);
            if !on_grid {
                continue;
            }
            match first.get(&[x, y]) {
                Some(&first) => self.pinned_twice(i, [x, y], first),
                None => {
                    first.insert([x, y], i);
                }
            }
        }
    }

    /// Whether coordinate `index` of a pin lies below `count`, which the key `count_key` gives.
    fn pin_on_axis(&mut self, pin: usize, axis: usize, index: usize, count: usize, count_key: &str) -> bool {
        if index < count || !self.clean(&[count_key]) {
            return true;
        }
        let key = format!("cloth.pinned.{pin}");
        let place = self.span(&format!("{key}.{axis}"));
        let name = count_key.strip_prefix("cloth.").unwrap_or(count_key);
        let finding = Finding::new("scene::pin_outside", format!("pinned point `{key}` is outside the grid"))
            .key(key)
            .also(self.span(count_key), format!("`{name}` is set here"));
        let last = count.saturating_sub(1);
        self.error(place, &format!("must be from 0 to {last}: there are {count} points"), finding);
        false
    }

    fn pinned_twice(&mut self, pin: usize, [x, y]: [usize; 2], first: usize) {
        let key = format!("cloth.pinned.{pin}");
        let place = self.span(&key);
        let finding = Finding::new("scene::duplicate_pin", format!("point [{x}, {y}] is pinned twice"))
            .key(key)
            .also(self.span(&format!("cloth.pinned.{first}")), "first pinned here")
            .help("remove one of the two");
        self.error(place, "again here", finding);
    }

    /// Warns if self-collision pushes points apart that are neighbours at rest.
    fn thickness(&mut self, cloth: &Cloth) {
        let keys = [W, H, "cloth.width", "cloth.height", "cloth.thickness"];
        let [dx, dy] = [(cloth.width, cloth.num_width_points), (cloth.height, cloth.num_height_points)]
            .map(|(length, points)| length / points.saturating_sub(1) as f64);
        let spacing = dx.min(dy);
        let off = self.scene.sim.self_collision == SelfCollision::Off;
        if off || 2.0 * cloth.thickness <= spacing || !self.clean(&keys) {
            return;
        }
        let message = format!(
            "2 x thickness is {} m, more than the {spacing} m between neighbouring points",
            2.0 * cloth.thickness
        );
        let finding = Finding::new("scene::thickness", message).key("cloth.thickness").help(format!(
            "self-collision pushes the cloth apart at rest unless this is at most {}",
            spacing / 2.0
        ));
        if let Some(place) = self.span("cloth.thickness") {
            self.diagnostics.warn(finding.at(place, "half the distance that self-collision keeps"));
        }
    }

    /// No finite rate takes all of the motion away.
    fn damping(&mut self, cloth: &Cloth) {
        let all_per_second = self.scene.sim.damping == Damping::PerSecond && cloth.damping == 100.0;
        if !all_per_second || !self.clean(&["cloth.damping", "sim.damping"]) {
            return;
        }
        let place = self.span("cloth.damping");
        let finding = Finding::new("scene::damping", "a damping of 100 % has no rate per second")
            .key("cloth.damping")
            .also(self.span("sim.damping"), "`sim.damping` is set here")
            .help("lower `cloth.damping` below 100, or leave out `sim.damping`");
        self.error(place, "must be below 100", finding);
    }

    /// Half a step back is where Verlet's scheme has its velocity; the others have it at the start.
    /// The other integrators have no binary32 version.
    fn only_verlet(&mut self) {
        let sim = &self.scene.sim;
        if sim.integrator == Integrator::Verlet || !self.clean(&["sim.integrator"]) {
            return;
        }
        let half_step = sim.start == Start::HalfStep;
        let why = "other integrators know the velocity at the start";
        self.verlets("sim.start", half_step, "starts with half a step", why);
        let single = sim.precision == Precision::F32;
        self.verlets("sim.precision", single, "runs in binary32", "other integrators are binary64");
    }

    /// Reports that only Verlet's scheme does what `key` asks for, if it `does` ask.
    fn verlets(&mut self, key: &str, does: bool, what: &str, why: &str) {
        if does && self.clean(&[key]) {
            let finding = Finding::new("scene::integrator", format!("only Verlet's scheme {what}"))
                .key(key)
                .also(self.span("sim.integrator"), "`sim.integrator` is set here")
                .help(format!("leave out `{key}` or `sim.integrator`: {why}"));
            self.error(self.span(key), "of Verlet's scheme", finding);
        }
    }

    /// A share of the motion is at most 1; a coefficient of friction may be larger.
    fn friction(&mut self) {
        let scene = self.scene;
        if scene.sim.contact == Contact::Coulomb || !self.clean(&["sim.contact"]) {
            return;
        }
        let mut counts = PerKind::<usize>::default();
        for collider in &scene.colliders {
            let (kind, number) = (collider.kind(), counts[collider.kind()]);
            counts[kind] += 1;
            let keys = [format!("{}.friction", kind.key()), format!("{}.{number}.friction", kind.key())];
            let Some(key) = keys.iter().find(|key| self.span(key).is_some()) else { continue };
            if collider.friction() > 1.0 && self.clean(&[key]) {
                let message = format!("`{key}` is {} but must be from 0 to 1", collider.friction());
                let finding = Finding::new("scene::friction", message)
                    .key(key)
                    .also(self.span("sim.contact"), "`sim.contact` is set here")
                    .help("a coefficient of friction, which may be larger, needs `sim.contact` = `coulomb`");
                self.error(self.span(key), "not allowed", finding);
            }
        }
    }

    fn near_and_far(&mut self) {
        let camera = &self.scene.camera;
        if camera.near < camera.far || !self.clean(&["camera.near", "camera.far"]) {
            return;
        }
        let (near, far) = (self.span("camera.near"), self.span("camera.far"));
        let message =
            format!("the near plane ({} m) is not before the far plane ({} m)", camera.near, camera.far);
        let finding = Finding::new("scene::near_far", message)
            .key("camera.near")
            .also(near.and(far), "`camera.far` is set here")
            .help("`camera.near` must be below `camera.far`");
        self.error(near.or(far), "", finding);
    }

    fn sample_count(&mut self) {
        let [width, height] = self.scene.render.size;
        let samples = self.scene.render.samples;
        if self.scene.render.sample_count() <= MAX_SAMPLES || !self.clean(&[SIZE, "render.samples"]) {
            return;
        }
        let message = format!("{width} x {height} pixels of {samples} samples are too many");
        let finding = Finding::new("scene::too_many_samples", message)
            .key(SIZE)
            .also(self.span("render.samples"), "times this")
            .help(format!("pixels times samples may be at most {MAX_SAMPLES}"));
        self.error(self.span(SIZE), "", finding);
    }

    fn object_count(&mut self) {
        let scene = self.scene;
        let count = scene.materials().count();
        if count <= MAX_OBJECTS {
            return;
        }
        let counts = scene.collider_counts();
        let kind = ColliderKind::ALL.iter().copied().max_by_key(|&kind| counts[kind]);
        let key = kind.map_or("cloth", ColliderKind::key);
        let plurals = counts.entries().map(|(plural, _)| plural);
        let names: Vec<String> = iter::once("cloth").chain(plurals).map(str::to_owned).collect();
        let names = enumerated(&names, "and");
        let place = self.span(key).map(Span::first);
        let finding = Finding::new("scene::too_many_objects", format!("{count} objects are too many"))
            .key(key)
            .help(format!("{names} together may be at most {MAX_OBJECTS}"));
        self.error(place, "most of them are here", finding);
    }

    fn error(&mut self, place: Option<Span>, label: &str, finding: Finding) {
        self.diagnostics.error(match place {
            Some(place) => finding.at(place, label),
            None => finding,
        });
    }

    fn clean(&self, keys: &[&str]) -> bool {
        keys.iter().all(|key| self.diagnostics.clean(key))
    }

    fn span(&self, path: &str) -> Option<Span> {
        self.document.get(path).map(|node| node.span)
    }
}

const SIZE: &str = "render.size";
const W: &str = "cloth.num_width_points";
const H: &str = "cloth.num_height_points";
