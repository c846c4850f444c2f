//! How long positions can be trusted, where that is known.

use super::repository;
use drape::scene::Overrides;
use drape_lab::accuracy::measure::Measure;
use drape_lab::accuracy::source::Source;
use drape_lab::horizon::{self, Horizon};

fn horizon(scene: &str, sets: &[&str], frames: u64) -> Horizon {
    let sets = sets.iter().map(ToString::to_string).collect();
    let overrides = Overrides { sets, ..Overrides::default() };
    let source = Source { path: repository::path(&format!("scenes/{scene}.json")), overrides };
    let measure = Measure::Pixels;
    Horizon::of(&source, &[], frames, measure, &|| Ok(())).unwrap()
}

#[test]
fn a_cloth_in_free_fall_keeps_its_rounding() {
    let fall = horizon("pinned2", &["cloth.pinned=[]", "sim.self_collision=off"], 20);
    assert!(fall.rounding > 1e-17 && fall.rounding < 1e-15);
    assert!(fall.partings.iter().all(|parting| parting.max < 1e-12));
    assert!(fall.times.iter().all(|reached| reached.time.is_none()));
    assert_eq!(fall.partings.len(), 20);
}

#[test]
fn a_cloth_that_falls_on_a_ball_parts() {
    let ball = horizon("sphere", &[], 120);
    let times: Vec<f64> = ball.times.iter().map(|reached| reached.time.unwrap()).collect();
    assert!(times.is_sorted(), "{times:?}");
    assert!(ball.growth.unwrap() > 5.0, "{:?}", ball.growth);
    let last = ball.partings.last().unwrap();
    assert!(last.max >= last.rms && last.max > 1e-2);
    // The picture is 1024 pixels wide, and a cloth of 1 m fills about half of it.
    let pixels = last.largest(Measure::Pixels);
    assert!((100.0..2000.0).contains(&(pixels / last.max)), "{pixels} px for {} m", last.max);
    let seen = ball.reached(Measure::Pixels, 1e-3).unwrap();
    assert!(seen <= ball.reached(Measure::Max, 1e-3).unwrap(), "a thousandth of a pixel is less than 1 mm");
    let farthest = ball.map.iter().copied().fold(0.0, f64::max);
    assert_eq!((ball.size, ball.map.len(), farthest), ([50, 50], 2500, last.max));
    // What the copies agree on is far better known than their points.
    let [low, high] = ball.spread.mean;
    assert!(low <= high && high - low < 0.5 * last.rms, "{:?}", ball.spread);
    let page = horizon::page(&ball, "sphere.json").unwrap();
    assert!(page.contains("<svg") && page.contains("1 mm") && page.contains("data:image/png"));
}
