//! Animations as Pillow and ffmpeg read them.

use serde_json::Value;

use super::{program, python};
use crate::scratch::{Scratch, scene};

/// A textured scene with many colours.
const LOOK: [&str; 6] = ["--time", "0.2", "--fps", "30", "--set", "camera.polar=60"];

fn animate(scratch: &Scratch, out: &str, more: &[&str]) {
    let path = scene("sphere.json");
    scratch.succeed(&[&["animate", &path, out][..], &LOOK, more].concat());
}

#[test]
fn pillow_sees_every_picture_of_a_gif_and_an_apng_in_its_colours() {
    let scratch = Scratch::new();
    let textured = ["--shader", "texture", "--size", "160x125"];
    std::fs::create_dir(scratch.path("p")).unwrap();
    animate(&scratch, "p/%04d.png", &textured);
    for (out, most) in [("a.gif", 0.78), ("a.apng", 0.0)] {
        animate(&scratch, out, &textured);
        let Some(found) = python(&scratch, "animations", &[out, "p"]) else { return };
        assert_eq!(found["pictures"], 6, "{out}");
        let delays: f64 = found["delays"].as_array().unwrap().iter().filter_map(Value::as_f64).sum();
        assert!((delays - 200.0).abs() < 6.0, "{out} lasts {delays} ms");
        let errors: Vec<f64> = found["errors"].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
        println!("{out}: mean error of a channel {errors:?}");
        assert!(errors.len() == 6 && errors.iter().all(|error| *error <= most), "{out}: {errors:?}");
    }
}

/// Of a picture with far more colours than a GIF can have, ours shows nearer ones than ffmpeg's, by what the page says.
#[test]
fn the_colours_of_a_gif_are_nearer_than_those_of_ffmpeg() {
    let scratch = Scratch::new();
    let close = [
        &["--time", "0.3", "--fps", "20", "--size", "320x250", "--shader", "texture"][..],
        &["--set", "camera.distance=0.5", "--set", "camera.target=[0.5,1,0.5]", "--set", "camera.polar=20"],
    ]
    .concat();
    let path = scene("pinned2.json");
    std::fs::create_dir(scratch.path("p")).unwrap();
    for out in ["p/%04d.png", "ours.gif"] {
        scratch.succeed(&[&["animate", &path, out][..], &close].concat());
    }
    let error = |gif: &str| {
        let found = python(&scratch, "animations", &[gif, "p"])?;
        assert_eq!(found["pictures"], 6, "{gif}");
        let errors = found["errors"].as_array().unwrap().iter().map(|error| error.as_f64().unwrap());
        Some(errors.sum::<f64>() / 6.0)
    };
    let ffmpeg = |dither: &str| {
        let palettes =
            format!("split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1{dither}");
        let encode =
            ["-y", "-v", "error", "-framerate", "20", "-i", "p/%04d.png", "-filter_complex", &palettes];
        program(&scratch, "ffmpeg", &[&encode[..], &["theirs.gif"]].concat())?;
        error("theirs.gif")
    };
    let (Some(ours), Some(dithered), Some(plain)) = (error("ours.gif"), ffmpeg(""), ffmpeg(":dither=none"))
    else {
        return;
    };
    println!("mean error of a channel: ours {ours:.3}, ffmpeg {dithered:.3}, without dithering {plain:.3}");
    assert!(ours < plain && ours < dithered, "{ours}, ffmpeg {dithered} and {plain}");
    let page = std::fs::read_to_string(crate::repository::path("docs/recipes.md")).unwrap();
    assert!(page.contains(&format!("a channel is {ours:.2} of 255")), "{ours}");
    // Other versions of ffmpeg may choose a little differently.
    for (found, stated) in [(dithered, "1.62"), (plain, "1.41")] {
        let expected: f64 = stated.parse().unwrap();
        assert!(page.contains(stated) && (found - expected).abs() < 0.1, "{found} instead of {stated}");
    }
}

#[test]
fn a_film_is_tagged_bt_709_and_shows_the_colours_of_the_pictures() {
    let scratch = Scratch::new();
    if program(&scratch, "ffprobe", &["-version"]).is_none() {
        return;
    }
    // Odd sides; a scene of one colour and its background.
    let red = [
        "--size",
        "161x125",
        "--shader",
        "wireframe",
        "--set",
        "material.color=[1,0,0]",
        "--set",
        "render.background=[0,0.5,0.25]",
    ];
    animate(&scratch, "a.mp4", &red);
    let entries =
        "stream=width,height,color_space,color_primaries,color_transfer,color_range,pix_fmt,nb_frames";
    let probe = ["-v", "error", "-select_streams", "v", "-show_entries", entries, "-of", "json", "a.mp4"];
    let stream: Value = serde_json::from_slice(&program(&scratch, "ffprobe", &probe).unwrap()).unwrap();
    let stream = &stream["streams"][0];
    for (key, value) in [
        ("color_space", "bt709"),
        ("color_primaries", "bt709"),
        ("color_transfer", "bt709"),
        ("color_range", "tv"),
        ("pix_fmt", "yuv420p"),
        ("nb_frames", "6"),
    ] {
        assert_eq!(stream[key], value, "{key}");
    }
    assert_eq!((&stream["width"], &stream["height"]), (&162.into(), &126.into()));
    let bytes = scratch.read("a.mp4");
    let place = |name: &[u8]| bytes.windows(4).position(|window| window == name).unwrap();
    assert!(place(b"moov") < place(b"mdat"), "a player can start before it has the whole file");
    let raw = ["-v", "error", "-i", "a.mp4", "-frames:v", "1", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"];
    let rgb = program(&scratch, "ffmpeg", &raw).unwrap();
    let pixel = |x: usize, y: usize| <[u8; 3]>::try_from(&rgb[3 * (162 * y + x)..][..3]).unwrap();
    let near = |found: [u8; 3], expected: [u8; 3]| (0..3).all(|c| found[c].abs_diff(expected[c]) <= 6);
    // The added column and row have the background's colour, and the ball's red is that red.
    for [x, y] in [[0, 0], [161, 60], [80, 125], [161, 125]] {
        assert!(near(pixel(x, y), [0, 128, 64]), "{x}, {y}: {:?}", pixel(x, y));
    }
    let reds =
        (0..126).flat_map(|y| (0..162).map(move |x| [x, y])).filter(|&[x, y]| near(pixel(x, y), [255, 0, 0]));
    assert!(reds.count() > 200, "the ball is red");
}
