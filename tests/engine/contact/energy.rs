//! Contact takes energy and never adds any: no hops, no speed of what starts inside, no entry above 0.

use drape::error::Kind;
use drape::scene::{Overrides, Scene, load};
use drape::simulation::Simulation;

use super::{INTEGRATORS, after, scene, simulation};

/// A stock scene of 8 x 8 points with thickness 0, damping per second and `sets`.
fn stock(name: &str, sets: &[&str]) -> Scene {
    let path = crate::repository::path(&format!("scenes/{name}.json"));
    let size = ["cloth.num_width_points=8", "cloth.num_height_points=8", "cloth.thickness=0"];
    let sets = [&size[..], &["sim.damping=per_second"], sets].concat();
    let sets = sets.iter().map(ToString::to_string).collect();
    load(&path, &Overrides { sets, ..Overrides::default() }).unwrap().scene
}

/// The most that a total of the energies is above the least before it, and that an entry of contact rises in a frame,
/// in J.
fn most_gained(simulation: &mut Simulation, frames: u64) -> [f64; 2] {
    let (mut least, mut gained, mut entered) = (simulation.energy().total(), 0.0_f64, 0.0_f64);
    let entries = |simulation: &Simulation| {
        let ledger = simulation.ledger().unwrap();
        let colliders = ledger.colliders.entries().map(|(_, energy)| energy);
        colliders.chain([ledger.self_collision]).collect::<Vec<_>>()
    };
    let mut before = entries(simulation);
    for _ in 0..frames {
        simulation.advance_frame().unwrap();
        let now = entries(simulation);
        entered = now.iter().zip(&before).map(|(now, before)| now - before).fold(entered, f64::max);
        before = now;
        let total = simulation.energy().total();
        gained = gained.max(total - least);
        least = least.min(total);
    }
    let (ledger, end) = (simulation.ledger().unwrap(), simulation.energy().total());
    let start = Simulation::energy(simulation).total() - ledger.sum();
    assert!((end - ledger.sum() - start).abs() < 1e-9, "the ledger closes");
    [gained, entered]
}

#[test]
fn a_cloth_that_lands_never_hops() {
    for steps in ["30", "1000", "10000"] {
        let steps = format!("sim.steps_per_frame={steps}");
        for sets in INTEGRATORS {
            if steps != "sim.steps_per_frame=30" && sets.len() > 1 {
                continue;
            }
            // A fall of 1 cm takes four frames.
            let near = ["sim.contact=coulomb", "cloth.offset=[0,-0.99,0]", &steps];
            let mut simulation = simulation(&stock("plane", &[&near[..], sets].concat()));
            (0..5).for_each(|_| simulation.advance_frame().unwrap());
            let [gained, entered] = most_gained(&mut simulation, 5);
            assert!(entered < 1e-9 && gained < 1e-6 * 1470.0, "{steps}, {sets:?}: {gained:e}, {entered:e} J");
            let highest = simulation.positions().y.iter().copied().fold(0.0, f64::max);
            assert!(highest < 1e-6, "{steps}, {sets:?}: {highest} m above the plane");
        }
    }
}

/// What the report's contact adds ends in an error.
#[test]
fn contact_that_adds_energy_is_stopped_under_any_mode() {
    let hops = stock("plane", &["sim.steps_per_frame=10000", "sim.start=half_step", "sim.contact=outside"]);
    let inside = ["sphere.origin=[0.5,0.9,0.5]", "sim.gravity=[0,0,0]", "sim.steps_per_frame=120"];
    for scene in
        [hops, stock("sphere", &inside), stock("sphere", &[&inside[..], &["sim.contact=outside"]].concat())]
    {
        let mut simulation = Simulation::new(&scene).unwrap();
        let error = (0..90).find_map(|_| simulation.advance_frame().err()).expect("stopped");
        assert_eq!(error.kind, Kind::Unstable, "{error}");
    }
}

#[test]
fn what_starts_inside_leaves_without_speed() {
    let objects = [
        r#"sphere={"origin":[0.5,0.9,0.5],"radius":0.3,"friction":0.3}"#,
        r#"box={"origin":[0.5,0.9,0.5],"size":[0.9,0.3,0.9],"friction":0.3}"#,
        r#"plane={"point":[0.5,1.5,0.5],"normal":[0.3,1,0],"friction":0.3}"#,
    ];
    for object in objects {
        for sets in INTEGRATORS {
            let scene = scene(&[&[object, "sim.gravity=[0,0,0]"], sets].concat());
            let end = after(&scene, 0.2);
            // Rounding to binary32 moves the ends of the springs by up to 6e-8 m.
            let bound = if sets.contains(&"sim.precision=f32") { 1e-3 } else { 1e-9 };
            assert!(end.extremes().speed < bound, "{object}, {sets:?}: {} m/s", end.extremes().speed);
        }
    }
}

#[test]
fn what_is_put_outside_at_the_start_loses_the_velocity_of_the_cloth() {
    let thrown = |objects: &[&str]| {
        let sets = [objects, &["cloth.velocity=[0,0.5,0]", "sim.gravity=[0,0,0]"]].concat();
        Simulation::new(&scene(&sets)).unwrap()
    };
    let [free, ball] =
        [thrown(&[]), thrown(&[r#"sphere={"origin":[0.5,0.9,0.5],"radius":0.3,"friction":0.3}"#])];
    let (mut put, mut kept) = (0, 0);
    for p in 0..free.positions().len() {
        let is_put = ball.positions().get(p) != free.positions().get(p);
        let rests = ball.positions().get(p) == ball.last_positions().get(p);
        assert_eq!(is_put, rests, "point {p}");
        *if is_put { &mut put } else { &mut kept } += 1;
    }
    assert!(put > 0 && kept > 0, "{put} points were put outside, {kept} not");
}

/// A ball that pokes a sheet without gravity: no frame ends with more energy, and no entry of contact is above 0.
#[test]
fn a_cloth_that_hits_something_only_loses_energy() {
    let objects = [
        r#"sphere={"origin":[0.5,0.2,0.5],"radius":0.3,"friction":0.4}"#,
        r#"box={"origin":[0.4,0.2,0.45],"size":[0.5,0.3,0.5],"friction":0.4}"#,
        r#"plane={"point":[0.5,0.2,0.5],"normal":[0.3,1,0.2],"friction":0.4}"#,
    ];
    for object in objects {
        for sets in INTEGRATORS {
            let speed = ["cloth.velocity=[0.3,-2,0.1]", "sim.gravity=[0,0,0]", "cloth.damping=0.02"];
            let size = ["cloth.num_width_points=12", "cloth.num_height_points=12"];
            let mut simulation = simulation(&scene(&[&[object], &size[..], &speed, sets].concat()));
            let start = simulation.energy().total();
            let [gained, entered] = most_gained(&mut simulation, 90);
            assert!(
                entered <= 0.0 && gained < 2e-3 * start,
                "{object}, {sets:?}: {gained:e}, {entered:e} J of {start}"
            );
        }
    }
}
