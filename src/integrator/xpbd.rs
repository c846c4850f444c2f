//! Extended position-based dynamics (Macklin, Müller and Chentanez 2016) in small steps (Macklin and
//! others 2019): the points move on freely, then each spring in creation order pulls its ends to
//! where its own force would leave them at the end of the step.
//!
//! A spring has the constraint `C = l - l0` and the compliance `1 / k`. Written for its tension
//! `F = -λ / dt²`, in N, the update of the paper, `Δλ = (-C - λ / (k dt²)) / (Σ 1/m + 1 / (k dt²))`,
//! becomes `ΔF = (k C - F) / (1 + k Σ dt2_over_m)`, where `dt2_over_m = dt² / m` moves a point by
//! `dt2_over_m ΔF`; it holds for k = 0 too, and with damping through `dt2_over_m`. One spring alone obeys implicit Euler exactly.
//! Several do not: even converged, the directions in which they pull are those of earlier passes.
//! With too few passes the springs gain energy from nowhere: stable, but wrong.
//!
//! Velocity is what it is for Verlet's scheme, `(x - last) / dt`, and so holds what the
//! collisions and the stretch limit of the step before did to the position.

use fearless_simd::f64x4;
use fearless_simd::prelude::*;

use super::damped_step::DampedStep;
use super::wave::{Chunk, LANES, LIFE, Wave};
use super::window::{Direction, Window};
use super::{Integrator, StepBound};
use crate::cloth::grid::{Grid, Pins};
use crate::cloth::springs::{Family, Springs};
use crate::cloth::{Counters, Model, Params, Points, filled};
use crate::error::Result;
use crate::lanes::level::{Narrow, dispatch_narrow};
use crate::scene::{Cloth, Damping, Sim, Vec3};

/// The integrator, and what it knows of the springs.
#[derive(Clone, Debug)]
pub(super) struct Xpbd {
    step: DampedStep,
    iterations: u32,
    waves: Vec<Wave>,
    window: Window,
    /// As [`Springs::families`].
    constraints: Vec<Constraints>,
}

impl Integrator for Xpbd {
    fn new(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Self> {
        let waves = Wave::all(springs.grid)?;
        let constraints =
            springs.families.iter().map(|family| Constraints::new(family, springs.grid, &waves));
        Ok(Self {
            step: DampedStep::backward(cloth, sim),
            iterations: sim.iterations,
            constraints: constraints.collect::<Result<_>>()?,
            window: Window::new(springs.grid)?,
            waves,
        })
    }

    fn step_bound(_cloth: &Cloth, _damping: Damping, _dt: f64) -> Option<StepBound> {
        None
    }

    fn advance(&mut self, x: &mut Points, last: &mut Points, model: Model<'_>, work: &mut Counters) {
        let Model { springs, pins, params } = model;
        let DampedStep { velocity_retention, dt2_over_m } = self.step;
        for p in pins.free.iter().cloned().flatten() {
            let predicted =
                x.get(p) + (x.get(p) - last.get(p)) * velocity_retention + params.weight * dt2_over_m;
            last.set(p, x.get(p));
            x.set(p, predicted);
        }
        work.points_advanced += pins.free_points();
        self.constraints.iter_mut().for_each(|constraints| constraints.tensions.fill([0.0; LANES]));
        for _ in 0..self.iterations {
            dispatch_narrow!(Narrow::widest(), simd => self.pass(simd, x, pins));
            work.springs_evaluated += springs.len() as u64;
        }
    }

    fn decompose(&self, _p: usize, before: Vec3, moved: Vec3, params: &Params) -> [Vec3; 2] {
        self.step.decompose(before, moved, params)
    }
}

impl Xpbd {
    /// Satisfies each spring once, with the bits of the order of creation.
    #[inline(always)]
    fn pass<S: Simd>(&mut self, simd: S, x: &mut Points, pins: &Pins) {
        let Self { step, waves, window, constraints, .. } = self;
        for number in 0..waves.len() + LIFE {
            if let Some(wave) = waves.get(number) {
                window.load(wave, x, pins, step.dt2_over_m);
                for constraints in &mut *constraints {
                    for (chunk, j) in wave.chunks.clone().zip(wave.chunk_rows()) {
                        let ends = window.ends(wave, j, constraints.direction);
                        constraints.satisfy(simd, chunk, window, ends);
                    }
                }
            }
            if let Some(done) = number.checked_sub(LIFE) {
                window.store(&waves[done], x);
            }
        }
    }
}

/// The springs of one family, wave by wave.
#[derive(Clone, Debug)]
struct Constraints {
    direction: Direction,
    /// Stiffness, in N/m.
    stiffness: f64,
    /// Rest lengths, in metres; NaN for a point without a spring.
    rest: Vec<Chunk>,
    /// What the springs pull with in this step, in N.
    tensions: Vec<Chunk>,
}

impl Constraints {
    /// The springs of `family`, which join points of `grid`.
    fn new(family: &Family, grid: Grid, waves: &[Wave]) -> Result<Self> {
        let chunks = waves.last().map_or(0, |wave| wave.chunks.end);
        let mut rest = filled(chunks, [f64::NAN; LANES])?;
        for wave in waves {
            let of_wave = rest[wave.chunks.clone()].as_flattened_mut();
            for (place, a) in wave.points(grid) {
                let (i, j) = grid.column_row(a);
                if family.columns.contains(&i) && family.rows.contains(&j) {
                    of_wave[place] = family.rest[a];
                }
            }
        }
        Ok(Self {
            direction: Direction::of(family),
            stiffness: family.stiffness,
            rest,
            tensions: filled(chunks, [0.0; LANES])?,
        })
    }

    /// Moves the ends of the springs of a `chunk`, which are at `ends` of `window`, and updates their tensions.
    #[inline(always)]
    fn satisfy<S: Simd>(&mut self, simd: S, chunk: usize, window: &mut Window, [a, b]: [usize; 2]) {
        let load = |chunk: Chunk| f64x4::simd_from(simd, chunk);
        let (xa, ya, za) = (load(window.get(a, 0)), load(window.get(a, 1)), load(window.get(a, 2)));
        let (xb, yb, zb) = (load(window.get(b, 0)), load(window.get(b, 1)), load(window.get(b, 2)));
        let (moves_a, moves_b) = (load(window.get(a, 3)), load(window.get(b, 3)));
        let (rest, tension) = (load(self.rest[chunk]), load(self.tensions[chunk]));
        let (zero, one) = (f64x4::splat(simd, 0.0), f64x4::splat(simd, 1.0));
        let k = f64x4::splat(simd, self.stiffness);

        let (ex, ey, ez) = (xb - xa, yb - ya, zb - za);
        let l = (ex * ex + ey * ey + ez * ez).sqrt();
        let moves = moves_a + moves_b;
        let change = (k * (l - rest) - tension) / (one + k * moves);
        let scale = change / l;
        let acts = rest.simd_eq(rest) & !(l.simd_eq(zero) | moves.simd_eq(zero));
        let (px, py, pz) = (ex * scale, ey * scale, ez * scale);

        // As a sum, because a choice becomes a masked store. No tension is -0, so adding 0 changes none.
        self.tensions[chunk] = (tension + acts.select(change, zero)).into();
        window.set(a, 0, acts.select(xa + px * moves_a, xa));
        window.set(a, 1, acts.select(ya + py * moves_a, ya));
        window.set(a, 2, acts.select(za + pz * moves_a, za));
        window.set(b, 0, acts.select(xb - px * moves_b, xb));
        window.set(b, 1, acts.select(yb - py * moves_b, yb));
        window.set(b, 2, acts.select(zb - pz * moves_b, zb));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::grid::start;
    use crate::lanes::level::Level;
    use crate::math::length;
    use crate::math::splitmix64;
    use crate::scene::{Overrides, Scene, Vec3, load_text};

    /// A cloth with pins and so many points a side; without some kind of spring if `seed` says so.
    fn scene(width: usize, height: usize, seed: u64) -> Scene {
        let (on, last) = (|kind| seed % 8 != kind, height - 1);
        let text = format!(
            r#"{{"cloth": {{"width": 1, "height": 1, "num_width_points": {width}, "num_height_points": {height},
            "thickness": 0.01, "orientation": 0, "damping": 0.2, "density": 150, "ks": 5000, "enable_structural": {},
            "enable_shearing": {}, "enable_bending": {}, "pinned": [[0, 0], [0, {last}], [1, {last}]]}}}}"#,
            on(1),
            on(2),
            on(3)
        );
        load_text("a.json", &text, &Overrides::default()).unwrap().scene
    }

    /// One pass as the module says it: spring by spring in the order of creation.
    fn one_by_one(x: &mut Points, springs: &Springs, tensions: &mut [Vec<f64>], pins: &Pins, moves: f64) {
        let points = (0..springs.grid.len())
            .flat_map(|a| springs.families.iter().zip(0..).map(move |family| (a, family)));
        for (a, (family, index)) in points {
            let (i, j) = springs.grid.column_row(a);
            if !(family.rows.contains(&j) && family.columns.contains(&i)) {
                continue;
            }
            let (b, tension): (_, &mut f64) = (a - family.offset, &mut tensions[index][a]);
            let e = x.get(b) - x.get(a);
            let l = length(e);
            let [moves_a, moves_b] = [a, b].map(|p| if pins.pinned[p] { 0.0 } else { moves });
            if l == 0.0 || moves_a + moves_b == 0.0 {
                continue;
            }
            let k = family.stiffness;
            let change = (k * (l - family.rest[a]) - *tension) / (1.0 + k * (moves_a + moves_b));
            *tension += change;
            let pull = e * (change / l);
            x.set(a, x.get(a) + pull * moves_a);
            x.set(b, x.get(b) - pull * moves_b);
        }
    }

    #[test]
    fn a_pass_has_the_bits_of_spring_by_spring() {
        let sizes = [(3, 3), (4, 3), (5, 17), (21, 4), (16, 16), (50, 13), (3, 40), (40, 3)];
        for ((width, height), seed) in sizes.into_iter().zip(0..) {
            let scene = scene(width, height, seed);
            let cloth = scene.cloth.as_ref().unwrap();
            let grid = Grid::new(cloth).unwrap();
            let mut x = start(cloth, grid).unwrap();
            let springs = Springs::new(cloth, grid, &x).unwrap();
            let pins = Pins::new(cloth, grid).unwrap();
            for p in 0..x.len() {
                let number =
                    |c| (splitmix64(9000 * seed + 3 * p as u64 + c) >> 11) as f64 / (1_u64 << 56) as f64;
                x.set(p, x.get(p) + Vec3::new(number(0), number(1), number(2)));
            }
            // The first spring has no length.
            x.set(1, x.get(0));
            let mut expected = x.clone();
            let xpbd = Xpbd::new(cloth, &scene.sim, &springs).unwrap();
            let mut tensions = vec![vec![0.0; x.len()]; springs.families.len()];
            for _ in 0..3 {
                let moves = xpbd.step.dt2_over_m;
                one_by_one(&mut expected, &springs, &mut tensions, &pins, moves);
            }
            assert_ne!(x, expected);
            Level::for_each(|level| {
                let (mut xpbd, mut x) = (xpbd.clone(), x.clone());
                for _ in 0..3 {
                    dispatch_narrow!(Narrow::widest(), simd => xpbd.pass(simd, &mut x, &pins));
                }
                assert_eq!(x, expected, "{width} x {height}, {level:?}");
            });
        }
    }
}
