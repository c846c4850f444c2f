//! The built-in set is what its generator paints.

use drape::cubemap::FACES;
use drape::texture::Texture;
use drape::texture_source::TextureSource;

use super::paint;

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
