//! Plots as SVG within a page: axes, ticks, lines, markers, areas and a legend.
//!
//! Written here rather than with the crate `plotters`, which writes its colours as numbers: a page
//! follows the reader's light or dark theme only if a plot names the page's custom properties
//! (`--a` to `--f`, `--ink`, `--soft`, `--line`). All sizes are units of the view box, so a plot
//! fits any width; its text is 13 units high, which is 11 pixels on a telephone 390 pixels wide.

use std::fmt::Write;

use super::axis::Axis;
use super::html::escape;

/// Width of the view box and of its text, in units.
const WIDTH: f64 = 420.0;
const TEXT: f64 = 13.0;
/// The frame within the view box: left, right, top, bottom.
const FRAME: [f64; 4] = [62.0, 396.0, 28.0, 290.0];
/// Top of the legend and height of its lines; two entries stand side by side.
const LEGEND: f64 = 352.0;
const LEGEND_LINE: f64 = 20.0;

/// The form of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Disc,
    /// A square.
    Square,
    /// A triangle.
    Triangle,
    /// A square on its corner.
    Diamond,
    /// Two crossing strokes.
    Cross,
    /// Nothing.
    None,
}

/// Colour, marker and stroke of a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// A custom property of the page, such as `--a`.
    pub color: &'static str,
    /// The marker of its points.
    pub marker: Marker,
    /// Whether its markers are only outlines.
    pub hollow: bool,
    /// Whether its line is dashed.
    pub dashed: bool,
    /// Width of its line in units; 0 for none.
    pub stroke: f64,
}

impl Style {
    /// The style of series number `index`: colours and markers take turns, so that 24 differ.
    pub fn of_series(index: usize) -> Self {
        const COLORS: [&str; 6] = ["--a", "--b", "--c", "--d", "--e", "--f"];
        const MARKERS: [Marker; 4] = [Marker::Disc, Marker::Square, Marker::Triangle, Marker::Diamond];
        let [color, marker] = [index % COLORS.len(), (index + index / 12) % MARKERS.len()];
        Self { color: COLORS[color], marker: MARKERS[marker], hollow: false, dashed: false, stroke: 1.5 }
    }

    /// A thin dashed line without markers of its own.
    pub const GUIDE: Self =
        Self { color: "--soft", marker: Marker::None, hollow: true, dashed: true, stroke: 1.0 };
}

/// A plot in the making.
#[derive(Clone, Debug)]
pub struct Plot {
    title: String,
    x: Axis,
    y: Axis,
    body: String,
    legend: String,
    entries: usize,
}

impl Plot {
    /// An empty plot; `title` also describes it to those who cannot see it.
    pub fn new(title: &str, x: Axis, y: Axis) -> Self {
        Self { title: title.to_owned(), x, y, body: String::new(), legend: String::new(), entries: 0 }
    }

    /// A point of the view box.
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [left, right, top, bottom] = FRAME;
        [left + self.x.place(x) * (right - left), bottom - self.y.place(y) * (bottom - top)]
    }

    /// Joins `points`; what lies outside the frame is cut off.
    pub fn line(&mut self, points: &[[f64; 2]], style: Style) {
        let places: Vec<_> = points.iter().map(|&point| self.at(point)).map(pair).collect();
        let dash = if style.dashed { ";stroke-dasharray:4 4" } else { "" };
        let Style { color, stroke, .. } = style;
        self.body += &format!(
            "<polyline clip-path=\"url(#frame)\" points=\"{}\" style=\"fill:none;stroke:var({color});stroke-width:{stroke}{dash}\"/>\n",
            places.join(" ")
        );
    }

    /// A marker at `point`, explained by `hint`.
    pub fn marker(&mut self, point: [f64; 2], style: Style, hint: &str) {
        let place = self.at(point);
        if place.iter().all(|c| c.is_finite()) {
            self.body += &format!("<g>{}<title>{}</title></g>\n", shape(place, style), escape(hint));
        }
    }

    /// Fills the area between two corners, explained by `hint`; what lies outside is cut off.
    pub fn area(&mut self, corners: [[f64; 2]; 2], color: &str, opacity: f64, hint: &str) {
        let [[x0, y0], [x1, y1]] = corners.map(|corner| self.at(corner));
        self.body += &format!(
            "<rect clip-path=\"url(#frame)\" x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" style=\"fill:var({color});opacity:{opacity}\"><title>{}</title></rect>\n",
            x0.min(x1),
            y0.min(y1),
            (x1 - x0).abs(),
            (y1 - y0).abs(),
            escape(hint)
        );
    }

    /// Writes `text` beside `point`.
    pub fn note(&mut self, point: [f64; 2], text: &str) {
        let [x, y] = self.at(point);
        self.body += &text_at([x, y - 4.0], "middle", "--soft", text);
    }

    /// Explains a style.
    pub fn entry(&mut self, style: Style, text: &str) {
        let column = f64::from(u8::from(self.entries % 2 == 1));
        let [x, y] = [8.0 + column * 0.5 * WIDTH, LEGEND + (self.entries / 2) as f64 * LEGEND_LINE];
        if style.stroke > 0.0 {
            let dash = if style.dashed { ";stroke-dasharray:4 4" } else { "" };
            let Style { color, stroke, .. } = style;
            self.legend += &format!(
                "<path d=\"M{x} {y}h24\" style=\"stroke:var({color});stroke-width:{stroke}{dash}\"/>"
            );
        }
        self.legend += &shape([x + 12.0, y], style);
        self.legend += &text_at([x + 30.0, y + 4.5], "start", "--ink", text);
        self.entries += 1;
    }

    /// The whole plot as an `svg` element; `id` is one that no other plot of the page has.
    pub fn finish(&self, id: &str) -> String {
        let [left, right, top, bottom] = FRAME;
        let height = LEGEND + self.entries.div_ceil(2) as f64 * LEGEND_LINE - 6.0;
        let mut svg = format!(
            "<svg viewBox=\"0 0 {WIDTH} {height}\" font-size=\"{TEXT}\" role=\"img\" aria-label=\"{0}\" class=\"plot\">\n\
             <clipPath id=\"{id}\"><rect x=\"{left}\" y=\"{top}\" width=\"{1}\" height=\"{2}\"/></clipPath>\n",
            escape(&self.title),
            right - left,
            bottom - top,
        );
        self.grid(&mut svg);
        svg += &text_at([0.5 * (left + right), 16.0], "middle", "--ink", &self.title);
        svg += &self.body.replace("url(#frame)", &format!("url(#{id})"));
        svg + &self.legend + "</svg>\n"
    }

    /// The frame, the ticks with their lines, and the labels.
    fn grid(&self, svg: &mut String) {
        let [left, right, top, bottom] = FRAME;
        let mut path = format!("M{left} {top}H{right}V{bottom}H{left}Z");
        for (value, text) in self.x.ticks() {
            let x = left + self.x.place(value) * (right - left);
            // Writing to a string cannot fail.
            let _ = write!(path, "M{x:.2} {top}V{bottom}");
            *svg += &text_at([x, bottom + 17.0], "middle", "--soft", &text);
        }
        for (value, text) in self.y.ticks() {
            let y = bottom - self.y.place(value) * (bottom - top);
            let _ = write!(path, "M{left} {y:.2}H{right}");
            *svg += &text_at([left - 5.0, y + 4.5], "end", "--soft", &text);
        }
        *svg += &format!("<path d=\"{path}\" style=\"fill:none;stroke:var(--line)\"/>\n");
        *svg += &text_at([0.5 * (left + right), bottom + 37.0], "middle", "--ink", &self.x.label);
        let turned = text_at([-0.5 * (top + bottom), 12.0], "middle", "--ink", &self.y.label);
        *svg += &format!("<g transform=\"rotate(-90)\">{turned}</g>\n");
    }
}

fn pair([x, y]: [f64; 2]) -> String {
    format!("{x:.2},{y:.2}")
}

fn text_at([x, y]: [f64; 2], anchor: &str, color: &str, text: &str) -> String {
    format!(
        "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\" style=\"fill:var({color})\">{}</text>\n",
        escape(text)
    )
}

/// A marker at a point of the view box.
fn shape([x, y]: [f64; 2], style: Style) -> String {
    let path = match style.marker {
        Marker::Disc => "m-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z",
        Marker::Square => "m-3.6 -3.6h7.2v7.2h-7.2z",
        Marker::Triangle => "m0 -5l4.8 8.4h-9.6z",
        Marker::Diamond => "m0 -5l5 5l-5 5l-5 -5z",
        Marker::Cross => "m-4 -4l8 8m0 -8l-8 8",
        Marker::None => return String::new(),
    };
    let fill = if style.hollow { "--paper" } else { style.color };
    let color = style.color;
    format!(
        "<path d=\"M{x:.2} {y:.2}{path}\" style=\"fill:var({fill});stroke:var({color});stroke-width:1.6\"/>"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::axis::Scale;

    fn plot() -> Plot {
        let axis = |label| Axis::new(label, Scale::Linear, 0.0, 10.0);
        Plot::new("a < b", axis("time (s)"), axis("error (m)"))
    }

    #[test]
    fn the_corners_of_the_axes_are_those_of_the_frame() {
        let [left, right, top, bottom] = FRAME;
        assert_eq!(plot().at([0.0, 0.0]), [left, bottom]);
        assert_eq!(plot().at([10.0, 10.0]), [right, top]);
    }

    #[test]
    fn a_plot_holds_what_was_drawn_and_follows_the_theme() {
        let mut plot = plot();
        plot.line(&[[0.0, 0.0], [10.0, 5.0]], Style::of_series(1));
        plot.marker([5.0, 5.0], Style { hollow: true, ..Style::of_series(2) }, "half \"way\"");
        plot.marker([f64::NAN, 5.0], Style::of_series(2), "nowhere");
        plot.area([[0.0, 0.0], [10.0, 2.5]], "--soft", 0.3, "floor");
        plot.entry(Style::of_series(1), "one");
        let svg = plot.finish("p0");
        for part in
            ["a &lt; b", "time (s)", "error (m)", "points=\"62.00,290.00 396.00,159.00\"", "half &quot;way"]
        {
            assert!(svg.contains(part), "{part} in {svg}");
        }
        assert!(svg.contains("y=\"224.50\" width=\"334.00\" height=\"65.50\""), "{svg}");
        assert!(!svg.contains("nowhere") && !svg.contains("NaN") && !svg.contains("rgb"));
        assert_eq!(svg.matches("url(#p0)").count(), 2);
        assert_eq!(svg.matches("<svg").count() + svg.matches("</svg>").count(), 2);
    }

    #[test]
    fn series_differ() {
        let styles: Vec<_> =
            (0..24).map(|i| (Style::of_series(i).color, Style::of_series(i).marker)).collect();
        for (i, style) in styles.iter().enumerate() {
            assert!(!styles[..i].contains(style), "{i}: {style:?}");
        }
    }
}
