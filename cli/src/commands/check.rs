//! `drape check`: every error of scene files, and what would stop a later command. Nothing is simulated.

use std::collections::BTreeSet;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::args::scene::Changes;
use crate::args::textures;
use crate::session::Session;
use crate::session::ui::{help_lines, paint};
use drape::diagnostics::advice::unstable_at_rest;
use drape::diagnostics::geometry::{Concern, concerns};
use drape::diagnostics::stability::Stability;
use drape::error::{Diagnostic, Error, Kind, Result};
use drape::render::Renderer;
use drape::scene::{self, Images, Material, Scene};
use drape::texture_source::{TextureSource, is_built_in_cubemap, is_built_in_texture};
use drape_lab::printable;

/// The arguments of `check`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The scene files (JSON); `-` for standard input
    #[arg(value_name = "SCENE", required = true)]
    paths: Vec<PathBuf>,
    #[command(flatten)]
    changes: Changes,
    /// Read textures from this folder instead of the built-in set
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
}

/// The findings in all files.
#[derive(Serialize)]
struct Report {
    files: Vec<Findings>,
}

/// The findings in one file.
#[derive(Serialize)]
struct Findings {
    file: String,
    errors: Vec<Diagnostic>,
    warnings: Vec<Diagnostic>,
    /// Why the file could not be checked, if it could not.
    #[serde(skip_serializing_if = "Option::is_none")]
    failure: Option<String>,
    #[serde(skip)]
    kind: Option<Kind>,
}

/// Prints the findings; the worst of them decides the exit code.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let source = args.textures.clone().map_or(TextureSource::BuiltIn, TextureSource::Folder);
    let mut files = Vec::new();
    for path in &args.paths {
        session.stop.check()?;
        files.push(check(path, &args.changes, &source));
    }
    let colored = session.ui.color.applies(std::io::stdout().is_terminal());
    let text = files.iter().map(|file| file.text(colored)).collect::<String>();
    let count = files.iter().filter(|file| file.kind.is_some()).count();
    let worst = files.iter().filter_map(|file| file.kind).reduce(worse);
    let total = files.len();
    if session.ui.json {
        session.print_json(&Report { files })?;
    } else {
        session.print_text(text)?;
    }
    match worst {
        None => Ok(()),
        Some(kind) => Err(Error::new(kind, format!("{count} of {total} scene files are not valid"))),
    }
}

/// An invalid scene is worse than a file that cannot be read.
fn worse(a: Kind, b: Kind) -> Kind {
    if a == Kind::Scene { a } else { b }
}

fn check(path: &Path, changes: &Changes, textures: &TextureSource) -> Findings {
    let mut findings = Findings {
        file: printable::line(&path.display().to_string()),
        errors: Vec::new(),
        warnings: Vec::new(),
        failure: None,
        kind: None,
    };
    match scene::load(path, &changes.overrides()) {
        Ok(loaded) => {
            findings.warnings = loaded.warnings;
            findings.warnings.extend(foreseen(&findings.file, &loaded.scene, textures));
            let errors = of_picture(&loaded.scene, textures);
            findings.kind = errors.iter().map(|(_, error)| error.kind).reduce(worse);
            let file = &findings.file;
            findings.errors = errors.iter().map(|(code, e)| placeless("error", file, code, e)).collect();
        }
        Err(error) => {
            findings.kind = Some(error.kind);
            findings.failure = error.diagnostics.is_empty().then(|| error.to_string());
            findings.errors = error.diagnostics;
        }
    }
    findings
}

/// What keeps the scene from being drawn as it is: its camera, its size, and the textures that its shaders read.
fn of_picture(scene: &Scene, textures: &TextureSource) -> Vec<(&'static str, Error)> {
    let picture = Renderer::check(scene).err().map(|error| ("check::picture", error));
    let Images { textures: images, environments } = Images::of(scene);
    let unread = unreadable([&BTreeSet::from_iter(images), &BTreeSet::from_iter(environments)], textures);
    let textures = unread.into_iter().map(|error| ("check::texture", error));
    picture.into_iter().chain(textures).collect()
}

/// What would stop a later command or make its result wrong, although the scene is valid: a texture that another
/// shader would read, a folder of textures that no shader does, a geometry that cannot hold, or a step that is unstable.
fn foreseen(file: &str, scene: &Scene, source: &TextureSource) -> Vec<Diagnostic> {
    let [images, cubes] = unread_names(scene);
    let unread = unreadable([&images, &cubes], source);
    let mut warnings: Vec<_> = unread.iter().map(|error| warning(file, "check::texture", error)).collect();
    match concerns(scene) {
        Ok(concerns) => warnings.extend(concerns.into_iter().map(|concern| of_geometry(file, concern))),
        Err(error) => warnings.push(warning(file, "check::geometry", &error)),
    }
    let reads_none = !textures::are_read(scene) && images.is_empty() && cubes.is_empty();
    if reads_none && matches!(source, TextureSource::Folder(_)) {
        warnings.push(warning(file, "check::without_effect", &Error::new(Kind::Usage, textures::UNREAD)));
    }
    warnings.extend(instability(scene).map(|error| warning(file, "check::unstable", &error)));
    warnings
}

/// The errors of the textures and of the cube maps that cannot be read.
fn unreadable([images, cubes]: [&BTreeSet<String>; 2], textures: &TextureSource) -> Vec<Error> {
    let images = images.iter().filter_map(|name| textures.texture(name).err());
    images.chain(cubes.iter().filter_map(|name| textures.cubemap(name).err())).collect()
}

/// The textures and the cube maps that only a change of the shader would read, but for those that are built in.
fn unread_names(scene: &Scene) -> [BTreeSet<String>; 2] {
    let Images { textures, environments } = Images::of(scene);
    let [mut images, mut cubes] = [BTreeSet::new(), BTreeSet::new()];
    for Material { texture, height_map, environment, .. } in scene.materials() {
        images.extend([texture, height_map].into_iter().filter(|name| !is_built_in_texture(name)).cloned());
        cubes.extend(Some(environment).filter(|name| !is_built_in_cubemap(name)).cloned());
    }
    images.retain(|name| !textures.contains(name));
    cubes.retain(|name| !environments.contains(name));
    [images, cubes]
}

/// The error before the first step, if there would be one.
fn instability(scene: &Scene) -> Option<Error> {
    let cloth = scene.cloth.as_ref()?;
    match Stability::of_bounded(cloth, &scene.sim) {
        Ok(stability) => {
            let unstable = stability.filter(Stability::is_unstable_at_rest)?;
            Some(unstable_at_rest(&unstable, cloth.ks, scene.sim.steps_per_frame))
        }
        Err(error) => Some(error),
    }
}

/// A warning of geometry that cannot hold.
fn of_geometry(file: &str, concern: Concern) -> Diagnostic {
    let Concern { code, key, message, help } = concern;
    let rendered = format!("warning[{code}]: {message}\n --> {file}{}", help_lines(&help));
    Diagnostic { code, message, file: file.to_owned(), line: 0, column: 0, key, help, rendered }
}

/// A warning of a later error.
fn warning(file: &str, code: &'static str, error: &Error) -> Diagnostic {
    placeless("warning", file, code, error)
}

/// A finding that belongs to no place in the file.
fn placeless(severity: &str, file: &str, code: &'static str, error: &Error) -> Diagnostic {
    let Error { message, help, .. } = error;
    let rendered = format!("{severity}[{code}]: {message}\n --> {file}{}", help_lines(help));
    let (message, help, file) = (message.clone(), help.clone(), file.to_owned());
    Diagnostic { code, message, file, line: 0, column: 0, key: String::new(), help, rendered }
}

impl Findings {
    fn text(&self, colored: bool) -> String {
        let mut blocks: Vec<String> =
            self.errors.iter().chain(&self.warnings).map(|found| paint(&found.rendered, colored)).collect();
        blocks.extend(self.failure.as_ref().map(|failure| paint(&format!("error: {failure}"), colored)));
        if self.kind.is_none() {
            let warned = match self.warnings.len() {
                0 => String::new(),
                1 => ", with a warning".to_owned(),
                several => format!(", with {several} warnings"),
            };
            blocks.push(printable::lines(&format!("{}: valid{warned}", self.file)));
        }
        blocks.join("\n\n") + "\n"
    }
}
