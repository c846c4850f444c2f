//! A whole study of a small cloth: right, kept, and taken up again where it was stopped.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use drape::error::{Error, Kind, Result};
use drape::scene::{Integrator, Overrides, SelfCollision};
use drape::texture_source::TextureSource;
use drape_lab::accuracy::source::Source;
use drape_lab::page::live::Live;
use drape_lab::store::Store;
use drape_lab::study::extent::Extent;
use drape_lab::study::matrix::{Cell, panels};
use drape_lab::study::method::METHODS;
use drape_lab::study::runs::Outcome;
use drape_lab::study::{self, Cost, Results, Study};

const SCENE: &str = r#"{"cloth": {"width": 1, "height": 1, "num_width_points": 6,
    "num_height_points": 6, "thickness": 0.0095, "orientation": 0, "pinned": [[0, 0], [5, 0]],
    "damping": 0.2, "density": 150, "ks": 500000, "enable_structural": true,
    "enable_shearing": true, "enable_bending": true},
    "sphere": {"origin": [0.5, 0.2, 0.5], "radius": 0.2, "friction": 0.3},
    "render": {"size": [32, 20], "time": 0.1}}"#;

/// One stiffness, stable from 600 steps/s: one rate below, two above, and the scene's own 2700.
fn extent() -> Extent {
    Extent {
        tenths: vec![1, 2],
        densities: vec![1.0],
        rates: vec![0.5, 2.0, 8.0],
        repeats: 2,
        resolutions: vec![8],
        ..Extent::quick()
    }
}

fn source(folder: &Path) -> Source {
    let path = folder.join("scene.json");
    std::fs::write(&path, SCENE).unwrap();
    Source { path, overrides: Overrides::default() }
}

/// A study with the cells in `folder`, and how many runs were made and kept.
fn run(source: &Source, extent: &Extent, folder: &Path) -> (Study, [u64; 2]) {
    let store = Store::new(&folder.join("cells"), crate::write).unwrap();
    let told = AtomicU64::new(0);
    let watch = |steps: u32| {
        told.fetch_add(steps.into(), Ordering::Relaxed);
        Ok(())
    };
    let study = study::run(source, &TextureSource::BuiltIn, extent, &store, &watch).unwrap();
    // Also of what is kept, was given up, or is not needed: progress reaches the end. Beyond it are only
    // runs of the reference.
    let beyond = told.into_inner().checked_sub(study::steps(source, extent).unwrap());
    let smallest = u64::from(study.panels[0].panel.finest / 10 * extent.last());
    assert_eq!(beyond.map(|steps| steps % smallest), Some(0), "{beyond:?} of {smallest}");
    (study, store.counts())
}

/// Everything in the results but what the clock said.
fn without_times(study: &Study) -> serde_json::Value {
    let mut value = serde_json::to_value(Results::new(study, "scene.json", [0, 0])).unwrap();
    for panel in value["panels"].as_array_mut().unwrap() {
        for name in ["hull", "advice"] {
            panel[name].take();
        }
        for cell in panel["cells"].as_array_mut().unwrap() {
            cell["wall"].take();
            cell["walls"].take();
        }
    }
    for name in ["hull", "advice"] {
        value["pictures"][name].take();
    }
    for way in value["pictures"]["ways"].as_array_mut().unwrap() {
        way["ms"].take();
        way["times"].take();
    }
    value
}

#[test]
fn a_small_study_finds_the_order_of_every_method() {
    let folder = tempfile::tempdir().unwrap();
    let (study, _) = run(&source(folder.path()), &extent(), folder.path());
    let panel = &study.panels[0];
    let moment = panel.moment();
    let of = |method: &str| {
        let number = METHODS.iter().position(|m| m.name == method).unwrap();
        panel.cells.iter().filter(|cell| cell.method == number).collect::<Vec<_>>()
    };
    let error = |method: &str, i: usize| of(method)[i].errors[moment].rms;
    let half = of("Verlet, half-step start");
    assert_eq!(half.iter().map(|cell| cell.rate).collect::<Vec<_>>(), [360, 1260, 2700, 4860]);
    assert!(half.iter().zip(&half[1..]).all(|(a, b)| a.springs < b.springs));
    assert_ne!(half[0].outcome, Outcome::Ok, "half of the stable rate");
    assert!(half[1..].iter().all(|cell| cell.outcome == Outcome::Ok));
    // Second order, first order, and none.
    let slope = |method: &str| {
        let cells = of(method);
        drape::math::ln(error(method, 1) / error(method, 3))
            / drape::math::ln(f64::from(cells[3].rate) / f64::from(cells[1].rate))
    };
    assert!((slope("Verlet, half-step start") - 2.0).abs() < 0.1, "{}", slope("Verlet, half-step start"));
    assert!((slope("Verlet, report start") - 1.0).abs() < 0.1, "{}", slope("Verlet, report start"));
    // Damping per step is another cloth but at the rate that it is meant for.
    let per_step = [1, 2, 3].map(|i| error("Verlet, damping per step", i));
    assert!(per_step[0] > 5.0 * per_step[1] && per_step[2] > 5.0 * per_step[1], "{per_step:?}");
    // The reference is far better than what is held against it.
    let floor = &panel.reference.floor[moment];
    let smallest = error("Verlet, half-step start", 3);
    assert!(floor.rms <= 0.1 * smallest, "{floor:?} for {smallest:e}");
    assert!(panel.reference.rates[1] >= 4 * half[3].rate, "{:?}", panel.reference.rates);
    // On the front that is the same on every machine the fourth-order method is the most accurate, and no
    // implicit method is there.
    let front: Vec<String> = panel.front(Cost::Springs).into_iter().map(|i| panel.name(i)).collect();
    assert!(front.last().is_some_and(|name| name.starts_with("rk4 ")), "{front:?}");
    assert!(front.iter().any(|name| name.starts_with("Verlet, half-step start ")), "{front:?}");
    let is_implicit = |name: &String| name.starts_with("implicit") || name.starts_with("BDF2");
    assert!(!front.iter().any(is_implicit), "{front:?}");
    let pictures = study.pictures.as_ref().unwrap();
    let rmse: Vec<f64> = pictures.drawn.iter().map(|drawn| drawn.rmse).collect();
    assert_eq!(pictures.drawn.len(), 8, "samples in binary32 and in binary64");
    assert!(rmse[3] < rmse[1] && rmse[1] < rmse[0], "more samples come closer: {rmse:?}");
    assert!(rmse.iter().all(|error| *error > 0.0 && *error < 60.0), "{rmse:?}");
}

#[test]
fn finished_cells_are_not_run_again() {
    let folder = tempfile::tempdir().unwrap();
    let source = source(folder.path());
    let (first, [made, kept]) = run(&source, &extent(), folder.path());
    assert!(made > 40 && kept == 0, "{made} made, {kept} kept");
    let (again, counts) = run(&source, &extent(), folder.path());
    assert_eq!(counts, [0, made], "everything is kept");
    assert_eq!(without_times(&first), without_times(&again));
    assert_eq!(study::csv(&first), study::csv(&again), "times are kept too");
    // Another scene finds nothing; another matrix only what it shares.
    let stiffer = Source {
        overrides: Overrides { sets: vec!["cloth.ks=600000".to_owned()], ..Overrides::default() },
        ..source.clone()
    };
    let (_, [made_again, kept]) = run(&stiffer, &extent(), folder.path());
    assert!(made_again > 40 && kept == 0, "{made_again} made, {kept} kept");
    let wider = Extent { repeats: 3, ..extent() };
    let (_, [more, kept]) = run(&source, &wider, folder.path());
    assert!(more > 0 && more < made && kept == made, "{more} more, {kept} of {made} kept");
}

#[test]
fn a_study_that_was_stopped_goes_on_where_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let source = source(folder.path());
    let (whole, [made, _]) = run(&source, &extent(), &folder.path().join("whole"));
    let store = Store::new(&folder.path().join("cells"), crate::write).unwrap();
    let stop = |_: u32| -> Result<()> {
        let [made, _] = store.counts();
        if made < 20 { Ok(()) } else { Err(Error::new(Kind::Signal(2), "stopped")) }
    };
    let stopped = study::run(&source, &TextureSource::BuiltIn, &extent(), &store, &stop);
    assert_eq!(stopped.err().map(|e| e.kind), Some(Kind::Signal(2)));
    let [before, _] = store.counts();
    assert!(before == 20 && before < made, "{before} of {made}");
    let (rest, [after, kept]) = run(&source, &extent(), folder.path());
    assert_eq!((after, kept), (made - before, before));
    assert_eq!(without_times(&whole), without_times(&rest));
}

/// What several machines have run is found by the one that makes the page.
#[test]
fn the_parts_of_a_study_are_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let source = source(folder.path());
    let only = vec!["verlet".to_owned()];
    let extent = Extent { only, repeats: 1, ..extent() };
    let parts = [[1, 2], [0, 2]].map(|part| Extent { part: Some(part), ..extent.clone() });
    let (_, [first, _]) = run(&source, &parts[0], folder.path());
    let (_, [second, kept]) = run(&source, &parts[1], folder.path());
    assert!(first > 0 && second > 0 && kept > 0, "{first}, {second}: the reference is shared, {kept}");
    let (whole, counts) = run(&source, &extent, folder.path());
    assert_eq!(counts, [0, first + second], "nothing is run again");
    let (alone, _) = run(&source, &extent, &folder.path().join("alone"));
    let errors =
        |study: &Study| study.panels[0].cells.iter().map(|cell| cell.errors.clone()).collect::<Vec<_>>();
    assert!(!errors(&whole).is_empty() && errors(&whole) == errors(&alone));
}

/// A part of a study has the errors of the whole one, and asks for what there is.
#[test]
fn runs_can_be_picked_by_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let source = source(folder.path());
    let (whole, [all, _]) = run(&source, &extent(), folder.path());
    let only = vec!["BDF2 at 600 steps/s".to_owned(), "XPBD, 1 pass at 6".to_owned()];
    let (part, counts) = run(&source, &Extent { only, ..extent() }, folder.path());
    assert!(counts[0] == 0 && counts[1] < all / 4, "{counts:?} of {all}: everything is kept");
    let [whole, part_of] = [&whole.panels[0], &part.panels[0]];
    let names: Vec<String> = (0..part_of.cells.len()).map(|i| part_of.name(i)).collect();
    assert_eq!(names, ["XPBD, 1 pass at 60 steps/s", "XPBD, 1 pass at 600 steps/s", "BDF2 at 600 steps/s"]);
    assert_eq!(part_of.reference.rates, whole.reference.rates);
    for (i, cell) in part_of.cells.iter().enumerate() {
        let same = (0..whole.cells.len()).find(|&j| whole.name(j) == part_of.name(i)).unwrap();
        assert_eq!(cell.errors, whole.cells[same].errors);
    }
    assert!(
        part.pictures.is_none() && !study::page(&part, "scene.json", None).unwrap().contains("No pictures")
    );
    let page = study::page(&part, "scene.json", Some(&Live::at("live.html"))).unwrap();
    let link = "set=sim.integrator=bdf2&amp;set=sim.start=report&amp;set=sim.fps=10&amp;set=sim.steps_per_frame=60\">BDF2 at 600 steps/s</a>";
    assert!(
        page.contains("<a href=\"live.html#paused&amp;set=sim.integrator=verlet&amp;") && page.contains(link),
        "{page}"
    );
    assert!(page.contains("at 0.1, 0.2 s, without stretch limit and self-collision"), "{page}");
    assert!(page.contains("the scene's cloth: 150 kg/m², stable at worst from 600 steps/s"), "{page}");
}

#[test]
fn a_study_may_be_longer_and_keep_what_has_no_limit() {
    let moments = |extent: Extent, tenth: u32| extent.up_to(tenth).tenths;
    assert_eq!(moments(Extent::full(), 10), [2, 4, 10]);
    assert_eq!(moments(Extent::quick(), 1), [1]);
    let folder = tempfile::tempdir().unwrap();
    let source = source(folder.path());
    let only = vec!["Verlet, half-step start".to_owned()];
    let extent = Extent { only, kept: vec!["stretch_limit"], repeats: 1, ..extent() };
    let (study, _) = run(&source, &extent, folder.path());
    let sim = &study.panels[0].panel.cells[0].scene.sim;
    assert_eq!((sim.stretch_limit, sim.self_collision), (Some(0.1), SelfCollision::Off));
    let page = study::page(&study, "scene.json", None).unwrap();
    assert!(
        page.contains("the model keeps sim.stretch_limit") && page.contains("without self-collision"),
        "{page}"
    );
    let results = Results::new(&study, "scene.json", [0, 0]);
    assert!(results.text().starts_with("the model keeps sim.stretch_limit"), "{}", results.text());
    let json = serde_json::to_value(&results).unwrap();
    assert_eq!(json["without_limit"], serde_json::json!(["stretch_limit"]));
    assert!(!json["model"].to_string().contains("stretch_limit"), "{}", json["model"]);
}

/// By any part of a name, however it is written, and by the integrator as a scene has it.
#[test]
fn runs_are_asked_for_by_name_or_integrator() {
    let folder = tempfile::tempdir().unwrap();
    let source = source(folder.path());
    let extent = Extent { densities: vec![1.0, 1e-3], ..extent() };
    let asked = |only: &[&str]| {
        let only = only.iter().map(|&text| text.to_owned()).collect();
        panels(&source, &Extent { only, ..extent.clone() })
    };
    let cells =
        |only: &[&str]| asked(only).unwrap().into_iter().flat_map(|panel| panel.cells).collect::<Vec<_>>();
    let count = |is: &dyn Fn(&Cell) -> bool| cells(&[]).iter().filter(|cell| is(cell)).count();
    for integrator in [Integrator::Verlet, Integrator::Xpbd, Integrator::ImplicitEuler, Integrator::Bdf2] {
        let named = cells(&[integrator.name()]);
        assert!(named.iter().all(|cell| cell.scene.sim.integrator == integrator), "{}", integrator.name());
        assert_eq!(named.len(), count(&|cell| cell.scene.sim.integrator == integrator));
    }
    assert_eq!(cells(&["BDF2, LOOSE"]).len(), count(&|cell| METHODS[cell.method].name == "BDF2, loose"));
    assert_eq!(cells(&["bdf2", "xpbd", "bdf3"]).len(), cells(&["bdf2"]).len() + cells(&["xpbd"]).len());
    assert_eq!(asked(&["K/M 1.20E8"]).unwrap().len(), 1);
    let names: Vec<String> = asked(&[]).unwrap().iter().map(|panel| panel.cloth()).collect();
    assert_eq!(names, ["the scene's cloth", "1/1000 of the scene's density"]);
    let refused = asked(&["bdf3"]).unwrap_err();
    assert_eq!(refused.kind, Kind::Usage);
    let known = METHODS.iter().map(|method| method.name).chain(["k/m 1.20e5", "k/m 1.20e8"]);
    known.for_each(|name| assert!(refused.help.contains(name), "{name}: {}", refused.help));
}

#[test]
fn a_scene_without_a_cloth_is_nothing_to_study() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("empty.json");
    std::fs::write(&path, "{}").unwrap();
    let source = Source { path, overrides: Overrides::default() };
    assert_eq!(study::steps(&source, &extent()).map_err(|e| e.kind), Err(Kind::Nothing));
}
