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

use super::damped_step::DampedStep;
use super::{Integrator, StepBound};
use crate::cloth::grid::{Grid, Pins};
use crate::cloth::springs::{Family, Springs};
use crate::cloth::{Counters, Model, Params, Points, filled, len};
use crate::error::Result;
use crate::scene::{Cloth, Damping, Sim, Vec3};

/// The integrator and its tensions.
#[derive(Clone, Debug)]
pub(super) struct Xpbd {
    step: DampedStep,
    iterations: u32,
    /// Of each family and point, the tension of its spring in this step, in N.
    tensions: Vec<Vec<f64>>,
}

impl Integrator for Xpbd {
    fn new(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Self> {
        let tensions = springs.families.iter().map(|family| filled(family.rest.len(), 0.0));
        Ok(Self {
            step: DampedStep::backward(cloth, sim),
            iterations: sim.iterations,
            tensions: tensions.collect::<Result<_>>()?,
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
        self.tensions.iter_mut().for_each(|tensions| tensions.fill(0.0));
        for _ in 0..self.iterations {
            self.pass(x, springs, pins);
            work.springs_evaluated += springs.len() as u64;
        }
    }

    fn decompose(&self, _p: usize, before: Vec3, moved: Vec3, params: &Params) -> [Vec3; 2] {
        self.step.decompose(before, moved, params)
    }
}

impl Xpbd {
    /// Satisfies each spring once, in creation order.
    fn pass(&mut self, x: &mut Points, springs: &Springs, pins: &Pins) {
        let dt2_over_m = self.step.dt2_over_m;
        let Grid { width, height } = springs.grid;
        for (j, i) in (0..height).flat_map(|j| (0..width).map(move |i| (j, i))) {
            for (family, tensions) in springs.families.iter().zip(&mut self.tensions) {
                if family.rows.contains(&j) && family.columns.contains(&i) {
                    let a = j * width + i;
                    satisfy(x, family, a, &mut tensions[a], pins, dt2_over_m);
                }
            }
        }
    }
}

/// Moves the ends of the spring of `family` that point `a` owns, and updates its `tension`.
fn satisfy(x: &mut Points, family: &Family, a: usize, tension: &mut f64, pins: &Pins, dt2_over_m: f64) {
    let b = a - family.offset;
    let e = x.get(b) - x.get(a);
    let l = len(e);
    let [moves_a, moves_b] = [a, b].map(|p| if pins.pinned[p] { 0.0 } else { dt2_over_m });
    if l == 0.0 || moves_a + moves_b == 0.0 {
        return;
    }
    let k = family.stiffness;
    let change = (k * (l - family.rest[a]) - *tension) / (1.0 + k * (moves_a + moves_b));
    *tension += change;
    let pull = e * (change / l);
    x.set(a, x.get(a) + pull * moves_a);
    x.set(b, x.get(b) - pull * moves_b);
}
