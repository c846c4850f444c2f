//! Plots of each measure over one or two parameters. Over all cases, in memory that does not grow with their number.

use crate::page::axis::{Axis, Scale};
use crate::page::plot::{Marker, Plot, Style};
use crate::page::short;
use crate::sweep::measures::unit;
use crate::sweep::record::Record;
use drape::math::ln;
use drape::scene::sweep::{self, Spec};

/// Most values of a parameter along a plot, and most lines in one.
const MOST_ALONG: usize = 500;
const MOST_LINES: usize = 8;

/// The colour of the cells of a map.
const CELL: &str = "--a";

/// The numbers of a measure where two parameters have given values.
#[derive(Clone, Copy, Debug)]
struct Range {
    count: f64,
    sum: f64,
    least: f64,
    most: f64,
}

const NOTHING: Range = Range { count: 0.0, sum: 0.0, least: f64::INFINITY, most: f64::NEG_INFINITY };

impl Range {
    fn mean(self) -> Option<f64> {
        (self.count > 0.0).then(|| self.sum / self.count)
    }
}

/// The numbers behind all plots.
pub(super) struct Plots {
    /// Which parameter runs along the plots, and which one has a line for each value.
    along: Option<usize>,
    lines: Option<usize>,
    measures: Vec<(String, Vec<Vec<Range>>)>,
}

/// The values of a parameter, if all are numbers.
fn numbers(axis: &sweep::Axis) -> Option<Vec<f64>> {
    axis.values.iter().map(serde_json::Value::as_f64).collect()
}

impl Plots {
    /// Plots of what `spec` measures, without numbers yet.
    pub(super) fn new(spec: &Spec) -> Self {
        let length = |axis: &sweep::Axis| axis.values.len();
        let fits = |axis: &sweep::Axis| (2..=MOST_ALONG).contains(&length(axis)) && numbers(axis).is_some();
        let axes = || spec.set.iter().enumerate();
        let along =
            axes().filter(|(_, axis)| fits(axis)).max_by_key(|(i, axis)| (length(axis), usize::MAX - i));
        let along = along.map(|(i, _)| i);
        let others = axes().filter(|(i, axis)| Some(*i) != along && (2..=MOST_ALONG).contains(&length(axis)));
        let lines = others
            .filter(|_| !spec.zip)
            .max_by_key(|(i, axis)| (fits(axis), length(axis) <= MOST_LINES, usize::MAX - i));
        let lines = lines.map(|(i, _)| i);
        let size = |i: Option<usize>| i.and_then(|i| spec.set.get(i)).map_or(1, length);
        let empty = vec![vec![NOTHING; if along.is_some() { size(along) } else { 0 }]; size(lines)];
        let measures = spec.measure.iter().map(|name| (name.clone(), empty.clone())).collect();
        Self { along, lines, measures }
    }

    /// Takes in a case.
    pub(super) fn add(&mut self, spec: &Spec, number: u64, record: Option<&Record>) {
        let (Some(record), Some(along)) = (record, self.along) else { return };
        let places = spec.places(number);
        let (column, line) = (places[along], self.lines.map_or(0, |lines| places[lines]));
        for (name, lines) in &mut self.measures {
            let Some(number) = record.number(name) else { continue };
            let range = &mut lines[line][column];
            range.count += 1.0;
            range.sum += number;
            (range.least, range.most) = (range.least.min(number), range.most.max(number));
        }
    }

    /// The plots, and a map where two parameters are numbers; empty if nothing can be plotted.
    pub(super) fn html(&self, spec: &Spec) -> String {
        let Some(along) = self.along.and_then(|along| spec.set.get(along)) else { return String::new() };
        let lines = self.lines.and_then(|lines| spec.set.get(lines));
        let mut html = String::new();
        for (number, (name, ranges)) in self.measures.iter().enumerate() {
            let means: Vec<f64> = ranges.iter().flatten().filter_map(|range| range.mean()).collect();
            if means.len() < 2 {
                continue;
            }
            html += "<div class=\"row\">\n";
            if ranges.len() <= MOST_LINES {
                html += &format!(
                    "<figure>{}</figure>\n",
                    curves(name, along, lines, ranges).finish(&format!("c{number}"))
                );
            }
            if let Some(plot) = lines.and_then(|lines| map(name, along, lines, ranges)) {
                html += &format!("<figure>{}</figure>\n", plot.finish(&format!("m{number}")));
            }
            html += "</div>\n";
        }
        html
    }
}

fn title(name: &str) -> String {
    let unit = unit(name);
    if unit.is_empty() { name.to_owned() } else { format!("{name} ({unit})") }
}

/// A line for each value of the second parameter; where other parameters vary too, their mean and range.
fn curves(name: &str, along: &sweep::Axis, lines: Option<&sweep::Axis>, ranges: &[Vec<Range>]) -> Plot {
    let x = numbers(along).unwrap_or_default();
    let ends = ranges.iter().flatten().filter(|range| range.count > 0.0);
    let y = ends.flat_map(|range| [range.least, range.most]).collect::<Vec<_>>();
    let mut plot = Plot::new(&title(name), parameter(along), measure(name, &y));
    for (number, line) in ranges.iter().enumerate() {
        let style = Style::of_series(number);
        let points: Vec<[f64; 2]> =
            x.iter().zip(line).filter_map(|(&x, range)| Some([x, range.mean()?])).collect();
        plot.line(&points, style);
        for (&x, range) in x.iter().zip(line) {
            let Some(mean) = range.mean() else { continue };
            if range.least < range.most {
                plot.line(
                    &[[x, range.least], [x, range.most]],
                    Style { stroke: 1.0, marker: Marker::None, ..style },
                );
            }
            let from = if range.least < range.most {
                format!(", from {} to {}", short(range.least), short(range.most))
            } else {
                String::new()
            };
            plot.marker([x, mean], style, &format!("{} = {}: {}{from}", along.path, short(x), short(mean)));
        }
        if let Some(lines) = lines {
            let value = lines.values.get(number).map(ToString::to_string).unwrap_or_default();
            plot.entry(style, &format!("{} {}", last_step(&lines.path), value.trim_matches('"')));
        }
    }
    plot
}

/// A cell for each pair of values, the stronger in colour the larger the mean; nothing if a parameter is not numbers.
fn map(name: &str, along: &sweep::Axis, across: &sweep::Axis, ranges: &[Vec<Range>]) -> Option<Plot> {
    let (x, y) = (edges(&numbers(along)?, scale(along)), edges(&numbers(across)?, scale(across)));
    let means: Vec<f64> = ranges.iter().flatten().filter_map(|range| range.mean()).collect();
    let least = means.iter().copied().fold(f64::INFINITY, f64::min);
    let most = means.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let ends = |edges: &[[f64; 2]]| {
        let low = edges.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        [low, edges.iter().flatten().copied().fold(f64::NEG_INFINITY, f64::max)]
    };
    let axis = |parameter: &sweep::Axis, [low, high]: [f64; 2]| {
        Axis::new(&parameter.path, scale(parameter), low, high)
    };
    let title = format!("{name}: faint {}, strong {}", short(least), short(most));
    let mut plot = Plot::new(&title, axis(along, ends(&x)), axis(across, ends(&y)));
    for (line, y) in ranges.iter().zip(&y) {
        for (range, x) in line.iter().zip(&x) {
            let Some(mean) = range.mean() else { continue };
            let part = if most > least { (mean - least) / (most - least) } else { 0.5 };
            let opacity = (0.06 + 0.94 * part).clamp(0.0, 1.0);
            plot.area([[x[0], y[0]], [x[1], y[1]]], CELL, (opacity * 1e3).round() / 1e3, &short(mean));
        }
    }
    Some(plot)
}

/// Around each value, where its cell ends: in the middle to its neighbours. Values may stand in any order.
fn edges(values: &[f64], scale: Scale) -> Vec<[f64; 2]> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = |a: f64, b: f64| match scale {
        Scale::Linear => 0.5 * (a + b),
        Scale::Log => (a * b).sqrt(),
    };
    let beyond = |at: f64, inside: f64| match scale {
        Scale::Linear => at + (at - inside),
        Scale::Log => at * at / inside,
    };
    let cell = |value: f64| {
        let place = sorted.iter().position(|&other| other == value).unwrap_or(0);
        let before = place.checked_sub(1).and_then(|i| sorted.get(i)).copied();
        let after = sorted.get(place + 1).copied();
        let low = before.or_else(|| Some(beyond(value, after?)));
        let high = after.or_else(|| Some(beyond(value, before?)));
        [low.map_or(value, |low| middle(low, value)), high.map_or(value, |high| middle(value, high))]
    };
    values.iter().map(|&value| cell(value)).collect()
}

/// The scale of a parameter: that of its range, and of a list the one on which its values are spaced more evenly.
fn scale(axis: &sweep::Axis) -> Scale {
    let mut values = numbers(axis).unwrap_or_default();
    values.sort_by(f64::total_cmp);
    let unevenness = |gap: fn(f64, f64) -> f64| {
        let gaps = values.windows(2).map(|pair| gap(pair[0], pair[1])).filter(|gap| *gap > 0.0);
        let (least, most) =
            gaps.fold((f64::INFINITY, 0.0_f64), |(least, most), gap| (least.min(gap), most.max(gap)));
        most / least
    };
    let positive = values.len() > 2 && values.first().is_some_and(|&first| first > 0.0);
    let geometric = positive && unevenness(|a, b| ln(b / a)) < unevenness(|a, b| b - a);
    if axis.scale == sweep::Scale::Log || geometric { Scale::Log } else { Scale::Linear }
}

/// The axis of a parameter, which is along the plot from its least to its largest value.
fn parameter(axis: &sweep::Axis) -> Axis {
    let values = numbers(axis).unwrap_or_default();
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let [low, high] = if low < high { [low, high] } else { [low - 1.0, low + 1.0] };
    Axis::new(&axis.path, scale(axis), low, high)
}

/// The axis of a measure: logarithmic where it spans more than three decades.
fn measure(name: &str, values: &[f64]) -> Axis {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if low > 0.0 && high > 1e3 * low {
        return Axis::decades(&title(name), values.iter().copied());
    }
    let margin = if high > low { 0.05 * (high - low) } else { low.abs().max(1.0) * 0.5 };
    Axis::new(&title(name), Scale::Linear, low - margin, high + margin)
}

/// The last name of a dotted path.
fn last_step(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_meet_in_the_middle_in_any_order() {
        assert_eq!(edges(&[3.0, 1.0, 2.0], Scale::Linear), [[2.5, 3.5], [0.5, 1.5], [1.5, 2.5]]);
        assert_eq!(edges(&[4.0, 16.0], Scale::Log), [[2.0, 8.0], [8.0, 32.0]]);
    }

    #[test]
    fn a_list_has_the_scale_on_which_it_is_even() {
        let scale = |values: &[f64]| {
            let values = values.iter().map(|&value| value.into()).collect();
            scale(&sweep::Axis { path: String::new(), values, scale: sweep::Scale::Linear })
        };
        assert_eq!(scale(&[15.0, 500.0, 50.0, 150.0]), Scale::Log);
        assert_eq!(
            [scale(&[1.0, 2.0, 3.0]), scale(&[0.0, 1.0, 10.0]), scale(&[1.0, 1000.0])],
            [Scale::Linear; 3]
        );
    }
}
