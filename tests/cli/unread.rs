//! Keys that `--set` names although the command does not read them, and options that leave nothing to do, are named; an
//! address that cannot be followed is refused.

use std::fs;

use crate::scratch::{Scratch, scene};

const TIME: &str = "`--set render.time` has no effect";
const COLOR: &str = "`--set material.color` has no effect";

/// The warnings of a command that ends well.
fn said(scratch: &Scratch, line: &str, more: &[&str]) -> String {
    let words: Vec<&str> = line.split(' ').chain(more.iter().copied()).collect();
    let run = scratch.run(&words);
    assert_eq!(run.code, Some(0), "{words:?}: {}", run.stderr);
    run.stderr
}

#[test]
fn a_moment_that_an_option_says_too_is_named() {
    let scratch = Scratch::new();
    for line in [
        "render small.json a.png --size 20x16 --frame 1",
        "render small.json a.png --size 20x16 --time 0.01",
        "animate small.json a.gif --size 20x16 --frames 0..2",
        "animate small.json a.gif --size 20x16 --time 0.02",
        "export small.json a.obj --frame 1",
        "export small.json a.glb --frames 0..2",
        "simulate small.json --frames 1",
        "simulate small.json --time 0.01",
        "choose small.json --within 1mm --frame 1",
        "horizon small.json --frame 1",
        "stability small.json map --quick --ks 5000 --density 150 --steps 30 --part 1/9",
    ] {
        assert!(said(&scratch, line, &["--set", "render.time=0.1"]).contains(TIME), "{line}");
        assert!(!said(&scratch, line, &["--set", "sim.fps=80"]).contains("effect"), "{line}");
    }
    for line in ["render small.json a.png --size 20x16", "simulate small.json"] {
        assert!(!said(&scratch, line, &["--set", "render.time=0.01"]).contains("effect"), "{line}");
    }
}

#[test]
fn a_key_that_only_a_picture_shows_is_named_where_nothing_is_drawn() {
    let scratch = Scratch::new();
    for line in [
        "simulate small.json --frames 1 --positions p.bin",
        "choose small.json --within 1mm --frame 1",
        "horizon small.json --frame 1",
        "compare-positions small.json p.bin --frame 1",
        "export small.json a.obj --frame 1",
        "stability small.json map --quick --ks 5000 --density 150 --steps 30 --part 1/9",
    ] {
        assert!(said(&scratch, line, &["--set", "material.color=[1,0,0]"]).contains(COLOR), "{line}");
        assert!(
            said(&scratch, line, &["--set", "camera.polar=30"]).contains("`--set camera.polar` has"),
            "{line}"
        );
        assert!(!said(&scratch, line, &["--set", "sphere.0.friction=0.5"]).contains("effect"), "{line}");
    }
    for line in ["render small.json a.png --size 20x16 --frame 1", "export small.json a.glb --frame 1"] {
        assert!(!said(&scratch, line, &["--set", "material.color=[1,0,0]"]).contains("effect"), "{line}");
    }
    let pixels = "choose small.json --within 0.5px --frame 1";
    assert!(!said(&scratch, pixels, &["--set", "camera.polar=30"]).contains("effect"));
}

#[test]
fn options_that_leave_nothing_to_do_are_named() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("t")).unwrap();
    said(&scratch, "simulate small.json --frames 1 --positions p.bin", &[]);
    said(&scratch, "render small.json drawn.png --size 20x16 --frame 1", &[]);
    let map = "stability small.json map --ks 5000 --density 150 --steps 30 --time 0.01 --part 1/9";
    for (line, option) in [
        ("render small.json --frame 1 --size 20x16 --hash --provenance hashes", "--provenance"),
        ("render small.json --frame 1 --size 20x16 --bench 1 --provenance hashes", "--provenance"),
        ("simulate small.json --frames 1 --positions q.bin --every 2", "--every"),
        ("simulate small.json --frames 1 --csv - --ledger", "--ledger"),
        ("export small.json a.obj --frame 1 --set sphere=null --objects", "--objects"),
        ("compare-positions p.bin p.bin --no-diagnosis", "--no-diagnosis"),
        ("compare-positions p.bin p.bin --set cloth.ks=1", "--set or --patch"),
        ("verify drawn.png --textures t", "--textures"),
        ("choose small.json --within 0.5px --frame 1 --max", "--max"),
        (&format!("{map} --quick"), "--quick"),
        (&format!("{map} --live live.html"), "--live"),
        (&format!("{map} --set cloth.ks=9"), "`--set cloth.ks`"),
        ("study small.json s --quick --part 1/900 --live live.html", "--live"),
        ("study small.json s --quick --part 1/900 --set sim.integrator=rk4", "`--set sim.integrator`"),
        ("study small.json s --quick --part 1/900 --set sim.stretch_limit=1", "`--set sim.stretch_limit`"),
        ("gallery g --only part5-mball --part 1/2 --size 20x16", "--size"),
    ] {
        let said = said(&scratch, line, &[]);
        assert!(said.contains(&format!("{option} has no effect")), "{line}: {said}");
    }
    for line in [
        "simulate small.json --frames 1 --positions q%d.bin --every 2",
        "simulate small.json --frames 1 --ledger",
        "export small.json a.obj --frame 1 --objects",
        "choose small.json --within 1mm --frame 1 --max",
        "study small.json s --quick --part 1/900 --set sim.stretch_limit=1 --keep stretch_limit",
    ] {
        let said = said(&scratch, line, &[]);
        assert!(!said.contains("effect"), "{line}: {said}");
    }
}

#[test]
fn check_names_a_folder_of_textures_that_no_shader_reads() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("t")).unwrap();
    fs::copy(crate::repository::path("textures/texture_1.png"), scratch.path("t/texture_1.png")).unwrap();
    let found = |more: &[&str]| {
        let all = [&["check", "small.json", "--textures", "t", "--json"], more].concat();
        scratch.json(&all)["files"][0]["warnings"].to_string()
    };
    assert!(found(&[]).contains("--textures has no effect"));
    assert!(!found(&["--set", "material.shader=texture"]).contains("effect"));
    // Another shader would read it from there.
    assert!(!found(&["--set", "material.texture=own"]).contains("--textures has"));
    assert!(!scratch.json(&["check", "small.json", "--json"]).to_string().contains("effect"));
}

#[test]
fn keys_of_a_sweep_that_change_nothing_are_named() {
    let scratch = Scratch::new();
    let plan = |set: &str, more: &str| {
        let text = format!(r#"{{"scene": "small.json", "set": {{{set}}}, "measure": ["hash"]{more}}}"#);
        fs::write(scratch.path("spec.json"), text).unwrap();
        said(&scratch, "sweep plan spec.json out", &[])
    };
    let (frames, drawn) =
        (r#", "frames": 1"#, r#", "frames": 1, "render": {"material": {}, "size": [20, 16]}"#);
    for (set, more, named) in [
        (r#""sim.iterations": [1, 2, 3]"#, frames, "`sim.iterations` has no effect"),
        (r#""sim.iterations": [1, 2], "sim.integrator": ["verlet", "xpbd"]"#, frames, ""),
        (r#""material.color": [[1, 0, 0], [0, 1, 0]]"#, frames, "`material.color` has no effect"),
        (r#""material.color": [[1, 0, 0], [0, 1, 0]]"#, drawn, ""),
        (r#""render.time": [1, 2]"#, frames, "`render.time` has no effect"),
        (r#""render.time": [0.01, 0.02]"#, "", ""),
        (r#""cloth.ks": [100, 200]"#, frames, ""),
    ] {
        let said = plan(set, more);
        let right = if named.is_empty() { !said.contains("effect") } else { said.contains(named) };
        assert!(right, "{set}{more}: {said}");
    }
}

#[test]
fn an_address_that_cannot_be_followed_is_refused() {
    let scratch = Scratch::new();
    // Short, should one be run all the same.
    let commands = [
        "gallery out --only part5-mball --part 1/2",
        "stability small.json out --quick --ks 500 --density 10 --steps 30 --part 1/9",
        "study small.json out --quick --part 1/900",
    ];
    for command in commands {
        for address in ["x", "example.org", "javascript:alert(1)//live.html", "live.html x", "https://"] {
            let words: Vec<&str> = command.split(' ').chain(["--live", address]).collect();
            let run = scratch.run(&words);
            assert_eq!(run.code, Some(2), "{words:?}: {}", run.stderr);
            assert!(run.stderr.contains("https://...") && run.stderr.contains(".html"), "{}", run.stderr);
        }
    }
    assert_eq!(scratch.names(), ["small.json"]);
}

#[test]
fn a_scene_from_standard_input_needs_no_name_where_no_picture_is_written() {
    let scratch = Scratch::new();
    let scene = fs::read_to_string(scene("plane.json")).unwrap();
    fs::write(scratch.path("plane.json"), &scene).unwrap();
    let options = ["--hash", "--frame", "0", "--size", "40x30"];
    let named = scratch.succeed(&[&["render", "plane.json"], &options[..]].concat());
    let fed = |arguments: &[&str]| {
        let mut command = scratch.command(arguments);
        command.stdin(fs::File::open(scratch.path("plane.json")).unwrap()).output().unwrap()
    };
    let piped = fed(&[&["render", "-"], &options[..]].concat());
    assert_eq!((piped.status.code(), piped.stdout), (Some(0), named));
    assert_eq!(
        fed(&["render", "-", "--bench", "1", "--frame", "0", "--size", "20x16"]).status.code(),
        Some(0)
    );
    // Links to the live page hold its text.
    let map = [
        "stability",
        "-",
        "map",
        "--quick",
        "--ks",
        "5000",
        "--density",
        "150",
        "--steps",
        "30",
        "--time",
        "0.01",
    ];
    assert_eq!(fed(&[&map[..], &["--live", "live.html"]].concat()).status.code(), Some(0));
    let page = String::from_utf8(scratch.read("map/index.html")).unwrap();
    assert!(page.contains("live.html#paused") && page.contains("num_width_points"));
    let unnamed = fed(&["study", "-", "--quick"]);
    assert_eq!(unnamed.status.code(), Some(2), "there is no name to name the folder after");
}
