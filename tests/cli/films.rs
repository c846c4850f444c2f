//! `animate` to a film: what ffmpeg is asked for, and what happens without it.

use std::fs::{self, File};
use std::io::Read;

use crate::animate::{LOOK, rendered};
use crate::scratch::{Run, Scratch};

/// A folder for `PATH` in which `ffmpeg` is a script.
#[cfg(unix)]
fn with_ffmpeg(scratch: &Scratch, script: &str) -> String {
    use std::os::unix::fs::PermissionsExt;
    fs::create_dir(scratch.path("bin")).unwrap();
    let program = scratch.path("bin/ffmpeg");
    fs::write(&program, format!("#!/bin/sh\n[ \"$1\" = -version ] && exit 0\n{script}\n")).unwrap();
    fs::set_permissions(program, fs::Permissions::from_mode(0o755)).unwrap();
    format!("{}:/usr/bin:/bin", scratch.path("bin").display())
}

#[cfg(unix)]
fn film(scratch: &Scratch, path: &str, more: &[&str]) -> Run {
    let arguments = ["animate", "small.json", "a.mp4", "--frames", "0..12", "--fps", "30", "-q"];
    let mut command = scratch.command(&[&arguments[..], &LOOK, more].concat());
    command.env("PATH", path).output().unwrap().into()
}

#[cfg(unix)]
#[test]
fn a_film_is_what_ffmpeg_makes_of_the_pictures() {
    let scratch = Scratch::new();
    // The last argument is the file to write; the pictures come through standard input.
    let path = with_ffmpeg(&scratch, "for last; do :; done; echo \"$*\" > args; cat > \"$last\"");
    let run = film(&scratch, &path, &[]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert_eq!(scratch.read("a.mp4"), rendered(&scratch, &[0, 3, 6, 9]).concat());
    let arguments = String::from_utf8(scratch.read("args")).unwrap();
    for option in [
        "-pixel_format rgb24",
        "-video_size 40x30",
        "-framerate 30",
        "-c:v libx264",
        "-f mp4",
        // The colours that players assume, and the index before the pictures.
        "out_color_matrix=bt709",
        "-colorspace bt709",
        "-color_primaries bt709",
        "-color_range tv",
        "-movflags +faststart",
    ] {
        assert!(arguments.contains(option), "{arguments}");
    }
    assert_eq!(scratch.names(), ["a.mp4", "args", "bin", "small.json"]);
}

#[cfg(unix)]
#[test]
fn ffmpeg_that_fails_is_6_and_is_quoted() {
    let scratch = Scratch::new();
    for script in ["cat > /dev/null; echo no such encoder >&2; exit 1", "echo no such encoder >&2; exit 1"] {
        let path = with_ffmpeg(&scratch, script);
        let run = film(&scratch, &path, &[]);
        assert_eq!(run.code, Some(6), "{}", run.stderr);
        assert!(run.stderr.contains("no such encoder"), "{}", run.stderr);
        fs::remove_dir_all(scratch.path("bin")).unwrap();
        assert_eq!(scratch.names(), ["small.json"]);
    }
}

#[cfg(unix)]
#[test]
fn without_ffmpeg_the_exit_code_is_6_and_the_line_to_run_is_told() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("empty")).unwrap();
    let path = scratch.path("empty").to_str().unwrap().to_owned();
    // The simulation would be refused as unstable.
    let run = film(&scratch, &path, &["--set", "cloth.ks=1e12"]);
    assert_eq!(run.code, Some(6), "{}", run.stderr);
    assert!(run.stderr.contains("animate to a/%04d.png"), "{}", run.stderr);
    let line = run.stderr.lines().find(|line| line.trim().starts_with("ffmpeg ")).expect("a line to run");
    let expected = "ffmpeg -framerate 30 -i a/%04d.png -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2:color=0x404040,\
        scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int,format=yuv420p' -c:v libx264 -pix_fmt \
        yuv420p -colorspace bt709 -color_primaries bt709 -color_trc bt709 -color_range tv -movflags '+faststart' a.mp4";
    assert_eq!(line.trim(), expected);
    assert_eq!(scratch.names(), ["empty", "small.json"]);
    // The line is one that a shell can read.
    fs::remove_dir(scratch.path("empty")).unwrap();
    with_ffmpeg(&scratch, "for last; do :; done; printf '%s\\n' \"$@\" > \"$last\"");
    let mut shell = std::process::Command::new("/bin/sh");
    shell.args(["-c", line.trim()]).current_dir(scratch.path("")).env("PATH", scratch.path("bin"));
    assert!(shell.status().unwrap().success());
    let mut words = String::new();
    File::open(scratch.path("a.mp4")).unwrap().read_to_string(&mut words).unwrap();
    assert!(
        words.lines().any(|word| word.starts_with("pad=ceil(iw/2)*2:ceil(ih/2)*2:color=0x404040,scale=")),
        "{words}"
    );
}
