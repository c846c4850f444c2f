//! Contact with Coulomb friction (`sim.contact` = `coulomb`): the end of a step.
//!
//! The way of a point in the step, from `last` to `x`, is swept against every object. Where it first enters one, with
//! the normal n, contact changes the rest of the way and the velocity v alike:
//!
//! - the normal part ends (restitution 0): the impulse per mass is `j = -v · n`, if that is above 0;
//! - the tangential part is reduced by `μ j`, or ends if it is less: the point sticks.
//!
//! Then the rest of the way is swept again, up to [`MOST_CONTACTS`] times; a point that is caught between objects for
//! longer ends its way there. At last `last` is put where the point would have been a step ago at its new velocity.
//! So a point that is put back gains no speed from that, and under a constant load a sliding point gets
//! `(g_t - μ g_n) dt` in every step, however long the step is.
//!
//! Both the way and the velocity are changed because they differ: the velocity at the end of a step is what the
//! integrator says that it is. Each contact takes `m (|v|² - |v'|²) / 2`, which is never below 0 but for rounding.

use std::ops::Range;

use super::Colliders;
use super::contact::{Entry, Shape};
use crate::cloth::grid::Pins;
use crate::cloth::{Counters, Points, filled};
use crate::error::Result;
use crate::math::{dot, length};
use crate::scene::{ColliderKind, PerKind, Vec3};

/// Most contacts of a point in one step.
const MOST_CONTACTS: u32 = 16;

/// Points that are asked at once whether they are near an object.
const BLOCK: usize = 64;

/// The part of a way that leads into an object where the way only grazes it: what rounding makes of a way along the
/// surface.
const GRAZE: f64 = 1e-12;

/// What contact did to the squares of the velocities in a step: the change of `|v dt|²`, in m², summed over the points.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Change {
    /// By contact of the cloth with itself.
    pub(crate) self_collision: f64,
    /// By contact with the objects of each kind.
    pub(crate) colliders: PerKind<f64>,
}

/// The motion of the points at the end of a step, which contact changes.
#[derive(Clone, Debug)]
pub(crate) struct Coulomb {
    /// How far each point that was in contact in this step goes in a step at its velocity, in metres.
    pub(crate) velocity: Points,
    /// Whether each point was in contact in this step.
    pub(crate) touched: Vec<bool>,
    /// What contact did in this step.
    pub(crate) change: Change,
}

impl Coulomb {
    /// For a cloth of `points` points.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(points: usize) -> Result<Self> {
        Ok(Self {
            velocity: Points::zeros(points)?,
            touched: filled(points, false)?,
            change: Change::default(),
        })
    }

    /// Begins a step.
    pub(crate) fn begin(&mut self) {
        self.touched.fill(false);
        self.change = Change::default();
    }

    /// Notes that point `p` is in contact, and its velocity if it was not yet.
    pub(super) fn touch(&mut self, p: usize, velocity: impl FnOnce() -> Vec3) {
        if !self.touched[p] {
            self.touched[p] = true;
            self.velocity.set(p, velocity());
        }
    }

    /// The sum of the squares of the velocities of a pair.
    pub(super) fn square_of(&self, pair: [usize; 2]) -> f64 {
        let [v, w] = pair.map(|p| self.velocity.get(p));
        dot(v, v) + dot(w, w)
    }

    /// Contact of every unpinned point, on its way from `last` to `x`, with the objects. `velocity` is how far a point
    /// goes in a step, of its number and both positions.
    pub(crate) fn meet(
        &mut self,
        colliders: &Colliders,
        x: &mut Points,
        last: &Points,
        pins: &Pins,
        velocity: impl Fn(usize, Vec3, Vec3) -> Vec3,
        counters: &mut Counters,
    ) {
        for block in pins.free.iter().flat_map(blocks) {
            let near = near(x, last, &block, colliders);
            for p in block.zip(near).filter_map(|(p, near)| near.then_some(p)) {
                let (end, start) = (x.get(p), last.get(p));
                let motion = Motion { at: start, way: end - start, velocity: Vec3::zeros() };
                let entry = first_entry(p, &motion, colliders);
                if entry.is_none() && put_outside(p, end, colliders).is_none() {
                    continue;
                }
                self.touch(p, || velocity(p, end, start));
                let motion = Motion { velocity: self.velocity.get(p), ..motion };
                let motion = motion.meet(p, end, entry, colliders, &mut self.change.colliders);
                x.set(p, motion.at);
                self.velocity.set(p, motion.velocity);
                counters.object_moves += 1;
            }
        }
        counters.object_tests += pins.free_points() * colliders.len() as u64;
    }
}

/// `points`, up to [`BLOCK`] at once.
fn blocks(points: &Range<usize>) -> impl Iterator<Item = Range<usize>> + use<> {
    let end = points.end;
    points.clone().step_by(BLOCK).map(move |start| start..(start + BLOCK).min(end))
}

/// Which of the points `block` may touch an object on their ways from `last` to `x`: few do, so all are asked a cheap
/// question at once before each is swept.
fn near(x: &Points, last: &Points, block: &Range<usize>, colliders: &Colliders) -> [bool; BLOCK] {
    let mut near = [false; BLOCK];
    for (_, shape) in colliders.shapes() {
        shape.mark_near(x, last, block.clone(), &mut near[..block.len()]);
    }
    near
}

/// The motion of a point.
#[derive(Clone, Copy)]
struct Motion {
    at: Vec3,
    /// What is left of its way in the step.
    way: Vec3,
    /// How far it goes in a step at its velocity.
    velocity: Vec3,
}

impl Motion {
    /// The end of the step of point `p`, which would end at `x` without contact; it enters an object at `next` first.
    fn meet<'a>(
        mut self,
        p: usize,
        x: Vec3,
        mut next: Option<Meeting<'a>>,
        colliders: &'a Colliders,
        change: &mut PerKind<f64>,
    ) -> Self {
        for contacts in 0..MOST_CONTACTS {
            if contacts > 0 {
                next = first_entry(p, &self, colliders);
            }
            let Some((kind, shape, entry)) = next else {
                self.at = if contacts > 0 { self.at + self.way } else { x };
                break;
            };
            let before = dot(self.velocity, self.velocity);
            self.at = entry.point;
            self.way = after_contact(self.way * (1.0 - entry.part), entry.normal, shape.friction());
            self.velocity = after_contact(self.velocity, entry.normal, shape.friction());
            change[kind] += dot(self.velocity, self.velocity) - before;
        }
        Self { at: put_outside(p, self.at, colliders).unwrap_or(self.at), ..self }
    }
}

/// An object that a point enters, its kind, and where.
type Meeting<'a> = (ColliderKind, &'a dyn Shape, Entry);

/// The object that point `p` enters first, and where.
fn first_entry<'a>(p: usize, motion: &Motion, colliders: &'a Colliders) -> Option<Meeting<'a>> {
    let mut first: Option<Meeting<'_>> = None;
    for (kind, shape) in colliders.shapes() {
        if let Some(entry) = shape.enter(p, motion.at, motion.way)
            && -dot(motion.way, entry.normal) > GRAZE * length(motion.way)
            && first.as_ref().is_none_or(|(_, _, other)| entry.part < other.part)
        {
            first = Some((kind, shape, entry));
        }
    }
    first
}

/// What contact leaves of a velocity, or of a way, at a surface of the normal `n` and the friction `mu`.
fn after_contact(v: Vec3, n: Vec3, mu: f64) -> Vec3 {
    let impulse = -dot(v, n);
    if impulse <= 0.0 {
        return v;
    }
    let slide = v + n * impulse;
    let (speed, brake) = (length(slide), mu * impulse);
    if speed <= brake { Vec3::zeros() } else { slide * (1.0 - brake / speed) }
}

/// Where point `p` at `x` has to go to be outside of every object, as far as that can be; `None` if it is.
fn put_outside(p: usize, x: Vec3, colliders: &Colliders) -> Option<Vec3> {
    let mut outside = None;
    for _ in 0..MOST_CONTACTS {
        let before = outside;
        for (_, shape) in colliders.shapes() {
            outside = shape.depenetrate(p, outside.unwrap_or(x)).or(outside);
        }
        if outside == before {
            break;
        }
    }
    outside
}

/// Puts the unpinned points at `x` that are inside an object on its surface, at rest.
pub(crate) fn start_outside(x: &mut Points, last: &mut Points, pins: &Pins, colliders: &Colliders) {
    for p in pins.free.iter().cloned().flatten() {
        if let Some(outside) = put_outside(p, x.get(p), colliders) {
            x.set(p, outside);
            last.set(p, outside);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::splitmix64;
    use crate::scene::{Overrides, load_text};

    #[test]
    fn what_is_not_near_an_object_does_not_touch_it() {
        let text = r#"{"sim": {"contact": "coulomb"}, "sphere": {"origin": [0.2, 0, 0], "radius": 0.5, "friction": 0},
            "plane": {"point": [0, -0.6, 0], "normal": [1, 2, 3], "friction": 0},
            "box": {"origin": [-0.3, 0.1, 0], "size": [0.4, 0.8, 1], "friction": 0}}"#;
        let scene = load_text("a.json", text, &Overrides::default()).unwrap().scene;
        let count = 4000;
        let random = |i: u64| (splitmix64(i) >> 11) as f64 * (0.5 * f64::EPSILON) * 2.4 - 1.2;
        let [mut x, mut last] = [0, 1].map(|_| Points::zeros(count).unwrap());
        for p in 0..count {
            let i = 6 * p as u64;
            last.set(p, Vec3::new(random(i), random(i + 1), random(i + 2)));
            // Long ways and short ones.
            let part = if p % 2 == 0 { 1.0 } else { 0.05 };
            x.set(p, last.get(p) + Vec3::new(random(i + 3), random(i + 4), random(i + 5)) * part);
        }
        let colliders = Colliders::new(&scene, &last).unwrap();
        for (kind, shape) in colliders.shapes() {
            let touches = |p: usize| {
                let (from, to) = (last.get(p), x.get(p));
                shape.enter(p, from, to - from).is_some() || shape.depenetrate(p, to).is_some()
            };
            let mut counts = [0; 3];
            for block in blocks(&(0..count)) {
                let mut near = [false; BLOCK];
                shape.mark_near(&x, &last, block.clone(), &mut near[..block.len()]);
                for (p, near) in block.zip(near) {
                    assert!(near || !touches(p), "{kind:?}: from {} to {}", last.get(p), x.get(p));
                    counts[usize::from(near) + usize::from(touches(p))] += 1;
                }
            }
            assert!(counts[0] > 500 && counts[2] > 100, "{kind:?}: {counts:?} are far, near, touching");
        }
    }

    #[test]
    fn contact_ends_the_approach_and_brakes_the_slide() {
        let (n, v) = (Vec3::y(), Vec3::new(3.0, -2.0, 4.0));
        assert_eq!(after_contact(v, n, 0.0), Vec3::new(3.0, 0.0, 4.0), "smooth");
        let braked = after_contact(v, n, 0.5);
        assert!((braked - Vec3::new(2.4, 0.0, 3.2)).amax() < 1e-15, "5 m/s less 0.5 times 2 m/s: {braked}");
        assert_eq!(after_contact(v, n, 2.5), Vec3::zeros(), "at the edge of the cone");
        assert_eq!(after_contact(v, n, 1e15), Vec3::zeros());
        assert_eq!(after_contact(-v, n, 1.0), -v, "on its way out");
        assert_eq!(after_contact(Vec3::zeros(), n, 0.0), Vec3::zeros());
    }
}
