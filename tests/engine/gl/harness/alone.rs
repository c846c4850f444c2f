//! One primitive of a scene by itself: where it is and how deep, whatever stands in front of it.

use drape::camera::Camera;
use drape::raster::{self, DrawCall, Framebuffer, NoVaryings, Primitives};
use drape::scene::Scene;
use drape::shader::Uniforms;
use drape::shader::sampler::Sampler2d;
use drape::shader::{default, displacement, wireframe};
use drape::texture::Texture;

use super::object::Object;

/// The corners of a triangle or the ends of a line in clip space.
pub(crate) struct Alone {
    size: [u32; 2],
    corners: Vec<[f32; 4]>,
    uniforms: Uniforms,
}

impl Alone {
    /// Primitive `number` of `object`, whose vertex stage reads `height_map` if there is one.
    pub(crate) fn new(
        scene: &Scene,
        camera: &Camera,
        object: &Object<'_>,
        number: usize,
        height_map: Option<&Texture>,
    ) -> Self {
        let indices: &[u32] = match &object.lines {
            Some(lines) => &lines[number],
            None => &object.mesh.triangles[number],
        };
        let vertices = indices.iter().map(|&i| object.mesh.vertex(i as usize));
        let uniforms = object.uniforms(scene, camera);
        let corners = if let Some(texture) = height_map {
            let sampler = Sampler2d { texture, filter: scene.render.filter, wrap_v: object.wrap_v() };
            let program = displacement::vertex(&uniforms, sampler);
            vertices.map(|vertex| program(&vertex).0).collect()
        } else {
            let program = default::all(&uniforms);
            vertices.map(|vertex| program(&vertex).0).collect()
        };
        Self { size: scene.render.size, corners, uniforms }
    }

    /// Its depths in the whole picture, drawn by `drape::raster`; 1 where it is not.
    pub(crate) fn depth(&self) -> Vec<f32> {
        let mut framebuffer = Framebuffer::new(self.size[0], self.size[1], 1);
        let primitives = match self.corners.len() {
            2 => Primitives::Lines(&[[0, 1]]),
            _ => Primitives::Triangles(&[[0, 1, 2]]),
        };
        let vertex = |&corner: &[f32; 4]| (corner, NoVaryings::default());
        let fragment = wireframe::Fragment { u: self.uniforms };
        let call = DrawCall::new(primitives, self.corners.len(), |i| self.corners[i], vertex, fragment);
        raster::draw(&mut framebuffer, [0.0; 3], &[call], false);
        framebuffer.depth()
    }

    /// By how much a triangle's depth, as a plane, varies over the picture: the size of the terms
    /// from which a driver that works in f32 sums it up.
    pub(crate) fn depth_range(&self) -> f64 {
        let corner = |i: usize| [0, 1, 3].map(|k| f64::from(self.corners[i % 3][k]));
        let opposite = [1, 2, 0].map(|i| cross(corner(i), corner(i + 1)));
        let turn = dot(opposite[0], corner(0));
        let slope = |axis: usize| {
            let sum: f64 = (0..3).map(|i| f64::from(self.corners[i][2]) * opposite[i][axis]).sum();
            (sum / turn).abs()
        };
        slope(0) + slope(1)
    }

    /// Whether a plane of the view volume cuts it.
    pub(crate) fn is_cut(&self) -> bool {
        self.corners.iter().any(|&[x, y, z, w]| x.abs() > w || y.abs() > w || z.abs() > w)
    }

    /// Where a line passes the centre of a pixel's column, or of its row if the line is steep: the
    /// other coordinate in pixels, top row first. Nothing is snapped.
    pub(crate) fn minor_at(&self, pixel: [usize; 2]) -> f64 {
        let (from, to) = (self.window(0), self.window(1));
        let along = [to[0] - from[0], to[1] - from[1]];
        let major = usize::from(along[0].abs() < along[1].abs());
        let part = (pixel[major] as f64 + 0.5 - from[major]) / along[major];
        from[1 - major] + part * along[1 - major]
    }

    /// A corner in the window, in pixels, top row first.
    fn window(&self, corner: usize) -> [f64; 2] {
        let [w, h] = self.size.map(f64::from);
        let [x, y, _, w_clip] = self.corners[corner].map(f64::from);
        [(x / w_clip + 1.0) * w / 2.0, (1.0 - y / w_clip) * h / 2.0]
    }

    /// How thin a triangle is that was not cut: its height over its longest side, in pixels.
    pub(crate) fn thickness(&self) -> f64 {
        let corners = [0, 1, 2].map(|i| self.window(i));
        let side = |i: usize| [0, 1].map(|k| corners[(i + 1) % 3][k] - corners[i][k]);
        let longest = [0, 1, 2].map(|i| side(i)[0] * side(i)[0] + side(i)[1] * side(i)[1]);
        let area = side(0)[0] * side(1)[1] - side(0)[1] * side(1)[0];
        area.abs() / longest.into_iter().fold(0.0, f64::max).sqrt()
    }

    /// How far inside of a triangle's nearest edge the centre of pixel (x, y) lies, in pixels;
    /// negative outside. By edge functions in clip space, so nothing is clipped or snapped.
    pub(crate) fn inside(&self, x: usize, y: usize) -> f64 {
        let [w, h] = self.size.map(f64::from);
        let [px, py] = [(x as f64 + 0.5) * 2.0 / w - 1.0, 1.0 - (y as f64 + 0.5) * 2.0 / h];
        let corner = |i: usize| [0, 1, 3].map(|k| f64::from(self.corners[i % 3][k]));
        let edges = [0, 1, 2].map(|i| cross(corner(i), corner(i + 1)));
        let turn = dot(edges[0], corner(2)).signum();
        let distance = |[a, b, c]: [f64; 3]| {
            let slope = [a * 2.0 / w, b * 2.0 / h];
            turn * (a * px + b * py + c) / (slope[0] * slope[0] + slope[1] * slope[1]).sqrt()
        };
        edges.map(distance).into_iter().fold(f64::INFINITY, f64::min)
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
