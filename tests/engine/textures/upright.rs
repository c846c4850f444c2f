//! Pictures stand as other programs show them: turned by their Exif data, upright and readable on planes, balls and boxes,
//! and ending at the poles of a ball.

use std::fs;

use drape::cloth::Points;
use drape::render::{Options, Picture, Renderer};
use drape::scene::{Overrides, load_text};
use drape::texture::Texture;
use drape::texture_source::TextureSource;
use image::codecs::{jpeg::JpegEncoder, png::PngEncoder};
use image::{ExtendedColorType, ImageEncoder, Rgb, RgbImage};

/// Upper left, upper right, lower left, lower right.
const QUARTERS: [[u8; 3]; 4] = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]];

fn quarters() -> RgbImage {
    RgbImage::from_fn(64, 32, |x, y| Rgb(QUARTERS[usize::from(x >= 32) + 2 * usize::from(y >= 16)]))
}

/// A picture of the scene `objects` with `picture` as texture and height map.
fn draw(picture: &RgbImage, objects: &str, camera: &str, shader: &str) -> Picture {
    let folder = tempfile::tempdir().unwrap();
    picture.save(folder.path().join("own.png")).unwrap();
    let text = format!(
        r#"{{{objects}, "camera": {{{camera}}}, "render": {{"size": [120, 120]}},
            "material": {{"shader": "{shader}", "texture": "own", "height_map": "own"}}}}"#
    );
    let scene = load_text("upright.json", &text, &Overrides::default()).unwrap().scene;
    let source = TextureSource::Folder(folder.path().to_path_buf());
    Renderer::new(&scene, &source).unwrap().draw(&Points::default(), &Options::default())
}

fn pixel(picture: &Picture, [x, y]: [usize; 2]) -> [u8; 3] {
    let at = 3 * (y * picture.width as usize + x);
    [picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]]
}

#[test]
fn pictures_on_planes_are_upright_and_readable() {
    for (normal, polar, azimuth) in [
        ([0, 1, 0], 0, 0),
        ([0, 7, 0], 60, 0),
        ([0, -1, 0], 180, 0),
        ([0, -1, 0], 120, 0),
        ([0, 0, 1], 90, 0),
        ([0, 0, -1], 90, 180),
        ([1, 0, 0], 90, 90),
        ([-1, 0, 0], 90, -90),
        ([1, 0, 1], 80, 45),
        ([0, 2, 3], 80, 0),
        ([0, 3, -2], 40, 0),
    ] {
        let plane = format!(r#""plane": {{"point": [1, 2, 3], "normal": {normal:?}, "friction": 0}}"#);
        let camera = format!(r#""target": [1, 2, 3], "distance": 4, "polar": {polar}, "azimuth": {azimuth}"#);
        let picture = draw(&quarters(), &plane, &camera, "texture");
        let seen = [[52, 52], [68, 52], [52, 68], [68, 68]].map(|at| pixel(&picture, at));
        assert_eq!(seen, QUARTERS, "{normal:?} from {polar}, {azimuth}");
    }
}

#[test]
fn pictures_on_boxes_are_upright_and_readable_from_every_side() {
    let cuboid = r#""box": {"origin": [1, 2, 3], "size": [1.2, 0.9, 1], "friction": 0}"#;
    let sides = [("front", 90, 0), ("right", 90, 90), ("back", 90, 180), ("left", 90, 270)];
    for (side, polar, azimuth) in sides.into_iter().chain([("top", 0, 0), ("bottom", 180, 0)]) {
        let camera = format!(r#""target": [1, 2, 3], "distance": 3, "polar": {polar}, "azimuth": {azimuth}"#);
        let picture = draw(&quarters(), cuboid, &camera, "texture");
        let seen = [[48, 48], [72, 48], [48, 72], [72, 72]].map(|at| pixel(&picture, at));
        assert_eq!(seen, QUARTERS, "{side}");
    }
}

const BALL: &str = r#""sphere": {"origin": [0, 0, 0], "radius": 1, "friction": 0}"#;

#[test]
fn pictures_on_balls_are_upright_and_readable() {
    let picture = draw(&quarters(), BALL, r#""target": [0, 0, 0], "distance": 4"#, "texture");
    let seen = [[52, 52], [68, 52], [52, 68], [68, 68]].map(|at| pixel(&picture, at));
    assert_eq!(seen, QUARTERS);
}

/// The first row of the picture is one pole and the last the other: neither shows the other's colour, and no spike
/// stands there.
#[test]
fn pictures_end_at_the_poles() {
    let half = RgbImage::from_fn(64, 32, |_, y| Rgb(if y < 16 { [0; 3] } else { [255; 3] }));
    for (polar, color) in [(0, [0; 3]), (180, [255; 3])] {
        let camera = format!(r#""target": [0, 0, 0], "distance": 4, "polar": {polar}"#);
        let picture = draw(&half, BALL, &camera, "texture");
        for at in [[59, 59], [60, 60], [61, 58], [56, 63]] {
            assert_eq!(pixel(&picture, at), color, "polar {polar} at {at:?}");
        }
    }
    // Only the lower half is lifted: the outline ends where the ball does.
    let side = draw(&half, BALL, r#""target": [0, 0, 0], "distance": 4"#, "displacement");
    let plain = draw(&half, BALL, r#""target": [0, 0, 0], "distance": 4"#, "phong");
    let top =
        |picture: &Picture| (0..120).find(|&y| (55..65).any(|x| pixel(picture, [x, y]) != [64; 3])).unwrap();
    assert_eq!(top(&side), top(&plain), "a spike at the pole");
}

/// A TIFF header and one entry: tag 0x0112, SHORT, one value.
fn exif(orientation: u8) -> Vec<u8> {
    [b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0".as_slice(), &[orientation, 0, 0, 0], &[0; 4]].concat()
}

/// The four quarters as they are shown for each value of the tag, by the table of Exif 2.3.
#[test]
fn pictures_are_turned_as_their_exif_data_say() {
    let [a, b, c, d] = [0, 1, 2, 3];
    for (orientation, shown) in [
        (1, [a, b, c, d]),
        (2, [b, a, d, c]),
        (3, [d, c, b, a]),
        (4, [c, d, a, b]),
        (5, [a, c, b, d]),
        (6, [c, a, d, b]),
        (7, [d, b, c, a]),
        (8, [b, d, a, c]),
    ] {
        let picture = quarters();
        let (mut jpeg, mut png) = (Vec::new(), Vec::new());
        let mut encoder = JpegEncoder::new_with_quality(&mut jpeg, 98);
        encoder.set_exif_metadata(exif(orientation)).unwrap();
        encoder.write_image(picture.as_raw(), 64, 32, ExtendedColorType::Rgb8).unwrap();
        let mut encoder = PngEncoder::new(&mut png);
        encoder.set_exif_metadata(exif(orientation)).unwrap();
        encoder.write_image(picture.as_raw(), 64, 32, ExtendedColorType::Rgb8).unwrap();
        for bytes in [&jpeg, &png, &moved_back(&png)] {
            let texture = Texture::decode("turned", bytes).unwrap();
            let (w, h) = (texture.width(), texture.height());
            assert_eq!([w, h], if orientation < 5 { [64, 32] } else { [32, 64] }, "{orientation}");
            let places = [[w / 4, h / 4], [3 * w / 4, h / 4], [w / 4, 3 * h / 4], [3 * w / 4, 3 * h / 4]];
            for ([x, y], quarter) in places.into_iter().zip(shown) {
                let off =
                    (0..3).map(|i| (texture.texel(x, y)[i] - f32::from(QUARTERS[quarter][i]) / 255.0).abs());
                assert!(
                    off.fold(0.0, f32::max) < 0.02,
                    "{orientation} at {x}, {y}: {:?}",
                    texture.texel(x, y)
                );
            }
        }
    }
}

/// The PNG with its Exif chunk after the pixels, where it may stand too.
fn moved_back(png: &[u8]) -> Vec<u8> {
    let at = png.windows(4).position(|window| window == b"eXIf").expect("a chunk") - 4;
    let length = 12 + u32::from_be_bytes(png[at..at + 4].try_into().unwrap()) as usize;
    let end = png.len() - 12;
    [&png[..at], &png[at + length..end], &png[at..at + length], &png[end..]].concat()
}

#[test]
fn a_folder_s_pictures_are_turned_too() {
    let folder = tempfile::tempdir().unwrap();
    let mut jpeg = Vec::new();
    let mut encoder = JpegEncoder::new(&mut jpeg);
    encoder.set_exif_metadata(exif(6)).unwrap();
    encoder.write_image(quarters().as_raw(), 64, 32, ExtendedColorType::Rgb8).unwrap();
    fs::write(folder.path().join("own.jpg"), jpeg).unwrap();
    let texture = TextureSource::Folder(folder.path().to_path_buf()).texture("own").unwrap();
    assert_eq!((texture.width(), texture.height()), (32, 64));
}
