//! Pictures with more samples than the renderer offers, as averages of larger pictures.

use super::way::Way;
use drape::cloth::Points;
use drape::error::Result;
use drape::output::png::Pixels;
use drape::render::Renderer;
use drape::scene::Scene;
use drape::texture_source::TextureSource;

/// Latitude and longitude count of the spheres.
const FINE_SPHERE: u32 = 512;

/// The picture drawn with `times` the width and height and 16 samples, box-filtered to the scene's size.
///
/// # Errors
/// Those of the renderer.
pub(super) fn finer(scene: &Scene, textures: &TextureSource, points: &Points, times: u32) -> Result<Pixels> {
    let [width, height] = scene.render.size;
    let best = Way { samples: 16, bilinear: Some(true), resolution: Some(FINE_SPHERE), double: true };
    let mut fine = best.scene(scene);
    fine.render.size = [width * times, height * times];
    let picture = Renderer::new(&fine, textures)?.draw(points, &best.options());
    let [wide, times_] = [picture.width as usize, times as usize];
    let mean = |pixel: usize, channel: usize| {
        let (left, top) = (pixel % width as usize * times_, pixel / width as usize * times_);
        let rows = (top..top + times_).flat_map(|y| (left..left + times_).map(move |x| y * wide + x));
        let sum: u32 = rows.map(|i| u32::from(picture.rgb[3 * i + channel])).sum();
        u8::try_from((sum + times * times / 2) / (times * times)).unwrap_or(u8::MAX)
    };
    let rgba = (0..width as usize * height as usize).map(|i| [mean(i, 0), mean(i, 1), mean(i, 2), 255]);
    Ok(Pixels { width, height, rgba: rgba.collect() })
}
