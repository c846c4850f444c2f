//! `drape stability`: a map of where a cloth is stable, over stiffness, density and steps per frame.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::args::address::address;
use crate::args::part::Part;
use crate::args::scene::SceneArgs;
use crate::commands::cells;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use crate::session::progress::Tally;
use crate::session::ui::Ui;
use crate::session::{Session, json_failed};
use drape::error::{Error, Kind, Result};
use drape::scene::{Cloth, SEEN, Scene};
use drape_lab::page::short;
use drape_lab::printable;
use drape_lab::stability_map::extremes::{self, Row};
use drape_lab::stability_map::range::Values;
use drape_lab::stability_map::{Axes, Column, Map, page};
use drape_lab::store::Store;

/// Stiffness, density and steps of the whole map, and of a quick one, as the help has them.
const FULL: [&str; 3] = ["500..500000:log7", "1.5..1500:log4", "1..500:log10"];
const QUICK: [&str; 3] = ["500..500000:log3", "1.5..1500:log3", "1..300:log6"];

/// The arguments of `stability`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The folder for index.html, results.json and the finished runs
    #[arg(value_name = "OUT", default_value = "stability")]
    out: PathBuf,
    /// Stiffness in N/m: a list such as `500,5000`, or a range of 4 values with equal ratios, `500..500000:log4`, or
    /// equal differences, `500..500000:lin4` (default: 500..500000:log7; --quick: 500..500000:log3)
    #[arg(long, value_name = "RANGE", value_parser = Values::parse)]
    ks: Option<Values>,
    /// Density in kg/m², in the same form (default: 1.5..1500:log4; --quick: 1.5..1500:log3)
    #[arg(long, value_name = "RANGE", value_parser = Values::parse)]
    density: Option<Values>,
    /// Steps per frame, in the same form (default: 1..500:log10; --quick: 1..300:log6)
    #[arg(long, value_name = "RANGE", value_parser = Values::parse)]
    steps: Option<Values>,
    /// Simulated time of each run, in seconds (default: 0.5; --quick: 0.2)
    #[arg(long, value_name = "S", value_parser = crate::args::flag::seconds)]
    time: Option<f64>,
    /// A coarse map of shorter runs: half a minute of processor time for scenes/pinned2.json instead of three
    /// minutes
    #[arg(long)]
    quick: bool,
    /// Run only part K of N of the map and keep the results in OUT/cells, for the command without --part
    #[arg(long, value_name = "K/N")]
    part: Option<Part>,
    /// Link each row of the page's table to its cloth on the live page at this address (see web/README.md)
    #[arg(long, value_name = "URL", value_parser = address)]
    live: Option<String>,
}

/// The results.
#[derive(Serialize)]
struct Results<'a> {
    map: &'a Map,
    extremes: &'a [Row],
}

/// Runs every cell and every extreme, writes the page and the numbers, prints the thresholds.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let scene = args.scene.load(session)?;
    let Some(cloth) = &scene.cloth else {
        return Err(Error::new(Kind::Nothing, "the scene has no cloth, so there is no map of its stability"));
    };
    args.caution(&session.ui);
    let files = ["index.html", "results.json"].map(|name| args.out.join(name));
    outputs::make_folder(&args.out)?;
    outputs::check(&args.scene.inputs(), files.iter().map(|file| (file.as_path(), Content::Text)))?;

    let live = args.live.as_deref().map(|url| args.scene.live(url)).transpose()?;
    let store = cells::open(&args.out)?;
    if let Some(part) = args.part {
        return args.share(&scene, cloth, part, &store, session);
    }
    let (map, rows) = args.measure(&scene, cloth, &store, session)?;
    cells::warn_of_damaged(&store, session);
    let results = Results { map: &map, extremes: &rows };
    let json = serde_json::to_string_pretty(&results).map_err(|e| json_failed(&e))?;
    let [index, data] = files;
    atomic::write(&data, (json + "\n").as_bytes())?;
    atomic::write(&index, page::page(&args.title(), &map, &rows, live.as_ref()).as_bytes())?;
    session.print(&results, &text(&map, &rows, &index))
}

impl Args {
    /// Warns of options that change nothing.
    fn caution(&self, ui: &Ui) {
        self.scene.caution_of_own_moments(ui);
        for (key, option) in
            [("cloth.ks", "--ks"), ("cloth.density", "--density"), ("sim.steps_per_frame", "--steps")]
        {
            self.scene.caution(&[key], &format!("{option} says which values the map has"), ui);
        }
        if self.live.is_none() {
            self.scene.caution(&SEEN, "`stability` draws nothing of the scene", ui);
        }
        if self.live.is_some() && self.part.is_some() {
            ui.caution("--live has no effect: a part writes no page", "");
        }
        let ranges = [&self.ks, &self.density, &self.steps];
        if self.quick && self.time.is_some() && ranges.iter().all(|range| range.is_some()) {
            ui.caution(
                "--quick has no effect: --ks, --density, --steps and --time say all that it would",
                "",
            );
        }
    }

    /// Runs a part of the map.
    fn share(
        &self,
        scene: &Scene,
        cloth: &Cloth,
        part: Part,
        store: &Store,
        session: &Session,
    ) -> Result<()> {
        let axes = self.axes();
        let range = part.range(axes.pieces() as u64);
        let progress = Tally::new(&session.ui, "trying", range.end - range.start);
        let done = || {
            progress.add(1);
            cells::check_stop(session)
        };
        Map::share(scene, cloth, &axes, store, &|number| part.takes(number), &done)?;
        cells::finish_part(store, &self.out, session);
        Ok(())
    }

    fn measure(
        &self,
        scene: &Scene,
        cloth: &Cloth,
        store: &Store,
        session: &Session,
    ) -> Result<(Map, Vec<Row>)> {
        let axes = self.axes();
        let total = axes.pieces() + extremes::len();
        let progress = Tally::new(&session.ui, "trying", total as u64);
        let done = || {
            progress.add(1);
            cells::check_stop(session)
        };
        let map = Map::new(scene, cloth, axes, store, &done)?;
        let rows = extremes::table(&|sets| self.scene.load_with(sets), &mut || done())?;
        Ok((map, rows))
    }

    fn axes(&self) -> Axes {
        let [ks, density, steps] = if self.quick { QUICK } else { FULL };
        let values = |asked: &Option<Values>, text: &str| match asked {
            Some(values) => values.clone(),
            None => Values::parse(text).unwrap_or(Values(Vec::new())),
        };
        Axes {
            ks: values(&self.ks, ks).0,
            density: values(&self.density, density).0,
            steps: values(&self.steps, steps).whole(),
            time: self.time.unwrap_or(if self.quick { 0.2 } else { 0.5 }),
        }
    }

    fn title(&self) -> String {
        let name = self.scene.path.file_stem().unwrap_or_default();
        format!("Where {} is stable", name.to_string_lossy())
    }
}

/// The thresholds, the outcome of the extremes and those with a wrong outcome, and the path of the page.
fn text(map: &Map, rows: &[Row], index: &Path) -> String {
    let steps = |found: Option<f64>| found.map_or_else(|| "-".to_owned(), |steps| page::rate(steps, map.fps));
    let line = |column: &Column| {
        let [rest, worst, _] = column.theory;
        format!(
            "{:>10} {:>10} {:>15} {:>15} {:>15} {:>15}\n",
            short(column.density),
            short(column.ks),
            steps(Some(rest)),
            steps(column.at_rest),
            steps(column.in_motion),
            steps(Some(worst)),
        )
    };
    let columns: String = map.columns.iter().map(line).collect();
    let broken = rows.iter().filter(|row| !row.kept);
    let broken: String =
        broken.map(|row| format!("broken promise: {}: {}\n", row.what, row.happened)).collect();
    format!(
        "fewest stable steps a second, in brackets per frame\n\
         {:>10} {:>10} {:>15} {:>15} {:>15} {:>15}\n{columns}\
         extremes     {} (docs/extremes.md)\n{broken}page         {}\n",
        "density",
        "ks",
        "at rest",
        "tried at rest",
        "tried in motion",
        "at worst",
        extremes::headline(rows),
        printable::line(&index.display().to_string()),
    )
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, Parser};

    use super::*;

    #[derive(Parser)]
    struct Stability {
        #[command(flatten)]
        args: Args,
    }

    #[test]
    fn the_help_has_the_defaults() {
        let help = Stability::command().render_long_help().to_string();
        for default in FULL.iter().chain(&QUICK) {
            assert!(Values::parse(default).is_ok() && help.contains(default), "{default}: {help}");
        }
        let axes = |option: &[&str]| {
            let words = ["stability", "a.json"].iter().chain(option);
            Stability::try_parse_from(words).unwrap().args.axes()
        };
        let [full, quick] = [axes(&[]), axes(&["--quick"])];
        assert_eq!([full.ks.len(), full.density.len(), full.steps.len()], [7, 4, 10]);
        for axes in [full, quick] {
            assert!(help.contains(&format!(": {}", axes.time)), "{} s: {help}", axes.time);
        }
    }
}
