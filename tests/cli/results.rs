//! Standard output carries the result and nothing else, and the result is right.

use crate::scratch::Scratch;
use std::fs;

#[test]
fn help_and_version_are_results() {
    let scratch = Scratch::new();
    for arguments in [&["--help"][..], &["-h"], &["render", "--help"], &["help", "render"], &["--version"]] {
        let run = scratch.run(arguments);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{arguments:?}");
        let text = String::from_utf8(run.stdout).unwrap();
        assert!(
            text.contains("Usage: drape") || text == format!("drape {}\n", drape::version::VERSION),
            "{text}"
        );
        assert!(!text.contains('\x1b'), "no colour where there is no terminal");
    }
}

#[test]
fn render_prints_nothing_unless_asked() {
    let scratch = Scratch::new();
    let quiet = ["render", "small.json", "--size", "40x30", "--frame", "3", "-q"];
    let run = scratch.run(&quiet);
    assert_eq!((run.code, run.stdout.len(), run.stderr.as_str()), (Some(0), 0, ""));
    assert_eq!(scratch.names(), ["small.json", "small.png"], "named after the scene");
    let summary = scratch.json(&[&quiet[..], &["--json"]].concat());
    assert_eq!(
        (&summary["width"], &summary["height"], &summary["frame"]),
        (&40.into(), &30.into(), &3.into())
    );
    assert_eq!(summary["stats"]["triangles"], 32 + 2 * 40 * 40);
    let stats = String::from_utf8(scratch.succeed(&[&quiet[..], &["--stats"]].concat())).unwrap();
    assert!(stats.starts_with("vertices    1706\ntriangles   3232\n"), "{stats}");
}

#[test]
fn pictures_to_standard_output_are_those_of_the_file() {
    let scratch = Scratch::new();
    let bytes = scratch.succeed(&["render", "small.json", "-", "--size", "40x30", "--frame", "3"]);
    scratch.succeed(&["render", "small.json", "out.png", "--size", "40x30", "--frame", "3"]);
    assert!(bytes.starts_with(b"\x89PNG\r\n\x1a\n"));
    assert_eq!(bytes, scratch.read("out.png"));
    assert_eq!(scratch.names(), ["out.png", "small.json"]);
}

#[test]
fn a_picture_hash_is_that_of_the_file_and_no_file_is_written() {
    let scratch = Scratch::new();
    let render = ["render", "small.json", "--size", "40x30", "--frame", "3"];
    let text = String::from_utf8(scratch.succeed(&[&render[..], &["--hash"]].concat())).unwrap();
    assert_eq!(scratch.names(), ["small.json"]);
    scratch.succeed(&render);
    let picture = drape::output::png::read(&scratch.path("small.png")).unwrap();
    let mut hash = drape::math::StateHash::default();
    picture.rgba.iter().for_each(|pixel| hash.write(&pixel[..3]));
    assert_eq!(text, format!("{:016x}\n", hash.finish()));
    let json = scratch.json(&[&render[..], &["--hash", "--json"]].concat());
    assert_eq!(json["picture_hash"], text.trim());
    let other = scratch.succeed(&[&render[..], &["--hash", "--shader", "normal"]].concat());
    assert_ne!(other, text.as_bytes());
    assert_eq!(scratch.run(&["render", "small.json", "x.png", "--hash"]).code, Some(2));
}

#[test]
fn a_picture_of_the_background_alone_is_warned_of() {
    let scratch = Scratch::new();
    let said = |more: &[&str]| {
        let run = scratch.run(&[&["render", "small.json", "out.png", "--frame", "0"], more].concat());
        assert_eq!(run.code, Some(0));
        run.stderr
    };
    let away = ["--set", "camera.target=[50,0,0]"];
    let warning = said(&away);
    assert!(
        warning.contains("warning: no object is visible") && warning.contains("camera.target"),
        "{warning}"
    );
    assert_eq!(said(&[&away[..], &["-q"]].concat()), "");
    let seen = said(&["--shader", "wireframe"]);
    assert!(!seen.contains("warning"), "{seen}");
}

#[test]
fn time_and_frame_name_the_same_moment() {
    let scratch = Scratch::new();
    let hash = |arguments: &[&str]| {
        let run = scratch.json(&[&["simulate", "small.json", "--json"], arguments].concat());
        (run["frames"].as_u64().unwrap(), run["state_hash"].as_str().unwrap().to_owned())
    };
    let frames = hash(&["--frames", "45"]);
    assert_eq!(frames.0, 45);
    assert_eq!(hash(&["--time", "0.5"]), frames);
    assert_eq!(hash(&["--time", "0.5055"]), frames, "rounded to 45.495 -> 45");
    assert_eq!(hash(&["--set", "render.time=0.5"]), frames);
    assert_ne!(hash(&["--frames", "46"]).1, frames.1);
    assert_eq!(hash(&["--frames", "0"]).0, 0);
}

#[test]
fn depth_and_ids_have_a_number_a_pixel() {
    let scratch = Scratch::new();
    let size = ["--size", "40x30", "--frame", "0"];
    scratch.succeed(&[&["render", "small.json", "--depth", "d", "--ids", "i"], &size[..]].concat());
    let words = |name| -> Vec<[u8; 4]> {
        scratch.read(name).chunks(4).map(|chunk| chunk.try_into().unwrap()).collect()
    };
    let depths: Vec<f32> = words("d").into_iter().map(f32::from_le_bytes).collect();
    let ids: Vec<u32> = words("i").into_iter().map(u32::from_le_bytes).collect();
    assert_eq!((depths.len(), ids.len()), (1200, 1200));
    for (depth, id) in depths.iter().zip(&ids) {
        assert_eq!(*id == 0, *depth == 1.0, "background is far and has no id");
        assert!((0.0..=1.0).contains(depth));
    }
    scratch.succeed(&[&["render", "small.json", "--depth-metres", "m"], &size[..]].concat());
    let metres = words("m").into_iter().map(f32::from_le_bytes);
    for (depth, metres) in depths.iter().zip(metres) {
        assert_eq!(*depth == 1.0, metres == f32::INFINITY);
        assert!(metres >= 0.01, "the near plane");
    }
    let objects: std::collections::BTreeSet<u32> = ids.iter().map(|id| id >> 24).collect();
    assert!(objects.contains(&0) && objects.contains(&2), "background and ball are seen: {objects:?}");
}

#[test]
fn changes_from_the_command_line_reach_the_picture() {
    let scratch = Scratch::new();
    let picture = |arguments: &[&str]| {
        scratch
            .succeed(&[&["render", "small.json", "-", "--size", "64x48", "--frame", "5"], arguments].concat())
    };
    let plain = picture(&[]);
    let mut pictures = vec![plain.clone()];
    for change in [
        &["--shader", "normal"][..],
        &["--shader", "wireframe"],
        &["--shader", "wireframe", "--springs", "bending"],
        &["--samples", "4"],
        &["-a", "4"],
        &["-o", "4"],
        &["--set", "camera.polar=60"],
    ] {
        let other = picture(change);
        assert!(!pictures.contains(&other), "{change:?} changes nothing of its own");
        pictures.push(other);
    }
    assert_eq!(
        picture(&["--shader", "phong", "-a", "40", "-o", "40", "--samples", "1"]),
        plain,
        "the defaults"
    );
    fs::write(scratch.path("patch.json"), r#"{"camera": {"polar": 60}}"#).unwrap();
    assert_eq!(picture(&["--patch", "patch.json"]), picture(&["--set", "camera.polar=60"]));
}

#[test]
fn benchmarks_print_json_and_write_nothing() {
    let scratch = Scratch::new();
    let render = scratch.run(&["render", "small.json", "--size", "40x30", "--frame", "1", "--bench", "3"]);
    let object = render.object();
    assert!(
        object["ms_min"].as_f64() > Some(0.0) && object["ms_median"].as_f64() >= object["ms_min"].as_f64()
    );
    assert!(object["threads"].as_u64() >= Some(1) && object["triangles"] == 3232);
    assert!(object["fragments"].as_u64() > Some(0) && object["stages"]["raster"].as_f64() > Some(0.0));
    let simulate = scratch.run(&["simulate", "small.json", "--frames", "2", "--bench"]).object();
    assert!(simulate["ns_per_substep"].as_f64() > Some(0.0));
    assert_eq!(
        (&simulate["substeps"], &simulate["points"], &simulate["springs"]),
        (&60.into(), &25.into(), &102.into())
    );
    assert!(simulate["stages"]["forces"].as_u64() > Some(0));
    assert_eq!(scratch.names(), ["small.json"]);
}

#[test]
fn compare_tells_equal_different_and_missing_pictures_apart() {
    let scratch = Scratch::new();
    for folder in ["a", "b"] {
        fs::create_dir(scratch.path(folder)).unwrap();
    }
    let render = |out: &str, polar: &str| {
        let view = format!("camera.polar={polar}");
        scratch.succeed(&["render", "small.json", out, "--size", "40x30", "--frame", "1", "--set", &view])
    };
    for (out, polar) in [("a/x.png", "90"), ("b/x.png", "90"), ("a/y.png", "90"), ("b/y.png", "60")] {
        render(out, polar);
    }
    let same = scratch.json(&["compare", "a/x.png", "b/x.png", "--json"]);
    assert_eq!((&same["differing"], &same["max"], &same["pixels"]), (&0.into(), &0.into(), &1200.into()));
    let run =
        scratch.run(&["compare", "a/y.png", "b/y.png", "--json", "--diff", "d.png", "--html", "d.html"]);
    assert_eq!((run.code, &run.error()["kind"]), (Some(1), &"difference".into()));
    let found = run.object();
    let differing = found["differing"].as_u64().unwrap();
    let counted: u64 = found["histogram"].as_object().unwrap().values().map(|n| n.as_u64().unwrap()).sum();
    assert!(differing > 0 && counted == differing && found["rmse"].as_f64() > Some(0.0));
    assert!(scratch.read("d.png").starts_with(b"\x89PNG"));
    assert_eq!(String::from_utf8(scratch.read("d.html")).unwrap().matches("<img ").count(), 3);
    let budget = format!("255:{differing}");
    assert_eq!(scratch.run(&["compare", "a/y.png", "b/y.png", "--budget", &budget]).code, Some(0));
    let less = format!("255:{}", differing - 1);
    assert_eq!(scratch.run(&["compare", "a/y.png", "b/y.png", "--budget", &less]).code, Some(1));

    assert_eq!(scratch.run(&["compare", "a", "b"]).code, Some(1));
    assert_eq!(scratch.run(&["compare", "a", "a"]).code, Some(0));
    render("b/y.png", "90");
    assert_eq!(scratch.run(&["compare", "a", "b"]).code, Some(0));
    fs::create_dir(scratch.path("b/inside")).unwrap();
    render("b/inside/z.png", "90");
    let extra = scratch.run(&["compare", "a", "b", "--json"]);
    assert_eq!(
        (extra.code, &extra.error()["kind"]),
        (Some(4), &"nothing".into()),
        "nothing is expected of it"
    );
    assert_eq!(extra.object()["only_in_b"], serde_json::json!(["inside/z.png"]));
    assert_eq!(scratch.run(&["compare", "b", "a"]).code, Some(1), "a picture is gone");
}

#[test]
fn messages_are_coloured_only_when_asked_and_silent_when_asked() {
    let scratch = Scratch::new();
    let message = |arguments: &[&str]| scratch.run(&[&["info", "no.json"], arguments].concat()).stderr;
    assert!(!message(&[]).contains('\x1b'));
    assert!(message(&["--color", "always"]).starts_with("\x1b[1;31merror\x1b[0m: "));
    assert!(!message(&["--color", "never"]).contains('\x1b'));
    let remarks = |arguments: &[&str]| {
        scratch.run(&[&["simulate", "small.json", "--frames", "1"], arguments].concat()).stderr
    };
    assert!(remarks(&["-v"]).starts_with("simulated 1 frames in "));
    assert_eq!((remarks(&[]).as_str(), remarks(&["-q"]).as_str()), ("", ""));
}
