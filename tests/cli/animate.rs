//! Animations show the pictures that `render` draws, at the right times, whole or not at all.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;

use crate::scratch::{Run, Scratch};

/// Small pictures of a few colours.
pub(crate) const LOOK: [&str; 4] = ["--size", "40x30", "--shader", "wireframe"];

/// Three bytes a pixel.
type Rgb = Vec<u8>;

/// What `render` draws of the simulated frames.
pub(crate) fn rendered(scratch: &Scratch, frames: &[u64]) -> Vec<Rgb> {
    let draw = |frame: &u64| {
        let bytes = scratch
            .succeed(&[&["render", "small.json", "-", "--frame", &frame.to_string()], &LOOK[..]].concat());
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut rgb).unwrap();
        rgb
    };
    frames.iter().map(draw).collect()
}

fn animate(scratch: &Scratch, out: &str, more: &[&str]) -> Run {
    let run = scratch.run(&[&["animate", "small.json", out], &LOOK[..], more].concat());
    assert_eq!(run.code, Some(0), "{out} {more:?}: {}", run.stderr);
    assert_eq!(run.stdout, b"", "{out} {more:?} printed something");
    run
}

#[test]
fn pictures_of_the_background_alone_are_warned_of() {
    let scratch = Scratch::new();
    let said = |more: &[&str]| animate(&scratch, "a.gif", &[&["--frames", "0..2"], more].concat()).stderr;
    let away = ["--set", "camera.target=[50,0,0]"];
    assert!(said(&away).contains("warning: no object is visible in the pictures"), "{}", said(&away));
    assert_eq!(said(&[&away[..], &["-q"]].concat()), "");
    assert!(!said(&[]).contains("warning"), "{}", said(&[]));
}

fn paste(canvas: &mut Rgb, rgb: &[u8], [left, top, width]: [usize; 3]) {
    for (y, row) in rgb.chunks(3 * width).enumerate() {
        let at = 3 * ((top + y) * 40 + left);
        canvas[at..at + row.len()].copy_from_slice(row);
    }
}

/// The pictures of an animated PNG as a viewer shows them, and the delays.
fn read_apng(path: &Path) -> (Vec<Rgb>, Vec<(u16, u16)>) {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path).unwrap())).read_info().unwrap();
    let control = *reader.info().animation_control().unwrap();
    assert_eq!(control.num_plays, 0, "for ever");
    let (mut canvas, mut pictures, mut delays) = (vec![0; 40 * 30 * 3], Vec::new(), Vec::new());
    for _ in 0..control.num_frames {
        let mut rgb = vec![0; 40 * 30 * 3];
        let found = reader.next_frame(&mut rgb).unwrap();
        let frame = reader.info().frame_control().unwrap();
        assert_eq!((frame.dispose_op, frame.blend_op), (png::DisposeOp::None, png::BlendOp::Source));
        rgb.truncate(found.buffer_size());
        paste(&mut canvas, &rgb, [frame.x_offset, frame.y_offset, frame.width].map(|side| side as usize));
        pictures.push(canvas.clone());
        delays.push((frame.delay_num, frame.delay_den));
    }
    (pictures, delays)
}

/// The same of a GIF, with delays in hundredths of a second.
fn read_gif(path: &Path) -> (Vec<Rgb>, Vec<u16>) {
    let mut decoder = gif::DecodeOptions::new().read_info(File::open(path).unwrap()).unwrap();
    let (mut canvas, mut pictures, mut delays) = (vec![0; 40 * 30 * 3], Vec::new(), Vec::new());
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert_eq!((frame.dispose, frame.transparent), (gif::DisposalMethod::Keep, None));
        let palette = frame.palette.as_ref().unwrap();
        let color = |&i: &u8| palette[3 * usize::from(i)..3 * usize::from(i) + 3].to_vec();
        let rgb: Rgb = frame.buffer.iter().flat_map(color).collect();
        paste(&mut canvas, &rgb, [frame.left, frame.top, frame.width].map(usize::from));
        pictures.push(canvas.clone());
        delays.push(frame.delay);
    }
    assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
    (pictures, delays)
}

#[test]
fn an_animated_png_shows_the_nearest_frames_in_real_time() {
    let scratch = Scratch::new();
    animate(&scratch, "a.apng", &["--frames", "2..17", "--fps", "50"]);
    let (pictures, delays) = read_apng(&scratch.path("a.apng"));
    // 90 simulated frames a second: one picture every 1.8.
    assert!(pictures == rendered(&scratch, &[2, 4, 6, 7, 9, 11, 13, 15, 16]), "other pictures");
    assert_eq!(delays, [(1, 50); 9]);
    assert!(pictures.windows(2).all(|pair| pair[0] != pair[1]), "it moves");
}

#[test]
fn a_gif_shows_them_too_with_times_that_do_not_drift() {
    let scratch = Scratch::new();
    animate(&scratch, "a.gif", &["--frames", "0..18", "--fps", "30"]);
    animate(&scratch, "b.gif", &["--time", "0.2", "--fps", "30"]);
    assert_eq!(scratch.read("a.gif"), scratch.read("b.gif"), "0.2 s are 18 frames");
    let (pictures, delays) = read_gif(&scratch.path("a.gif"));
    assert!(pictures == rendered(&scratch, &[0, 3, 6, 9, 12, 15]), "other pictures");
    assert_eq!(delays, [3, 4, 3, 3, 4, 3]);
}

#[test]
fn without_options_every_frame_to_the_moment_of_the_scene_is_shown() {
    let scratch = Scratch::new();
    for (out, fps, pictures) in [("a.apng", 90, 9), ("f/%d.png", 90, 9), ("a.gif", 50, 5)] {
        let time = ["--set", "render.time=0.1", "--json"];
        let summary = scratch.json(&[&["animate", "small.json", out], &LOOK[..], &time].concat());
        assert_eq!((&summary["fps"], &summary["pictures"]), (&fps.into(), &pictures.into()), "{out}");
        assert_eq!((&summary["out"], &summary["kept"]), (&out.into(), &0.into()));
    }
    assert_eq!(read_apng(&scratch.path("a.apng")).0.len(), 9);
    assert_eq!(read_gif(&scratch.path("a.gif")).0.len(), 5);
    assert_eq!(fs::read_dir(scratch.path("f")).unwrap().count(), 9);
}

#[test]
fn every_number_of_threads_gives_the_same_bytes() {
    let scratch = Scratch::new();
    for (out, file) in [("a.apng", "a.apng"), ("a.gif", "a.gif"), ("%02d.png", "03.png")] {
        let bytes = |threads: &str| {
            let _ = fs::remove_file(scratch.path(file));
            let more = ["--shader", "phong", "--frames", "0..12", "--fps", "30", "--threads", threads];
            scratch.succeed(&[&["animate", "small.json", out, "--size", "80x60"], &more[..]].concat());
            scratch.read(file)
        };
        let one = bytes("1");
        for threads in ["2", "7"] {
            assert!(bytes(threads) == one, "{out}: {threads} threads differ from one");
        }
    }
}

/// Which of the pictures `f/0.png` .. `f/4.png` are other files after `change`.
#[cfg(unix)]
fn replaced(scratch: &Scratch, more: &[&str], change: impl Fn(&Scratch)) -> Vec<usize> {
    use std::os::unix::fs::MetadataExt;
    // A file that is written again is another one, of another time.
    let identities = || -> Vec<_> {
        let metadata = |k: usize| fs::metadata(scratch.path(&format!("f/{k}.png"))).ok();
        (0..5).map(|k| metadata(k).map(|m| (m.ino(), m.mtime(), m.mtime_nsec()))).collect()
    };
    animate(scratch, "f/%d.png", &["--frames", "0..5"]);
    change(scratch);
    let before = identities();
    animate(scratch, "f/%d.png", &[&["--frames", "0..5"], more].concat());
    let after = identities();
    (0..5).filter(|&k| before[k] != after[k]).collect()
}

#[cfg(unix)]
#[test]
fn numbered_pictures_of_the_same_scene_are_kept_and_others_are_drawn_again() {
    let scratch = Scratch::new();
    let path = |k: usize| format!("f/{k}.png");
    assert_eq!(replaced(&scratch, &[], |_| ()), [0; 0]);
    assert_eq!(replaced(&scratch, &["--set", "render.time=7", "--threads", "1"], |_| ()), [0; 0]);
    assert_eq!(replaced(&scratch, &[], |s| fs::remove_file(s.path(&path(3))).unwrap()), [3]);
    let cut = |s: &Scratch| fs::write(s.path(&path(1)), &s.read(&path(1))[..200]).unwrap();
    assert_eq!(replaced(&scratch, &[], cut), [1], "a file that is cut short");
    let other = |s: &Scratch| fs::copy(s.path(&path(2)), s.path(&path(4))).map(drop).unwrap();
    assert_eq!(replaced(&scratch, &[], other), [4], "the picture of another frame");
    let plain = |s: &Scratch| {
        let rgb = read_png(s, "f/2.png");
        let bytes = drape::output::png::encode(40, 30, &rgb, drape::output::png::Effort::Fast).unwrap();
        fs::write(s.path("f/2.png"), bytes).unwrap();
    };
    assert_eq!(replaced(&scratch, &[], plain), [2], "a picture that does not say what it shows");
    let drawn = |s: &Scratch| {
        let old = s.read("f/2.png");
        s.succeed(&[&["render", "small.json", "f/2.png", "--frame", "2"], &LOOK[..]].concat());
        assert!(s.read("f/2.png") == old, "each is the file that `render` writes");
    };
    assert_eq!(replaced(&scratch, &[], drawn), [0; 0]);
    for change in [
        &["--set", "cloth.ks=4999"][..],
        &["--set", "light.position=[0.51,2,2]"],
        &["--samples", "4"],
        &["--springs", "bending"],
        &["--shader", "texture"],
    ] {
        let run = |s: &Scratch| {
            let look = &LOOK[..if change[0] == "--shader" { 2 } else { 4 }];
            s.succeed(&[&["animate", "small.json", "f/%d.png", "--frames", "0..5"], look, change].concat());
        };
        assert_eq!(replaced(&scratch, &[], run), [0, 1, 2, 3, 4], "{change:?}");
    }
    assert!(rendered(&scratch, &[4]) == [read_png(&scratch, &path(4))], "what is kept is right");
}

fn read_png(scratch: &Scratch, name: &str) -> Rgb {
    let mut reader = png::Decoder::new(std::io::Cursor::new(scratch.read(name))).read_info().unwrap();
    let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut rgb).unwrap();
    rgb
}

#[cfg(unix)]
#[test]
fn other_texels_under_the_same_name_are_another_scene() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("set")).unwrap();
    let textures = crate::repository::path("textures");
    let arguments = ["animate", "small.json", "%d.png", "--frames", "0..2", "--size", "40x30"];
    let arguments = [&arguments[..], &["--shader", "texture", "--textures", "set", "--json"]].concat();
    let mut kept = Vec::new();
    for texture in ["texture_1.png", "texture_1.png", "texture_3.png"] {
        fs::copy(textures.join(texture), scratch.path("set/texture_1.png")).unwrap();
        kept.push(scratch.json(&arguments)["kept"].as_u64().unwrap());
    }
    assert_eq!(kept, [0, 2, 0]);
}

#[test]
fn a_failure_on_the_way_leaves_no_file_but_finished_pictures() {
    let scratch = Scratch::new();
    fs::write(scratch.path("old.gif"), "old").unwrap();
    let stiff = ["--set", "cloth.ks=1e12", "--set", "sim.stretch_limit=null", "--allow-unstable", "-q"];
    for out in ["a.apng", "old.gif", "f/%d.png"] {
        let run = scratch.run(&[&["animate", "small.json", out], &LOOK[..], &stiff].concat());
        assert_eq!(run.code, Some(5), "{out}: {}", run.stderr);
    }
    assert_eq!(scratch.names(), ["f", "old.gif", "small.json"]);
    assert_eq!(scratch.read("old.gif"), b"old");
    let pictures = fs::read_dir(scratch.path("f")).unwrap().map(|e| e.unwrap().file_name());
    assert!(pictures.into_iter().all(|name| name.to_string_lossy().ends_with(".png")));
}

#[cfg(unix)]
#[test]
fn a_signal_keeps_finished_pictures_and_no_other_file() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};
    let scratch = Scratch::new();
    for (out, says) in
        [("f/%d.png", "run the same command again to do the rest"), ("a.apng", "nothing was written")]
    {
        let arguments = ["animate", "small.json", out, "--frames", "0..100000000", "--size", "64x64"];
        let mut child = scratch.command(&arguments).stderr(Stdio::piped()).spawn().unwrap();
        let (started, first) = (Instant::now(), scratch.path("f/1.png"));
        // A picture is there, or, the second time, there would have been.
        while !first.exists() || started.elapsed() < Duration::from_millis(300) {
            assert!(started.elapsed() < Duration::from_secs(20), "no picture");
            std::thread::sleep(Duration::from_millis(10));
        }
        assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
        while child.try_wait().unwrap().is_none() {
            if started.elapsed() > Duration::from_secs(20) {
                child.kill().unwrap();
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        let run: Run = child.wait_with_output().unwrap().into();
        assert_eq!(run.code, Some(130), "{out}: {}", run.stderr);
        assert!(run.stderr.contains(says), "{out}: {}", run.stderr);
    }
    assert_eq!(scratch.names(), ["f", "small.json"]);
    for entry in fs::read_dir(scratch.path("f")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert_eq!(read_png(&scratch, &format!("f/{name}")).len(), 64 * 64 * 3, "{name}");
    }
}

/// A shorter run over a longer one leaves none of the old pictures, and touches nothing that is not of this program.
#[test]
fn pictures_of_a_longer_run_are_removed() {
    let scratch = Scratch::new();
    let run = |frames: &str| {
        let all =
            ["animate", "small.json", "p/%04d.png", "--fps", "30", "--size", "32x24", "--frames", frames];
        let run = scratch.run(&all);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        run.stderr
    };
    run("0..24");
    fs::write(scratch.path("p/0007.png"), b"of another program").unwrap();
    fs::write(scratch.path("p/notes.txt"), b"kept").unwrap();
    let said = run("0..9");
    let mut names: Vec<String> = fs::read_dir(scratch.path("p"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["0000.png", "0001.png", "0002.png", "0007.png", "notes.txt"]);
    assert!(said.contains("1 files from `p/0007.png` on"), "{said}");
}
