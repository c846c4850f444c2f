//! The stability map against closed forms: what is tried is what theory says.

#![expect(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

use drape::error::Result;
use drape::scene::{Overrides, Scene, load};
use drape_lab::page::live::Live;
use drape_lab::stability_map::extremes::{self, Promise};
use drape_lab::stability_map::outcome::{Outcome, Run, run};
use drape_lab::stability_map::{Axes, Cell, Column, Map, page, threshold};
use drape_lab::store::Store;
use rayon::prelude::*;

fn stock(name: &str, sets: &[&str]) -> Result<Scene> {
    let path = crate::repository::path("scenes").join(name);
    let sets = sets.iter().map(|&set| set.to_owned()).collect();
    load(&path, &Overrides { sets, ..Overrides::default() }).map(|loaded| loaded.scene)
}

/// A cloth of 12 x 12 points with pinned corners.
fn small(sets: &[&str]) -> Scene {
    let small = ["cloth.num_width_points=12", "cloth.num_height_points=12", "cloth.pinned=[[0,0],[11,0]]"];
    stock("pinned2.json", &[&small, sets].concat()).unwrap()
}

/// `ω² = 8 ks / m`, stable below `dt ω = sqrt(4 - 2 d)`: the stock cloth's closed form.
#[test]
fn the_threshold_at_rest_is_the_closed_form() {
    for (ks, density, damping) in
        [(5000.0, 150.0, 0.2), (500.0, 1.5, 0.0), (5e5, 1500.0, 5.0), (5000.0, 150.0, 100.0)]
    {
        let sets = [
            format!("cloth.ks={ks}"),
            format!("cloth.density={density}"),
            format!("cloth.damping={damping}"),
        ];
        let scene = stock("pinned2.json", &sets.each_ref().map(String::as_str)).unwrap();
        let tried = threshold::at_rest(&scene, scene.cloth.as_ref().unwrap()).unwrap().unwrap();
        let omega = (8.0 * ks * 2500.0_f64 / density).sqrt();
        let closed_form = omega / (4.0 - 2.0 * damping / 100.0_f64).sqrt();
        assert!((tried / closed_form - 1.0).abs() < 0.003, "{tried} instead of {closed_form} for ks {ks}");
    }
}

/// With damping per second the limit is 2 whatever the damping.
#[test]
fn damping_per_second_does_not_move_the_threshold() {
    for damping in [0.0, 5.0] {
        let scene = small(&["sim.damping=\"per_second\"", &format!("cloth.damping={damping}")]);
        let tried = threshold::at_rest(&scene, scene.cloth.as_ref().unwrap()).unwrap().unwrap();
        let theory =
            drape::diagnostics::stability::Stability::new(scene.cloth.as_ref().unwrap(), &scene.sim).unwrap();
        assert!((tried / (theory.omega_rest / 2.0) - 1.0).abs() < 0.003, "{tried}");
    }
}

#[test]
fn a_cloth_without_stiffness_has_no_threshold() {
    let scene = small(&["cloth.ks=0"]);
    assert_eq!(threshold::at_rest(&scene, scene.cloth.as_ref().unwrap()).unwrap(), None);
}

/// Up to the bound at worst the springs of a cloth so heavy put in more than it is allowed: there is the
/// edge, and not at an end of an interval across it.
#[test]
fn a_threshold_in_motion_is_not_above_the_one_at_worst() {
    let scene = small(&["cloth.ks=50"]);
    let cloth = scene.cloth.as_ref().unwrap();
    let theory = drape::diagnostics::stability::Stability::new(cloth, &scene.sim).unwrap();
    let worst = theory.omega_safe / theory.limit_worst;
    let tried = threshold::in_motion(&scene, cloth, 0.5).unwrap().unwrap();
    assert!((tried / worst - 1.0).abs() < 1e-9, "{tried} instead of {worst}");
}

#[test]
fn cells_break_below_the_bound_at_rest_and_hold_above_the_one_at_worst() {
    let scene = small(&[]);
    let cloth = scene.cloth.clone().unwrap();
    let axes = Axes {
        ks: vec![500.0, 5e5],
        density: vec![1.5, 150.0],
        steps: (1..=40).step_by(3).collect(),
        time: 0.5,
    };
    let folder = tempfile::tempdir().unwrap();
    let store = Store::new(folder.path(), crate::write).unwrap();
    // Two parts make the whole.
    for part in [1, 0] {
        Map::share(&scene, &cloth, &axes, &store, &|number| number % 2 == part, &|| Ok(())).unwrap();
    }
    let [made, _] = store.counts();
    let map = Map::new(&scene, &cloth, axes, &store, &|| Ok(())).unwrap();
    assert_eq!(store.counts(), [made, made], "nothing is run again");
    assert_eq!((map.cells.len(), map.columns.len()), (4 * 14, 4));
    let mut seen = [0; 2];
    for column in &map.columns {
        let [rest, worst, gershgorin] = column.theory;
        assert!(rest < worst && worst < gershgorin, "{column:?}");
        let in_motion = column.in_motion.unwrap();
        assert!(0.5 * rest < in_motion && in_motion <= (1.0 + 1e-9) * worst, "{column:?}");
        for cell in map.panel(column.density).filter(|cell| cell.ks == column.ks) {
            let steps = f64::from(cell.steps) * map.fps;
            if steps < 0.8 * rest {
                assert!(cell.run.outcome > Outcome::Ok, "{cell:?} against {column:?}");
                seen[0] += 1;
            }
            if steps > worst {
                assert!(!cell.run.outcome.is_unstable(), "{cell:?} against {column:?}");
                seen[1] += 1;
            }
        }
    }
    assert!(seen[0] > 10 && seen[1] > 10, "{seen:?}");
}

/// Maps of one value an axis, as a page: nothing was run.
#[test]
fn a_page_explains_itself_once_and_shows_single_values() {
    let run = Run { outcome: Outcome::Stretch, frames: 1, stretch: 1.5 };
    let linked = |ks: &[f64], steps: &[u32], live: Option<&Live>| {
        let axes = Axes { ks: ks.to_vec(), density: vec![1.5, 150.0], steps: steps.to_vec(), time: 0.1 };
        let materials = [1.5, 150.0].into_iter().flat_map(|density| ks.iter().map(move |&ks| (density, ks)));
        let column = |(density, ks)| {
            let theory = [408.2, 500.3, 605.8];
            Column { density, ks, theory, at_rest: Some(408.5), in_motion: None }
        };
        let columns = materials.clone().map(column).collect();
        let cell = |(density, ks)| steps.iter().map(move |&steps| Cell { density, ks, steps, run });
        let cells = materials.flat_map(cell).collect();
        page::page("a map", &Map { axes, fps: 90.0, cells, columns }, &[], live)
    };
    let page = |ks: &[f64], steps: &[u32]| linked(ks, steps, None);
    let text = page(&[5000.0], &[3]);
    for once in Outcome::ALL.map(Outcome::name).into_iter().chain(["at rest", "at worst", "Gershgorin"]) {
        assert_eq!(text.matches(&format!("<strong>{once}</strong>: ")).count(), 1, "{once}");
    }
    assert_eq!(text.matches(">5000</text>").count(), 2, "the one ks of each map: {text}");
    assert_eq!(text.matches(">3</text>").count(), 2, "the one step of each map: {text}");
    assert_eq!(text.matches("<polyline").count(), 2 * 3);
    for line in text.split("<polyline").skip(1) {
        let points = line.split("points=\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap();
        let across: Vec<&str> = points.split([' ', ',']).step_by(2).collect();
        assert_eq!(across, ["173.33", "284.67"], "a stroke across the middle third: {line}");
    }
    assert_eq!(page(&[500.0, 1000.0], &[6, 9]).matches(">10</text>").count(), 2, "a tick on a short axis");
    // A row links to its cloth with the fewest steps that are stable at rest.
    let linked = linked(&[5000.0], &[3], Some(&Live::at("live.html")));
    let link = "<a href=\"live.html#paused&amp;set=cloth.density=1.5&amp;set=cloth.ks=5000&amp;\
        set=sim.steps_per_frame=5\">1.5</a>";
    assert!(linked.contains(link) && !text.contains("live.html"), "{linked}");
    assert!(text.contains("<td>408.2 (5)</td>") && text.contains("<td>500.3 (6)</td>"), "{text}");
}

#[test]
fn a_run_tells_what_broke() {
    let outcome = |sets: &[&str]| run(&small(sets), 30).unwrap().outcome;
    assert_eq!(outcome(&[]), Outcome::Ok);
    assert_eq!(outcome(&["sim.stretch_limit=1e-6"]), Outcome::Stretch);
    assert_eq!(outcome(&["sim.stretch_limit=null", "cloth.density=1e-9"]), Outcome::Lost);
    assert_eq!(outcome(&["cloth.density=0.5", "sim.steps_per_frame=15"]), Outcome::Energy);
}

#[test]
fn every_extreme_keeps_its_promise_in_every_stock_scene() {
    ["pinned2", "pinned4", "plane", "sphere", "selfCollision"].par_iter().for_each(|scene| {
        let mut tried = 0;
        let rows = extremes::table(&|sets| stock(&format!("{scene}.json"), sets), &mut || {
            tried += 1;
            Ok(())
        });
        let rows = rows.unwrap();
        assert_eq!((rows.len(), tried), (extremes::len(), extremes::len()));
        for row in &rows {
            assert!(row.kept, "{scene}, {}: promised {:?}: {}", row.what, row.promise, row.happened);
        }
        assert!(rows.iter().any(|row| row.promise == Promise::Runs));
    });
}
