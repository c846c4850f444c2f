//! A run that goes on from a saved state has the same bits as one that never stopped.

use drape::error::Kind;
use drape::scene::{
    Contact, Damping, Integrator, Overrides, Precision, Scene, SelfCollision, Start, load_text,
};
use drape::simulation::Simulation;
use drape::simulation::snapshot::Snapshot;
use proptest::prelude::*;

/// A cloth that falls on a ball and a plane and meets itself.
const SCENE: &str = r#"{"cloth": {"width": 1, "height": 1, "num_width_points": 8, "num_height_points": 9,
    "thickness": 0.06, "orientation": 0, "pinned": [[0, 0]], "damping": 0.2, "density": 1500, "ks": 5000,
    "enable_structural": true, "enable_shearing": true, "enable_bending": true},
    "sphere": {"origin": [0.5, 0.8, 0.5], "radius": 0.19, "friction": 0.3},
    "plane": {"point": [0, 0.97, 0], "normal": [0.1, 1, 0], "friction": 0.4},
    "sim": {"fps": 60, "steps_per_frame": 12}}"#;

fn scene(sets: &[String]) -> Scene {
    let overrides = Overrides { sets: sets.to_vec(), ..Overrides::default() };
    load_text("cloth.json", SCENE, &overrides).unwrap().scene
}

/// `simulation` after so many more steps.
fn after(mut simulation: Simulation, steps: u64) -> Simulation {
    (0..steps).for_each(|_| simulation.step());
    simulation
}

/// A new simulation of `scene`, perhaps with a ledger.
fn new(scene: &Scene, ledger: bool) -> Simulation {
    let mut simulation = Simulation::new(scene).unwrap();
    if ledger {
        simulation.record_ledger().unwrap();
    }
    simulation
}

/// The bytes of the state at the end of a run that was stopped after `split` of `steps` steps and went on in a
/// simulation of its own, and of a run that was not stopped.
fn both(scene: &Scene, split: u64, steps: u64, ledger: bool) -> [Vec<u8>; 2] {
    let whole = after(new(scene, ledger), steps);
    let saved = after(new(scene, ledger), split).snapshot(scene).encode();
    let mut second = new(scene, ledger);
    second.restore(scene, &Snapshot::decode(&saved).unwrap()).unwrap();
    let second = after(second, steps - split);
    assert_eq!((second.time(), second.counters()), (whole.time(), whole.counters()));
    [second, whole].map(|simulation| simulation.snapshot(scene).encode())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4, failure_persistence: None, ..ProptestConfig::default() })]

    /// The contacts, the integrators and the precisions are those that scenes can ask for, so a new one is tried too.
    #[test]
    fn a_continued_run_has_the_bits_of_an_uninterrupted_one(
        split in 0_u64..150,
        start in prop::sample::select(Start::NAMES),
        damping in prop::sample::select(Damping::NAMES),
        search in prop::sample::select(SelfCollision::NAMES),
        ledger: bool,
    ) {
        for (integrator, _) in Integrator::NAMES {
            for (contact, _) in Contact::NAMES {
                for (precision, kind) in Precision::NAMES {
                    if *kind == Precision::F32 && *integrator != "verlet" {
                        continue;
                    }
                    // Only Verlet's scheme starts with half a step.
                    let start = if *integrator == "verlet" { start.0 } else { "report" };
                    let sets = [
                        ("integrator", integrator), ("contact", contact), ("precision", precision),
                        ("start", &start), ("damping", &damping.0), ("self_collision", &search.0),
                    ];
                    let scene = scene(&sets.map(|(key, value)| format!("sim.{key}={value}")));
                    let [continued, whole] = both(&scene, split, 150, ledger);
                    prop_assert!(continued == whole, "{sets:?}, split at {split}");
                }
            }
        }
    }
}

#[test]
fn a_state_between_frames_knows_its_frame_and_what_is_not_a_state_is_refused() {
    let scene = scene(&[]);
    let mut simulation = Simulation::new(&scene).unwrap();
    (0..3).for_each(|_| simulation.advance_frame().unwrap());
    let bytes = simulation.snapshot(&scene).encode();
    let snapshot = Snapshot::decode(&bytes).unwrap();
    assert_eq!((snapshot.frame(), snapshot.encode() == bytes), (3, true));
    let mut second = Simulation::new(&scene).unwrap();
    second.restore(&scene, &snapshot).unwrap();
    assert_eq!(second.positions_at_frame_start(), simulation.positions_at_frame_start());
    assert_eq!((second.frame(), second.state_hash()), (3, simulation.state_hash()));
    for end in (0..bytes.len()).step_by(97).chain([bytes.len() - 1]) {
        assert_eq!(Snapshot::decode(&bytes[..end]).unwrap_err().kind, Kind::Io, "cut to {end} bytes");
    }
    for place in (0..bytes.len()).step_by(89) {
        let mut bytes = bytes.clone();
        bytes[place] ^= 1;
        assert_eq!(Snapshot::decode(&bytes).unwrap_err().kind, Kind::Io, "byte {place} changed");
    }
}

#[test]
fn a_state_of_another_scene_or_version_is_refused_with_what_differs() {
    let saved = scene(&[]);
    let snapshot = Simulation::new(&saved).unwrap().snapshot(&saved);
    let refusal = |sets: &[&str], snapshot: &Snapshot| {
        let scene = scene(&sets.iter().map(ToString::to_string).collect::<Vec<_>>());
        let refused =
            Simulation::new(&scene).unwrap().restore(&scene, snapshot).map_err(|e| (e.kind, e.message));
        refused.err().unzip().1.unwrap_or_default()
    };
    let message = "the state is of another scene: `cloth.ks` is 5000 in the state and 500 in the scene";
    assert_eq!(refusal(&["cloth.ks=500"], &snapshot), message);
    let message = refusal(&["sphere=[]", "sim.gravity=[0,1,0]"], &snapshot);
    assert!(
        message.contains(
            "`sim.gravity` is [0,-9.8,0] in the state and [0,1,0] in the scene; `sphere.0.origin` is"
        )
    );
    assert!(message.ends_with("and absent in the scene"), "{message}");
    assert!(refusal(&["cloth.num_width_points=9"], &snapshot).contains("`cloth.num_width_points` is 8"));
    assert_eq!(refusal(&["camera.polar=3", "cloth.material.shader=bump"], &snapshot), "");

    // The version stands in the line at the start, which the checksum covers.
    let mut bytes = snapshot.encode();
    let version = format!("\"version\":\"{}\"", drape::version::VERSION);
    let place = bytes.windows(version.len()).position(|part| part == version.as_bytes()).unwrap();
    bytes.splice(place..place + version.len(), *b"\"version\":\"0.0.7\"");
    let end = bytes.len() - 8;
    let mut hash = drape::math::StateHash::default();
    hash.write(&bytes[..end]);
    bytes.splice(end.., hash.finish().to_le_bytes());
    let old = Snapshot::decode(&bytes).unwrap();
    assert!(refusal(&[], &old).starts_with("the state was saved by version 0.0.7, and this is version"));
}
