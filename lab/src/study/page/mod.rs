//! `index.html`: advice, work-precision plots, tables and pictures on one page.

mod plots;
mod tables;

use super::extent::Extent;
use super::findings::{Cost, PanelStudy, Study};
use super::method::METHODS;
use super::pictures::Pictures;
use super::results::kept;
use crate::page::comparison::figure;
use crate::page::{self, escape, live::Live, short};
use drape::error::Result;
use drape::output::compare::difference_picture;
use drape::output::png::Effort;

/// What the page adds to the style of every page: plots side by side where there is room, and no larger than
/// their text needs.
const STYLE: &str = "<style>.plots{display:flex;flex-wrap:wrap;gap:1rem}\
.plots>svg{flex:1 1 22rem;min-width:0;max-width:38rem}details{margin:1rem 0}th,td.name{white-space:normal}\
.worded th:nth-child(2),.worded td:nth-child(2){white-space:normal;text-align:left;min-width:9rem}</style>\n";

/// The page of `study` of the scene called `scene`; with links to its runs on a live page, if there is one.
///
/// # Errors
/// Those of the renderer.
pub fn page(study: &Study, scene: &str, live: Option<&Live>) -> Result<String> {
    let mut text = page::head(&format!("Speed against accuracy: {scene}")) + STYLE;
    text += &format!("<p>{}</p>\n", introduction(study));
    text += "<h2>If you can pay this, use that</h2>\n<p>The budget is wall time: per simulated second, or per picture.</p>\n";
    for panel in &study.panels {
        text +=
            &format!("<h3>{}</h3>\n<div class=\"worded\">{}</div>\n", heading(panel), tables::advice(panel));
    }
    if let Some(pictures) = &study.pictures {
        text +=
            &format!("<h3>Pictures</h3>\n<div class=\"worded\">{}</div>\n", tables::picture_advice(pictures));
    }
    for (number, panel) in study.panels.iter().enumerate() {
        text += &section(study, panel, number, live);
    }
    for k_over_m in &study.left_out {
        text += &format!("<p>k/m = {k_over_m:.2e} /s² is left out: its reference would take too long.</p>\n");
    }
    text += &match &study.pictures {
        Some(pictures) => picture_section(pictures)?,
        None if !study.extent.only.is_empty() => String::new(),
        None => "<p>No pictures: a wireframe has no converged picture, since its lines are one pixel wide at every \
                 size, and a cloth that becomes unstable cannot be drawn.</p>\n"
            .to_owned(),
    };
    Ok(text + &method_section(&study.extent) + page::END)
}

/// What the model leaves out, after a comma.
fn without(extent: &Extent) -> String {
    let left_out: Vec<&str> = [("stretch_limit", "stretch limit"), ("self_collision", "self-collision")]
        .into_iter()
        .filter(|(key, _)| !extent.kept.contains(key))
        .map(|(_, name)| name)
        .collect();
    if left_out.is_empty() { String::new() } else { format!("without {} and ", left_out.join(" and ")) }
}

fn introduction(study: &Study) -> String {
    let times: Vec<String> =
        study.extent.tenths.iter().map(|t| format!("{}", f64::from(*t) / 10.0)).collect();
    format!(
        "Compared is the start of the motion, at {} s, {}with damping per \
         second, whatever the scene says: all methods approach only this model as their steps shrink. Methods that \
         are named after one of these options use it. {}{}</p>\n\
         <p>Each point is a method at a number of steps per second. The horizontal axis is the cost. The vertical axis \
         is the error: the root mean square distance of the points from those of the reference. The reference is the \
         model with so many steps that halving their number changes the positions by less than the grey floor. An \
         error below ten times the floor cannot be distinguished from that of the reference and counts as ten times \
         the floor. Times were measured one run after the other on this machine; each is the median of up to {} \
         interleaved repetitions. Springs visited are counted, and the same on every machine.{}",
        times.join(", "),
        without(&study.extent),
        cloths(study),
        kept(&study.extent.kept).map_or_else(String::new, |note| format!(" Note: {}.", escape(&note))),
        study.extent.repeats,
        match study.extent.only.is_empty() {
            true => String::new(),
            false =>
                format!(" Only the runs selected by {} were made.", escape(&study.extent.only.join(" or "))),
        },
    )
}

/// Why other cloths than that of the scene are studied.
fn cloths(study: &Study) -> String {
    let others = study.panels.iter().filter(|panel| panel.panel.part != 1.0);
    let others: Vec<_> = others.map(|panel| panel.panel.cloth()).collect();
    if others.is_empty() {
        return String::new();
    }
    format!(
        "Besides the scene's cloth, lighter ones are studied, of {}: the lighter the cloth, the shorter is the longest \
         stable step of Verlet's scheme. k/m is the stiffness of a spring over the mass of a point: at 1/1000 of the \
         density it is 1000 times as high.",
        others.join(" and ")
    )
}

/// The heading of a panel.
fn heading(panel: &PanelStudy) -> String {
    let panel = &panel.panel;
    format!(
        "k/m = {:.2e} /s² ({}: {} kg/m², stable at worst from {:.0} steps/s)",
        panel.k_over_m,
        panel.cloth(),
        short(panel.density),
        panel.stable_rate
    )
}

fn section(study: &Study, panel: &PanelStudy, number: usize, live: Option<&Live>) -> String {
    let plots = [Cost::Wall, Cost::Springs].map(|cost| plots::work_precision(study, panel, cost, number));
    let [by_time, by_count] = [Cost::Wall, Cost::Springs].map(|cost| {
        let names: Vec<_> = panel.front(cost).into_iter().map(|i| escape(&panel.name(i))).collect();
        names.join(" → ")
    });
    let [coarse, fine] = panel.reference.rates;
    format!(
        "<h2>{}</h2>\n<div class=\"plots\">\n{}</div>\n\
         <p><strong>Pareto front</strong>: no other point is both cheaper and more accurate.</p>\n\
         <ul><li>By time: {by_time}.</li>\n<li>By springs visited: {by_count}.</li></ul>\n\
         <p class=\"soft\">Hollow: at some moment the cloth holds more energy than the reference, by over 1 % of what the \
         fall released. It gained energy from nothing, or its model dissipates less (damping per step, stretch limit). \
         Crosses on the top edge: lost, a position is not a number. Not drawn: runs that were given up before this \
         moment, after {:.0e} springs, or twice as many before the first moment. Grey: cannot be distinguished from the \
         reference, which is Verlet with the half-step start at {fine} steps/s; the floor is its distance from \
         {coarse} steps/s.</p>\n\
         <details><summary>All {} runs</summary>\n<div class=\"worded\">{}</div></details>\n",
        heading(panel),
        plots.concat(),
        study.extent.most_springs,
        panel.cells.len(),
        tables::cells(study, panel, live),
    )
}

fn picture_section(pictures: &Pictures) -> Result<String> {
    let [width, height] = pictures.size();
    let (pixels, levels) = pictures.rounding()?;
    let mut text = format!(
        "<h2>Pictures</h2>\n<p>{width} × {height} pixels at the scene's time. The horizontal axis is the time to draw \
         one. The vertical axis is the root mean square difference from a converged picture (256 samples a pixel, \
         binary64, bilinear filter), in levels of 255; grey is the difference of that one from one with 64 samples. \
         Fragment programs in binary32 instead of binary64 change at most {pixels} pixels of a picture, by at most \
         {levels} of 255.</p>\n<div class=\"plots\">\n{}</div>\n{}",
        plots::pictures(pictures),
        tables::ways(pictures),
    );
    text += &figure("converged", &pictures.converged, Effort::Small)?;
    let shown = tables::shown(pictures);
    for i in shown {
        let drawn = &pictures.drawn[i];
        let picture = pictures.draw(&drawn.way)?;
        let map = difference_picture(&pictures.converged, &picture);
        text += &format!(
            "<h3>{}</h3>\n<div class=\"row\">\n{}{}</div>\n",
            escape(&drawn.way.text()),
            figure(
                &format!("{:.2} ms, error {:.3} of 255", drawn.ms(), drawn.rmse),
                &picture,
                Effort::Small
            )?,
            figure("error map: black where equal, white where off by 255", &map, Effort::Small)?,
        );
    }
    Ok(text)
}

/// What each method changes.
fn method_section(extent: &Extent) -> String {
    let code = |sets: &[String]| {
        let sets: Vec<_> = sets.iter().map(|set| format!("<code>{}</code>", escape(set))).collect();
        if sets.is_empty() { "the model itself".to_owned() } else { sets.join(" ") }
    };
    let row = |(name, sets): (&str, String)| {
        format!("<tr><td>{}</td><td class=\"name\">{sets}</td></tr>\n", escape(name))
    };
    let rows: String = METHODS.iter().map(|method| row((method.name, code(&method.sets)))).collect();
    format!(
        "<h2>Methods</h2>\n<p>What each method sets besides the steps, as <code>--set</code> takes it. An implicit method is stable with any \
         number of steps, but fewer steps are not always cheaper: a longer step takes more iterations.</p>\n\
         <div class=\"wide\"><table><tr><th>method</th><th>changes</th></tr>\n{}{rows}</table></div>\n",
        row(("model", code(&extent.model().into_iter().map(str::to_owned).collect::<Vec<_>>()))),
    )
}
