//! Random valid scenes over the ranges of all keys, each held against the same scene with 8 times the steps: what the
//! program refuses, stops and lets end is what it should.

mod course;
mod draw;
mod verdict;

use std::collections::BTreeMap;

use drape::scene::{Integrator, Overrides, Precision, Scene, load_text};
use rayon::prelude::*;
use serde_json::Value;

use verdict::{Verdict, verdict};

/// How many scenes are drawn, from the seed 0 on.
const SEEDS: u64 = 2000;

/// The rows of the table of `docs/stability.md`.
const ROWS: [&str; 6] = ["`verlet`", "`verlet`, `f32`", "`rk4`", "`xpbd`", "`implicit_euler`", "`bdf2`"];

/// The row of a scene.
fn row(scene: &Scene) -> usize {
    match (scene.sim.integrator, scene.sim.precision) {
        (Integrator::Verlet, Precision::F64) => 0,
        (Integrator::Verlet, Precision::F32) => 1,
        (Integrator::Rk4, _) => 2,
        (Integrator::Xpbd, _) => 3,
        (Integrator::ImplicitEuler, _) => 4,
        (Integrator::Bdf2, _) => 5,
    }
}

/// The seeds by row and verdict. None may have a verdict that is wrong.
fn settled() -> BTreeMap<(usize, Verdict), Vec<u64>> {
    let settle = |seed| {
        let (scene, _, frames) = draw::scene(seed);
        ((row(&scene), verdict(&scene, frames)), seed)
    };
    let list: Vec<_> = (0..SEEDS).into_par_iter().map(settle).collect();
    let mut table = BTreeMap::<_, Vec<u64>>::new();
    list.into_iter().for_each(|(key, seed)| table.entry(key).or_default().push(seed));
    for ((row, verdict), seeds) in &table {
        assert!(!verdict.is_wrong(), "{}, {verdict:?}: seeds {seeds:?}", ROWS[*row]);
    }
    table
}

/// The numbers of the table of the page.
fn page() -> Vec<Vec<usize>> {
    let page = std::fs::read_to_string(crate::repository::path("docs/stability.md")).unwrap();
    let numbers = |name: &&str| {
        let line = page.lines().find_map(|line| line.strip_prefix(&format!("| {name} | "))).unwrap();
        line.trim_end_matches(" |").split(" | ").map(|cell| cell.parse().unwrap()).collect()
    };
    ROWS.iter().map(numbers).collect()
}

#[test]
fn every_random_scene_is_judged_as_the_page_says() {
    let table = settled();
    let counts = |row| Verdict::ALL.map(|verdict| table.get(&(row, verdict)).map_or(0, Vec::len)).to_vec();
    let counts: Vec<Vec<usize>> = (0..ROWS.len()).map(counts).collect();
    let rows = |counts: &[Vec<usize>]| {
        let cells = |row: &Vec<usize>| row.iter().map(|count| format!(" {count} |")).collect::<String>();
        ROWS.iter().zip(counts).map(|(name, row)| format!("| {name} |{}\n", cells(row))).collect::<String>()
    };
    assert_eq!(page(), counts, "docs/stability.md should have\n{}", rows(&counts));
}

/// Scenes that were once judged wrongly.
#[test]
fn what_was_judged_wrongly_is_not() {
    let list: Vec<Value> = serde_json::from_str(include_str!("mended.json")).unwrap();
    for case in list {
        let scene = load_text("mended", &case["scene"].to_string(), &Overrides::default()).unwrap().scene;
        let right: Verdict = serde_json::from_value(case["verdict"].clone()).unwrap();
        assert_eq!(verdict(&scene, case["frames"].as_u64().unwrap()), right, "{}", case["was"]);
    }
}
