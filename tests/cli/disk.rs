//! What cannot be read or written.

use super::errors::fails;
use crate::scratch::{Run, Scratch};
use std::fs;

#[test]
fn a_file_that_cannot_be_read_is_6() {
    let scratch = Scratch::new();
    for arguments in [
        &["render", "no.json"][..],
        &["simulate", "no.json"],
        &["info", "no.json"],
        &["export", "no.json", "out.obj"],
        &["simulate", "small.json", "--patch", "no.json"],
        &["compare", "no.png", "no.png"],
        &["compare", ".", "no.png"],
        &["compare-positions", "small.json", "no.raw"],
        &["compare-positions", "small.json", "small.json"],
        &["compare", "no.folder", "."],
        &["compare", "small.json", "small.json"],
    ] {
        let (error, _) = fails(&scratch, arguments, 6, "io");
        let message = error["error"].as_str().unwrap();
        assert!(message.contains("no.") || message.contains("small.json"), "{message}");
    }
}

#[test]
fn a_place_that_cannot_be_written_is_6_before_anything_is_simulated() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("folder")).unwrap();
    // The simulation would be refused as unstable.
    let stiff = ["--set", "cloth.ks=1e12"];
    for place in ["no/out", "folder", "new/", "small.json/out"] {
        for command in [
            &["render", "small.json", "out.png", "--depth", place][..],
            &["render", "small.json", "out.png", "--ids", place],
            &["simulate", "small.json", "--positions", place],
            &["export", "small.json", place],
        ] {
            let (error, _) = fails(&scratch, &[command, &stiff].concat(), 6, "io");
            assert!(error["error"].as_str().unwrap().contains(place), "{error}");
        }
    }
    for out in ["no/a.gif", "no/no/%d.png", "small.json/a.apng", "small.json/%d.png"] {
        fails(&scratch, &[&["animate", "small.json", out], &stiff[..]].concat(), 6, "io");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_may_not_be_written_is_6() {
    use std::os::unix::fs::PermissionsExt;
    let scratch = Scratch::new();
    // No user may create files here.
    fails(&scratch, &["simulate", "small.json", "--positions", "/proc/out"], 6, "io");
    let folder = scratch.path("locked");
    fs::create_dir(&folder).unwrap();
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o500)).unwrap();
    // The administrator may write anywhere.
    if fs::write(folder.join("probe"), "").is_err() {
        fails(&scratch, &["simulate", "small.json", "--positions", "locked/out"], 6, "io");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_6() {
    let scratch = Scratch::new();
    fails(&scratch, &["render", "small.json", "/dev/full", "--size", "8x8", "-q"], 6, "io");
    fails(&scratch, &["simulate", "small.json", "--positions", "/dev/full", "--frames", "1"], 6, "io");
    fails(&scratch, &["export", "small.json", "/dev/full", "--frame", "1"], 6, "io");
    let before = scratch.names();
    for arguments in [
        &["render", "small.json", "-", "--size", "8x8", "-q"][..],
        &["simulate", "small.json", "--positions", "-", "--frames", "1"],
        &["simulate", "small.json", "--hash"],
        &["export", "small.json", "-"],
        &["info", "small.json"],
        &["check", "small.json"],
        &["--help"],
        &["--version"],
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let run: Run = scratch.command(arguments).stdout(full).output().unwrap().into();
        assert_eq!(run.code, Some(6), "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains("standard output"), "{arguments:?}: {}", run.stderr);
    }
    assert_eq!(scratch.names(), before);
}

#[test]
fn a_picture_does_not_replace_a_texture_that_it_may_read() {
    let scratch = Scratch::new();
    fs::create_dir_all(scratch.path("set/cube")).expect("folders");
    for texture in ["set/texture_1.png", "set/cube/posx.png"] {
        fs::write(scratch.path(texture), "not looked into").expect("a file");
        let arguments = ["render", "small.json", texture, "--textures", "set", "--shader", "custom"];
        fails(&scratch, &arguments, 2, "usage");
        assert_eq!(scratch.read(texture), b"not looked into");
    }
    // One of the numbered pictures is the texture.
    let arguments =
        ["animate", "small.json", "set/texture_%d.png", "--textures", "set", "--shader", "texture"];
    fails(&scratch, &arguments, 2, "usage");
}
