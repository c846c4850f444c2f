//! The page of a horizon: how copies part over time, and where on the cloth.

use super::{COPIES, Horizon};
use crate::page::axis::{Axis, Scale};
use crate::page::plot::{Marker, Plot, Style};
use crate::page::{self, Cells, escape, short};
use drape::error::Result;
use drape::output::png::{self, Effort};

/// Pixels of a point of the map.
const POINT: u32 = 8;

/// The page of the `horizon` of the scene named `name`.
///
/// # Errors
/// Those of the encoder.
pub fn page(horizon: &Horizon, name: &str) -> Result<String> {
    let mut text = page::head(&format!("Horizon of {name}"));
    text += &format!(
        "<p>The simulation beside {COPIES} copies whose points start {} m away, a rounding error. Where they have parted, no \
         number of steps gives the positions of the points.</p>\n",
        short(horizon.rounding)
    );
    text += &plot(horizon);
    let rows = horizon.times.iter().map(|reached| {
        let time = reached.time.map_or("not by the end".to_owned(), |time| format!("{time:.3} s"));
        vec![format!("{} m", short(reached.distance)), time]
    });
    text += "<h2>When they part</h2>\n";
    text += &page::table(&["a point has parted by", "after"], Cells::Numbers, rows);
    if let Some(rate) = horizon.growth {
        text += &format!(
            "<p>Before that the distance grows by the factor e every {} s.</p>\n",
            short(1.0 / rate)
        );
    }
    text += &map(horizon)?;
    text += "<h2>What the copies agree on</h2>\n";
    let spread = &horizon.spread;
    let rows = [
        ("energy", spread.energy, "J"),
        ("lowest point", spread.lowest, "m"),
        ("mean height", spread.mean, "m"),
        ("highest point", spread.highest, "m"),
    ];
    let rows = rows.iter().map(|(name, [low, high], unit)| {
        vec![escape(name), format!("{low:.6} {unit}"), format!("{high:.6} {unit}")]
    });
    text += &page::table(&["", "lowest of the copies", "highest"], Cells::Numbers, rows);
    Ok(text + page::END)
}

fn plot(horizon: &Horizon) -> String {
    let last = horizon.partings.last().map_or(1.0, |parting| parting.time);
    let mut plot = Plot::new(
        "Distance of the copies over time",
        Axis::new("simulated time, s", Scale::Linear, 0.0, last),
        Axis::new("distance, m", Scale::Log, 1e-17, 10.0),
    );
    for (distance, name) in super::DISTANCES {
        plot.line(&[[0.0, distance], [last, distance]], Style::GUIDE);
        plot.note([0.06 * last, distance], name);
    }
    let series = |of: fn(&super::Parting) -> f64| -> Vec<[f64; 2]> {
        horizon.partings.iter().map(|p| [p.time, of(p)]).filter(|point| point[1] > 0.0).collect()
    };
    let line = |index: usize| Style { marker: Marker::None, ..Style::of_series(index) };
    plot.line(&series(|p| p.max), line(1));
    plot.line(&series(|p| p.rms), line(0));
    plot.entry(line(0), "root mean square");
    plot.entry(line(1), "largest of a point");
    plot.finish("partings")
}

/// The cloth laid flat, each point coloured by the logarithm of how far it has parted.
fn map(horizon: &Horizon) -> Result<String> {
    let [columns, rows] = horizon.size;
    if columns == 0 || rows == 0 {
        return Ok(String::new());
    }
    #[expect(clippy::cast_possible_truncation, reason = "sides of a grid that fits in memory")]
    let (width, height) = (columns as u32 * POINT, rows as u32 * POINT);
    let range = range(&horizon.map);
    let mut pixels = Vec::with_capacity((width * height * 4) as usize);
    for y in 0..height {
        for x in 0..width {
            let p = (y / POINT) as usize * columns + (x / POINT) as usize;
            pixels.extend(color(horizon.map.get(p).copied().unwrap_or(0.0), range));
        }
    }
    let png = png::encode(width, height, &pixels, Effort::Small)?;
    let picture = page::image("how far each point has parted", &png);
    Ok(format!(
        "<h2>Where they part</h2>\n<figure>{picture}<figcaption>The cloth laid flat, at the end: from dark blue, {} m \
         and less, to yellow, {} m, on a logarithmic scale.</figcaption></figure>\n",
        short(range[0]),
        short(range[1])
    ))
}

/// The smallest and the largest distance of a point that has parted; a tenth of the largest at most for the smallest.
fn range(map: &[f64]) -> [f64; 2] {
    let parted = map.iter().copied().filter(|&distance| distance > 0.0);
    let [low, high] = [parted.clone().fold(1.0, f64::min), parted.fold(1e-16, f64::max)];
    [low.min(0.1 * high), high]
}

/// Dark blue to yellow from `low` to `high`, by the logarithm.
fn color(distance: f64, [low, high]: [f64; 2]) -> [u8; 4] {
    let place = (drape::math::ln(distance.max(low) / low) / drape::math::ln(high / low)).clamp(0.0, 1.0);
    let mix = |from: f64, to: f64| (from + (to - from) * place).round();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 255")]
    let [r, g, b] = [mix(20.0, 250.0), mix(30.0, 230.0), mix(110.0, 40.0)].map(|channel| channel as u8);
    [r, g, b, 255]
}
