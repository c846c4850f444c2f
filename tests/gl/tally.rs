//! How two pictures differ, pixel by pixel.

use drape::camera::Camera;
use drape::cloth::Points;
use drape::render::Picture;
use drape::scene::Scene;

use super::alone::depth_alone;
use super::device::GlPicture;
use super::object::objects;

/// Units in the last place by which the driver, which computes depth in f32, may be off. Of two
/// surfaces that are nearer to each other, it may show either.
const DEPTH_ERROR: i64 = 3;

/// Counts over one picture.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    /// Pixels in which either side sees something.
    pub(crate) covered: usize,
    /// Of these, pixels in which both see the same primitive.
    pub(crate) same: usize,
    /// Pixels in which both primitives lie, with depths that are equal to the last bit.
    pub(crate) ties: usize,
    /// As `ties`, with depths that differ, by less than the driver's error.
    pub(crate) near_ties: usize,
    /// Pixels for which nothing excuses the difference; the first few in words.
    pub(crate) wrong: usize,
    pub(crate) examples: Vec<String>,
    /// Largest difference in depth where both see the same, in units of the last place.
    pub(crate) depth_error: i64,
    /// Pixels by the largest difference of a channel: 0, 1, more. Where the ids differ, none.
    pub(crate) levels: [usize; 3],
}

impl Tally {
    /// Compares what the library and the driver made of a scene.
    pub(crate) fn between(own: &Picture, gl: &GlPicture, scene: &Scene, points: &Points) -> Self {
        let mut tally = Self::default();
        let mut differing = Vec::new();
        let colors = own.rgb.chunks_exact(3).zip(gl.rgb.chunks_exact(3));
        for (i, (a, b)) in colors.enumerate() {
            let step = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
            if own.ids[i] != gl.ids[i] {
                tally.covered += 1;
                differing.push(i);
            } else if own.ids[i] != 0 {
                tally.covered += 1;
                tally.same += 1;
                tally.levels[usize::from(step.min(2))] += 1;
                tally.depth_error = tally.depth_error.max(ulps(own.depth[i], gl.depth[i]).abs());
            } else if step > 0 {
                tally.wrong(own, gl, i, "the background differs");
            }
        }
        tally.explain(&differing, own, gl, scene, points);
        tally
    }

    /// Finds out why pixels show different primitives.
    fn explain(&mut self, differing: &[usize], own: &Picture, gl: &GlPicture, scene: &Scene, points: &Points) {
        let objects = objects(scene, points);
        let camera = Camera::of(scene).unwrap();
        for &i in differing {
            if gl.ids[i] == 0 || own.ids[i] == 0 {
                self.wrong(own, gl, i, "one side sees nothing");
                continue;
            }
            let (object, number) = (gl.ids[i] >> 24, (gl.ids[i] & 0xFF_FFFF) - 1);
            // Ours is in front, or first: the other one, drawn alone, is as deep or deeper.
            let other = depth_alone(scene, &camera, &objects[object as usize - 1], number as usize);
            match (other[i] < 1.0, ulps(other[i], own.depth[i])) {
                (false, _) => self.wrong(own, gl, i, "the driver's primitive is not there"),
                (true, 0) => self.ties += 1,
                (true, 1..=DEPTH_ERROR) => self.near_ties += 1,
                (true, apart) => self.wrong(own, gl, i, &format!("{apart} units apart in depth")),
            }
        }
    }

    fn wrong(&mut self, own: &Picture, gl: &GlPicture, i: usize, why: &str) {
        self.wrong += 1;
        if self.examples.len() < 4 {
            let (x, y) = (i % own.width as usize, i / own.width as usize);
            self.examples.push(format!("({x}, {y}): {:#x} and {:#x}: {why}", own.ids[i], gl.ids[i]));
        }
    }

    /// What breaks the limits: nothing, if the pictures agree. `identical` is the smallest part
    /// of the covered pixels that must have the same colour.
    pub(crate) fn faults(&self, identical: f64) -> Vec<String> {
        let [same, one, more] = self.levels;
        let mut faults = self.examples.clone();
        if more > 0 {
            faults.push(format!("{more} pixels are more than one level apart"));
        }
        if (same as f64) < identical * self.same as f64 {
            faults.push(format!("{one} of {} pixels are one level apart", self.same));
        }
        if self.depth_error > DEPTH_ERROR {
            faults.push(format!("depths differ by {} units in the last place", self.depth_error));
        }
        if self.same == 0 {
            faults.push("nothing is drawn".to_owned());
        }
        faults
    }
}

/// How many f32 lie between two positive ones.
fn ulps(a: f32, b: f32) -> i64 {
    i64::from(a.to_bits()) - i64::from(b.to_bits())
}
