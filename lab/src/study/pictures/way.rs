//! The ways to draw a scene: samples × filter × sphere resolution × arithmetic.

use serde::{Deserialize, Serialize};

use crate::study::extent::Extent;
use drape::render::{Options, Shading};
use drape::scene::{Collider, Filter, Images, Scene};

/// A way to draw the scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Way {
    /// Samples per pixel.
    pub samples: u32,
    /// Whether textures are filtered bilinearly; absent where none is read.
    pub bilinear: Option<bool>,
    /// Latitude and longitude count of the spheres; absent where there are none.
    pub resolution: Option<u32>,
    /// Whether the fragment programs run in binary64.
    pub double: bool,
}

impl Way {
    /// The way in words, such as `4 samples, bilinear, f32`.
    pub fn text(&self) -> String {
        let mut text = format!("{} sample{}", self.samples, if self.samples == 1 { "" } else { "s" });
        if let Some(bilinear) = self.bilinear {
            text += if bilinear { ", bilinear" } else { ", nearest" };
        }
        if let Some(resolution) = self.resolution {
            text += &format!(", spheres {resolution} × {resolution}");
        }
        text + if self.double { ", f64" } else { ", f32" }
    }

    /// `scene` as it is drawn in this way.
    pub(super) fn scene(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.render.samples = self.samples;
        if let Some(bilinear) = self.bilinear {
            scene.render.filter = if bilinear { Filter::Bilinear } else { Filter::Nearest };
        }
        for collider in &mut scene.colliders {
            if let (Collider::Sphere(sphere), Some(n)) = (collider, self.resolution) {
                sphere.resolution = [n, n];
            }
        }
        scene
    }

    /// The options of the renderer for this way.
    pub(super) fn options(&self) -> Options {
        let shading = if self.double { Shading::F64 } else { Shading::F32 };
        Options { shading, ..Options::default() }
    }
}

/// Every way that makes a difference for `scene`, in groups of four that differ in the samples alone.
pub(super) fn ways(scene: &Scene, extent: &Extent) -> Vec<Way> {
    let reads = !Images::of(scene).is_empty();
    let filters = if reads { vec![Some(false), Some(true)] } else { vec![None] };
    let resolutions = if scene.spheres().next().is_none() {
        vec![None]
    } else {
        extent.resolutions.iter().copied().map(Some).collect()
    };
    let mut ways = Vec::new();
    for &bilinear in &filters {
        for &resolution in &resolutions {
            for double in [false, true] {
                let way = |samples| Way { samples, bilinear, resolution, double };
                ways.extend([1, 4, 8, 16].map(way));
            }
        }
    }
    ways
}
