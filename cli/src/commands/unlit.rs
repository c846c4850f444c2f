//! How much of a picture only ambient light reaches.

use drape::error::Result;
use drape::math::Vec3;
use drape::render::{Options, Renderer};
use drape::scene::{Scene, Shader};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;

/// Width of the picture in which pixels are counted.
const WIDTH: f64 = 160.0;

/// Where more than this is unlit, something is to be done.
const MOST: f64 = 0.5;

/// So strong a light that whatever it reaches is white.
const BRIGHT: f64 = 1e14;

/// What to do where most of what is seen is unlit, of which `part` is; empty where it is not.
///
/// # Errors
/// As [`part`].
pub(crate) fn hint(scene: &Scene, unlit: Option<f64>) -> Result<String> {
    let Some(share) = unlit.filter(|share| *share > MOST) else { return Ok(String::new()) };
    let mut both = scene.clone();
    both.materials_mut().for_each(|material| material.two_sided = true);
    // A side that is turned to the camera may face away from the light all the same.
    let cured = part(&both)?.is_some_and(|rest| rest <= MOST);
    let cure = if cured { "material.two_sided=true lights both sides, or move" } else { "move" };
    Ok(format!(
        "\nhint        {:.0} % of what is seen at the start faces away from the light: {cure} light.position\n",
        100.0 * share
    ))
}

/// The part of what is seen of lit objects at the start that faces away from the light, from 0 to 1; nothing if no
/// lit object is seen.
///
/// # Errors
/// Those of a simulation and a renderer of the scene.
pub(crate) fn part(scene: &Scene) -> Result<Option<f64>> {
    let is_lit = |shader: Shader| {
        matches!(
            shader,
            Shader::Diffuse | Shader::Phong | Shader::Bump | Shader::Displacement | Shader::Custom
        )
    };
    let lit: Vec<bool> = scene.materials().map(|material| is_lit(material.shader)).collect();
    if !lit.contains(&true) {
        return Ok(None);
    }
    let mut scene = scene.clone();
    let [width, height] = scene.render.size.map(f64::from);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 16384")]
    let rows = (height * (WIDTH / width)).clamp(1.0, 16_384.0) as u32;
    (scene.render.size, scene.render.samples) = ([160, rows], 1);
    scene.light.intensity = Vec3::repeat(BRIGHT);
    for material in scene.materials_mut() {
        (material.shader, material.kd, material.color) = (Shader::Diffuse, 1.0, Vec3::repeat(1.0));
    }
    let start = Simulation::new(&scene)?;
    let renderer = Renderer::new(&scene, &TextureSource::BuiltIn)?;
    let picture = renderer.draw(start.positions(), &Options { ids: true, ..Options::default() });
    let (mut seen, mut dark) = (0_u32, 0_u32);
    for (id, rgb) in picture.ids.iter().zip(picture.rgb.as_chunks::<3>().0) {
        let object = (id >> 24) as usize;
        if object > 0 && lit[object - 1] {
            seen += 1;
            dark += u32::from(*rgb == [0; 3]);
        }
    }
    Ok((seen > 0).then(|| f64::from(dark) / f64::from(seen)))
}
