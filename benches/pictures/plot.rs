//! The plot of `docs/speed.md`: how the time of a picture grows with the points of the cloth and with the pixels.

use std::f64::consts::LN_10;
use std::fmt::Write;

use drape::math::{ln, pow};

/// Width and height of the plot, and its frame: left, right, top, bottom.
const SIZE: [f64; 2] = [640.0, 400.0];
const FRAME: [f64; 4] = [64.0, 620.0, 20.0, 340.0];

/// The powers of ten at the ends of both axes: counts, and milliseconds.
const ENDS: [[f64; 2]; 2] = [[3.0, 8.0], [-1.0, 4.0]];

/// Rows that are plotted by the first word of their names, with their colours and what stands in the legend.
const SERIES: [(&str, &str, &str); 2] = [
    ("cloth", "#b3541e", "points of a cloth in 1024 x 800 pixels"),
    ("pixels", "#2a6f97", "pixels of a square picture of sphere.json"),
];

/// A place in the plot.
fn place(count: f64, milliseconds: f64) -> [f64; 2] {
    let [left, right, top, bottom] = FRAME;
    let part = |value: f64, [low, high]: [f64; 2]| (ln(value) / LN_10 - low) / (high - low);
    let (x, y) = (part(count, ENDS[0]), part(milliseconds, ENDS[1]));
    [left + x * (right - left), bottom - y * (bottom - top)]
}

/// What a row of a table adds to the series called `word`: a count, and its least time.
fn entry(row: &str, word: &str) -> Option<[f64; 2]> {
    let mut cells = row.trim_matches('|').split('|').map(str::trim);
    let (name, least) = (cells.next()?, cells.next()?);
    let side: f64 = name.strip_prefix(word)?.trim().parse().ok()?;
    Some([side * side, least.parse().ok()?])
}

/// The plot as SVG, from the tables for one thread and for two. A dotted line has the slope of linear growth.
pub(super) fn plot(tables: &[String]) -> String {
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"13\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    grid(&mut svg);
    for (at, (word, color, meaning)) in SERIES.into_iter().enumerate() {
        for (table, dashes) in tables.iter().zip(["", "6 3"]) {
            let places: Vec<[f64; 2]> =
                table.lines().filter_map(|row| entry(row, word)).map(|[n, ms]| place(n, ms)).collect();
            let line: String = places.iter().map(|[x, y]| format!("{x:.1},{y:.1} ")).collect();
            let _ = writeln!(
                svg,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\" stroke-dasharray=\"{dashes}\"/>",
                line.trim_end()
            );
            for [x, y] in places {
                let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{color}\"/>");
            }
        }
        let y = FRAME[2] + 20.0 * (at + 1) as f64;
        let _ = writeln!(svg, "<text x=\"80\" y=\"{y}\" fill=\"{color}\">{meaning}</text>");
    }
    let _ = writeln!(
        svg,
        "<text x=\"80\" y=\"{}\">line: 1 thread; dashed: 2; dotted: linear</text>",
        FRAME[2] + 60.0
    );
    svg + "</svg>\n"
}

/// Axes with a line for each power of ten, and lines of linear growth.
fn grid(svg: &mut String) {
    let [left, right, top, bottom] = FRAME;
    for exponent in 3..=8 {
        let [x, _] = place(pow(10.0, f64::from(exponent)), 1.0);
        let _ = writeln!(svg, "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"#ddd\"/>");
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">10<tspan dy=\"-5\" font-size=\"9\">{exponent}</tspan></text>",
            bottom + 20.0
        );
    }
    for exponent in -1..=4 {
        let [_, y] = place(1.0, pow(10.0, f64::from(exponent)));
        let _ = writeln!(svg, "<path d=\"M{left} {y:.1}H{right}\" stroke=\"#ddd\"/>");
        let _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            left - 6.0,
            y + 4.0,
            pow(10.0, f64::from(exponent))
        );
    }
    for first in [[1e3, 0.1], [1e4, 0.1]] {
        let ([x, y], [end_x, end_y]) = (place(first[0], first[1]), place(1e8, first[1] * 1e8 / first[0]));
        let _ = writeln!(
            svg,
            "<path d=\"M{x:.1} {y:.1}L{end_x:.1} {end_y:.1}\" stroke=\"#999\" stroke-dasharray=\"1 4\"/>"
        );
    }
    let middle = f64::midpoint(left, right);
    let _ = writeln!(
        svg,
        "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">count</text>\n<text x=\"14\" y=\"{}\" \
         transform=\"rotate(-90 14 180)\" text-anchor=\"middle\">ms a picture, least</text>",
        bottom + 45.0,
        180
    );
}
