//! The steps per second of the runs.

use super::extent::Extent;
use drape::scene::{Cloth, Scene};

/// Springs that a run at `rate` steps per second visits: about six for each point and step.
pub(super) fn springs_in(cloth: &Cloth, rate: u32, extent: &Extent) -> f64 {
    let points = (cloth.num_width_points * cloth.num_height_points) as f64;
    6.0 * points * f64::from(rate) * 0.1 * f64::from(extent.last())
}

/// Steps per second around the `stable` rate, and the scene's own, ascending. All are multiples of
/// [`quantum`].
pub(super) fn rates_around(stock: &Scene, stable: f64, cloth: &Cloth, extent: &Extent) -> Vec<u32> {
    let quantum = quantum(stock.sim.fps);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "above 0; saturates")]
    let rounded = |rate: f64| ((rate / f64::from(quantum)).ceil() as u32).saturating_mul(quantum);
    let own = stock.sim.fps * f64::from(stock.sim.steps_per_frame);
    let mut rates: Vec<u32> = extent.rates.iter().map(|part| rounded(part * stable)).collect();
    rates.extend(Some(rounded(own)).filter(|&rate| f64::from(rate) == own));
    rates.retain(|&rate| springs_in(cloth, rate, extent) <= extent.most_springs);
    rates.sort_unstable();
    rates.dedup();
    rates
}

/// The common divisor of all steps per second: the frames per second if those are a multiple of 10, else 10.
fn quantum(fps: f64) -> u32 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 1000")]
    if (10.0..=1000.0).contains(&fps) && fps % 10.0 == 0.0 { fps as u32 } else { 10 }
}

/// The changes that make a scene of `fps` frames per second run at `rate` steps per second.
pub(super) fn clock(fps: f64, rate: u32) -> [String; 2] {
    let frames = Some(quantum(fps)).filter(|frames| rate.is_multiple_of(*frames)).unwrap_or(10);
    [format!("sim.fps={frames}"), format!("sim.steps_per_frame={}", rate / frames)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_whole_tens_and_keep_the_frames_of_the_scene() {
        assert_eq!(clock(90.0, 2700), ["sim.fps=90", "sim.steps_per_frame=30"]);
        assert_eq!(clock(90.0, 60), ["sim.fps=10", "sim.steps_per_frame=6"]);
        assert_eq!(clock(24.0, 240), ["sim.fps=10", "sim.steps_per_frame=24"]);
    }
}
