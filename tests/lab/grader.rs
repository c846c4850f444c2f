//! The search for the cause of a difference tells how far it is.

use std::sync::Mutex;

use drape::scene::{Overrides, Scene, load_text};
use drape::simulation::Simulation;
use drape_lab::grader::{Case, Comparison, Event, Ours};

/// A cloth that swings and meets a ball.
const SCENE: &str = r#"{"cloth": {"width": 1, "height": 1, "num_width_points": 7, "num_height_points": 7,
    "thickness": 0.02, "orientation": 0, "pinned": [[0, 0]], "damping": 0.2, "density": 150, "ks": 5000,
    "enable_structural": true, "enable_shearing": true, "enable_bending": true},
    "sphere": {"origin": [0.5, 0.8, 0.5], "radius": 0.15, "friction": 0.3}, "render": {"time": 0.2}}"#;

fn scene(sets: &[&str]) -> Scene {
    let sets = sets.iter().map(ToString::to_string).collect();
    load_text("x.json", SCENE, &Overrides { sets, ..Overrides::default() }).unwrap().scene
}

/// The states of frames 0 to 18 of a scene.
fn states(scene: &Scene) -> Vec<Ours> {
    Ours::simulate(Simulation::new(scene).unwrap(), 0, 19, |_| Ok(())).unwrap()
}

/// The stages of a search with the frames that each announced and told, and its verdict.
fn search(theirs: &[Ours]) -> (Vec<(String, [u64; 2])>, String) {
    let (scene, stages) = (scene(&[]), Mutex::new(Vec::new()));
    let (ours, cloth) = (states(&scene), scene.cloth.clone().unwrap());
    let points = |state: &Ours| (0..49).map(|p| state.positions.get(p).into()).collect();
    let theirs: Vec<Vec<[f64; 3]>> = theirs.iter().map(points).collect();
    let case = Case {
        scene: &scene,
        cloth: &cloth,
        first_frame: 0,
        last_frame: 18,
        start: None,
        ours: &ours,
        theirs: &theirs,
    };
    let watch = |event| {
        let mut stages = stages.lock().unwrap();
        match event {
            Event::Stage(what, frames) => stages.push((what, [frames, 0])),
            Event::Frames(frames) => stages.last_mut().unwrap().1[1] += frames,
        }
        Ok(())
    };
    let text = Comparison::new(&case, 0.0, Some(&watch)).unwrap().text();
    (stages.into_inner().unwrap(), text)
}

#[test]
fn every_stage_tells_as_many_frames_as_it_announces() {
    let (stages, text) = search(&states(&scene(&["cloth.damping=0.3"])));
    assert!(text.contains("cloth.damping of 0.3 instead of 0.2"), "{text}");
    let kinds: Vec<&str> = stages.iter().map(|(what, _)| what.split_once(' ').unwrap().0).collect();
    assert_eq!(kinds, ["looking", "running", "fitting", "running"], "{stages:?}");
    for (what, [announced, told]) in &stages {
        assert!(announced == told && *told > 0, "{what}: {told} of {announced}");
    }

    // Only rounding at first, which the ball makes large.
    let mut twin = states(&scene(&["cloth.damping=0.2000000000001"]));
    twin[0] = states(&scene(&[])).swap_remove(0);
    let (stages, _) = search(&twin);
    assert!(stages.iter().all(|(_, [announced, told])| told <= announced), "{stages:?}");
}
