//! The meaning of the colours, lines and marks of the maps, once for all maps of a page.

use super::outcome::Outcome;
use crate::page::escape;
use crate::page::plot::{Marker, Style};

/// The style of the legend.
pub(super) const STYLE: &str = "\
.legend{list-style:none;padding:0;font-size:.9rem}.legend li{padding-left:2.6rem;margin:.4rem 0}\
.legend i{float:left;width:1.8rem;margin-left:-2.6rem;text-align:center;font-style:normal}\
.legend .fill{height:1.1em;margin-top:.15em;opacity:.65}.legend .line{margin-top:.75em}";

/// How opaque the rectangles are, here and in the maps.
pub(super) const OPACITY: f64 = 0.65;

/// A bound by theory.
pub(super) struct Line {
    /// Its name in every page, message and table.
    pub(super) name: &'static str,
    meaning: &'static str,
    color: &'static str,
    /// Width in units of a plot.
    stroke: f64,
    dashed: bool,
}

/// In the order of [`super::map::Column::theory`].
pub(super) const LINES: [Line; 3] = [
    Line {
        name: "at rest",
        meaning: "the bound by theory in the shape of the start (ω² = 8 ks/m for the stock lattice). With fewer steps \
                  per frame than this line the cloth is certain to blow up, if it moves for long enough.",
        color: "--ink",
        stroke: 2.0,
        dashed: false,
    },
    Line {
        name: "at worst",
        meaning: "the bound by theory in the shape whose vibrations are the fastest (12 ks/m). With at least as many \
                  steps no cloth was found to blow up. The bound is higher without damping, since motion then feeds \
                  resonances. Between the two lines the outcome depends on how the cloth is deformed.",
        color: "--ink",
        stroke: 2.0,
        dashed: true,
    },
    Line {
        name: "Gershgorin",
        meaning: "a cruder bound (17.6 ks/m): twice the stiffness of all springs that meet in a point. It is shown for \
                  comparison; no cloth needs so many steps.",
        color: "--soft",
        stroke: 1.0,
        dashed: true,
    },
];

impl Line {
    /// How it is drawn.
    pub(super) fn style(&self) -> Style {
        Style { color: self.color, dashed: self.dashed, stroke: self.stroke, ..Style::GUIDE }
    }
}

/// The thresholds found by bisection: mark, name, and the character for the mark in the legend.
pub(super) const TRIED: [(Marker, &str, &str); 2] =
    [(Marker::Disc, "tried at rest", "●"), (Marker::Diamond, "tried in motion", "◆")];

/// The colour of an outcome.
pub(super) fn color(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Ok => "--c",
        Outcome::Stretch => "--a",
        Outcome::Energy => "--b",
        Outcome::Lost => "--f",
    }
}

/// What was observed, whether it is a blow-up, and what to do.
fn meaning(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Ok => {
            "no blow-up in this run, and no spring much longer than the stretch limit allows. These values may be used; \
             with at least as many steps as the line at worst no blow-up was found later."
        }
        Outcome::Stretch => {
            "no blow-up: no energy came from nothing. But at the end of a frame a spring exceeded its rest length by \
             more than twice what the stretch limit allows: one pass of the limit in each of so few steps is not \
             enough for a cloth so heavy or soft. These values may be used where that does no harm; more steps per \
             frame help, even far above all lines."
        }
        Outcome::Energy => {
            "a blow-up: the cloth held more energy than its forces can give, or its springs put in more. Between the \
             lines the springs may also only react to the corrections of the stretch limit in every step, and stay \
             bounded. Do not use these values; more steps per frame, a smaller ks or a higher density help."
        }
        Outcome::Lost => {
            "a complete blow-up: a position is not a number, or is beyond 1e15 m. Do not use these values; the same \
             changes help."
        }
    }
}

/// The legend as HTML.
pub(super) fn legend() -> String {
    let outcomes = Outcome::ALL.map(|outcome| {
        let swatch = format!("<i class=\"fill\" style=\"background:var({})\"></i>", color(outcome));
        entry(&swatch, outcome.name(), meaning(outcome))
    });
    let lines = LINES.map(|Line { name, meaning, color, stroke, dashed }| {
        let kind = if dashed { "dashed" } else { "solid" };
        let swatch = format!("<i class=\"line\" style=\"border-top:{stroke}px {kind} var({color})\"></i>");
        entry(&swatch, name, meaning)
    });
    let tried = TRIED.map(|(_, name, mark)| {
        entry(
            &format!("<i>{mark}</i>"),
            name,
            "the fewest stable steps found by bisection, as in the table below.",
        )
    });
    format!("<ul class=\"legend\">\n{}{}{}</ul>\n", outcomes.concat(), lines.concat(), tried.concat())
}

fn entry(swatch: &str, name: &str, meaning: &str) -> String {
    format!("<li>{swatch}<strong>{}</strong>: {}</li>\n", escape(name), escape(meaning))
}
