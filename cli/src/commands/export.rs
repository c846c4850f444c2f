//! `drape export`: the simulated cloth as a mesh.

use std::path::PathBuf;

use serde::Serialize;

use crate::args::scene::{Moment, SceneArgs};
use crate::args::state::StateArgs;
use crate::run::advance::advance_until;
use crate::run::start::start;
use crate::session::Session;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use drape::error::{Error, Kind, Result};
use drape::mesh::Mesh;
use drape::output::obj;
use drape::scene::Needs;

/// The arguments of `export`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The mesh to write, an OBJ file (`-` for standard output)
    #[arg(value_name = "OUT.obj")]
    mesh: PathBuf,
    #[command(flatten)]
    moment: Moment,
    #[command(flatten)]
    state: StateArgs,
}

/// The summary.
#[derive(Serialize)]
struct Summary {
    mesh: String,
    frame: u64,
    time: f64,
    points: usize,
    triangles: usize,
}

/// Simulates and writes the mesh.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let scene = args.scene.load(session)?;
    let until = args.moment.until(&scene);
    outputs::check_ending(&args.mesh, "obj")?;
    let inputs: Vec<PathBuf> = args.scene.inputs().into_iter().chain(args.state.inputs()).collect();
    outputs::check(&inputs, [(args.mesh.as_path(), Content::Text)].into_iter().chain(args.state.outputs()))?;
    let Some(cloth) = &scene.cloth else {
        return Err(Error::new(Kind::Nothing, "the scene has no cloth, so there is no mesh to export"));
    };
    let mut simulation = start(&scene, until.frames, args.moment.stability.allow_unstable, session)?;
    args.state.restore(&mut simulation, &scene, until.frames)?;
    let mut saving = args.state.saving(&scene);
    let ended = advance_until(&mut simulation, &scene, until, session, |now| saving.after_frame(now))?;
    saving.finish(&simulation)?;
    let points = simulation.positions();
    let mesh = Mesh::cloth(cloth, points, Needs { normal: true, uv: true, ..Needs::default() });
    // In f64, as simulated: the mesh that is drawn has f32.
    let positions: Vec<[f64; 3]> = (0..points.len()).map(|i| points.get(i).into()).collect();
    let text = obj::encode(&positions, &mesh.uvs, &mesh.normals, &mesh.triangles)?;
    atomic::write(&args.mesh, text.as_bytes())?;
    let (frame, time) = (simulation.frame(), simulation.time());
    let (points, triangles) = (positions.len(), mesh.triangles.len());
    let mesh = args.mesh.display().to_string();
    let line = format!("{mesh}: {points} points, {triangles} triangles, frame {frame}, {time} s");
    session.report(&Summary { mesh, frame, time, points, triangles }, &line)?;
    ended.result()
}
