//! Textures of a folder and cube maps: what is found, what is not opened, what is said.

use std::fs;
use std::path::Path;

use drape::cubemap::{Cubemap, FACES};
use drape::error::Kind;
use drape::texture::Texture;
use drape::texture_source::TextureSource;
use image::{DynamicImage, ImageFormat, Rgb};

use super::encode;

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

/// What the help about a folder ends with.
const REPLACES: &str = "a folder replaces the whole built-in set: copy what you want to keep of it from \
                        textures/ of the source, or name a texture that is there";

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
             the folder holds bark.jpg, stone.png; {REPLACES}"
        )
    );
    let error = source(&folder.path().join("nowhere")).texture("brick").unwrap_err();
    assert_eq!(error.kind, Kind::Scene);
    assert!(error.help.contains("does not exist"), "{error}");
}

#[test]
fn a_full_folder_is_not_listed_to_the_end() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(
        source(folder.path()).texture("x").unwrap_err().help,
        format!("the folder is empty; {REPLACES}")
    );
    for i in 10..35 {
        fs::write(folder.path().join(format!("{i}.txt")), "").unwrap();
    }
    let help = source(folder.path()).texture("x").unwrap_err().help;
    assert!(help.ends_with(&format!("28.txt, 29.txt and 5 more; {REPLACES}")), "{help}");
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

#[test]
fn files_in_memory_go_before_the_built_in_ones() {
    let picture = |color: u8| {
        let image: DynamicImage = image::RgbImage::from_pixel(8, 8, Rgb([color; 3])).into();
        encode(&image, ImageFormat::Png)
    };
    let mut files = std::collections::BTreeMap::from([("texture_1".to_owned(), picture(51))]);
    files.extend(FACES[..5].iter().map(|face| (format!("room/{face}"), picture(102))));
    let source = TextureSource::Memory(files.clone());
    assert_eq!(source.texture("texture_1").unwrap().texel(0, 0)[..3], [0.2; 3]);
    assert_eq!(source.texture("texture_2"), TextureSource::BuiltIn.texture("texture_2"));
    assert_eq!(source.cubemap("cube"), TextureSource::BuiltIn.cubemap("cube"));
    assert_eq!(source.texture("plaid").unwrap_err().kind, Kind::Scene);
    assert_eq!(source.cubemap("room").unwrap_err().message, "there is no texture room/negz");
    files.insert("room/negz".to_owned(), picture(153));
    let room = TextureSource::Memory(files).cubemap("room").unwrap();
    assert_eq!((room.size(), room.faces()[5].texel(0, 0)[0]), (8, 0.6));
}
