//! `compare` sees everything that it is given: every picture of an animation and its timing, every folder, and
//! what it cannot read.

use std::fs::{self, File};
use std::os::unix::fs::symlink;

use crate::scratch::{Run, Scratch};
use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder, Rgb, RgbImage};
use serde_json::json;

/// A picture of one colour but for pixel (1, 2).
fn picture(pixel: [u8; 3]) -> RgbImage {
    let mut picture = RgbImage::from_pixel(20, 10, Rgb([40, 80, 120]));
    picture.put_pixel(1, 2, Rgb(pixel));
    picture
}

/// A GIF that shows pictures of these grey levels, each with its delay in hundredths of a second.
fn gif(scratch: &Scratch, name: &str, pictures: &[(u8, u16)], repeat: gif::Repeat) {
    let palette: Vec<u8> = (0..=255).flat_map(|grey| [grey; 3]).collect();
    let mut encoder = gif::Encoder::new(File::create(scratch.path(name)).unwrap(), 8, 4, &palette).unwrap();
    encoder.set_repeat(repeat).unwrap();
    for &(grey, delay) in pictures {
        let frame =
            gif::Frame { width: 8, height: 4, delay, buffer: vec![grey; 32].into(), ..Default::default() };
        encoder.write_frame(&frame).unwrap();
    }
}

fn animation(run: &Run) -> serde_json::Value {
    run.object()["animation"].clone()
}

#[test]
fn every_picture_of_an_animation_is_compared() {
    let scratch = Scratch::new();
    for ending in ["apng", "gif"] {
        let (a, b) = (format!("a.{ending}"), format!("b.{ending}"));
        let animate = |out: &str, gravity: &str| {
            let set = format!("sim.gravity=[0,{gravity},0]");
            scratch.succeed(&[
                "animate",
                "small.json",
                out,
                "--frames",
                "0..9",
                "--size",
                "32x24",
                "--set",
                &set,
            ]);
        };
        animate(&a, "-9.8");
        animate(&b, "-60");
        assert_eq!(scratch.run(&["compare", &a, &a]).code, Some(0));
        let run = scratch.run(&["compare", &a, &b, "--json", "--diff", "d.png"]);
        let found = animation(&run);
        assert_eq!(run.code, Some(1), "{ending}: {found}");
        assert_eq!(
            (&found["pictures_a"], &found["pictures_b"]),
            (&found["pictures_b"], &found["pictures_a"])
        );
        let first = found["first"].as_u64().expect("a picture that differs");
        assert!(first > 0, "the first pictures are equal: {found}");
        assert!(found["differing_pictures"].as_u64() > Some(1), "and all those after it: {found}");
        let shown = image::open(scratch.path("d.png")).unwrap().into_rgb8();
        assert!(
            shown.pixels().any(|pixel| pixel.0 != [0; 3]),
            "the difference is of the picture that differs"
        );
    }
    // A name does not make a still picture of it.
    fs::rename(scratch.path("b.apng"), scratch.path("b.png")).unwrap();
    assert_eq!(scratch.run(&["compare", "a.apng", "b.png"]).code, Some(1));
}

#[test]
fn numbers_times_and_repetitions_are_compared() {
    let scratch = Scratch::new();
    let write = |name: &str, pictures: &[(u8, u16)], repeat| gif(&scratch, name, pictures, repeat);
    let plain = [(10, 5), (20, 5), (30, 5)];
    write("a.gif", &plain, gif::Repeat::Infinite);
    write("same.gif", &plain, gif::Repeat::Infinite);
    write("slow.gif", &[(10, 5), (20, 6), (30, 5)], gif::Repeat::Infinite);
    write("short.gif", &plain[..2], gif::Repeat::Infinite);
    write("once.gif", &plain, gif::Repeat::Finite(1));
    write("last.gif", &[(10, 5), (20, 5), (31, 5)], gif::Repeat::Infinite);
    let compared = |name: &str| scratch.run(&["compare", "a.gif", name, "--json", "--budget", "255:0"]);
    assert_eq!(compared("same.gif").code, Some(0));
    for (name, key, value) in [
        ("slow.gif", "delays", json!(1)),
        ("short.gif", "pictures_b", json!(2)),
        ("once.gif", "plays", json!(true)),
        ("last.gif", "first", json!(2)),
    ] {
        let run = compared(name);
        assert_eq!((run.code, &animation(&run)[key]), (Some(1), &value), "{name}");
    }
    let whole = scratch.read("a.gif");
    fs::write(scratch.path("cut.gif"), &whole[..whole.len() - 20]).unwrap();
    assert_ne!(compared("cut.gif").code, Some(0));
    // What a decoder would not look at is not equal to nothing.
    fs::write(scratch.path("two.gif"), [whole.clone(), whole].concat()).unwrap();
    let two = compared("two.gif");
    assert_eq!(two.code, Some(6), "{}", two.stderr);
}

#[test]
fn folders_behind_links_are_compared_and_a_circle_is_reported() {
    let scratch = Scratch::new();
    for folder in ["a", "b", "elsewhere_a", "elsewhere_b"] {
        fs::create_dir(scratch.path(folder)).unwrap();
    }
    for side in ["a", "b"] {
        symlink(format!("../elsewhere_{side}"), scratch.path(&format!("{side}/linked"))).unwrap();
        picture([1, 2, 3]).save(scratch.path(&format!("{side}/x.png"))).unwrap();
        fs::write(scratch.path(&format!("{side}/notes.txt")), side).unwrap();
    }
    picture([1, 2, 3]).save(scratch.path("elsewhere_a/y.png")).unwrap();
    picture([1, 2, 4]).save(scratch.path("elsewhere_b/y.png")).unwrap();
    let run = scratch.run(&["compare", "a", "b", "--json"]);
    let found = run.object();
    assert_eq!((run.code, found["pictures"].as_array().unwrap().len()), (Some(1), 2), "{found}");
    assert_eq!(found["not_compared"], json!(["notes.txt"]));
    symlink("../elsewhere_b", scratch.path("b/elsewhere_b")).unwrap();
    symlink("../b", scratch.path("elsewhere_b/round")).unwrap();
    let circle = scratch.run(&["compare", "a", "b", "--json"]);
    let found = circle.object();
    let unread = found["unreadable"].to_string();
    assert_eq!(circle.code, Some(6), "{unread}");
    for name in ["elsewhere_b/round", "linked/round"] {
        assert!(unread.contains(&format!(r#""name":"{name}","#)), "{name}: {unread}");
    }
    assert!(unread.contains("leads back to a folder above"), "{unread}");
    assert_eq!(found["pictures"].as_array().unwrap().len(), 2, "the rest is compared: {found}");
}

#[test]
fn what_cannot_be_read_is_reported_and_the_rest_is_compared() {
    let scratch = Scratch::new();
    for folder in ["a", "b"] {
        fs::create_dir(scratch.path(folder)).unwrap();
        picture([1, 2, 3]).save(scratch.path(&format!("{folder}/z.png"))).unwrap();
        let wide = image::ImageBuffer::<image::Luma<u16>, _>::from_pixel(3, 3, image::Luma([258]));
        wide.save(scratch.path(&format!("{folder}/deep.png"))).unwrap();
        fs::write(scratch.path(&format!("{folder}/broken.png")), b"\x89PNG\r\n\x1a\n").unwrap();
    }
    symlink("nowhere.png", scratch.path("a/lost.png")).unwrap();
    picture([1, 2, 3]).save(scratch.path("b/lost.png")).unwrap();
    let run = scratch.run(&["compare", "a", "b", "--json", "--html", "page.html"]);
    let found = run.object();
    assert_eq!(run.code, Some(6), "{found}");
    let unread: Vec<&str> =
        found["unreadable"].as_array().unwrap().iter().map(|u| u["name"].as_str().unwrap()).collect();
    assert_eq!(unread, ["broken.png", "deep.png", "lost.png"]);
    assert_eq!(found["pictures"].as_array().unwrap().len(), 1);
    let page = String::from_utf8(scratch.read("page.html")).unwrap();
    assert!(page.contains("16 bits a channel") && page.matches("<img ").count() == 3, "{page}");
    assert!(page.contains("<h2>deep.png</h2>"));
    // Alone it is an error, too.
    assert_eq!(scratch.run(&["compare", "a/deep.png", "b/deep.png"]).code, Some(6));
}

#[test]
fn a_mask_leaves_out_what_is_black_in_it_and_a_percentage_is_of_the_rest() {
    let scratch = Scratch::new();
    picture([1, 2, 3]).save(scratch.path("a.png")).unwrap();
    picture([1, 2, 9]).save(scratch.path("b.png")).unwrap();
    let mask = |name: &str, at: [u32; 2], color: [u8; 3], around: [u8; 3]| {
        let mut mask = RgbImage::from_pixel(20, 10, Rgb(around));
        mask.put_pixel(at[0], at[1], Rgb(color));
        mask.save(scratch.path(name)).unwrap();
    };
    mask("there.png", [1, 2], [0; 3], [255; 3]);
    mask("beside.png", [2, 2], [0; 3], [255; 3]);
    mask("only.png", [1, 2], [1, 0, 0], [0; 3]);
    mask("black.png", [0, 0], [0; 3], [0; 3]);
    let code = |more: &[&str]| scratch.run(&[&["compare", "a.png", "b.png"], more].concat()).code;
    assert_eq!(code(&["--mask", "there.png"]), Some(0));
    assert_eq!(code(&["--mask", "beside.png"]), Some(1));
    assert_eq!(code(&["--mask", "only.png"]), Some(1));
    assert_eq!(code(&["--mask", "black.png"]), Some(4), "nothing is left to compare");
    // One of 200 pixels.
    assert_eq!((code(&["--budget", "0.5%"]), code(&["--budget", "0.49%"])), (Some(0), Some(1)));
    assert_eq!((code(&["--budget", "6:0.5%"]), code(&["--budget", "5:0.5%"])), (Some(0), Some(1)));
    assert_eq!(code(&["--budget", "0.5%", "--mask", "only.png"]), Some(1), "one of one");
    RgbImage::from_pixel(3, 3, Rgb([255; 3])).save(scratch.path("small.png")).unwrap();
    assert_eq!(code(&["--mask", "small.png"]), Some(2));
}

/// A second picture behind the end of a file, and the picture of an animated PNG that only programs without animation
/// show: a decoder looks at neither.
#[test]
fn pictures_that_a_decoder_passes_over_are_not_equal_to_nothing() {
    let scratch = Scratch::new();
    for name in ["a.png", "a.jpg"] {
        picture([1, 2, 3]).save(scratch.path(name)).unwrap();
        let whole = scratch.read(name);
        for (other, bytes) in [
            ("two", [&whole[..], &whole].concat()),
            ("more", [&whole[..], b"more"].concat()),
            ("cut", whole[..whole.len() - 2].to_vec()),
        ] {
            let other = format!("{other}.{name}");
            fs::write(scratch.path(&other), bytes).unwrap();
            let run = scratch.run(&["compare", name, &other]);
            assert_eq!(run.code, Some(6), "{other}: {}", run.stderr);
            assert!(run.stderr.contains("is cut short, or has more behind its end"), "{}", run.stderr);
        }
    }
    let animated = |name: &str, cover: u8| {
        let mut encoder = png::Encoder::new(File::create(scratch.path(name)).unwrap(), 2, 1);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_animated(2, 0).unwrap();
        encoder.set_sep_def_img(true).unwrap();
        let mut writer = encoder.write_header().unwrap();
        [[cover; 2], [7; 2], [8; 2]].iter().for_each(|pixels| writer.write_image_data(pixels).unwrap());
        writer.finish().unwrap();
    };
    animated("a.apng", 1);
    animated("same.apng", 1);
    animated("cover.apng", 2);
    assert_eq!(scratch.run(&["compare", "a.apng", "same.apng"]).code, Some(0));
    let run = scratch.run(&["compare", "a.apng", "cover.apng", "--json"]);
    let found = animation(&run);
    assert_eq!(
        (run.code, &found["pictures_a"], &found["first"], &found["differing_pictures"]),
        (Some(1), &json!(3), &json!(0), &json!(1)),
        "{found}"
    );
}

#[test]
fn jpeg_pictures_are_compared_as_they_are_shown() {
    let scratch = Scratch::new();
    let encode = |name: &str, orientation: Option<u8>| {
        let mut encoder = JpegEncoder::new_with_quality(File::create(scratch.path(name)).unwrap(), 95);
        if let Some(orientation) = orientation {
            // A TIFF header and one entry: tag 0x0112, SHORT, one value.
            let exif = [
                b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0".as_slice(),
                &[orientation, 0, 0, 0],
                &[0; 4],
            ];
            encoder.set_exif_metadata(exif.concat()).unwrap();
        }
        encoder.write_image(picture([250, 0, 0]).as_raw(), 20, 10, ExtendedColorType::Rgb8).unwrap();
    };
    encode("a.jpg", None);
    encode("b.jpg", Some(1));
    encode("turned.jpg", Some(6));
    assert_eq!(scratch.run(&["compare", "a.jpg", "b.jpg"]).code, Some(0));
    let turned = scratch.run(&["compare", "a.jpg", "turned.jpg", "--json"]);
    assert_eq!((turned.code, &turned.object()["size_b"]), (Some(1), &json!([10, 20])));
}

/// The sides of the screen stand behind the six bytes of the signature.
#[test]
fn an_animation_without_pixels_is_refused() {
    let scratch = Scratch::new();
    gif(&scratch, "a.gif", &[(10, 5), (20, 5)], gif::Repeat::Infinite);
    for sides in [6..8, 8..10, 6..10] {
        let mut bytes = scratch.read("a.gif");
        bytes[sides.clone()].fill(0);
        fs::write(scratch.path("none.gif"), bytes).unwrap();
        let run = scratch.run(&["compare", "none.gif", "none.gif", "--html", "o.html", "--diff", "o.png"]);
        assert_eq!(run.code, Some(6), "{sides:?}: {}", run.stderr);
        assert!(run.stderr.contains("`none.gif`") && run.stderr.contains("no pixels"), "{}", run.stderr);
    }
}

#[test]
fn a_page_does_not_replace_a_picture_of_the_folders() {
    let scratch = Scratch::new();
    fs::create_dir_all(scratch.path("f/g")).unwrap();
    gif(&scratch, "f/g/a.gif", &[(10, 5)], gif::Repeat::Infinite);
    let before = scratch.read("f/g/a.gif");
    for page in ["f/g/a.gif", "f/../f/g/a.gif"] {
        let run = scratch.run(&["compare", "f", "f", "--html", page]);
        assert_eq!(run.code, Some(2), "{page}: {}", run.stderr);
        assert_eq!(scratch.read("f/g/a.gif"), before, "{page}");
    }
    scratch.succeed(&["compare", "f", "f", "--html", "f/g/a.html"]);
}
