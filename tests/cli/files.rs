//! Files are whole or absent, and links, devices and odd names are handled as a user expects.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

use crate::scratch::{SMALL, Scratch};

#[test]
fn an_old_file_is_replaced_as_a_whole() {
    let scratch = Scratch::new();
    fs::write(scratch.path("p"), vec![7; 10_000]).unwrap();
    scratch.succeed(&["simulate", "small.json", "--frames", "0", "--positions", "p"]);
    assert_eq!(scratch.read("p").len(), 25 * 24);
    assert_eq!(scratch.names(), ["p", "small.json"]);
}

#[test]
fn a_failure_keeps_the_old_file() {
    let scratch = Scratch::new();
    fs::write(scratch.path("p"), "old").unwrap();
    let run = scratch.run(&["simulate", "small.json", "--positions", "p", "--set", "cloth.ks=1e12"]);
    assert_eq!(run.code, Some(5));
    assert_eq!(scratch.read("p"), b"old");
}

#[cfg(unix)]
#[test]
fn a_link_stays_and_its_file_is_written() {
    let scratch = Scratch::new();
    std::os::unix::fs::symlink("real", scratch.path("link")).unwrap();
    scratch.succeed(&["simulate", "small.json", "--frames", "0", "--positions", "link"]);
    assert_eq!(scratch.read("real").len(), 600);
    assert!(fs::symlink_metadata(scratch.path("link")).unwrap().is_symlink());
}

#[cfg(target_os = "linux")]
#[test]
fn a_name_that_is_not_text_is_a_name() {
    use std::os::unix::ffi::OsStrExt;
    let scratch = Scratch::new();
    let name = std::ffi::OsStr::from_bytes(b"caf\xe9.json");
    fs::write(scratch.path("").join(name), SMALL).unwrap();
    let mut command = scratch.command(&["render", "--size", "8x8", "--frame", "0"]);
    assert!(command.arg(name).status().unwrap().success());
    let picture = std::ffi::OsStr::from_bytes(b"caf\xe9.png");
    assert!(scratch.path("").join(picture).exists(), "{:?}", scratch.names());
}

#[test]
fn a_reader_that_leaves_is_no_failure() {
    let scratch = Scratch::new();
    // Without the reader the program would print for minutes.
    let mut child = scratch
        .command(&["simulate", "small.json", "--frames", "100000000", "--hash"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
    assert!(line.starts_with("0 "), "{line}");
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

/// A name with a place for a number is that of many files, or an error that says what would do.
#[test]
fn a_place_for_a_number_is_never_part_of_a_name() {
    let scratch = Scratch::new();
    let refused = |arguments: &[&str], part: &str| {
        let run = scratch.run(arguments);
        assert_eq!((run.code, run.stdout.len()), (Some(2), 0), "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(part), "{arguments:?}: {}", run.stderr);
    };
    for width in ["020", "00", "4", "099999999999999999999999"] {
        let name = |ending: &str| format!("x%{width}d.{ending}");
        for arguments in [
            ["simulate", "small.json", "--frames", "2", "--positions", &name("npy")],
            ["export", "small.json", "--frames", "0..2", "-q", &name("obj")],
            ["animate", "small.json", "--frames", "0..2", "-q", &name("png")],
            ["compare-positions", "small.json", "-q", "--tolerance", "1", &name("npy")],
        ] {
            refused(&arguments, "the limit is 19 digits");
        }
    }
    refused(&["render", "small.json", "x%04d.png"], "%04d stands for the number of many");
    refused(&["animate", "small.json", "x%d.gif", "--frames", "0..2"], "%d stands for");
    refused(&["simulate", "small.json", "--csv", "x%d.csv"], "%d stands for");
    refused(&["animate", "small.json", "%d-%d.png", "--frames", "0..2"], "has 2 places for a number");
    refused(&["render", "small.json", "100%dark.png"], "or write %%d for a percent sign");
    assert_eq!(scratch.names(), ["small.json"]);
    scratch.succeed(&["render", "small.json", "5% x.png", "--size", "8x8", "--frame", "0"]);
    scratch.succeed(&["animate", "small.json", "x%019d.png", "--size", "8x8", "--frames", "0..1"]);
    assert_eq!(scratch.names(), ["5% x.png", "small.json", "x0000000000000000000.png"]);
}

/// What a command writes to a name with `%%` has one percent sign there, and the command says that name.
#[test]
fn two_percent_signs_in_the_name_of_an_output_are_one() {
    let scratch = Scratch::new();
    let written = |arguments: &[&str], files: &[&str]| {
        let run = scratch.run(&[arguments, &["--set", "render.size=[8,8]"]].concat());
        assert!(run.code == Some(0) && !run.stderr.contains("%%"), "{arguments:?}: {}", run.stderr);
        for file in files {
            fs::remove_file(scratch.path(file)).unwrap_or_else(|e| panic!("{arguments:?}: {file}: {e}"));
        }
        assert_eq!(scratch.names(), ["small.json"], "{arguments:?}");
    };
    let render =
        ["render", "small.json", "9%%dark.png", "--frame", "0", "--depth", "9%%d.raw", "--ids", "%%.ids"];
    written(&render, &["9%dark.png", "9%d.raw", "%.ids"]);
    written(&["animate", "small.json", "9%%d.gif", "--frames", "0..2"], &["9%d.gif"]);
    written(&["export", "small.json", "9%%d.glb", "--frame", "0"], &["9%d.glb"]);
    let simulate = ["simulate", "small.json", "--frames", "1", "--positions", "9%%d.npy"];
    let others = ["--csv", "9%%d.csv", "--save-state", "9%%d.state"];
    written(&[&simulate[..], &others].concat(), &["9%d.npy", "9%d.csv", "9%d.state"]);
    scratch.succeed(&simulate);
    scratch.succeed(&["compare-positions", "small.json", "9%%d.npy", "--frame", "1"]);
    scratch.succeed(&["export", "small.json", "9%%d-%d.obj", "--frames", "0..2"]);
    assert_eq!(scratch.names(), ["9%d-0.obj", "9%d-1.obj", "9%d.npy", "small.json"]);
}

/// A texture beside the mesh is written anew, without its transparency and as it is turned.
#[test]
fn a_texture_of_the_user_is_not_overwritten_by_its_copy() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("art")).unwrap();
    let picture = image::RgbaImage::from_pixel(4, 4, image::Rgba([200, 100, 50, 90]));
    picture.save(scratch.path("art/mine.png")).unwrap();
    let before = scratch.read("art/mine.png");
    let options = ["--frame", "0", "--materials", "--textures", "art", "--set", "material.texture=mine"];
    let shaded = |out: &str, shader: &str| {
        let shader = format!("material.shader={shader}");
        scratch.run(&[&["export", "small.json", out], &options[..], &["--set", &shader]].concat())
    };
    let refused = shaded("art/cloth.obj", "texture");
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(refused.stderr.contains("art/mine.png") && refused.stderr.contains("also an input"));
    // One that is missing is told before anything is written.
    assert_eq!(shaded("cloth.obj", "bump").code, Some(3), "there is no texture_2 in the folder");
    assert_eq!((scratch.tree("art").len(), scratch.names()), (1, vec!["art".into(), "small.json".into()]));
    assert_eq!(shaded("cloth.obj", "texture").code, Some(0));
    assert_eq!(scratch.names(), ["art", "cloth.mtl", "cloth.obj", "mine.png", "small.json"]);
    assert_eq!(scratch.read("art/mine.png"), before);
}
