//! The pictures that are timed.

use drape::scene::{Overrides, Scene, load};

use super::repository;

/// The plane from so near that it fills the picture.
const FULL_SCREEN: [&str; 4] =
    ["camera.polar=0", "camera.target=[0,0,0]", "camera.distance=0.5", "render.size=[1920,1080]"];

/// A picture: a stock scene with changes.
pub(super) struct Row {
    pub(super) name: String,
    stock: &'static str,
    sets: Vec<String>,
    /// Whether the cloth is left out.
    bare: bool,
}

impl Row {
    fn new(name: String, stock: &'static str, sets: &[&str]) -> Self {
        let sets = sets.iter().map(|set| (*set).to_owned()).collect();
        Self { name, stock, sets, bare: false }
    }

    /// The scene.
    pub(super) fn scene(&self) -> Scene {
        let path = repository::path(&format!("scenes/{}.json", self.stock));
        let overrides = Overrides { sets: self.sets.clone(), ..Overrides::default() };
        let mut scene = load(&path, &overrides).unwrap().scene;
        if self.bare {
            scene.cloth = None;
        }
        scene
    }
}

/// All rows.
pub(super) fn all() -> Vec<Row> {
    let mut rows = Vec::new();
    let shaders =
        ["wireframe", "normal", "diffuse", "phong", "texture", "displacement", "bump", "mirror", "custom"];
    for samples in [1, 4] {
        let samples_set = format!("render.samples={samples}");
        for shader in shaders {
            let sets = [&*format!("material.shader={shader}"), &samples_set];
            rows.push(Row::new(format!("sphere {shader} x{samples}"), "sphere", &sets));
        }
        for shader in shaders.into_iter().skip(1) {
            let sets = [&*format!("material.shader={shader}"), &samples_set];
            let row =
                Row::new(format!("full {shader} x{samples}"), "plane", &[&FULL_SCREEN[..], &sets].concat());
            rows.push(Row { bare: true, ..row });
        }
    }
    for points in [50, 100, 256, 512, 1024, 2048] {
        let sets = ["width", "height"].map(|side| format!("cloth.num_{side}_points={points}"));
        let sets = [&sets[0], &sets[1], "cloth.pinned=[]", "material.shader=phong"];
        rows.push(Row::new(format!("cloth {points}"), "pinned2", &sets));
    }
    for side in [256, 512, 1024, 2048, 4096, 8192] {
        let size = format!("render.size=[{side},{side}]");
        rows.push(Row::new(format!("pixels {side}"), "sphere", &[&size]));
    }
    rows
}
