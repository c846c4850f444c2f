//! Valid scenes from seeds: every key that moves a cloth, over its range.

use drape::diagnostics::geometry::{STARTS_INSIDE, concerns};
use drape::math::{exp, ln, splitmix64};
use drape::scene::{Overrides, Scene, load_text};
use serde_json::{Value, json};

/// The valid scene of `seed`, its text, and how many frames it runs.
pub(super) fn scene(seed: u64) -> (Scene, String, u64) {
    let mut draw = Draw { seed, index: 0 };
    loop {
        let (value, frames) = draw.scene();
        let text = value.to_string();
        let Ok(loaded) = load_text("random", &text, &Overrides::default()) else { continue };
        // Points that start inside an object get the speed that they leave it with, and most such runs are stopped.
        let inside = concerns(&loaded.scene).unwrap().iter().any(|concern| concern.code == STARTS_INSIDE);
        if !inside || draw.chance(0.1) {
            return (loaded.scene, text, frames);
        }
    }
}

/// The random numbers of a seed.
struct Draw {
    seed: u64,
    index: u64,
}

impl Draw {
    fn bits(&mut self) -> u64 {
        self.index += 1;
        splitmix64(splitmix64(self.seed).wrapping_add(self.index))
    }

    /// From 0 up to 1.
    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn chance(&mut self, part: f64) -> bool {
        self.unit() < part
    }

    fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[(self.bits() % choices.len() as u64) as usize]
    }

    /// From `least` to `most` with even logarithms, to three digits.
    fn log(&mut self, least: f64, most: f64) -> f64 {
        rounded(least * exp(self.unit() * ln(most / least)))
    }

    /// A number mostly from `usual`; if the scene is an `extreme` one, now and then from `all`.
    fn number(&mut self, extreme: bool, usual: [f64; 2], all: [f64; 2]) -> f64 {
        let [least, most] = if extreme && self.chance(0.2) { all } else { usual };
        self.log(least, most)
    }

    fn whole(&mut self, least: f64, most: f64) -> u64 {
        self.log(least, most) as u64
    }

    /// A vector whose components are 0 or of either sign.
    fn vector(&mut self, extreme: bool, usual: [f64; 2], all: [f64; 2]) -> [f64; 3] {
        if self.chance(0.5) {
            return [0.0; 3];
        }
        [(); 3].map(|()| self.one_of(&[-1.0, 0.0, 1.0]) * self.number(extreme, usual, all))
    }

    fn scene(&mut self) -> (Value, u64) {
        let extreme = self.chance(0.5);
        let sides = [self.whole(2.0, 9.0), self.whole(2.0, 9.0)];
        let size = [(); 2].map(|()| self.number(extreme, [0.2, 3.0], [1e-9, 1e9]));
        let offset = self.vector(extreme, [0.01, 10.0], [1e-9, 1e12]);
        let sim = self.sim(extreme);
        let cloth = self.cloth(extreme, sides, size, offset, &sim);
        let colliders = ["sphere", "box", "plane"].map(|kind| {
            let count = self.one_of(&[0, 0, 0, 0, 1, 1, 2]);
            let coulomb = sim["contact"] == "coulomb";
            (0..count).map(|_| self.collider(kind, extreme, coulomb, size, offset)).collect::<Vec<_>>()
        });
        let mut scene = json!({ "cloth": cloth, "sim": sim });
        for (kind, list) in ["sphere", "box", "plane"].into_iter().zip(colliders) {
            if !list.is_empty() {
                scene[kind] = Value::Array(list);
            }
        }
        (scene, self.whole(1.0, 13.0))
    }

    fn sim(&mut self, extreme: bool) -> Value {
        let integrator = self.one_of(&["verlet", "verlet", "rk4", "xpbd", "implicit_euler", "bdf2"]);
        let stretch_limit = match self.one_of(&[0, 0, 1, 2]) {
            0 => Value::Null,
            1 => json!(0.1),
            _ => json!(self.number(extreme, [1e-3, 1.0], [1e-12, 1e12])),
        };
        let gravity = match self.one_of(&[0, 0, 0, 1, 2, 2]) {
            0 => [0.0, -9.8, 0.0],
            1 => [0.0; 3],
            _ => [(); 3]
                .map(|()| self.one_of(&[-1.0, 0.0, 1.0]) * self.number(extreme, [0.1, 100.0], [1e-9, 1e4])),
        };
        let mut sim = json!({
            "fps": self.number(extreme, [10.0, 1000.0], [1e-6, 1e9]),
            "steps_per_frame": self.whole(1.0, 61.0),
            "gravity": gravity,
            "integrator": integrator,
            "stretch_limit": stretch_limit,
            "damping": self.one_of(&["per_step", "per_second"]),
            "self_collision": self.one_of(&["same_box", "neighbors", "off", "off"]),
            "contact": self.one_of(&["report", "outside", "coulomb"]),
        });
        if self.chance(0.25) {
            sim["stretch_passes"] = json!(self.whole(1.0, 20.0));
        }
        match integrator {
            "verlet" => {
                sim["precision"] = json!(self.one_of(&["f64", "f64", "f64", "f32"]));
                sim["start"] = json!(self.one_of(&["report", "half_step"]));
            }
            "xpbd" => sim["iterations"] = json!(self.whole(1.0, 30.0)),
            "rk4" => {}
            _ => sim["tolerance"] = json!(self.number(extreme, [1e-6, 1e-2], [1e-15, 1.0])),
        }
        sim
    }

    fn cloth(
        &mut self,
        extreme: bool,
        [w, h]: [u64; 2],
        [width, height]: [f64; 2],
        offset: [f64; 3],
        sim: &Value,
    ) -> Value {
        let density = self.number(extreme, [0.1, 1000.0], [1e-6, 1e12]);
        let damping = match self.one_of(&[0, 1, 1, 2]) {
            0 => 0.0,
            1 => self.number(extreme, [1e-3, 10.0], [1e-12, 100.0]),
            _ => self.number(extreme, [0.1, 1.0], [1e-12, 100.0]),
        };
        let spacing = (width / (w - 1) as f64).min(height / (h - 1) as f64);
        let thickness = match self.one_of(&[0, 1, 1]) {
            0 => 0.0,
            _ => self.number(extreme, [0.05 * spacing, 0.6 * spacing], [0.001 * spacing, 1e3 * spacing]),
        };
        let pinned_part = self.one_of(&[0.0, 0.0, 0.1, 0.3, 0.9, 1.0]);
        let pins: Vec<[u64; 2]> = if self.chance(0.3) {
            vec![[0, 0], [w - 1, 0]]
        } else {
            (0..h).flat_map(|y| (0..w).map(move |x| [x, y])).filter(|_| self.chance(pinned_part)).collect()
        };
        json!({
            "width": width, "height": height, "num_width_points": w, "num_height_points": h,
            "thickness": rounded(thickness), "orientation": self.one_of(&[0, 1]), "offset": offset,
            "velocity": self.vector(extreme, [0.01, 10.0], [1e-9, 1e6]),
            "pinned": pins, "damping": damping, "density": density,
            "ks": self.stiffness(density * width * height / (w * h) as f64, sim),
            "enable_structural": self.chance(0.8), "enable_shearing": self.chance(0.8),
            "enable_bending": self.chance(0.7),
        })
    }

    /// Mostly such that the step times the highest frequency at worst is within two decades around the bounds.
    fn stiffness(&mut self, mass: f64, sim: &Value) -> f64 {
        if self.chance(0.2) {
            return self.one_of(&[0.0, 1.0, 1.0]) * self.log(1e-6, 1e12);
        }
        let rate = sim["fps"].as_f64().unwrap() * sim["steps_per_frame"].as_f64().unwrap();
        let most = if ["verlet", "rk4"].iter().any(|name| sim["integrator"] == *name) { 4.0 } else { 1e3 };
        let dt_omega = self.log(0.05, most);
        rounded((dt_omega * rate) * (dt_omega * rate) * mass / 12.0).min(1e12)
    }

    fn collider(
        &mut self,
        kind: &str,
        extreme: bool,
        coulomb: bool,
        size: [f64; 2],
        offset: [f64; 3],
    ) -> Value {
        let largest = size[0].max(size[1]);
        let [x, y, z] = [size[0], largest, size[1]].map(|side| rounded(side * (1.6 * self.unit() - 0.3)));
        let place = [x + offset[0], 1.0 - y + offset[1], z + offset[2]];
        let friction = self.unit() * if coulomb { self.one_of(&[1.0, 3.0, 1e6]) } else { 1.0 };
        let friction = self.one_of(&[0.0, 0.5, rounded(friction)]);
        let length = |draw: &mut Self| {
            draw.number(extreme, [0.02 * largest, largest], [1e-3 * largest, 1e3 * largest])
        };
        match kind {
            "sphere" => json!({ "origin": place, "radius": length(self), "friction": friction }),
            "box" => {
                let edges = [(); 3].map(|()| length(self));
                json!({ "origin": place, "size": edges, "friction": friction })
            }
            _ => {
                let tilt = [(); 2].map(|()| self.one_of(&[0.0, 1.0]) * (2.0 * self.unit() - 1.0));
                json!({ "point": place, "normal": [rounded(tilt[0]), 1.0, rounded(tilt[1])], "friction": friction })
            }
        }
    }
}

/// `value` to three digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap()
}
