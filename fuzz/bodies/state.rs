//! Saved states: the bytes as they are, and with a checksum that fits, so that it does not keep everything out.

use drape::error::Kind;
use drape::math::StateHash;
use drape::scene::{Overrides, Scene, load_text};
use drape::simulation::Simulation;
use drape::simulation::snapshot::Snapshot;
use drape::version::VERSION;

/// Nine points that can meet everything.
const SCENE: &str = r#"{"cloth": {"width": 1, "height": 1, "num_width_points": 3, "num_height_points": 3,
    "thickness": 0.1, "orientation": 0, "pinned": [[0, 0]], "damping": 0.2, "density": 150, "ks": 500,
    "enable_structural": true, "enable_shearing": true, "enable_bending": true},
    "sphere": {"origin": [0.5, 0.8, 0.5], "radius": 0.19, "friction": 0.3},
    "box": {"origin": [0, 0.9, 0], "size": [0.2, 0.1, 0.3], "friction": 0.2},
    "plane": {"point": [0, 0.97, 0], "normal": [0.1, 1, 0], "friction": 0.4},
    "sim": {"fps": 60, "steps_per_frame": 2}}"#;

/// Most bytes that reading an input may hold at once; it has some kilobytes.
const MOST_BYTES: u64 = 8 << 20;

/// Ways to move it. The first byte of an input chooses one.
const WAYS: [&[&str]; 8] = [
    &[],
    &["sim.self_collision=neighbors", "sim.contact=outside"],
    &["sim.contact=coulomb", "sim.self_collision=neighbors"],
    &["sim.precision=f32", "sim.contact=coulomb"],
    &["sim.integrator=rk4"],
    &["sim.integrator=xpbd", "sim.iterations=3"],
    &["sim.integrator=implicit_euler"],
    &["sim.integrator=bdf2"],
];

/// Reads a state, and goes on from it.
pub(crate) fn run(bytes: &[u8]) {
    let [way, state @ ..] = bytes else { return };
    let state = &of_this_version(state);
    let scene = scene(usize::from(*way) % WAYS.len());
    goes_on(&scene, state);
    goes_on(&scene, &with_checksum(state));
}

/// The scene moved in one of the ways.
pub(crate) fn scene(way: usize) -> Scene {
    let sets = WAYS[way].iter().map(ToString::to_string).collect();
    load_text("scene.json", SCENE, &Overrides { sets, ..Overrides::default() }).expect("a scene").scene
}

/// The state with the version of this program in place of the bare release: the inputs stay good when results change.
fn of_this_version(state: &[u8]) -> Vec<u8> {
    const RELEASE: &[u8] = b"\"version\":\"0.1.0\"";
    let Some(place) = state.windows(RELEASE.len()).position(|part| part == RELEASE) else {
        return state.to_vec();
    };
    let version = format!("\"version\":\"{VERSION}\"");
    [&state[..place], version.as_bytes(), &state[place + RELEASE.len()..]].concat()
}

fn with_checksum(content: &[u8]) -> Vec<u8> {
    let mut hash = StateHash::default();
    hash.write(content);
    [content, &hash.finish().to_le_bytes()].concat()
}

/// A state is refused, or it is written as it was read and the simulation goes on from it.
fn goes_on(scene: &Scene, bytes: &[u8]) {
    let mut decoded = None;
    let memory = allocation_counter::measure(|| decoded = Some(Snapshot::decode(bytes)));
    assert!(memory.bytes_max <= MOST_BYTES, "{memory:?}");
    let snapshot = match decoded.expect("it was decoded") {
        Ok(snapshot) => snapshot,
        Err(error) => return assert_eq!(error.kind, Kind::Io, "{error:?}"),
    };
    let written = snapshot.encode();
    let again = Snapshot::decode(&written).expect("what we write can be read");
    assert_eq!((again.frame(), again.encode()), (snapshot.frame(), written));

    let mut simulation = Simulation::new(scene).expect("the scene is stable");
    simulation.record_ledger().expect("a ledger");
    if let Err(error) = simulation.restore(scene, &snapshot) {
        return assert_eq!(error.kind, Kind::Scene, "{error:?}");
    }
    assert_eq!(simulation.frame(), snapshot.frame());
    if let Err(error) = simulation.advance_frame() {
        return assert_eq!(error.kind, Kind::Unstable, "{error:?}");
    }
    let positions = simulation.positions();
    assert!((0..positions.len()).all(|p| positions.get(p).iter().all(|c| c.is_finite())));
    Snapshot::decode(&simulation.snapshot(scene).encode()).expect("what we write can be read");
}
