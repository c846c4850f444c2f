//! What the program says of contact: geometry that cannot hold, points that start inside, rest, and a stretch limit that
//! did not hold.

use super::scratch::{Run, Scratch, scene};

/// `simulate` of a stock scene with `sets`.
fn simulate(scratch: &Scratch, name: &str, sets: &[&str], options: &[&str]) -> Run {
    let path = scene(name);
    let mut arguments = vec!["simulate", &path];
    sets.iter().for_each(|set| arguments.extend(["--set", set]));
    arguments.extend(options);
    scratch.run(&arguments)
}

/// The warnings of `check` for a stock scene with `sets`, each with its code, key, message and help.
fn warnings(scratch: &Scratch, name: &str, sets: &[&str]) -> Vec<[String; 4]> {
    let path = scene(name);
    let mut arguments = vec!["check", "--json", &path];
    sets.iter().for_each(|set| arguments.extend(["--set", set]));
    let found = scratch.json(&arguments);
    let all = found["files"][0]["warnings"].as_array().unwrap();
    let text = |warning: &serde_json::Value, key: &str| warning[key].as_str().unwrap().to_owned();
    all.iter().map(|warning| ["code", "key", "message", "help"].map(|key| text(warning, key))).collect()
}

/// A scene, the changes that make it wrong, the code and key of its warning, a part of the message, and the changes that
/// its help asks for.
type Wrong = (&'static str, &'static [&'static str], [&'static str; 3], &'static [&'static str]);

const COARSE: [&str; 3] =
    ["cloth.num_width_points=20", "cloth.num_height_points=20", "cloth.pinned=[[0,0],[19,0]]"];

const WRONG: &[Wrong] = &[
    (
        "pinned2.json",
        &COARSE,
        ["geometry::thin", "cloth.thickness", "2 x thickness is 0.019 m"],
        &["cloth.thickness=0.0187"],
    ),
    (
        "pinned2.json",
        &COARSE,
        ["geometry::thin", "cloth.thickness", "0.0372 m from"],
        &["cloth.num_width_points=39", "cloth.num_height_points=39"],
    ),
    (
        "sphere.json",
        &["sphere.radius=0.012"],
        ["geometry::fits_between", "sphere", "a radius of 0.012 m"],
        &["sphere.radius=0.0145"],
    ),
    (
        "pinned2.json",
        &[
            r#"box=[{"origin":[0.5,0.5,0.5],"size":[9,1,9],"friction":0},{"origin":[0.5,0.5,0.5],"size":[0.01,1,0.015],"friction":0}]"#,
        ],
        ["geometry::fits_between", "box.1", "edges of only 0.01 m and 0.015 m"],
        &["box.1.size.0=0.0205"],
    ),
    (
        "sphere.json",
        &["sphere.origin=[0.5,0.9,0.5]"],
        ["geometry::starts_inside", "sphere", "points of the cloth start inside"],
        &["cloth.offset.1=0.101"],
    ),
    (
        "pinned2.json",
        &[r#"box={"origin":[0.5,0.9,0.5],"size":[0.5,0.5,0.5],"friction":0}"#],
        ["geometry::starts_inside", "box", "speed that nothing gave them"],
        &["cloth.offset.1=0.151"],
    ),
    (
        "plane.json",
        &["plane.point=[0,1.25,0]"],
        ["geometry::under_plane", "plane", "starts under `plane`"],
        &["cloth.offset=[0,0.251,0]"],
    ),
    (
        "selfCollision.json",
        &["plane.point=[0,0.5,0]"],
        ["geometry::under_plane", "plane", "starts across `plane`: 1250 of 2500"],
        &["cloth.offset=[0,0.501,0]"],
    ),
    (
        "pinned2.json",
        &["cloth.thickness=0.02"],
        ["scene::thickness", "cloth.thickness", "2 x thickness is 0.04 m"],
        &["cloth.thickness=0.0102"],
    ),
];

/// Each case is told by `check` and `info`, and what the help asks for makes it go.
#[test]
fn geometry_that_cannot_hold_is_told_with_what_would_do() {
    let scratch = Scratch::new();
    for (name, sets, [code, key, part], cure) in WRONG {
        let found = warnings(&scratch, name, sets);
        let [warning] = &found[..] else { panic!("{name}, {sets:?}: {found:?}") };
        assert_eq!([&warning[0], &warning[1]], [code, key], "{name}, {sets:?}");
        assert!(warning[2].contains(part), "{part}: {}", warning[2]);
        let cured = [sets, *cure].concat();
        assert_eq!(warnings(&scratch, name, &cured), Vec::<[String; 4]>::new(), "{cured:?}");
        let path = scene(name);
        let mut info = vec!["info", &path];
        sets.iter().for_each(|set| info.extend(["--set", set]));
        assert!(scratch.run(&info).stderr.contains(part), "info {name}, {sets:?}: {part}");
    }
}

/// Under `coulomb` a run says what it did with points that start inside.
#[test]
fn points_that_start_inside_are_put_on_the_surface_with_a_warning() {
    let scratch = Scratch::new();
    let sets = ["sphere.origin=[0.5,0.9,0.5]", "sim.contact=coulomb", "sim.gravity=[0,0,0]"];
    let run = simulate(&scratch, "sphere.json", &sets, &["--frames", "3", "--csv", "table.csv"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(
        run.stderr.contains("start inside `sphere`: they are put on its surface, at rest"),
        "{}",
        run.stderr
    );
    let table = String::from_utf8(scratch.read("table.csv")).unwrap();
    let speed: f64 = table.lines().last().unwrap().rsplit(',').next().unwrap().parse().unwrap();
    assert!(speed < 1e-9, "{speed} m/s");
}

/// The three cases in which two frames that are alike are no rest, and one that is.
#[test]
fn rest_is_quiet_for_a_while_and_not_held_by_drag() {
    let scratch = Scratch::new();
    let small = ["cloth.num_width_points=12", "cloth.num_height_points=12", "cloth.thickness=0"];
    let rest = |sets: &[&str], time: &str| {
        let sets = [&small[..], sets].concat();
        simulate(&scratch, "plane.json", &sets, &["--until-rest", "--json", "--time", time])
    };
    let falls = rest(&["sim.gravity=[0,-0.5,0]", "cloth.damping=20"], "2");
    assert_eq!(falls.code, Some(1), "it falls at its terminal speed: {}", falls.stderr);
    assert!(falls.stderr.contains("stay below their limits for 0.5 s"), "{}", falls.stderr);
    let jitters = rest(&[], "10");
    assert_eq!(jitters.code, Some(1), "on the report's plane it jitters: {}", jitters.stderr);
    let lies = rest(&["sim.contact=coulomb"], "10");
    assert_eq!(lies.code, Some(0), "{}", lies.stderr);
    let found = lies.object();
    assert!(
        found["energy"]["kinetic"].as_f64().unwrap() < 1e-12 && found["time"].as_f64().unwrap() < 5.0,
        "{found}"
    );
    assert_eq!(found["rest"]["quiet"], 0.5);
    assert!(found["rest"]["motion"]["speed"].as_f64() < found["rest"]["limit"]["speed"].as_f64(), "{found}");
}

/// A limit of 10 % that ends beyond it, and a cloth that hangs in the limit.
#[test]
fn the_summary_says_what_the_stretch_limit_left() {
    let scratch = Scratch::new();
    let summary = |sets: &[&str]| {
        let run = simulate(&scratch, "pinned2.json", &[&COARSE, sets].concat(), &["--time", "1"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        String::from_utf8(run.stdout).unwrap()
    };
    let soft = summary(&["cloth.ks=50"]);
    assert!(soft.contains("the limit of 10.0 % did not hold"), "{soft}");
    assert!(soft.contains("the sag is the limit's, not ks's"), "{soft}");
    let stiff = summary(&["cloth.density=1"]);
    assert!(!stiff.contains("stretch  "), "{stiff}");
    assert!(!summary(&["sim.stretch_limit=null"]).contains("stretch  "), "no limit");
}
