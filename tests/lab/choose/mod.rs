//! An estimate of accuracy is held against the truth: the same scene with far smaller steps.

mod page;

use std::time::Duration;

use super::repository;
use drape::scene::{Overrides, Scene};
use drape::simulation::Simulation;
use drape_lab::accuracy::measure::Measure;
use drape_lab::accuracy::run::Run;
use drape_lab::accuracy::source::Source;
use drape_lab::choose::goal::Tolerance;
use drape_lab::choose::{self, Answer};

/// A stock scene with a cloth of `side` x `side` points, pinned at the same corners, and more changes.
fn source(scene: &str, side: usize, sets: &[&str]) -> Source {
    let (size, last) = (format!("={side}"), side - 1);
    let pins = match scene {
        "pinned2" => format!("[[0,0],[{last},0]]"),
        "pinned4" => format!("[[0,0],[{last},0],[0,{last}],[{last},{last}]]"),
        _ => "[]".to_owned(),
    };
    let size = [
        format!("cloth.num_width_points{size}"),
        format!("cloth.num_height_points{size}"),
        format!("cloth.pinned={pins}"),
    ];
    let sets = size.into_iter().chain(sets.iter().map(ToString::to_string)).collect();
    let path = repository::path(&format!("scenes/{scene}.json"));
    Source { path, overrides: Overrides { sets, ..Overrides::default() } }
}

fn mm(value: f64) -> Tolerance {
    Tolerance { value: value * 1e-3, measure: Measure::Rms }
}

fn within(source: &Source, frames: u64, tolerance: Tolerance) -> Answer {
    choose::within(source, frames, tolerance, &|| Ok(())).unwrap()
}

/// Where the points are at frame `frames` under `scene`.
fn run(scene: &Scene, frames: u64) -> Vec<[f64; 3]> {
    run_at_most(scene, frames, u64::MAX).unwrap().0
}

/// The same and the springs visited, unless those are more than `most` or the cloth blows up.
fn run_at_most(scene: &Scene, frames: u64, most: u64) -> Option<(Vec<[f64; 3]>, u64)> {
    let mut run = Run::new(scene).unwrap();
    for _ in 0..frames {
        run.simulation.advance_frame().ok()?;
        if run.springs() > most {
            return None;
        }
    }
    let x = run.simulation.positions();
    Some(((0..x.len()).map(|p| x.get(p).into()).collect(), run.springs()))
}

/// The scene with the settings that have a limit, under `integrator` with `steps` steps a frame.
fn with(source: &Source, integrator: &str, steps: u32) -> Scene {
    let start = if integrator == "verlet" { "half_step" } else { "report" };
    let sets = [
        format!("sim.integrator={integrator}"),
        format!("sim.start={start}"),
        "sim.damping=per_second".to_owned(),
        format!("sim.steps_per_frame={steps}"),
    ];
    source.scene(&sets).unwrap()
}

#[test]
fn the_error_of_a_run_is_that_of_free_fall() {
    // The report's start is off by g dt t / 2 at each time t, and so is twice the difference from half the step.
    let source = source("pinned2", 5, &["cloth.pinned=[]", "cloth.damping=0", "sim.self_collision=off"]);
    let scene = source.scene(&[]).unwrap();
    let mut simulation = Simulation::new(&scene).unwrap();
    (0..30).for_each(|_| simulation.advance_frame().unwrap());
    let error = choose::own_error(&source, &scene, &simulation, &|| Ok(())).unwrap();
    let right = 9.8 / 2700.0 * (1.0 / 3.0) / 2.0;
    assert!((error.rms - right).abs() < 1e-9 && (error.max - right).abs() < 1e-9, "{error:?}, not {right}");
    assert_eq!(error.steps_per_frame, 60);
}

#[test]
fn the_error_of_a_run_is_within_a_factor_of_two() {
    for (scene, side, frames, sets) in [
        ("pinned2", 12, 30, &["sim.stretch_limit=null", "cloth.damping=3"][..]),
        ("pinned4", 10, 20, &["sim.stretch_limit=null", "sim.damping=per_second", "sim.start=half_step"][..]),
        ("sphere", 12, 45, &[][..]),
    ] {
        let source = source(scene, side, sets);
        let scene = source.scene(&[]).unwrap();
        let mut simulation = Simulation::new(&scene).unwrap();
        (0..frames).for_each(|_| simulation.advance_frame().unwrap());
        let error = choose::own_error(&source, &scene, &simulation, &|| Ok(())).unwrap().rms;
        // At 2700 steps a second damping per step and per second are the same.
        let sets = ["sim.steps_per_frame=960", "sim.damping=per_second"].map(str::to_owned);
        let truth = run(&source.scene(&sets).unwrap(), frames);
        let x = simulation.positions();
        let here: Vec<[f64; 3]> = (0..x.len()).map(|p| x.get(p).into()).collect();
        let truth = Measure::Rms.distance(&here, &truth);
        assert!((0.5..=2.0).contains(&(truth / error)), "{:?}: {truth:.2e}, not {error:.2e}", source.path);
    }
}

#[test]
fn free_fall_needs_the_fewest_steps() {
    // With the half-step start Verlet's scheme is exact without damping.
    let source = source("pinned2", 5, &["cloth.pinned=[]", "cloth.damping=0", "sim.self_collision=off"]);
    let answer = within(&source, 30, mm(1e-6));
    let choice = answer.choice.as_ref().unwrap();
    assert!(choice.error + choice.uncertainty < 1e-11, "{}", answer.text());
    let steps: Vec<u32> = answer.candidates.iter().map(|candidate| candidate.steps_per_frame).collect();
    assert_eq!(choice.set[1], format!("sim.steps_per_frame={}", steps[0]));
    // The report's start is off by g dt t / 2 at each time t.
    let written = 9.8 / 2700.0 * (1.0 / 3.0) / 2.0;
    assert!((answer.model[0].error - written).abs() < 1e-9, "{:?}", answer.model);
}

#[test]
fn what_has_no_limit_is_refused_with_the_reason() {
    // Beyond its first contact with the ball the cloth is chaotic.
    let source = source("sphere", 20, &[]);
    let answer = within(&source, 90, mm(1e-6));
    assert!(answer.choice.is_none());
    let reason = answer.reason.unwrap();
    assert!(reason.contains("halving the step still moves") && reason.contains("lowest point"), "{reason}");
}

#[test]
fn a_budget_buys_the_steps_that_it_pays_for() {
    let source = source("pinned2", 8, &[]);
    let answer =
        choose::within_budget(&source, 20, Duration::from_millis(300), Measure::Rms, &|| Ok(())).unwrap();
    let choice = answer.choice.as_ref().unwrap();
    assert!(choice.ms <= 300.0, "{}", answer.text());
    // Nothing that was within the budget is better.
    for candidate in answer.candidates.iter().filter(|candidate| candidate.ms.is_some_and(|ms| ms <= 300.0)) {
        assert!(candidate.error.unwrap() >= choice.error, "{}", answer.text());
    }
    let none =
        choose::within_budget(&source, 20, Duration::from_nanos(10), Measure::Rms, &|| Ok(())).unwrap();
    assert!(none.choice.is_none() && none.reason.unwrap().contains("the fewest steps"));
}

#[test]
fn pixels_are_those_of_the_camera() {
    let source =
        source("pinned2", 8, &["sim.stretch_limit=null", "camera.distance=2", "render.size=[200,200]"]);
    let px = |value: f64| Tolerance { value, measure: Measure::Pixels };
    let errors = [0.5, 0.05].map(|value| within(&source, 20, px(value)).choice.unwrap().error);
    assert!(errors[0] <= 0.5 && errors[1] <= 0.05 && errors[1] > 0.0, "{errors:?}");
    let larger = source_of_size(400);
    let [small, large] = [&source, &larger].map(|source| {
        let answer = within(source, 20, px(0.5));
        answer.candidates[0].error.unwrap()
    });
    assert!((large / small - 2.0).abs() < 0.05, "{small} px, and {large} px in a picture of twice the size");
}

#[test]
fn beyond_the_horizon_no_pixels_are_promised() {
    let source = source("sphere", 20, &["camera.distance=2"]);
    let answer = within(&source, 90, Tolerance { value: 1e-4, measure: Measure::Pixels });
    assert!(answer.choice.is_none(), "{}", answer.text());
    let reason = answer.reason.unwrap();
    assert!(reason.contains("beyond its horizon") && reason.contains(" px apart"), "{reason}");
    assert!(answer.horizon.is_some_and(|time| time > 0.3 && time < 1.0), "{:?}", answer.horizon);
}

fn source_of_size(size: u32) -> Source {
    let size = format!("render.size=[{size},{size}]");
    source("pinned2", 8, &["sim.stretch_limit=null", "camera.distance=2", &size])
}
