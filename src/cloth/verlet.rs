//! Verlet's scheme (Verlet 1967): the next position from the last two.

use rayon::prelude::*;

use super::grid::Pins;
use super::{Constants, Counters, Points, pieces};

/// Moves every unpinned point on by one step of `constants.dt`:
/// `new = x + (x - last) · keep + f · dt²/m`, `last = x`, `x = new`. `force` is in N.
pub(crate) fn advance(
    x: &mut Points,
    last: &mut Points,
    force: &Points,
    pins: &Pins,
    constants: &Constants,
    counters: &mut Counters,
) {
    let state = x.cut_mut().zip(last.cut_mut()).zip(force.cut()).enumerate();
    state.for_each(|(piece, ((x, last), force))| {
        let components = x.into_iter().zip(last).zip(force);
        components.for_each(|((x, last), force)| {
            for run in pieces::within(&pins.free, piece) {
                advance_run(&mut x[run.clone()], &mut last[run.clone()], &force[run], constants);
            }
        });
    });
    counters.points_advanced += pins.free_points();
}

/// One component of consecutive points.
fn advance_run(x: &mut [f64], last: &mut [f64], force: &[f64], constants: &Constants) {
    let Constants { keep, a2, .. } = *constants;
    for ((x, last), f) in x.iter_mut().zip(last).zip(force) {
        let new = *x + (*x - *last) * keep + f * a2;
        *last = *x;
        *x = new;
    }
}
