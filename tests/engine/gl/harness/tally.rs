//! How two pictures differ, pixel by pixel, and why.

use drape::camera::Camera;
use drape::render::Picture;
use drape::scene::Scene;
use drape::texture::Texture;

use super::alone::Alone;
use super::device::GlPicture;
use super::object::Object;
use super::seams::seams;

/// The driver sums up depth in f32 from terms as large as 1 + `depth_range`. By this many 2^-24
/// of that it may be off, and of two surfaces that are nearer to each other it may show either.
const DEPTH_ERROR: f64 = 3.0;

/// Where a plane of the view volume cuts a triangle, new corners arise, and each side rounds them
/// to its grid of 1/256 pixel. So much nearer to an edge, either side may be right.
const SNAPPING: f64 = 1.0 / 256.0;

/// A triangle that is thinner, in pixels, has attributes so steep that their f32 planes in the
/// driver lose sight of it. In the one such case here ours are those of the formulas in f64.
const NARROW: f64 = 1.0 / 16.0;

/// The part of the pixels that must have the same colour on both sides, if ours are not the nearer
/// ones to the formulas in f64; so large is also the part that must have the colour of these.
const IDENTICAL: f64 = 0.999;

/// The part that must have the same colour in any case. Where a colour is a texel and nothing else, the
/// last bits of texture coordinates and directions show, and the driver loses more of them.
const NEARER: f64 = 0.997;

/// After so many pixels no more are looked into, for each takes a picture of its own: the rest of
/// those that differ is wrong.
const ENOUGH: usize = 100;

/// Counts over one picture.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    /// Pixels in which either side sees something.
    pub(crate) covered: usize,
    /// Of these, pixels in which both see the same primitive.
    pub(crate) same: usize,
    /// Pixels in which both primitives lie, at depths that are equal to the last bit.
    pub(crate) ties: usize,
    /// As `ties`, at depths that differ by less than the driver's error.
    pub(crate) near_ties: usize,
    /// Pixels whose centre lies on the edge of a triangle that was cut, to the grid's resolution.
    pub(crate) cut_edges: usize,
    /// Pixels in which a line is seen on one side, and something as deep on the other.
    pub(crate) line_ties: usize,
    /// Pixels in which a line is on one side only, or behind on one side only.
    pub(crate) lines: usize,
    /// Pixels for which nothing excuses the difference.
    pub(crate) wrong: usize,
    /// The first few of `wrong`, in words.
    pub(crate) examples: Vec<String>,
    /// Largest difference in depth where both see the same triangle, in units of `DEPTH_ERROR`.
    pub(crate) depth_error: f64,
    /// Pixels that see the same, by the largest difference of a channel: 0, 1, more.
    pub(crate) levels: [usize; 3],
    /// Pixels more than one level apart on a seam of the cube map, or in a triangle that is
    /// narrow or was cut.
    pub(crate) jumps: usize,
    /// Pixels that see the same, and have another colour than the formulas in f64: ours, the driver's.
    pub(crate) rounded: [usize; 2],
}

/// The two sides, and what they drew.
struct Sides<'a> {
    own: &'a Picture,
    /// As `own`, with fragment programs in f64.
    exact: &'a Picture,
    gl: &'a GlPicture,
    scene: &'a Scene,
    camera: Camera,
    objects: &'a [Object<'a>],
    /// What the objects' vertex stages read.
    height_maps: Vec<Option<Texture>>,
}

impl Tally {
    /// Compares what the library and the driver made of a scene.
    pub(crate) fn between(
        [own, exact]: [&Picture; 2],
        gl: &GlPicture,
        scene: &Scene,
        objects: &[Object<'_>],
    ) -> Self {
        let height_maps = objects.iter().map(Object::height_map).collect();
        let sides = Sides { own, exact, gl, scene, camera: Camera::of(scene).unwrap(), objects, height_maps };
        let mut tally = Self::default();
        let mut far = Vec::new();
        for i in 0..own.ids.len() {
            tally.covered += usize::from(own.ids[i] != 0 || gl.ids[i] != 0);
            if own.ids[i] == gl.ids[i] {
                let step = tally.add_same(&sides, i);
                far.extend((step > 1).then_some(i));
            } else {
                tally.add_differing(&sides, i);
            }
        }
        tally.excuse_jumps(&sides, &far);
        tally
    }

    /// Takes out of the pixels more than one level apart those in which that has a reason.
    fn excuse_jumps(&mut self, sides: &Sides<'_>, far: &[usize]) {
        if far.is_empty() || far.len() > self.same / 10_000 + 1 {
            return;
        }
        let seams = seams(sides.scene, sides.objects);
        let steep = |triangle: Alone| triangle.is_cut() || triangle.thickness() < NARROW;
        let excused = |&&i: &&usize| seams[i] || steep(sides.primitive(sides.own.ids[i]));
        self.jumps = far.iter().filter(excused).count();
        self.levels[2] -= self.jumps;
    }

    /// Counts a pixel that shows the same primitive; returns how many levels its colours are apart.
    fn add_same(&mut self, sides: &Sides<'_>, i: usize) -> u8 {
        let pixel = |rgb: &[u8]| [rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]];
        let [a, b, exact] = [&sides.own.rgb, &sides.gl.rgb, &sides.exact.rgb].map(|rgb| pixel(rgb));
        let step = a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0);
        if sides.own.ids[i] != 0 {
            self.same += 1;
            self.levels[usize::from(step.min(2))] += 1;
            self.rounded[0] += usize::from(a != exact);
            self.rounded[1] += usize::from(b != exact);
            if !sides.is_line(sides.own.ids[i]) {
                self.depth_error = self.depth_error.max(sides.depth_error(i));
            }
        } else if step > 0 {
            self.add_wrong(sides, i, "the background differs");
        }
        step
    }

    /// Finds out why a pixel shows different primitives.
    fn add_differing(&mut self, sides: &Sides<'_>, i: usize) {
        let seen = [sides.own.ids[i], sides.gl.ids[i]];
        if seen.iter().any(|&id| sides.is_line(id)) {
            let tie = !seen.contains(&0) && sides.depth_difference(i) <= DEPTH_ERROR;
            *(if tie { &mut self.line_ties } else { &mut self.lines }) += 1;
            return;
        }
        if self.excused() + self.wrong >= ENOUGH {
            self.wrong += 1;
            return;
        }
        let alone = seen.map(|id| (id != 0).then(|| sides.primitive(id)));
        // Ours is in front, or first. The other one must be there too, as deep or hardly deeper.
        let depth = alone[1].as_ref().map_or(1.0, |theirs| theirs.depth()[i]);
        let scale = alone.iter().flatten().map(|p| 1.0 + p.depth_range()).fold(1.0, f64::max);
        let apart = units(depth, sides.own.depth[i]) / scale;
        let (x, y) = sides.place(i);
        let on_cut_edge = |p: &Alone| p.is_cut() && p.inside(x, y).abs() <= SNAPPING;
        if depth < 1.0 && depth == sides.own.depth[i] {
            self.ties += 1;
        } else if depth < 1.0 && apart <= DEPTH_ERROR {
            self.near_ties += 1;
        } else if alone.iter().flatten().all(on_cut_edge) {
            self.cut_edges += 1;
        } else {
            let inside = alone.map(|p| p.map(|p| p.inside(x, y)));
            self.add_wrong(sides, i, &format!("{apart} units apart in depth, inside by {inside:?} pixels"));
        }
    }

    /// Pixels that were looked into and found to be undecided.
    fn excused(&self) -> usize {
        self.ties + self.near_ties + self.cut_edges
    }

    fn add_wrong(&mut self, sides: &Sides<'_>, i: usize, why: &str) {
        self.wrong += 1;
        if self.examples.len() < 3 {
            let (own, gl) = (sides.own.ids[i], sides.gl.ids[i]);
            self.examples.push(format!("pixel {:?}: {own:#x} and {gl:#x}: {why}", sides.place(i)));
        }
    }

    /// What breaks the limits: nothing, if the pictures agree. A part `one_level` of the pixels may
    /// be one level apart where the usual limit is lower.
    pub(crate) fn faults(&self, one_level: f64) -> Vec<String> {
        let mut faults = self.examples.clone();
        let mut limit = |what: &str, is: f64, most: f64| {
            if is > most {
                faults.push(format!("{what}: {is}, at most {most}"));
            }
        };
        let part = |n: usize, parts: f64| (n as f64 * parts).ceil();
        limit("wrong pixels", self.wrong as f64, 0.0);
        limit("pixels on ties", self.excused() as f64, part(self.covered, 0.0003));
        limit("pixels on ties of lines", self.line_ties as f64, part(self.covered, 0.2));
        limit("pixels where lines deviate", self.lines as f64, part(self.covered, 0.0015));
        limit("pixels more than one level apart", self.levels[2] as f64, 0.0);
        let [own, driver] = self.rounded;
        let identical = if own < driver { NEARER } else { IDENTICAL };
        limit(
            "pixels one level apart",
            self.levels[1] as f64,
            part(self.same, (1.0 - identical).max(one_level)),
        );
        limit("pixels that rounding changed", own as f64, part(self.same, 1.0 - IDENTICAL));
        limit("units of depth", self.depth_error, DEPTH_ERROR);
        limit("empty pictures", f64::from(u8::from(self.same == 0)), 0.0);
        faults
    }
}

impl Sides<'_> {
    fn is_line(&self, id: u32) -> bool {
        id != 0 && self.objects[(id >> 24) as usize - 1].lines.is_some()
    }

    fn primitive(&self, id: u32) -> Alone {
        let [object, number] = [id >> 24, id & 0xFF_FFFF].map(|n| n as usize - 1);
        let height_map = self.height_maps[object].as_ref();
        Alone::new(self.scene, &self.camera, &self.objects[object], number, height_map)
    }

    fn place(&self, i: usize) -> (usize, usize) {
        (i % self.own.width as usize, i / self.own.width as usize)
    }

    fn depth_difference(&self, i: usize) -> f64 {
        units(self.own.depth[i], self.gl.depth[i])
    }

    /// The difference in depth of a triangle that both see, in units of `DEPTH_ERROR`. One that
    /// was cut says nothing: the driver cuts in f32, and a narrow rest shows that in its slope.
    fn depth_error(&self, i: usize) -> f64 {
        let units = self.depth_difference(i);
        if units <= DEPTH_ERROR {
            return units;
        }
        let triangle = self.primitive(self.own.ids[i]);
        if triangle.is_cut() { 0.0 } else { units / (1.0 + triangle.depth_range()) }
    }
}

/// How far two depths are apart, in units of 2^-24.
fn units(a: f32, b: f32) -> f64 {
    (f64::from(a) - f64::from(b)).abs() * 16_777_216.0
}
