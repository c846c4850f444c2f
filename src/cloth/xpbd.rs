//! Extended position-based dynamics (Macklin, Müller and Chentanez 2016) in small steps (Macklin and
//! others 2019): the points move on freely, then each spring in creation order pulls its ends to
//! where its own force would leave them at the end of the step.
//!
//! A spring has the constraint `C = l - l0` and the compliance `1 / k`. Written for its tension
//! `F = -λ / dt²`, in N, the update of the paper, `Δλ = (-C - λ / (k dt²)) / (Σ 1/m + 1 / (k dt²))`,
//! becomes `ΔF = (k C - F) / (1 + k Σ a2)`, where `a2 = dt² / m` moves a point by `a2 ΔF`; it holds
//! for k = 0 too, and with damping through `a2`. One spring alone obeys implicit Euler exactly.
//! Several do not: even converged, the directions in which they pull are those of earlier passes.
//! With too few passes the springs gain energy from nowhere: stable, but wrong.
//!
//! Velocity is what it is for Verlet's scheme, `(x - last) / dt`, and so holds what the
//! collisions and the stretch limit of the step before did to the position.

use super::grid::{Grid, Pins};
use super::springs::{Family, Springs};
use super::{Counters, Model, Points, filled, len};
use crate::error::Result;

/// The integrator and its tensions.
#[derive(Clone, Debug)]
pub(crate) struct Xpbd {
    iterations: u32,
    /// Of each family and point, the tension of its spring in this step, in N.
    tensions: Vec<Vec<f64>>,
}

impl Xpbd {
    /// The integrator of `springs` with so many passes over them in a step.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(iterations: u32, springs: &Springs) -> Result<Self> {
        let tensions = springs.families.iter().map(|family| filled(family.rest.len(), 0.0));
        Ok(Self { iterations, tensions: tensions.collect::<Result<_>>()? })
    }

    /// Moves every unpinned point on by one step.
    pub(crate) fn advance(
        &mut self,
        x: &mut Points,
        last: &mut Points,
        model: Model<'_>,
        counters: &mut Counters,
    ) {
        let Model { springs, pins, constants } = model;
        for p in pins.free.iter().cloned().flatten() {
            let predicted =
                x.get(p) + (x.get(p) - last.get(p)) * constants.keep + constants.weight * constants.a2;
            last.set(p, x.get(p));
            x.set(p, predicted);
        }
        counters.points_advanced += pins.free_points();
        self.tensions.iter_mut().for_each(|tensions| tensions.fill(0.0));
        for _ in 0..self.iterations {
            self.pass(x, springs, pins, constants.a2);
            counters.springs_evaluated += springs.len() as u64;
        }
    }

    /// Satisfies each spring once, in creation order.
    fn pass(&mut self, x: &mut Points, springs: &Springs, pins: &Pins, a2: f64) {
        let Grid { width, height } = springs.grid;
        for (j, i) in (0..height).flat_map(|j| (0..width).map(move |i| (j, i))) {
            for (family, tensions) in springs.families.iter().zip(&mut self.tensions) {
                if family.rows.contains(&j) && family.columns.contains(&i) {
                    let a = j * width + i;
                    satisfy(x, family, a, &mut tensions[a], pins, a2);
                }
            }
        }
    }
}

/// Moves the ends of the spring of `family` that point `a` made, and updates its `tension`.
fn satisfy(x: &mut Points, family: &Family, a: usize, tension: &mut f64, pins: &Pins, a2: f64) {
    let b = a - family.offset;
    let e = x.get(b) - x.get(a);
    let l = len(e);
    let [moves_a, moves_b] = [a, b].map(|p| if pins.pinned[p] { 0.0 } else { a2 });
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
