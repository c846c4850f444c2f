//! After contact rounding grows until it hides everything else: from when on is told, and no sooner.

use std::fs;

use drape::math::splitmix64;
use drape::scene::{Overrides, Scene, load_text};

use super::{HANGING, compared, raw, run, scene};
use crate::mistakes::{self, Fault, Mistakes};
use crate::textbook_cloth::{Cloth, Vector};

/// A stock scene with changes.
struct Stock {
    text: String,
    scene: Scene,
    sets: Vec<String>,
}

impl Stock {
    fn new(name: &str, sets: &[&str]) -> Self {
        let text = fs::read_to_string(crate::scratch::scene(name)).unwrap();
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        let overrides = Overrides { sets: sets.clone(), ..Overrides::default() };
        let scene = load_text(name, &text, &overrides).unwrap().scene;
        Self { text, scene, sets }
    }

    /// What the command says of `frames` frames of a program whose step is `step`.
    fn verdict(&self, frames: usize, step: impl FnMut(&mut Cloth<'_>)) -> String {
        let numbers = run(&self.scene, &mut mistakes::cloth(&self.scene, Mistakes::default()), frames, step);
        let range = format!("0..{frames}");
        let sets = self.sets.iter().flat_map(|set| ["--set", set]);
        let options: Vec<&str> = sets.chain(["--frames", &range]).collect();
        compared(&self.text, raw(&numbers), &options, 1)["verdict"].to_string()
    }
}

/// How a program that makes no mistake may round otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rounding {
    /// Its start has other last bits.
    Start(u64),
    /// Every point has another last bit after every step.
    EveryStep(u64),
    /// It sums the forces of the springs from the last one to the first.
    Springs,
    /// It computes a step as (2 - d) x - (1 - d) last + f dt² / m.
    Step,
}

impl Rounding {
    /// The step of a program that rounds so.
    fn step(self) -> impl FnMut(&mut Cloth<'_>) {
        let mut count = 0;
        move |cloth| {
            count += 1;
            match self {
                Self::Start(seed) if count == 1 => start_rounded(cloth, seed),
                Self::Springs => cloth.springs.reverse(),
                _ => {}
            }
            let forces = cloth.forces();
            if self == Self::Springs {
                cloth.springs.reverse();
            }
            let (x, last) = (cloth.x.clone(), cloth.last.clone());
            cloth.integrate(&forces);
            if self == Self::Step {
                integrate_otherwise(cloth, &x, &last, &forces);
            }
            cloth.collide_with_itself();
            cloth.collide_with_objects();
            cloth.limit_stretch();
            if let Self::EveryStep(seed) = self {
                let pinned = cloth.pinned.clone();
                rounded(&mut cloth.x, &pinned, seed << 32 | count);
            }
        }
    }
}

fn start_rounded(cloth: &mut Cloth<'_>, seed: u64) {
    let pinned = cloth.pinned.clone();
    rounded(&mut cloth.x, &pinned, seed);
    cloth.last.clone_from(&cloth.x);
}

/// Each coordinate of a point that is free one rounding larger, smaller, or as it is.
fn rounded(points: &mut [Vector], pinned: &[bool], seed: u64) {
    for (p, point) in points.iter_mut().enumerate().filter(|(p, _)| !pinned[*p]) {
        for (c, x) in point.iter_mut().enumerate() {
            let roundings = splitmix64(splitmix64(seed) ^ (3 * p + c) as u64) % 3;
            *x *= 1.0 + (roundings as f64 - 1.0) * f64::EPSILON;
        }
    }
}

fn integrate_otherwise(cloth: &mut Cloth<'_>, x: &[Vector], last: &[Vector], forces: &[Vector]) {
    let (kept, dt2_over_m) = (cloth.velocity_retention, cloth.dt * cloth.dt / cloth.mass);
    for p in (0..x.len()).filter(|&p| !cloth.pinned[p]).collect::<Vec<_>>() {
        cloth.x[p] =
            [0, 1, 2].map(|c| (1.0 + kept) * x[p][c] - kept * last[p][c] + forces[p][c] * dt2_over_m);
    }
}

const EVERY_ROUNDING: [Rounding; 4] =
    [Rounding::Start(1), Rounding::EveryStep(1), Rounding::Springs, Rounding::Step];

/// A cloth of so few points that contact comes soon and takes no time.
const SMALL: [&str; 3] = ["cloth.num_width_points=14", "cloth.num_height_points=14", "cloth.thickness=0.03"];

/// A cloth that hits hard: within one frame rounding grows to what a mistake does.
const FALLING: [&str; 6] = [
    "cloth.num_width_points=10",
    "cloth.num_height_points=10",
    "cloth.damping=0",
    "cloth.orientation=1",
    "plane.point=[0,-3,0]",
    "sim.gravity=[0,-1000,0]",
];

#[track_caller]
fn assert_is_rounding(stock: &Stock, frames: usize, rounding: Rounding) {
    let verdict = stock.verdict(frames, rounding.step());
    assert!(verdict.contains("operations in another order"), "{:?} {rounding:?}: {verdict}", stock.sets);
}

#[test]
fn rounding_alone_is_never_called_a_mistake() {
    let small = Stock::new("selfCollision.json", &SMALL);
    EVERY_ROUNDING.into_iter().for_each(|rounding| assert_is_rounding(&small, 40, rounding));
    let falling = Stock::new("plane.json", &[&FALLING[..], &SMALL[2..]].concat());
    for rounding in [Rounding::Springs, Rounding::Step, Rounding::EveryStep(1)] {
        assert_is_rounding(&falling, 20, rounding);
    }
}

/// In a long fall roundings of every step add up, before contact makes them grow.
#[test]
fn rounding_of_thousands_of_steps_is_never_called_a_mistake() {
    let slippery = ["cloth.damping=0", "plane.point=[0,-30,0]", "plane.friction=0"];
    let long = Stock::new("plane.json", &[&SMALL[..], &slippery].concat());
    assert_is_rounding(&long, 300, Rounding::EveryStep(2));
}

#[test]
#[ignore = "takes minutes"]
fn rounding_of_no_stock_scene_is_called_a_mistake() {
    for name in ["sphere.json", "plane.json", "pinned2.json", "pinned4.json", "selfCollision.json"] {
        let stock = Stock::new(name, &[]);
        let seeds = [2, 3].into_iter().flat_map(|seed| [Rounding::Start(seed), Rounding::EveryStep(seed)]);
        for rounding in EVERY_ROUNDING.into_iter().chain(seeds) {
            // Forces of a flat cloth that hits a plane as a whole are 0, whatever is summed first.
            if (name, rounding) != ("plane.json", Rounding::Springs) {
                assert_is_rounding(&stock, 181, rounding);
            }
        }
    }
}

/// The step of a program with a fault, whose start has other last bits if there is a `seed`.
fn faulty(scene: &Scene, fault: Fault, seed: Option<u64>) -> impl FnMut(&mut Cloth<'_>) {
    let mut seed = seed;
    move |cloth| {
        if let Some(seed) = seed.take() {
            start_rounded(cloth, seed);
        }
        mistakes::faulty_step(scene, cloth, fault, &mut Vec::new());
    }
}

/// Points on the border of a cell of self-collision let a mistake with rounding look like none that is known; what it
/// is in is told all the same.
#[test]
fn a_wrong_self_collision_is_not_taken_for_rounding() {
    for (thickness, fault) in [("0.055", Fault::PushBoth), ("0.0502", Fault::WholePush)] {
        let text = HANGING.replace("0.0095", thickness);
        let scene = scene(&text);
        for seed in [None, Some(1), Some(2)] {
            let mut cloth = mistakes::cloth(&scene, Mistakes::default());
            let numbers = run(&scene, &mut cloth, 6, faulty(&scene, fault, seed));
            let verdict = compared(&text, raw(&numbers), &[], 1)["verdict"].to_string();
            assert!(verdict.contains("self-collision"), "{fault:?} {seed:?}: {verdict}");
            assert!(!verdict.contains("in another order"), "{fault:?} {seed:?}: {verdict}");
        }
    }
}

/// Where rounding is larger than what a mistake does before the mistake acts, the verdict says from when on nothing can
/// be told, and what that leaves untested; a program without that rounding is told its mistake.
#[test]
fn a_self_collision_that_acts_too_late_is_named_as_untested() {
    let stock = Stock::new("selfCollision.json", &SMALL);
    let verdict = stock.verdict(40, faulty(&stock.scene, Fault::WholePush, Some(1)));
    for part in
        ["From frame 8 on nothing can be told", "acted too late", "self-collision (first in frame 27)"]
    {
        assert!(verdict.contains(part), "{part}: {verdict}");
    }
    let verdict = stock.verdict(40, faulty(&stock.scene, Fault::WholePush, None));
    assert!(verdict.contains("self-collision not divided by the steps of a frame"), "{verdict}");
}
