//! A case is simulated, measured and drawn.

use std::time::{Duration, Instant};

use super::case::Case;
use super::measures::{HASH, OUTCOME, REST_TIME, WALL_MS, needs_ledger};
use super::plan::Plan;
use super::record::{Measured, Record};
use crate::run::{start, table};
use drape::diagnostics::rest::RestWatch;
use drape::error::{Error, Kind, Result};
use drape::output::png::{self, Effort};
use drape::output::provenance::{Arguments, Provenance};
use drape::render::{Options, Renderer};
use drape::scene::sweep::{Picture, Spec, Until};
use drape::scene::{ColliderKind, Flag, Overrides, Scene, load_text};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;

/// What came of a case, and the bytes of its picture.
pub(super) type Outcome = (Record, Option<Vec<u8>>);

/// Runs `case` of `plan`; `each_frame` can stop it.
///
/// # Errors
/// Those of `each_frame`. Every other error is the record of the case.
pub(super) fn run(plan: &Plan, case: &Case, each_frame: &dyn Fn() -> Result<()>) -> Result<Outcome> {
    let mut stopped = None;
    let started = Instant::now();
    let measured = measure(plan, case, &mut || {
        each_frame().inspect_err(|error| stopped = Some(error.clone()))?;
        check_limit(plan.spec.time_limit, started.elapsed())
    });
    if let Some(error) = stopped {
        return Err(error);
    }
    let (mut record, picture) = measured.unwrap_or_else(|error| (Record::failed(&error), None));
    let asked = |name: &str| plan.spec.measure.iter().any(|measure| measure == name);
    if asked(OUTCOME) {
        record.values.insert(OUTCOME.into(), Measured::Text(record.outcome().into()));
    }
    if asked(WALL_MS) {
        record.values.insert(WALL_MS.into(), (started.elapsed().as_secs_f64() * 1e3).into());
    }
    Ok((record, picture))
}

/// The error of a case that takes too long. It does not say how far the case came, which depends on the machine.
fn check_limit(limit: Option<f64>, elapsed: Duration) -> Result<()> {
    match limit {
        Some(limit) if elapsed.as_secs_f64() > limit => {
            let message = format!("out of time: the case took more than {limit} s");
            Err(Error::new(Kind::Io, message))
        }
        _ => Ok(()),
    }
}

fn measure(plan: &Plan, case: &Case, each_frame: &mut dyn FnMut() -> Result<()>) -> Result<Outcome> {
    let spec = &plan.spec;
    let overrides = Overrides { sets: case.sets(), flags: flags(spec), ..Overrides::default() };
    let loaded = load_text(&plan.scene().name, &plan.scene().text, &overrides)?;
    let scene = &loaded.scene;
    // All inputs are read before anything is simulated.
    let renderer = spec.render.as_ref().map(|_| Renderer::new(scene, &TextureSource::BuiltIn)).transpose()?;
    let frames = frames(spec.until, scene);
    let (mut simulation, _) = start::start(scene, frames, None, false)?;
    if spec.measure.iter().any(|name| needs_ledger(name)) {
        simulation.record_ledger()?;
    }
    let mut rows = table::Rows::default();
    let mut rest = Rest::new(spec, scene, &simulation)?;
    each_frame()?;
    while simulation.frame() < frames {
        if simulation.frame() + 1 == frames {
            // What a phase added is counted from here to the last row.
            rows.next(&simulation);
        }
        simulation.advance_frame()?;
        rest.look(&simulation);
        each_frame()?;
    }
    let columns = table::columns().into_iter().zip(rows.next(&simulation).into_iter().map(Measured::from));
    let hash = Measured::Text(format!("{:016x}", simulation.state_hash()));
    let rest = rest.time.map_or(Measured::Nothing, Measured::from);
    let values = columns.chain([(HASH.to_owned(), hash), (REST_TIME.to_owned(), rest)]);
    let values = values.filter(|(name, _)| spec.measure.contains(name)).collect();
    let picture = renderer.map(|renderer| {
        let picture = renderer.draw(simulation.positions(), &Options::default());
        let arguments = Arguments { frame: Some(simulation.frame()), ..Arguments::default() };
        let provenance = Provenance::new(&loaded, arguments);
        let texts = provenance.of_picture(simulation.state_hash(), picture.hash()).texts();
        png::encode_with(picture.width, picture.height, &picture.rgb, Effort::Small, &texts)
    });
    Ok((Record { exit_code: 0, message: String::new(), values, picture: None }, picture.transpose()?))
}

/// The last frame of a case.
pub(super) fn frames(until: Until, scene: &Scene) -> u64 {
    let seconds = match until {
        Until::Frames(frames) => return frames,
        Until::Time(seconds) => seconds,
        Until::Scene => scene.render.time,
    };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most 1e6 s * 1e9 a second"
    )]
    let frames = (seconds * scene.sim.fps).round() as u64;
    frames
}

/// The changes for the picture.
pub(super) fn flags(spec: &Spec) -> Vec<Flag> {
    let Some(Picture { material, size }) = &spec.render else { return Vec::new() };
    let objects = || ["cloth"].into_iter().chain(ColliderKind::ALL.iter().map(|kind| kind.key()));
    let material = material.iter().flat_map(|(key, value)| {
        objects().map(move |object| Flag {
            name: "render.material",
            set: format!("{object}.*.material.{key}={value}"),
        })
    });
    let [width, height] = size;
    material.chain([Flag { name: "render.size", set: format!("render.size=[{width},{height}]") }]).collect()
}

/// When the cloth came to rest.
struct Rest {
    watch: Option<RestWatch>,
    time: Option<f64>,
}

impl Rest {
    /// A watch, if the sweep asks for it.
    fn new(spec: &Spec, scene: &Scene, simulation: &Simulation) -> Result<Self> {
        let asked = spec.measure.iter().any(|name| name == REST_TIME);
        let cloth = scene.cloth.as_ref().filter(|_| asked);
        let watch =
            cloth.map(|cloth| RestWatch::new(cloth, &scene.sim, simulation.positions())).transpose()?;
        Ok(Self { watch, time: None })
    }

    /// Looks at the cloth after a frame; the first rest counts.
    fn look(&mut self, simulation: &Simulation) {
        if let Some(watch) = &mut self.watch {
            watch.look(simulation.positions());
            if self.time.is_none() && watch.is_rest() {
                self.time = Some(simulation.time());
            }
        }
    }
}
