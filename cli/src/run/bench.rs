//! `drape render --bench`: the time to draw a picture.

use std::time::{Duration, Instant};

use serde::Serialize;

use crate::session::Session;
use drape::cloth::Points;
use drape::error::Result;
use drape::raster::Stages;
use drape::render::{Options, Renderer};

/// The times of all runs, in milliseconds.
#[derive(Serialize)]
struct Bench {
    ms_median: f64,
    ms_min: f64,
    runs: u32,
    threads: usize,
    triangles: u64,
    fragments: u64,
    /// The median of each stage.
    stages: StageTimes,
}

#[derive(Serialize)]
struct StageTimes {
    vertex: f64,
    setup: f64,
    raster: f64,
    shading: f64,
}

/// Draws once to warm up, then `runs` (at least 1) times, and prints the times.
pub(crate) fn run(
    renderer: &Renderer,
    points: &Points,
    options: &Options,
    runs: u32,
    session: &Session,
) -> Result<()> {
    let mut framebuffer = renderer.framebuffer();
    let stats = renderer.draw_into(&mut framebuffer, points, options);
    let (mut totals, mut stages) = (Vec::new(), Vec::new());
    for _ in 0..runs {
        session.stop.check()?;
        let started = Instant::now();
        let (_, times) = renderer.draw_timed(&mut framebuffer, points, options);
        totals.push(started.elapsed());
        stages.push(times);
    }
    session.print_json(&Bench {
        ms_median: median(totals.clone()),
        ms_min: totals.iter().min().copied().map_or(0.0, milliseconds),
        runs,
        threads: rayon::current_num_threads(),
        triangles: stats.triangles,
        fragments: stats.fragments,
        stages: StageTimes::medians(&stages),
    })
}

impl StageTimes {
    fn medians(stages: &[Stages]) -> Self {
        let of = |stage: fn(&Stages) -> Duration| median(stages.iter().map(stage).collect());
        Self {
            vertex: of(|s| s.vertex),
            setup: of(|s| s.setup),
            raster: of(|s| s.raster),
            shading: of(|s| s.shading),
        }
    }
}

/// The median in milliseconds: the middle, or the mean of the middle two; 0 for none.
fn median(mut times: Vec<Duration>) -> f64 {
    times.sort_unstable();
    let half = times.len() / 2;
    match times.get(half) {
        None => 0.0,
        Some(upper) if times.len() % 2 == 1 => milliseconds(*upper),
        Some(upper) => milliseconds((*upper + times[half - 1]) / 2),
    }
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_or_the_mean_of_two() {
        let ms = |times: &[u64]| median(times.iter().map(|&t| Duration::from_millis(t)).collect());
        assert_eq!(ms(&[]), 0.0);
        assert_eq!(ms(&[7]), 7.0);
        assert_eq!(ms(&[9, 1, 2]), 2.0);
        assert_eq!(ms(&[4, 1, 9, 2]), 3.0);
    }
}
