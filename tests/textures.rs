//! Textures: what is decoded is what the file says, what cannot be decoded is an error that names
//! the file, and the built-in set is what its generator paints.

#![expect(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

#[path = "../examples/make_textures/paint/mod.rs"]
mod paint;

use std::fs;
use std::io::Cursor;
use std::path::Path;

use drape::cubemap::{Cubemap, FACES};
use drape::error::Kind;
use drape::texture::{MAX_SIDE, Texture};
use drape::texture_source::TextureSource;
use image::{DynamicImage, GrayAlphaImage, GrayImage, ImageBuffer, ImageFormat, Luma, Rgb, Rgba, RgbaImage};
use proptest::prelude::*;

fn encode(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn png(image: impl Into<DynamicImage>) -> Vec<u8> {
    encode(&image.into(), ImageFormat::Png)
}

/// A picture with a different colour in every texel.
fn rgb(width: u32, height: u32) -> DynamicImage {
    let byte = |n: u32| u8::try_from(n % 256).unwrap();
    image::RgbImage::from_fn(width, height, |x, y| Rgb([byte(x * 7), byte(y * 11), byte(x + y)])).into()
}

fn decode(bytes: &[u8]) -> Texture {
    Texture::decode("sample", bytes).unwrap()
}

fn texels(bytes: &[u8]) -> Vec<[f32; 4]> {
    decode(bytes).texels().to_vec()
}

#[test]
fn all_256_bytes_survive_the_way_to_unit_numbers_and_back() {
    let all: Vec<u8> = (0..=255).collect();
    let texture = decode(&png(GrayImage::from_raw(16, 16, all.clone()).unwrap()));
    for (&byte, texel) in all.iter().zip(texture.texels()) {
        let unit = f32::from(byte) / 255.0;
        assert_eq!(texel, &[unit, unit, unit, 1.0], "byte {byte}");
        assert_eq!((texel[0] * 255.0).round(), f32::from(byte), "byte {byte} comes back");
    }
}

#[test]
fn all_65536_words_are_rounded_once() {
    let all: Vec<u16> = (0..=u16::MAX).collect();
    let image = ImageBuffer::<Luma<u16>, _>::from_raw(256, 256, all.clone()).unwrap();
    for (&word, texel) in all.iter().zip(texels(&png(image))) {
        let unit = f32::from(word) / 65535.0;
        assert_eq!(texel, [unit, unit, unit, 1.0], "word {word}");
    }
}

#[test]
fn every_channel_layout_gives_rgb_and_one() {
    let unit8 = |c: [u8; 3]| [f32::from(c[0]) / 255.0, f32::from(c[1]) / 255.0, f32::from(c[2]) / 255.0, 1.0];
    let grey_alpha = GrayAlphaImage::from_raw(2, 1, vec![9, 0, 200, 77]).unwrap();
    assert_eq!(texels(&png(grey_alpha)), [unit8([9; 3]), unit8([200; 3])], "grey and alpha");
    let image = rgb(5, 3);
    let expected: Vec<_> = image.to_rgb8().pixels().map(|p| unit8(p.0)).collect();
    assert_eq!(texels(&png(image)), expected, "RGB");
    let rgba = RgbaImage::from_raw(2, 1, vec![1, 2, 3, 0, 250, 251, 252, 128]).unwrap();
    assert_eq!(texels(&png(rgba)), [unit8([1, 2, 3]), unit8([250, 251, 252])], "RGBA");

    let words = [0x0102_u16, 0x8001, 0xFFFE];
    let expected = [words.map(|w| f32::from(w) / 65535.0)].map(|[r, g, b]| [r, g, b, 1.0]);
    let rgb16 = ImageBuffer::<Rgb<u16>, _>::from_raw(1, 1, words.to_vec()).unwrap();
    assert_eq!(texels(&png(rgb16)), expected, "RGB at 16 bits");
    let rgba16 = ImageBuffer::<Rgba<u16>, _>::from_raw(1, 1, [&words[..], &[7]].concat()).unwrap();
    assert_eq!(texels(&png(rgba16)), expected, "RGBA at 16 bits");
}

#[test]
fn rows_run_from_the_top_and_columns_from_the_left() {
    let texture = decode(&png(rgb(5, 3)));
    assert_eq!((texture.width(), texture.height()), (5, 3));
    assert_eq!(texture.texel(4, 0), [28.0 / 255.0, 0.0, 4.0 / 255.0, 1.0]);
    assert_eq!(texture.texel(0, 2), [0.0, 22.0 / 255.0, 2.0 / 255.0, 1.0]);
}

/// A JPEG of one flat colour loses next to nothing, in colour and in grey.
#[test]
fn jpeg_is_decoded() {
    for (color, tolerance) in [([200, 90, 30], 3.0), ([128, 128, 128], 0.0)] {
        let image: DynamicImage = image::RgbImage::from_pixel(17, 9, Rgb(color)).into();
        let texture = decode(&encode(&image, ImageFormat::Jpeg));
        assert_eq!((texture.width(), texture.height()), (17, 9));
        for texel in texture.texels() {
            for (&got, want) in texel.iter().zip(color.map(f32::from)) {
                assert!((got * 255.0 - want).abs() <= tolerance + 1e-3, "{texel:?} for {color:?}");
            }
            assert_eq!(texel[3], 1.0);
        }
    }
    let grey: DynamicImage = GrayImage::from_pixel(8, 8, Luma([64])).into();
    assert_eq!(
        texels(&encode(&grey, ImageFormat::Jpeg)),
        [[64.0 / 255.0, 64.0 / 255.0, 64.0 / 255.0, 1.0]; 64]
    );
}

fn assert_refused(bytes: &[u8], reason: &str) {
    let error = Texture::decode("walls/stone.png", bytes).unwrap_err();
    assert_eq!(error.kind, Kind::Scene, "{error}");
    assert!(error.message.contains("walls/stone.png"), "names the file: {error}");
    assert!(error.message.contains(reason), "says {reason:?}: {error}");
}

#[test]
fn other_formats_and_nothing_are_refused() {
    for bytes in [&b""[..], b"GIF89a\x01\x00\x01\x00\x00\x00\x00;", b"P3 1 1 255 0 0 0", b"\xFF", b"\x89PNG"]
    {
        assert_refused(bytes, "neither a PNG nor a JPEG");
    }
}

/// Each cut, down to the last byte: a decoder that fills the rest with grey would pass none.
#[test]
fn a_file_cut_short_is_refused_at_every_length() {
    for (format, signature) in [(ImageFormat::Png, 8), (ImageFormat::Jpeg, 3)] {
        let whole = encode(&rgb(20, 20), format);
        decode(&whole);
        for length in signature..whole.len() {
            assert_refused(&whole[..length], "cut short");
        }
    }
}

#[test]
fn a_corrupt_checksum_is_refused() {
    let mut bytes = png(rgb(20, 20));
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0x10;
    assert_refused(&bytes, "cannot be decoded");
}

/// The size is refused from the header alone: the files hold no picture at all.
#[test]
fn a_bomb_is_refused_before_anything_is_allocated() {
    for (width, height) in [(MAX_SIDE + 1, 1), (1, MAX_SIDE + 1), (MAX_SIDE, MAX_SIDE), (8192, 8193)] {
        let header = [width.to_be_bytes(), height.to_be_bytes()].concat();
        let bomb = png_of(&[(b"IHDR", &[&header[..], &[8, 2, 0, 0, 0]].concat()), (b"IDAT", &[])]);
        assert_refused(&bomb, &format!("{width} x {height} is too large"));
    }
    let header = [[0x7F, 0xFF, 0xFF, 0xFF, 0x7F, 0xFF, 0xFF, 0xFF, 8, 2, 0, 0, 0]].concat();
    assert_refused(&png_of(&[(b"IHDR", &header), (b"IDAT", &[])]), "");
}

/// Four texels of two bits that point into a palette of three colours.
#[test]
fn a_palette_is_looked_up() {
    let stored_row = [0x78, 1, 1, 2, 0, 0xFD, 0xFF, 0, 0b00_01_10_01, 0, 0x5C, 0, 0x5B];
    let bytes = png_of(&[
        (b"IHDR", &[0, 0, 0, 4, 0, 0, 0, 1, 2, 3, 0, 0, 0]),
        (b"PLTE", &[255, 0, 0, 0, 255, 0, 0, 0, 255]),
        (b"tRNS", &[0, 128]),
        (b"IDAT", &stored_row),
    ]);
    let [red, green, blue] = [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]];
    assert_eq!(texels(&bytes), [red, green, blue, green]);
}

/// A PNG of these chunks and an end.
fn png_of(chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, data) in chunks.iter().chain(&[(b"IEND", &[][..])]) {
        let body = [&kind[..], data].concat();
        bytes.extend(u32::try_from(data.len()).unwrap().to_be_bytes());
        bytes.extend(&body);
        bytes.extend(crc32(&body).to_be_bytes());
    }
    bytes
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { (c >> 1) ^ 0xEDB8_8320 } else { c >> 1 })
    })
}

#[test]
fn the_longest_side_is_accepted() {
    for (width, height) in [(MAX_SIDE, 1), (1, MAX_SIDE)] {
        let image = GrayImage::from_pixel(width, height, Luma([3]));
        let texture = decode(&png(image));
        assert_eq!((texture.width(), texture.height()), (width as usize, height as usize));
    }
}

proptest! {
    /// Damage anywhere is an error or a picture, and an error always names the file.
    #[test]
    fn damaged_files_never_panic(at in 0..2000_usize, bits in 1..=255_u8, jpeg: bool) {
        let mut bytes = encode(&rgb(20, 20), if jpeg { ImageFormat::Jpeg } else { ImageFormat::Png });
        let at = at % bytes.len();
        bytes[at] ^= bits;
        if let Err(error) = Texture::decode("damaged", &bytes) {
            prop_assert_eq!(error.kind, Kind::Scene);
            prop_assert!(error.message.contains("damaged"));
        }
    }
}

#[test]
fn from_rgb_wants_exactly_width_times_height() {
    let rgb = [[0.0, 0.5, 1.0], [0.25, 0.75, 0.125]];
    assert_eq!(Texture::from_rgb(1, 2, &rgb).unwrap().texel(0, 1), [0.25, 0.75, 0.125, 1.0]);
    for (width, height) in [(2, 2), (1, 1), (0, 2), (usize::MAX, 2)] {
        assert_eq!(Texture::from_rgb(width, height, &rgb).unwrap_err().kind, Kind::Internal);
    }
    assert_eq!(Texture::from_rgb(0, 0, &[]).unwrap_err().kind, Kind::Internal);
}

fn flat(width: usize, height: usize) -> Texture {
    Texture::from_rgb(width, height, &vec![[0.5; 3]; width * height]).unwrap()
}

#[test]
fn a_cube_map_wants_square_faces_of_one_size() {
    let cube = Cubemap::new("room", [(); 6].map(|()| flat(4, 4))).unwrap();
    assert_eq!((cube.size(), cube.faces().len()), (4, 6));
    for (face, name) in FACES.iter().enumerate() {
        let mut faces = [(); 6].map(|()| flat(4, 4));
        faces[face] = flat(4, 3);
        let error = Cubemap::new("room", faces).unwrap_err();
        assert_eq!(error.kind, Kind::Scene);
        assert_eq!(error.message, format!("cube map room: face {name} is 4 x 3: not square"));
    }
    let mut faces = [(); 6].map(|()| flat(4, 4));
    faces[4] = flat(8, 8);
    let message = Cubemap::new("room", faces).unwrap_err().message;
    assert_eq!(message, "cube map room: face posz is 8 x 8: differs from posx, which is 4 x 4");
}

/// A folder with the given files, each a small picture in its own colour.
fn folder(files: &[(&str, [u8; 3])]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (file, color) in files {
        let path = folder.path().join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        let image: DynamicImage = image::RgbImage::from_pixel(8, 8, Rgb(*color)).into();
        fs::write(&path, encode(&image, ImageFormat::from_path(&path).unwrap())).unwrap();
    }
    folder
}

fn source(path: &Path) -> TextureSource {
    TextureSource::Folder(path.to_owned())
}

#[test]
fn a_folder_gives_png_before_jpg_before_jpeg() {
    let (first, second, third) = ([255, 0, 0], [0, 255, 0], [0, 0, 255]);
    let folder = folder(&[
        ("a.png", first),
        ("a.jpg", second),
        ("a.jpeg", third),
        ("b.jpg", second),
        ("b.jpeg", third),
        ("c.jpeg", third),
    ]);
    for (name, strongest) in [("a", 0), ("b", 1), ("c", 2)] {
        let texel = source(folder.path()).texture(name).unwrap().texel(3, 3);
        assert!(texel[strongest] > 0.9, "{name}: {texel:?}");
    }
}

#[test]
fn a_missing_texture_says_what_was_looked_for_and_what_is_there() {
    let folder = folder(&[("stone.png", [9; 3]), ("bark.jpg", [9; 3])]);
    let error = source(folder.path()).texture("brick").unwrap_err();
    assert_eq!(error.kind, Kind::Scene);
    let place = folder.path().display();
    assert_eq!(
        error.to_string(),
        format!(
            "there is no texture brick in {place}: looked for brick.png, brick.jpg and brick.jpeg; \
             the folder holds bark.jpg, stone.png"
        )
    );
    let error = source(&folder.path().join("nowhere")).texture("brick").unwrap_err();
    assert_eq!(error.kind, Kind::Scene);
    assert!(error.help.contains("does not exist"), "{error}");
}

#[test]
fn a_full_folder_is_not_listed_to_the_end() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(source(folder.path()).texture("x").unwrap_err().help, "the folder is empty");
    for i in 10..35 {
        fs::write(folder.path().join(format!("{i}.txt")), "").unwrap();
    }
    let help = source(folder.path()).texture("x").unwrap_err().help;
    assert!(help.ends_with("28.txt, 29.txt and 5 more"), "{help}");
}

#[test]
fn a_name_cannot_lead_out_of_the_folder() {
    let outer = folder(&[("secret.png", [9; 3]), ("inner/open.png", [9; 3])]);
    let inner = source(&outer.path().join("inner"));
    inner.texture("open").unwrap();
    let absolute = outer.path().join("secret").display().to_string();
    for name in ["../secret", "..", ".", "", "/", "./open", "open/", &absolute] {
        for error in [inner.texture(name).unwrap_err(), inner.cubemap(name).unwrap_err()] {
            assert_eq!(error.kind, Kind::Scene);
            assert!(error.message.contains("is not the name of a texture"), "{name:?}: {error}");
        }
    }
}

#[test]
fn what_is_not_a_readable_picture_is_an_error_that_names_it() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("a.png")).unwrap();
    assert!(source(folder.path()).texture("a").unwrap_err().message.contains("no texture a"));
    fs::write(folder.path().join("b.png"), "text").unwrap();
    let error = source(folder.path()).texture("b").unwrap_err();
    assert_eq!(error.kind, Kind::Scene);
    assert!(error.message.contains("b.png"), "{error}");
}

#[test]
fn a_cube_map_of_a_folder_is_in_order_and_complete() {
    let files = FACES.map(|face| format!("sky/{face}.png"));
    let colors: Vec<_> = (1..=6_u8).zip(&files).map(|(i, file)| (file.as_str(), [i; 3])).collect();
    let folder = folder(&colors);
    let cube = source(folder.path()).cubemap("sky").unwrap();
    for (face, want) in cube.faces().iter().zip(1..=6_u8) {
        assert_eq!(face.texel(0, 0)[0], f32::from(want) / 255.0);
    }
    fs::remove_file(folder.path().join("sky/negy.png")).unwrap();
    let error = source(folder.path()).cubemap("sky").unwrap_err();
    assert!(error.message.contains("looked for negy.png"), "{error}");
}

/// A broken neighbour does no harm: only what is asked for is opened.
#[test]
fn only_what_is_asked_for_is_opened() {
    let folder = folder(&[("good.png", [9; 3])]);
    for broken in ["other.png", "good.jpg", "good.jpeg"] {
        fs::write(folder.path().join(broken), "no picture").unwrap();
    }
    source(folder.path()).texture("good").unwrap();
}

#[test]
fn unknown_built_in_names_list_the_known_ones() {
    let error = TextureSource::BuiltIn.texture("texture_9").unwrap_err();
    assert_eq!(error.kind, Kind::Scene);
    let known = "texture_1, texture_2, texture_3, texture_4";
    assert!(error.message.contains("\"texture_9\"") && error.help.contains(known), "{error}");
    let error = TextureSource::BuiltIn.cubemap("texture_1").unwrap_err();
    assert!(error.message.contains("cube map \"texture_1\"") && error.help.contains("cube"), "{error}");
}

fn built_in() -> Vec<(String, Texture)> {
    let texture = |name: String| (TextureSource::BuiltIn.texture(&name).unwrap(), name);
    let mut all: Vec<_> = (1..=4).map(|i| texture(format!("texture_{i}"))).map(|(t, n)| (n, t)).collect();
    let cube = TextureSource::BuiltIn.cubemap("cube").unwrap();
    all.extend(FACES.iter().zip(cube.faces()).map(|(face, t)| (format!("cube/{face}"), t.clone())));
    all
}

/// The files hold what the generator paints, under the right names and in the right order.
#[test]
fn the_built_in_set_is_what_its_generator_paints() {
    let painted = paint::all();
    assert_eq!(painted.len(), 10);
    for ((name, picture), (known, texture)) in painted.iter().zip(built_in()) {
        assert_eq!(*name, known);
        assert_eq!((texture.width(), texture.height()), (paint::SIZE, paint::SIZE), "{name}");
        let unit = |rgb: &[u8; 3]| rgb.map(|c| f32::from(c) / 255.0);
        let differing = picture.iter().zip(texture.texels()).filter(|(rgb, t)| unit(rgb) != t[..3]);
        assert_eq!(differing.count(), 0, "{name} differs from what is painted");
    }
}

/// Mean absolute difference of two rows of texels, in steps of 1/255.
fn contrast(a: &[[f32; 4]], b: &[[f32; 4]]) -> f32 {
    assert_eq!(a.len(), b.len());
    let differences = a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| (x - y).abs());
    differences.sum::<f32>() * 255.0 / (3 * a.len()) as f32
}

/// Row `y` (or column, if `upright`) of a texture.
fn line(texture: &Texture, upright: bool, y: usize) -> Vec<[f32; 4]> {
    (0..texture.width()).map(|x| if upright { texture.texel(y, x) } else { texture.texel(x, y) }).collect()
}

/// Whether opposite sides join: the step from one to the other is no larger than those of the four
/// texels beside it (a thread of the plaid is four wide).
fn joins(texture: &Texture, upright: bool) -> bool {
    let last = texture.width() - 1;
    let step = |a: usize, b: usize| contrast(&line(texture, upright, a), &line(texture, upright, b));
    let beside = (0..4).map(|k| step(k, k + 1).max(step(last - k - 1, last - k))).fold(0.0, f32::max);
    step(last, 0) <= 1.25 * beside + 0.5
}

#[test]
fn pictures_join_where_they_go_around() {
    for (name, upright) in [
        ("texture_1", true),
        ("texture_2", true),
        ("texture_2", false),
        ("texture_3", true),
        ("texture_3", false),
    ] {
        let texture = TextureSource::BuiltIn.texture(name).unwrap();
        assert!(joins(&texture, upright), "{name} has a seam (upright: {upright})");
    }
    assert!(
        !joins(&TextureSource::BuiltIn.texture("texture_1").unwrap(), false),
        "sky and ground do not join"
    );
}

/// Face, s and t of a direction: table 8.19 of the OpenGL 4.6 specification.
fn lookup([x, y, z]: [f64; 3]) -> (usize, f64, f64) {
    let (face, sc, tc, major) = if x.abs() >= y.abs() && x.abs() >= z.abs() {
        if x > 0.0 { (0, -z, -y, x) } else { (1, z, -y, x) }
    } else if y.abs() >= z.abs() {
        if y > 0.0 { (2, x, z, y) } else { (3, x, -z, y) }
    } else if z > 0.0 {
        (4, x, -y, z)
    } else {
        (5, -x, -y, z)
    };
    (face, (sc / major.abs() + 1.0) / 2.0, (tc / major.abs() + 1.0) / 2.0)
}

/// The texel of a cube map in a direction.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "s and t are in 0..=1")]
fn look(cube: &Cubemap, direction: [f64; 3]) -> (usize, [f32; 4]) {
    let (face, s, t) = lookup(direction);
    let texel = |place: f64| ((place * cube.size() as f64) as usize).min(cube.size() - 1);
    (face, cube.faces()[face].texel(texel(s), texel(t)))
}

/// Directions of the middles of a line of texels that runs along an edge between the faces on which
/// coordinates `a` and `b` have these signs, `outward` texels from the edge, on the face of `a`.
fn along_edge(a: (usize, f64), b: (usize, f64), outward: f64, size: usize) -> Vec<[f64; 3]> {
    let place = |i: usize| (i as f64 + 0.5) / size as f64 * 2.0 - 1.0;
    let mut direction = [0.0; 3];
    direction[a.0] = a.1;
    direction[b.0] = b.1 * (1.0 - 2.0 * (outward + 0.5) / size as f64);
    let free = 3 - a.0 - b.0;
    let at = |i| {
        let mut direction = direction;
        direction[free] = place(i);
        direction
    };
    (0..size).map(at).collect()
}

/// The step across one edge of the cube, and the larger of the steps beside it.
fn edge_steps(cube: &Cubemap, a: (usize, f64), b: (usize, f64)) -> (f32, f32) {
    let texels = |a, b, outward, face: &mut Vec<usize>| -> Vec<_> {
        let seen = along_edge(a, b, outward, cube.size()).into_iter().map(|d| look(cube, d));
        let (faces, texels): (Vec<_>, Vec<_>) = seen.unzip();
        assert!(faces.iter().all(|f| *f == faces[0]), "a line of texels lies on one face");
        face.push(faces[0]);
        texels
    };
    let mut faces = Vec::new();
    let [a1, a0] = [1.0, 0.0].map(|outward| texels(a, b, outward, &mut faces));
    let [b0, b1] = [0.0, 1.0].map(|outward| texels(b, a, outward, &mut faces));
    assert!(faces[0] == faces[1] && faces[2] == faces[3] && faces[0] != faces[2], "{faces:?}");
    (contrast(&a0, &b0), contrast(&a1, &a0).max(contrast(&b0, &b1)))
}

/// Edges of a cube map at which the picture breaks.
fn seams(cube: &Cubemap) -> Vec<String> {
    let mut found = Vec::new();
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        for (sa, sb) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let (across, beside) = edge_steps(cube, (a, sa), (b, sb));
            if across > 1.25 * beside + 0.5 {
                found.push(format!("axes {a}{sa:+} and {b}{sb:+}: {across} against {beside}"));
            }
        }
    }
    found
}

#[test]
fn the_cube_map_has_no_seams() {
    let cube = TextureSource::BuiltIn.cubemap("cube").unwrap();
    assert_eq!(seams(&cube), Vec::<String>::new());
}

/// The check above sees each face that is turned, mirrored or in the wrong place.
#[test]
fn a_wrong_face_is_a_seam() {
    let cube = TextureSource::BuiltIn.cubemap("cube").unwrap();
    let size = cube.size();
    for face in 0..6 {
        let texel = |x: usize, y: usize| cube.faces()[face].texel(x, y);
        let changes: [&dyn Fn(usize, usize) -> [f32; 4]; 3] =
            [&|x, y| texel(size - 1 - x, y), &|x, y| texel(x, size - 1 - y), &|x, y| texel(y, size - 1 - x)];
        for (number, change) in changes.iter().enumerate() {
            let rgb = (0..size * size).map(|i| change(i % size, i / size)).map(|[r, g, b, _]| [r, g, b]);
            let mut faces = cube.faces().clone();
            faces[face] = Texture::from_rgb(size, size, &rgb.collect::<Vec<_>>()).unwrap();
            let changed = Cubemap::new("changed", faces).unwrap();
            assert_ne!(seams(&changed), Vec::<String>::new(), "{}, change {number}", FACES[face]);
        }
        let mut faces = cube.faces().clone();
        faces.swap(face, (face + 1) % 6);
        assert_ne!(seams(&Cubemap::new("changed", faces).unwrap()), Vec::<String>::new(), "{}", FACES[face]);
    }
}
