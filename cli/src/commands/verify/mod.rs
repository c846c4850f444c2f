//! `drape verify`: a picture is made again from what it says of itself.
//!
//! First the pixels of the file are held against their hash, then the scene and the textures, each before anything
//! is simulated; then the state and every pixel against what is made again. The first difference ends it.

mod file;
mod again;
mod report;

use std::path::{Path, PathBuf};

use serde_json::{Map, Value};

use crate::args::render::{springs, texture_hash};
use crate::args::{state, textures};
use crate::run::start::{renderer, start};
use crate::session::Session;
use again::{Again, Moments};
use drape::error::{Error, Kind, Result};
use drape::output::provenance::{Provenance, document, document_hash};
use drape::render::{Options, Renderer};
use drape::scene::{self, Difference, Overrides, Scene, differences};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;
use file::{AsSeen, File};
use report::Report;

/// The arguments of `verify`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The picture or animation that `drape` wrote: PNG, animated PNG or GIF
    #[arg(value_name = "PICTURE")]
    picture: PathBuf,
    /// The scene file that it should be of (default: the scene that the picture holds); the changes that options made
    /// are made again. `-` for standard input
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Read all textures from this folder, if the picture was drawn with one
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
    /// Go on from the state in this file instead of simulating from the start
    #[arg(long, value_name = "FILE")]
    from_state: Option<PathBuf>,
}

/// Most differences between two scenes that are told.
const MOST_TOLD: usize = 5;

/// How often every animation that `drape` writes is shown.
const ENDLESS: &str = "endless";

/// Checks, makes again, compares; a difference is an error of [`Kind::Difference`].
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let file = File::read(&args.picture)?;
    let mut report = Report::new(args.picture.display().to_string(), &file.provenance);
    if report.is_of_another_version() {
        let version = &file.provenance.version;
        session
            .ui
            .caution(&format!("version {version} wrote the picture"), "this version may draw another one");
    }
    verify(args, &file, &mut report, session)?;
    session.print(&report, &report.text())?;
    report.verdict()
}

/// Notes in `report` what is equal, up to the first difference.
fn verify(args: &Args, file: &File, report: &mut Report, session: &Session) -> Result<()> {
    let said = &file.provenance;
    let picture = said.picture.as_deref().unwrap_or_default();
    let seen = file.seen()?;
    report.check("pixels", picture, &seen.hash, || {
        "its pixels are not those that it was written with".to_owned()
    });
    if !report.is_equal() {
        return Ok(());
    }
    let Some(scene) = args.scene(said, report, session)? else { return Ok(()) };
    let source = args.textures.clone().map_or(TextureSource::BuiltIn, TextureSource::Folder);
    let renderer = renderer(&scene, &source, session)?;
    textures::caution(args.textures.as_deref(), &scene, &session.ui);
    check_textures(said, &scene, &renderer, report);
    if !report.is_equal() {
        return Ok(());
    }
    let moments = Moments::of(&said.arguments, &scene)?;
    let size = scene.render.size;
    check_extent(&seen, &moments, size, report);
    if !report.is_equal() {
        return Ok(());
    }
    let kinds = said.arguments.springs.as_deref().map(springs).transpose();
    let springs =
        kinds.map_err(|why| Error::new(Kind::Io, format!("what the picture says is damaged: {why}")))?;
    let options = Options { springs, ..Options::default() };
    let simulation = args.simulation(&scene, &moments, session)?;
    let again = Again { file, moments: &moments, renderer: &renderer, options, size };
    let made = again.make(simulation, session)?;
    report.check("state", said.state.as_deref().unwrap_or_default(), &made.state, || {
        "the cloth is in another state than the picture says".to_owned()
    });
    report.check("picture", picture, &made.picture, || made.difference(&moments, size));
    report.note_pixels(made.differing, made.first);
    Ok(())
}

impl Args {
    /// The scene to draw; nothing if it is not the one of the picture.
    fn scene(&self, said: &Provenance, report: &mut Report, session: &Session) -> Result<Option<Scene>> {
        if let Some(held) = &said.scene_json {
            report.check("scene", &said.scene, &document_hash(held), || {
                "the scene that it holds is not the one that it names".to_owned()
            });
        }
        if !report.is_equal() {
            return Ok(None);
        }
        // Read anew, since this version may know keys that the other did not.
        let held = said.scene_json.as_ref().map(|held| self.held(held)).transpose()?;
        let Some(path) = &self.scene else {
            return held.map(Some).ok_or_else(no_scene);
        };
        let given = load(path, said, session)?;
        let found = document(&given);
        let held = held.as_ref().map(document);
        let expected = held.as_ref().map_or_else(|| said.scene.clone(), document_hash);
        report.check("file", &expected, &document_hash(&found), || told(held.as_ref(), &found));
        Ok(report.is_equal().then_some(given))
    }

    /// The scene that the picture holds.
    fn held(&self, held: &Document) -> Result<Scene> {
        let name = format!("the scene in {}", self.picture.display());
        let text = Value::Object(held.clone()).to_string();
        scene::load_text(&name, &text, &Overrides::default()).map(|loaded| loaded.scene)
    }

    /// The simulation at its start, or at the saved state.
    fn simulation(&self, scene: &Scene, moments: &Moments, session: &Session) -> Result<Simulation> {
        // What blows up beyond all bounds ends in an error all the same.
        let mut simulation = start(scene, moments.last(), true, session)?;
        if let Some(path) = &self.from_state {
            let snapshot = state::read(path)?;
            if snapshot.frame() > moments.frame(0) {
                let message = format!(
                    "the state is at frame {}, and the picture shows frame {}",
                    snapshot.frame(),
                    moments.frame(0)
                );
                return Err(Error::new(Kind::Usage, message).with_help("leave out --from-state"));
            }
            simulation.restore(scene, &snapshot)?;
        }
        Ok(simulation)
    }
}

/// The scene of a file, with the changes that the picture names. In another scene some may have no place; the
/// comparison tells what differs then.
fn load(path: &Path, said: &Provenance, session: &Session) -> Result<Scene> {
    let changes = &said.arguments.changes;
    let with = |sets| scene::load(path, &Overrides { sets, ..Overrides::default() });
    let loaded = with(changes.clone()).or_else(|_| {
        let alone = document(&with(Vec::new())?.scene);
        let fits =
            |change: &&String| change.split(['.', '=']).next().is_some_and(|key| alone.contains_key(key));
        with(changes.iter().filter(fits).cloned().collect()).or_else(|_| with(Vec::new()))
    })?;
    loaded.warnings.iter().for_each(|warning| session.ui.warn(warning));
    Ok(loaded.scene)
}

/// Checks that the file has the size of the scene's picture, and that an animation has as many pictures as moments and
/// is shown for ever.
fn check_extent(seen: &AsSeen, moments: &Moments, size: [u32; 2], report: &mut Report) {
    let [expected, there] = [size, seen.size].map(|[width, height]| format!("{width} x {height}"));
    report.check("size", &expected, &there, || format!("it has {there} pixels instead of {expected}"));
    if let Moments::Many(schedule, _) = moments {
        let [there, shown] = [seen.pictures, schedule.count()].map(|count| count.to_string());
        report.check("pictures", &shown, &there, || format!("it has {there} pictures instead of {shown}"));
        let plays = if seen.plays == 0 { ENDLESS.to_owned() } else { seen.plays.to_string() };
        report.check("plays", ENDLESS, &plays, || format!("it is shown {plays} times instead of for ever"));
    }
}

fn check_textures(said: &Provenance, scene: &Scene, renderer: &Renderer, report: &mut Report) {
    if let Some(textures) = &said.textures {
        let found = texture_hash(scene, renderer).unwrap_or_default();
        report.check("textures", textures, &found, || {
            "it was drawn with other textures: name their folder with --textures DIR".to_owned()
        });
    }
}

type Document = Map<String, Value>;

/// How the scene of the picture and the given one differ, in words.
fn told(held: Option<&Document>, given: &Document) -> String {
    let Some(held) = held else { return "it is of another scene".to_owned() };
    let found = differences(held, given);
    let value = |value: &Option<Value>| match value {
        None => "absent".to_owned(),
        Some(Value::Object(_)) => "there".to_owned(),
        Some(Value::Array(list)) if list.first().is_some_and(Value::is_object) => {
            format!("there ({})", list.len())
        }
        Some(value) => value.to_string(),
    };
    let one = |difference: &Difference| {
        let [held, given] = difference.values.each_ref().map(value);
        format!("`{}` is {held} in the picture and {given} in the scene", difference.path)
    };
    let mut all: Vec<String> = found.iter().take(MOST_TOLD).map(one).collect();
    all.extend((found.len() > MOST_TOLD).then(|| format!("{} more", found.len() - MOST_TOLD)));
    format!("it is of another scene: {}", all.join("; "))
}

fn no_scene() -> Error {
    Error::new(Kind::Usage, "the picture does not hold its scene")
        .with_help("name the scene file: drape verify PICTURE SCENE")
}
