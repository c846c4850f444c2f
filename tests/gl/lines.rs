//! Lines one by one: which pixels each side draws, whatever else is in the picture.

use drape::camera::Camera;
use drape::cloth::Points;
use drape::scene::Scene;

use super::alone::Alone;
use super::device::Device;
use super::object::{Object, objects};

/// Counts over many lines.
#[derive(Clone, Debug, Default)]
pub(crate) struct LineTally {
    pub(crate) lines: usize,
    /// Lines of which both sides draw the same pixels.
    pub(crate) same: usize,
    pub(crate) pixels: usize,
    /// Pixels that only one side draws.
    pub(crate) deviating: usize,
    /// Lines further off than OpenGL 3.3 (section 3.5.1) lets an implementation be: a pixel more
    /// than one away from any of the other side, or more than one pixel more or less.
    pub(crate) wrong: Vec<usize>,
}

impl LineTally {
    /// Draws the cloth's springs, each alone, by both sides.
    pub(crate) fn add(&mut self, device: &mut Device<'_>, scene: &Scene, points: &Points) {
        let camera = Camera::of(scene).unwrap();
        for cloth in objects(scene, points).into_iter().filter(|object| object.lines.is_some()) {
            for (number, &line) in cloth.lines.iter().flatten().enumerate() {
                let own = Alone::new(scene, &camera, &cloth, number, None).depth();
                let only = Object { mesh: cloth.mesh.clone(), lines: Some(vec![line]), ..cloth };
                let gl = device.draw(scene, &[only]).ids;
                let own = pixels(own.iter().map(|&depth| depth < 1.0), scene);
                self.add_line(number, &own, &pixels(gl.iter().map(|&id| id != 0), scene));
            }
        }
    }

    /// What breaks the limits.
    pub(crate) fn faults(&self) -> Vec<String> {
        let mut faults: Vec<_> = self.wrong.iter().map(|line| format!("line {line} is wrong")).collect();
        if self.lines == 0 || self.same * 100 < self.lines * 90 {
            faults.push(format!("only {} of {} lines are the same", self.same, self.lines));
        }
        faults
    }

    fn add_line(&mut self, number: usize, own: &[[i64; 2]], gl: &[[i64; 2]]) {
        let only = |a: &[[i64; 2]], b: &[[i64; 2]]| a.iter().filter(|pixel| !b.contains(pixel)).count();
        let near = |a: [i64; 2], b: [i64; 2]| (a[0] - b[0]).abs() <= 1 && (a[1] - b[1]).abs() <= 1;
        let all_near = |a: &[[i64; 2]], b: &[[i64; 2]]| a.iter().all(|&a| b.iter().any(|&b| near(a, b)));
        let deviating = only(own, gl) + only(gl, own);
        self.lines += 1;
        self.same += usize::from(deviating == 0);
        self.pixels += own.len();
        self.deviating += deviating;
        let lengths = own.len().abs_diff(gl.len()) <= 1;
        let ends = own.is_empty() || gl.is_empty() || (all_near(own, gl) && all_near(gl, own));
        if !(lengths && ends) {
            self.wrong.push(number);
        }
    }
}

/// Column and row of the pixels that are drawn.
fn pixels(drawn: impl Iterator<Item = bool>, scene: &Scene) -> Vec<[i64; 2]> {
    let width = i64::from(scene.render.size[0]);
    (0..).zip(drawn).filter_map(|(i, drawn)| drawn.then_some([i % width, i / width])).collect()
}
