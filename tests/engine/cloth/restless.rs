//! What `docs/restless.md` says of cloths without self-collision.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::fs;

use drape::scene::{Overrides, load};
use drape::simulation::Simulation;
use rayon::prelude::*;

/// The kinetic energy in J after 10 s at 30 frames a second, as the page writes it.
fn kinetic(change: &str) -> String {
    let path = crate::repository::path("scenes/pinned2.json");
    let sets = ["cloth.pinned=[[0,0],[0,49]]", "sim.fps=30", "sim.self_collision=\"off\"", change];
    let sets = sets.map(str::to_owned).to_vec();
    let scene = load(&path, &Overrides { sets, ..Overrides::default() }).unwrap().scene;
    let mut simulation = Simulation::new(&scene).unwrap();
    (0..300).for_each(|_| simulation.advance_frame().unwrap());
    format!("{:.2e}", simulation.energy().kinetic)
}

/// Both columns: with self-collision as in the page's first table, without as the simulation says.
#[test]
fn cloths_that_self_collision_keeps_moving_rest_without_it() {
    let page = fs::read_to_string(crate::repository::path("docs/restless.md")).unwrap();
    let (before, after) = page.split_once("| change | with self-collision |").unwrap();
    let rows: Vec<Vec<&str>> = after
        .lines()
        .filter(|line| line.starts_with("| cloth."))
        .map(|line| line.trim_matches(['|', ' ']).split(" | ").collect())
        .collect();
    let methods: Vec<&str> = before.lines().filter(|line| line.ends_with("| method |")).collect();
    assert_eq!(rows.len(), methods.len(), "every cloth of this verdict");
    for (row, method) in rows.iter().zip(methods) {
        let cells: Vec<&str> = method.split(" | ").collect();
        assert_eq!(row[..2], [cells[1], cells[4]], "as above");
    }
    let found: Vec<String> = rows.par_iter().map(|row| kinetic(row[0])).collect();
    assert_eq!(found, rows.iter().map(|row| row[2]).collect::<Vec<_>>());
}
