//! `drape gallery`: every figure of the report, and a page that shows them.

use std::path::PathBuf;

use serde::Serialize;

use crate::args::address::address;
use crate::args::flag::{flag, size};
use crate::args::part::Part;
use crate::commands::{cells, render};
use crate::session::Session;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use crate::session::progress::Tally;
use crate::session::ui::Ui;
use drape::error::{Error, Kind, Result};
use drape::output::provenance::Arguments;
use drape::scene::Flag;
use drape_lab::gallery::page;
use drape_lab::gallery::reel::{Reel, Watch};
use drape_lab::gallery::shot::{Shot, Shown, State};
use drape_lab::gallery::table::{Picture, parts_called};
use drape_lab::page::live::Live;

/// The name of the page.
const INDEX: &str = "index.html";

/// The arguments of `gallery`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The folder for the pictures, index.html and the simulated states
    #[arg(value_name = "OUT", default_value = "gallery")]
    out: PathBuf,
    /// Draw and show only this figure, or, if no figure has this name, all whose names start with it, such as `part5`;
    /// repeatable (default: all 51 figures, in 56 pictures: five figures have a second picture beside them)
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Width and height of the pictures in pixels (default: the report's 1024x800)
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<String>,
    /// Write only the pictures: no page, and no energy ledger, which takes three quarters of the time
    #[arg(long)]
    pictures: bool,
    /// Simulate only part K of N and keep the states in OUT/cells, for the command without --part
    #[arg(long, value_name = "K/N")]
    part: Option<Part>,
    /// Link each picture on the page to its moment on the live page at this address (see web/README.md)
    #[arg(long, value_name = "URL", value_parser = address, conflicts_with = "pictures")]
    live: Option<String>,
}

/// The summary.
#[derive(Serialize)]
struct Summary<'a> {
    folder: String,
    pictures: Vec<Made<'a>>,
}

/// One picture.
#[derive(Serialize)]
struct Made<'a> {
    name: &'a str,
    #[serde(flatten)]
    state: State,
}

/// Simulates what OUT/cells does not have, draws all pictures, then writes them and the page.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let parts = parts_called(&args.only)?;
    let pictures: Vec<&Picture> = parts.iter().flat_map(|p| &p.figures).flat_map(|f| &f.pictures).collect();
    let shots = pictures.iter().map(|picture| args.shot(picture)).collect::<Result<Vec<Shot>>>()?;
    let files: Vec<PathBuf> =
        pictures.iter().map(|picture| args.out.join(format!("{}.png", picture.name))).collect();
    let index = args.out.join(INDEX);
    outputs::make_folder(&args.out)?;
    let page = (!args.pictures).then_some((index.as_path(), Content::Text));
    outputs::check(&[], files.iter().map(|file| (file.as_path(), Content::Binary)).chain(page))?;

    let store = cells::open(&args.out)?;
    let reel = Reel::new(&shots, !args.pictures, &store);
    if let Some(part) = args.part {
        args.caution_of_part(&session.ui);
        let reel = reel.only(|number| part.takes(number));
        watched(&reel, session, |each_frame| reel.simulate(each_frame))?;
        cells::finish_part(&store, &args.out, session);
        return Ok(());
    }
    let shown = watched(&reel, session, |each_frame| reel.take(each_frame))?;
    cells::warn_of_damaged(&store, session);
    for (file, shown) in files.iter().zip(&shown) {
        atomic::write(file, &shown.png)?;
    }
    if !args.pictures {
        let live = args.live.as_deref().map(Live::at);
        atomic::write(&index, page::page(&parts, &shots, &shown, live.as_ref())?.as_bytes())?;
    }
    let figures = parts.iter().map(|part| part.figures.len()).sum();
    args.finish(figures, &pictures, &shown, session)
}

impl Args {
    /// Warns of options that change nothing in a part, which only simulates.
    fn caution_of_part(&self, ui: &Ui) {
        for (given, option) in [(self.live.is_some(), "--live"), (self.size.is_some(), "--size")] {
            if given {
                ui.caution(&format!("{option} has no effect: a part only simulates"), "");
            }
        }
    }

    fn shot(&self, picture: &Picture) -> Result<Shot> {
        let size = self.size.as_ref().map(|size| flag("--size", "render.size", size));
        read(picture, size)
    }

    fn finish(
        &self,
        figures: usize,
        pictures: &[&Picture],
        shown: &[Shown],
        session: &Session,
    ) -> Result<()> {
        let folder = self.out.display().to_string();
        let made = if self.pictures { self.out.clone() } else { self.out.join(INDEX) };
        let line = format!("{}: figures {figures}, pictures {}", made.display(), shown.len());
        let pictures = pictures.iter().zip(shown);
        let pictures =
            pictures.map(|(picture, shown)| Made { name: &picture.name, state: shown.state }).collect();
        session.report(&Summary { folder, pictures }, &line)
    }
}

/// What the command line makes of a picture's command, a `drape render` of built-in files.
fn read(picture: &Picture, size: Option<Flag>) -> Result<Shot> {
    let wrong = |cause: String| Error::new(Kind::Internal, format!("`{}`: {cause}", picture.command()));
    let render = render::Args::parse_line(picture.words()).map_err(|refusal| wrong(refusal.to_string()))?;
    let flags: Vec<Flag> = render.render.flags().into_iter().chain(size).collect();
    let loaded = render.scene.load_stock(&flags)?;
    let until = render.moment.until(&loaded.scene);
    if until.rest {
        return Err(wrong("its moment is known only at the end".to_owned()));
    }
    let allow_unstable = render.moment.stability.allow_unstable;
    let arguments = Arguments { frame: Some(until.frames), ..Arguments::default() };
    let provenance = render.render.provenance(&loaded, arguments);
    let options = render.render.options(false);
    Ok(Shot { scene: loaded.scene, options, frame: until.frames, allow_unstable, provenance })
}

/// What `work` makes of `reel`, while it is told how far it is.
fn watched<T>(reel: &Reel<'_>, session: &Session, work: impl FnOnce(Watch<'_>) -> Result<T>) -> Result<T> {
    let progress = Tally::new(&session.ui, "frames simulated", reel.frames());
    let made = work(&|| {
        progress.add(1);
        cells::check_stop(session)
    })?;
    cells::check_stop(session)?;
    Ok(made)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape::diagnostics::stability::Stability;
    use drape_lab::gallery::table::parts;

    fn pictures() -> Vec<Picture> {
        let parts = parts().unwrap();
        parts.into_iter().flat_map(|part| part.figures).flat_map(|figure| figure.pictures).collect()
    }

    /// `render` refuses a cloth that is certain to blow up; the gallery does not ask.
    #[test]
    fn the_commands_of_unstable_cloths_alone_allow_it() {
        for picture in pictures() {
            let shot = read(&picture, None).unwrap();
            let unstable = shot.scene.cloth.as_ref().is_some_and(|cloth| {
                shot.frame > 0 && Stability::new(cloth, &shot.scene.sim).unwrap().is_unstable_at_rest()
            });
            assert_eq!(shot.allow_unstable, unstable, "{}", picture.name);
        }
    }

    #[test]
    fn every_picture_has_the_size_of_the_report() {
        for picture in pictures() {
            assert_eq!(read(&picture, None).unwrap().scene.render.size, [1024, 800], "{}", picture.name);
        }
    }
}
