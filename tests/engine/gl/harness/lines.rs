//! Lines one by one: which pixels each side draws, whatever else is in the picture.

use std::fmt;

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
    /// Of these, pixels that are not explained: where the exact line does not pass on a border
    /// between two pixels, to the resolution of the sides' grids.
    pub(crate) wrong: Vec<String>,
}

/// Each side rounds a line's ends to a grid of 1/256 pixel.
const SNAPPING: f64 = 1.0 / 256.0;

impl LineTally {
    /// Draws the cloth's springs, each alone, by both sides.
    pub(crate) fn add(&mut self, device: &mut Device<'_>, scene: &Scene, points: &Points) {
        let camera = Camera::of(scene).unwrap();
        for cloth in objects(scene, points).into_iter().filter(|object| object.lines.is_some()) {
            for (number, &line) in cloth.lines.iter().flatten().enumerate() {
                let alone = Alone::new(scene, &camera, &cloth, number, None);
                let only = Object { mesh: cloth.mesh.clone(), lines: Some(vec![line]), ..cloth };
                let gl = device.draw(scene, &[only]).ids;
                let own = pixels(alone.depth().iter().map(|&depth| depth < 1.0), scene);
                self.add_line(&alone, &own, &pixels(gl.iter().map(|&id| id != 0), scene));
            }
        }
    }

    fn add_line(&mut self, line: &Alone, own: &[[usize; 2]], gl: &[[usize; 2]]) {
        let mut deviating: Vec<_> = own.iter().filter(|pixel| !gl.contains(pixel)).collect();
        deviating.extend(gl.iter().filter(|pixel| !own.contains(pixel)));
        self.lines += 1;
        self.same += usize::from(deviating.is_empty());
        self.pixels += own.len();
        self.deviating += deviating.len();
        for &pixel in deviating {
            let minor = line.minor_at(pixel);
            if (minor - minor.round()).abs() > SNAPPING {
                self.wrong
                    .push(format!("pixel {pixel:?}, where the line is at {minor}, is on one side only"));
            }
        }
    }

    /// What breaks the limits.
    pub(crate) fn faults(&self) -> Vec<String> {
        let mut faults: Vec<_> = self.wrong.iter().take(3).cloned().collect();
        if self.wrong.len() > faults.len() {
            faults.push(format!("{} such pixels", self.wrong.len()));
        }
        if self.lines == 0 || self.deviating * 1000 > self.pixels {
            faults
                .push(format!("{} of {} pixels of lines are on one side only", self.deviating, self.pixels));
        }
        faults
    }
}

impl fmt::Display for LineTally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { lines, same, pixels, deviating, wrong } = self;
        write!(
            f,
            "{same} of {lines} lines are the same; {deviating} of {pixels} pixels are on one side only, "
        )?;
        write!(f, "{} of them not on a border between two pixels", wrong.len())
    }
}

/// Column and row of the pixels that are drawn.
fn pixels(drawn: impl Iterator<Item = bool>, scene: &Scene) -> Vec<[usize; 2]> {
    let width = scene.render.size[0] as usize;
    (0..).zip(drawn).filter_map(|(i, drawn)| drawn.then_some([i % width, i / width])).collect()
}
