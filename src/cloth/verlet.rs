//! Verlet's scheme (Verlet 1967): the next position from the last two.

use super::grid::Pins;
use super::{Constants, Counters, Points};

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
    for run in &pins.free {
        let run = || run.clone();
        advance_run(&mut x.x[run()], &mut last.x[run()], &force.x[run()], constants);
        advance_run(&mut x.y[run()], &mut last.y[run()], &force.y[run()], constants);
        advance_run(&mut x.z[run()], &mut last.z[run()], &force.z[run()], constants);
        counters.points_advanced += run().len() as u64;
    }
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
