//! `drape export`: the simulated scene as meshes.

mod format;
mod write;

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::animation::pattern::Pattern;
use crate::args::frames::Frames;
use crate::args::provenance::ProvenanceArgs;
use crate::args::scene::{Moment, SceneArgs};
use crate::args::state::StateArgs;
use crate::args::textures;
use crate::run::advance::{Until, advance_until};
use crate::run::start::start;
use crate::session::Session;
use crate::session::files::numbered::one;
use crate::session::ui::Ui;
use drape::error::{Error, Kind, Result};
use drape::math::StateHash;
use drape::output::gltf::{Motion, Shape};
use drape::output::part::Part;
use drape::output::provenance::Arguments;
use drape::scene::{Images, Scene};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;
use format::Format;
use write::Writer;

/// The arguments of `export`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The file to write, in the format of its ending: .obj, .ply, or .glb (binary glTF 2.0); `-` for an OBJ on standard
    /// output. An .obj or .ply name with %d or %04d in it, such as frames/%04d.obj, means a file for each of --frames
    #[arg(value_name = "OUT")]
    mesh: PathBuf,
    #[command(flatten)]
    moment: Moment,
    #[command(flatten)]
    state: StateArgs,
    /// Export the frames from A to B, without B: a numbered file each, or in a .glb the motion as an animation
    #[arg(long, value_name = "A..B", conflicts_with_all = ["time", "frame", "until_rest"])]
    frames: Option<Frames>,
    /// Export balls, planes and everything else that is drawn, too
    #[arg(long)]
    objects: bool,
    /// Write materials too: of an .obj the file OUT.mtl, and the textures beside it. A .glb always has them
    #[arg(long)]
    materials: bool,
    /// Read textures from this folder instead of the built-in set
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
    #[command(flatten)]
    provenance: ProvenanceArgs,
}

/// Keys of a scene that no mesh has.
const SEEN_ALONE: [&str; 6] =
    ["camera", "light", "render.size", "render.samples", "render.background", "render.seamless"];

/// Where the keys of materials stand.
const MATERIALS: [&str; 5] =
    ["material", "cloth.material", "sphere.material", "box.material", "plane.material"];

/// The summary.
#[derive(Serialize)]
struct Summary {
    mesh: String,
    frame: u64,
    time: f64,
    points: usize,
    triangles: usize,
    /// How many frames were exported.
    frames: usize,
}

/// Simulates and writes the meshes.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let loaded = args.scene.load_with_flags(&[], session)?;
    let scene = &loaded.scene;
    let others = args.objects && !scene.colliders.is_empty();
    if scene.cloth.is_none() && !others {
        let nothing = "the scene has no cloth, so there is no mesh to export";
        return Err(Error::new(Kind::Nothing, nothing).with_help("--objects exports the other objects"));
    }
    let source = args.textures.clone().map_or(TextureSource::BuiltIn, TextureSource::Folder);
    let (frames, until) = args.frames(scene)?;
    let (format, pattern) = (Format::of(&args.mesh)?, args.pattern()?);
    args.provenance.caution(&args.mesh, format == Format::Glb, &session.ui);
    args.caution(format, scene, &session.ui);
    args.caution_of_sets(format, &session.ui);
    let path = if pattern.is_some() { args.mesh.clone() } else { one(&args.mesh)? };
    let writer = Writer { path: &path, format, pattern, materials: args.materials, source: &source };
    let inputs: Vec<PathBuf> = args.scene.inputs().into_iter().chain(args.state.inputs()).collect();
    let written = writer.textures(scene, args.objects)?;
    writer.check(&inputs, written.keys(), &frames, &args.state.outputs().collect::<Vec<_>>())?;
    for (name, _) in written.iter().filter(|(_, texture)| texture.was_transparent()) {
        textures::caution_of_transparency(name, &session.ui);
    }
    let mut simulation = start(scene, until.frames, args.moment.stability.allow_unstable, session)?;
    let seen = args.state.restore(&mut simulation, scene, frames.start)?;
    let until = Until { seen, ..until };
    let mut saving = args.state.saving(scene);
    let (mut motion, mut states) = (Motion::default(), StateHash::default());
    let ended = advance_until(&mut simulation, scene, until, session, |simulation, seen| {
        match (&args.frames, format) {
            (Some(frames), Format::Glb) => add(&mut motion, &mut states, frames, simulation, scene),
            (Some(frames), _) if frames.0.contains(&simulation.frame()) => {
                writer.frame(simulation.frame() - frames.0.start, &args.parts(scene, simulation))?;
            }
            _ => {}
        }
        saving.after_frame(simulation, seen)
    })?;
    saving.finish(&simulation, ended.seen)?;
    let parts = args.parts(scene, &simulation);
    if writer.pattern.is_none() {
        let moves = args.frames.is_some();
        let state = if moves { states.finish() } else { simulation.state_hash() };
        let said = args.provenance.of(&loaded, args.arguments(&simulation));
        writer.whole(args.base(parts.clone(), &motion), Some(&motion).filter(|_| moves), (state, &said))?;
    }
    writer.stale(frames.end - frames.start, session);
    args.report(&path, &simulation, &parts, frames.end - frames.start, session)?;
    ended.result()
}

/// Takes the cloth into `motion` and the hash of its state into `states`, if its frame is one of those.
fn add(motion: &mut Motion, states: &mut StateHash, frames: &Frames, simulation: &Simulation, scene: &Scene) {
    let frame = simulation.frame();
    let Some(cloth) = Part::cloth(scene, simulation.positions()).filter(|_| frames.0.contains(&frame)) else {
        return;
    };
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        reason = "glTF has times of 32 bits"
    )]
    let time = ((frame - frames.0.start) as f64 / scene.sim.fps) as f32;
    states.write(&simulation.state_hash().to_le_bytes());
    motion.times.push(time);
    motion.frames.push(Shape { positions: cloth.positions, normals: cloth.normals });
}

impl Args {
    /// Warns of keys that are set and change nothing in a mesh.
    fn caution_of_sets(&self, format: Format, ui: &Ui) {
        self.moment.caution(&self.scene, ui);
        self.scene.caution_of_moment(&[("--frames", self.frames.is_some())], ui);
        self.scene.caution(&SEEN_ALONE, "only a picture shows it", ui);
        if format != Format::Glb && !self.materials {
            self.scene.caution(&MATERIALS, "materials are not exported", ui);
        }
    }

    /// Warns of options that change nothing.
    fn caution(&self, format: Format, scene: &Scene, ui: &Ui) {
        if self.objects && scene.colliders.is_empty() {
            ui.caution("--objects has no effect: the scene has no object but the cloth", "");
        }
        let is_glb = format == Format::Glb;
        if self.materials && is_glb {
            ui.caution("--materials has no effect: a .glb always has materials", "");
        }
        if self.textures.is_some() && !self.materials && !is_glb {
            ui.caution(
                "--textures has no effect: only materials have textures",
                "add --materials, or name a .glb",
            );
        } else if self.textures.is_some() && Images::of(scene).textures.is_empty() {
            ui.caution("--textures has no effect: no shader of the scene reads a picture of the surface", "");
        }
    }

    /// The frames that are exported, and how far the scene is simulated.
    fn frames(&self, scene: &Scene) -> Result<(std::ops::Range<u64>, Until)> {
        let Some(Frames(frames)) = &self.frames else {
            let until = self.moment.until(scene);
            return Ok((until.frames..until.frames + 1, until));
        };
        Ok((frames.clone(), Until { frames: frames.end - 1, ..Until::default() }))
    }

    /// What is shown of the scene.
    fn arguments(&self, simulation: &Simulation) -> Arguments {
        let frames = self.frames.as_ref().map(|Frames(frames)| [frames.start, frames.end]);
        let frame = frames.is_none().then(|| simulation.frame());
        Arguments { frame, frames, objects: self.objects, ..Arguments::default() }
    }

    /// The pattern of numbered files, which go with --frames.
    fn pattern(&self) -> Result<Option<Pattern>> {
        let pattern = Pattern::parse(&self.mesh)?;
        let format = Format::of(&self.mesh)?;
        let usage = |message: String, help: &str| Err(Error::new(Kind::Usage, message).with_help(help));
        match (&pattern, &self.frames, format) {
            (Some(_), None, _) => {
                let message = format!("`{}` names a file for each frame", self.mesh.display());
                usage(message, "say which with --frames A..B")
            }
            (Some(_), Some(_), Format::Glb) => usage(
                "a .glb holds all frames in one file".to_owned(),
                "leave the number out of its name, or name an .obj or .ply",
            ),
            (None, Some(_), Format::Obj | Format::Ply) => {
                let message = format!("--frames: `{}` has no place for a number", self.mesh.display());
                usage(message, "write %04d into the name, as in frames/%04d.obj, or name a .glb")
            }
            _ => Ok(pattern),
        }
    }

    /// The meshes at the present state.
    fn parts<'a>(&self, scene: &'a Scene, simulation: &Simulation) -> Vec<Part<'a>> {
        let others = if self.objects { Part::colliders(scene) } else { Vec::new() };
        Part::cloth(scene, simulation.positions()).into_iter().chain(others).collect()
    }

    /// The meshes with the cloth as it is in the first frame of its motion.
    fn base<'a>(&self, mut parts: Vec<Part<'a>>, motion: &Motion) -> Vec<Part<'a>> {
        if let (Some(cloth), Some(first)) = (parts.first_mut(), motion.frames.first()) {
            (cloth.positions, cloth.normals) = (first.positions.clone(), first.normals.clone());
        }
        parts
    }

    fn report(
        &self,
        path: &Path,
        simulation: &Simulation,
        parts: &[Part<'_>],
        frames: u64,
        session: &Session,
    ) -> Result<()> {
        let (frame, time) = (simulation.frame(), simulation.time());
        let points = parts.iter().map(|part| part.positions.len()).sum();
        let triangles = parts.iter().map(|part| part.triangles.len()).sum();
        let mesh = path.display().to_string();
        let several = if frames > 1 { format!("{frames} frames, the last is ") } else { String::new() };
        let line =
            format!("{mesh}: {points} points, {triangles} triangles, {several}frame {frame}, {time} s");
        let frames = usize::try_from(frames).unwrap_or(usize::MAX);
        session.report(&Summary { mesh, frame, time, points, triangles, frames }, &line)
    }
}
