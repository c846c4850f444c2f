//! The table of `docs/contact.md`: what contact is off by, over the steps, against closed forms. Its plot has every
//! figure of the table.

use std::fs;

use drape::math::{atan2, cos};
use drape::scene::Scene;
use drape::simulation::Simulation;
use rayon::prelude::*;

use super::INTEGRATORS;

/// The steps per frame of the columns; the first ones run always.
const STEPS: [u32; 7] = [10, 30, 100, 300, 1000, 3000, 10000];
const ALWAYS: usize = 4;

/// The names that the page gives the integrators.
const NAMES: [&str; 6] = ["verlet", "verlet f32", "rk4", "xpbd", "implicit_euler", "bdf2"];

/// A case: its name, the changes of its scene, and the error of a run in metres.
struct Case {
    name: &'static str,
    sets: &'static [&'static str],
    error: fn(Simulation) -> f64,
}

const CASES: [Case; 5] = [
    Case {
        name: "slide",
        sets: &[r#"plane={"point":[0,1,0],"normal":[0,1,0],"friction":0.5}"#, "sim.gravity=[4.9,-8.487,0]"],
        error: |mut run| {
            let x = run.positions().x[0];
            advance(&mut run, 2.0, |_| ());
            (run.positions().x[0] - x - 0.5 * (4.9 - 0.5 * 8.487) * 4.0).abs()
        },
    },
    Case {
        name: "stick",
        sets: &[r#"plane={"point":[0,1,0],"normal":[0,1,0],"friction":0.6}"#, "sim.gravity=[4.9,-8.487,0]"],
        error: |mut run| {
            let (x, mut most) = (run.positions().x[0], 0.0_f64);
            advance(&mut run, 2.0, |run| most = most.max((run.positions().x[0] - x).abs()));
            most
        },
    },
    Case {
        name: "stop",
        sets: &[r#"plane={"point":[0,1,0],"normal":[0,1,0],"friction":0.4}"#, "cloth.velocity=[3,0,0]"],
        error: |mut run| {
            let x = run.positions().x[0];
            advance(&mut run, 2.0, |_| ());
            (run.positions().x[0] - x - 9.0 / (2.0 * 0.4 * 9.8)).abs()
        },
    },
    Case {
        name: "fall",
        sets: &[r#"plane={"point":[0,0,0],"normal":[0,1,0],"friction":0}"#],
        error: |mut run| {
            let mut highest = 0.0_f64;
            advance(&mut run, 1.0, |run| {
                if run.time() > 0.47 {
                    highest = highest.max(run.positions().y[0].abs());
                }
            });
            highest
        },
    },
    // Down is z: the cloth hangs from its first row, and is thrown at a wall 1 mm away.
    Case {
        name: "wall",
        sets: &[
            r#"plane={"point":[0,1.001,0],"normal":[0,-1,0],"friction":0}"#,
            "cloth.pinned=[[0,0],[1,0]]",
            "cloth.velocity=[0,0.01,0]",
            "cloth.density=0.01",
            "cloth.ks=500",
            "sim.gravity=[0,0,9.8]",
        ],
        error: |mut run| {
            advance(&mut run, 1.0, |_| ());
            let omega = 9.8_f64.sqrt();
            // When it hits: sin (ω t) = ω 1 mm / (0.01 m/s).
            let hit = atan2(0.1 * omega, (1.0 - 0.01 * 9.8_f64).sqrt()) / omega;
            (run.positions().y[2] - 1.0 - 1e-3 * cos(omega * (1.0 - hit))).abs()
        },
    },
];

fn advance(run: &mut Simulation, seconds: f64, mut look: impl FnMut(&Simulation)) {
    while run.time() < seconds - 1e-9 {
        run.advance_frame().unwrap();
        look(run);
    }
}

/// The scene of a case: 2 x 2 points without damping.
fn scene(case: &Case, integrator: &[&str], steps: u32) -> Scene {
    let steps = format!("sim.steps_per_frame={steps}");
    let size = ["cloth.num_width_points=2", "cloth.num_height_points=2", &steps];
    super::scene(&[&size[..], case.sets, integrator].concat())
}

/// The row of a case under an integrator, with the first `columns` columns.
fn row(case: &Case, name: &str, integrator: &[&str], columns: usize) -> String {
    let cells = STEPS[..columns].iter().map(|&steps| {
        let error = (case.error)(Simulation::new(&scene(case, integrator, steps)).unwrap());
        // Rounding of the positions in every step leaves up to 1e-7 m, which is no figure of the method.
        if error < 1e-7 { "< 1e-7".to_owned() } else { format!("{error:.1e}") }
    });
    format!("| {} | {name} | {}", case.name, cells.collect::<Vec<_>>().join(" | "))
}

fn compare(columns: usize) {
    let page = fs::read_to_string(crate::repository::path("docs/contact.md")).unwrap();
    let integrators = || NAMES.iter().zip(INTEGRATORS).filter(|(name, _)| **name != "verlet f32");
    let rows: Vec<_> = CASES.iter().flat_map(|case| integrators().map(move |of| (case, of))).collect();
    let row = |(case, (name, sets)): &(&Case, (&&str, &[&str]))| row(case, name, sets, columns);
    let found: Vec<String> = rows.par_iter().map(row).collect();
    let missing: Vec<&String> =
        found.iter().filter(|row| !page.lines().any(|line| line.starts_with(row.as_str()))).collect();
    assert!(missing.is_empty(), "not on the page:\n{}", found.join(" |\n"));
}

#[test]
fn the_table_is_what_the_simulation_gives() {
    compare(ALWAYS);
}

#[test]
#[ignore = "takes minutes"]
fn the_whole_table_is_what_the_simulation_gives() {
    compare(STEPS.len());
}

#[test]
fn the_plot_has_every_figure_of_the_table() {
    let page = fs::read_to_string(crate::repository::path("docs/contact.md")).unwrap();
    let plot = fs::read_to_string(crate::repository::path("docs/media/contact.svg")).unwrap();
    let mut figures = 0;
    for line in page.lines() {
        let cells: Vec<&str> = line.trim_matches(['|', ' ']).split(" | ").collect();
        if cells.len() == 2 + STEPS.len() && CASES.iter().any(|case| case.name == cells[0]) {
            for (steps, cell) in STEPS.iter().zip(&cells[2..]).filter(|(_, cell)| !cell.starts_with('<')) {
                let title = format!("<title>{} {} {steps}: {cell} m</title>", cells[0], cells[1]);
                assert!(plot.contains(&title), "{title}");
                figures += 1;
            }
        }
    }
    assert!(figures > 20, "{figures}");
}

/// The report's faults on 8 x 8 points without damping: how far a cloth slides on a level floor in 2 s.
fn slide(contact: &str, friction: f64, steps: u32) -> String {
    let floor = format!(r#"plane={{"point":[0,1,0],"normal":[0,1,0],"friction":{friction}}}"#);
    let contact = format!("sim.contact={contact}");
    let steps = format!("sim.steps_per_frame={steps}");
    let size = ["cloth.num_width_points=8", "cloth.num_height_points=8", "sim.start=half_step"];
    let scene =
        super::scene(&[&size[..], &["sim.gravity=[4.9,-8.487,0]", &floor, &contact, &steps]].concat());
    let mut run = Simulation::new(&scene).unwrap();
    run.allow_unstable();
    advance(&mut run, 2.0, |_| ());
    format!("{:.3} m", run.positions().x[0])
}

/// How high a cloth hops that falls 5 cm onto the stock plane, at 1000 steps a frame.
fn hop(contact: &str) -> String {
    let contact = format!("sim.contact={contact}");
    let floor = r#"plane={"point":[0,0,0],"normal":[0,1,0],"friction":0.5}"#;
    let sets = [floor, &contact, "cloth.offset=[0,-0.95,0]", "cloth.damping=0.2", "sim.steps_per_frame=1000"];
    let mut run = Simulation::new(&super::scene(&[&sets[..], INTEGRATORS[0]].concat())).unwrap();
    run.allow_unstable();
    let mut highest = 0.0_f64;
    advance(&mut run, 0.6, |run| {
        if run.time() > 0.2 {
            highest = highest.max(run.positions().y[0]);
        }
    });
    format!("{highest:.2} m")
}

/// How fast a cloth leaves the ball that it starts in.
fn leaves(contact: &str) -> String {
    let contact = format!("sim.contact={contact}");
    let ball = r#"sphere={"origin":[0.5,0.9,0.5],"radius":0.2,"friction":0.3}"#;
    let size = ["cloth.num_width_points=8", "cloth.num_height_points=8", "sim.gravity=[0,0,0]"];
    let mut run = Simulation::new(&super::scene(&[&size[..], &[ball, &contact]].concat())).unwrap();
    run.allow_unstable();
    let mut fastest = 0.0_f64;
    (0..90).for_each(|_| {
        run.step();
        fastest = fastest.max(run.extremes().speed);
    });
    format!("{fastest:.1} m/s")
}

#[test]
fn the_faults_that_it_cures_are_as_large_as_the_page_says() {
    let page = fs::read_to_string(crate::repository::path("docs/contact.md")).unwrap();
    let rows = [
        ("hops", hop("report"), hop("coulomb")),
        ("leaves", leaves("report"), leaves("coulomb")),
        ("smooth, 30", slide("report", 0.0, 30), slide("coulomb", 0.0, 30)),
        ("smooth, 120", slide("report", 0.0, 120), slide("coulomb", 0.0, 120)),
        ("rough, 30", slide("report", 0.5, 30), slide("coulomb", 0.5, 30)),
        ("rough, 120", slide("report", 0.5, 120), slide("coulomb", 0.5, 120)),
    ];
    let rows = rows.map(|(name, report, coulomb)| format!("({name}) | {report} | {coulomb} |"));
    assert!(rows.iter().all(|row| page.contains(row)), "not on the page:\n{}", rows.join("\n"));
}
