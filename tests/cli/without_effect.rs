//! Small promises of the command line: options that change nothing are named, a scene may come from standard input, and
//! what is missing is blamed by its name.

use std::fs;
use std::io::Write;
use std::process::Stdio;

use crate::scratch::{Run, SMALL, Scratch, scene};

fn said(scratch: &Scratch, arguments: &[&str]) -> String {
    let all = [&["render", "small.json", "out.png", "--frame", "0", "--size", "40x30"], arguments].concat();
    let run = scratch.run(&all);
    assert_eq!(run.code, Some(0), "{arguments:?}: {}", run.stderr);
    run.stderr
}

#[test]
fn options_that_change_nothing_are_named() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("t")).unwrap();
    for (arguments, named) in [
        (&["--springs", "bending"][..], "--springs has no effect"),
        (&["--textures", "t"], "--textures has no effect"),
        (
            &["--samples", "4", "--shader", "wireframe", "--set", "sphere=null"],
            "`render.samples` has no effect",
        ),
        (&["-a", "8", "--set", "sphere=null"], "-a has no effect"),
        (&["-o", "8", "--set", "sphere=null"], "-o has no effect"),
        (&["--set", "sim.iterations=3"], "`sim.iterations` has no effect"),
        (&["--set", "cloth=null", "--set", "sphere=null", "--shader", "bump"], "--shader has no effect"),
    ] {
        let said = said(&scratch, arguments);
        assert!(said.contains(named), "{arguments:?}: {said}");
    }
    for fine in [&["--springs", "bending", "--shader", "wireframe"][..], &["-a", "8"], &["--samples", "4"]] {
        let said = said(&scratch, fine);
        assert!(!said.contains("effect"), "{fine:?}: {said}");
    }
}

#[test]
fn options_of_export_that_change_nothing_are_named() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("t")).unwrap();
    let said = |arguments: &[&str]| {
        let run = scratch.run(&[&["export", "small.json", "--frame", "0"], arguments].concat());
        assert_eq!(run.code, Some(0), "{arguments:?}: {}", run.stderr);
        run.stderr
    };
    fs::copy(crate::repository::path("textures/texture_1.png"), scratch.path("t/texture_1.png")).unwrap();
    for out in [&["a.obj"][..], &["a.ply"], &["a.glb"], &["a.obj", "--materials"]] {
        assert!(said(&[out, &["--textures", "t"]].concat()).contains("--textures has no effect"), "{out:?}");
    }
    assert!(said(&["a.glb", "--materials"]).contains("--materials has no effect"));
    let reads =
        ["--set", "material.shader=texture", "--set", "material.texture=texture_1", "--textures", "t"];
    assert!(!said(&["a.ply"]).contains("effect"));
    for out in [&["a.obj", "--materials"][..], &["a.glb"]] {
        assert!(!said(&[out, &reads].concat()).contains("effect"), "{out:?}");
    }
}

/// Runs the program with a text as its standard input.
fn fed(scratch: &Scratch, text: &str, arguments: &[&str]) -> Run {
    let mut command = scratch.command(arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the program starts");
    child.stdin.take().expect("a pipe").write_all(text.as_bytes()).expect("it reads");
    child.wait_with_output().expect("it ends").into()
}

#[test]
fn a_scene_may_come_from_standard_input() {
    let scratch = Scratch::new();
    let frame = ["--frame", "2", "--size", "40x30"];
    scratch.succeed(&[&["render", "small.json", "a.png"], &frame[..]].concat());
    let run = fed(&scratch, SMALL, &[&["render", "-", "b.png"], &frame[..]].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(scratch.read("a.png"), scratch.read("b.png"));
    let piped = fed(&scratch, SMALL, &[&["render", "-", "-"], &frame[..]].concat());
    assert_eq!((piped.code, piped.stdout), (Some(0), scratch.read("a.png")), "{}", piped.stderr);
    for command in ["info", "check", "simulate"] {
        assert_eq!(fed(&scratch, SMALL, &[command, "-"]).code, Some(0), "{command}");
    }
    // Read once, used for several simulations.
    let study =
        fed(&scratch, SMALL, &["stability", "-", "map", "--quick", "--ks", "5000", "--density", "150"]);
    assert_eq!(study.code, Some(0), "{}", study.stderr);
    let wrong = fed(&scratch, "{\"cloht\": 1}", &["check", "-"]);
    assert_eq!(wrong.code, Some(3));
    let unnamed = fed(&scratch, SMALL, &["render", "-"]);
    assert_eq!(unnamed.code, Some(2), "there is no name to name the picture after");
    assert!(fed(&scratch, "{\n  \"sim\": 5}", &["info", "-"]).stderr.contains("standard input:2:10"));
}

#[test]
fn an_object_that_is_null_is_gone() {
    let scratch = Scratch::new();
    let path = scene("plane.json");
    let info = |set: &str| scratch.json(&["info", &path, "--json", "--set", set]);
    assert_eq!((&info("sim.fps=90")["planes"], &info("plane=null")["planes"]), (&1.into(), &0.into()));
    assert!(info("cloth=null")["cloth"].is_null());
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    let scratch = Scratch::new();
    fs::write(scratch.path("mark.json"), format!("\u{feff}{SMALL}")).unwrap();
    let hash =
        |path: &str| scratch.json(&["simulate", path, "--frames", "2", "--json"])["state_hash"].clone();
    assert_eq!(hash("mark.json"), hash("small.json"));
}

#[test]
fn a_folder_for_temporary_files_that_is_not_there_is_blamed() {
    let scratch = Scratch::new();
    let mut command =
        scratch.command(&["animate", "small.json", "a.mp4", "--frames", "0..2", "--size", "32x24"]);
    let bin = scratch.path("bin");
    fs::create_dir(&bin).unwrap();
    fs::write(bin.join("ffmpeg"), "#!/bin/sh\ncat > /dev/null\n").unwrap();
    fs::set_permissions(bin.join("ffmpeg"), std::os::unix::fs::PermissionsExt::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap_or_default());
    let run: Run = command.env("PATH", path).env("TMPDIR", scratch.path("gone")).output().unwrap().into();
    assert_eq!(run.code, Some(6), "{}", run.stderr);
    assert!(run.stderr.contains("gone") && run.stderr.contains("set TMPDIR"), "{}", run.stderr);
}

#[test]
fn transparent_textures_are_noted() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("t")).unwrap();
    for (alpha, noted) in [(255, false), (100, true)] {
        image::RgbaImage::from_pixel(4, 4, image::Rgba([200, 100, 50, alpha]))
            .save(scratch.path("t/glass.png"))
            .unwrap();
        let said =
            said(&scratch, &["--shader", "texture", "--textures", "t", "--set", "material.texture=glass"]);
        assert_eq!(said.contains("glass has transparent pixels"), noted, "{said}");
        for out in ["glass.glb", "glass.obj"] {
            let run = scratch.run(
                &[
                    &["export", "small.json", out, "--frame", "0", "--textures", "t", "--materials"],
                    &["--set", "material.shader=texture", "--set", "material.texture=glass"][..],
                ]
                .concat(),
            );
            assert_eq!(run.stderr.contains("glass has transparent pixels"), noted, "{out}: {}", run.stderr);
        }
    }
}
