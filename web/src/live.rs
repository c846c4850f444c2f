//! A scene in motion, with its picture.

use std::collections::BTreeMap;

use drape::diagnostics::advice::unstable_at_rest;
use drape::diagnostics::energy::Energy;
use drape::diagnostics::stability::{Stability, has_step_bound, is_always_stable};
use drape::error::{Error, Kind, Result};
use drape::math::StateHash;
use drape::output::png::{self, Effort};
use drape::output::raw;
use drape::raster::Framebuffer;
use drape::render::{Options, Renderer};
use drape::scene::{Images, Scene};
use drape::simulation::Simulation;
use drape::texture::Texture;
use drape::texture_source::TextureSource;
use serde_json::{Value, json};

use crate::command::command;
use crate::controls::{objects, values};
use crate::gauge::{Gauge, gauge};
use crate::message::texts;
use crate::request::Request;

/// Most samples of a picture: the memory of a page is small.
const MAX_SAMPLES: u64 = 1 << 24;

/// The page's scene, once there is one, and the textures of the user's own.
#[derive(Default)]
pub(crate) struct Live {
    stage: Option<Stage>,
    textures: BTreeMap<String, Vec<u8>>,
}

/// A scene in motion.
struct Stage {
    request: Request,
    scene: Scene,
    simulation: Simulation,
    renderer: Renderer,
    framebuffer: Framebuffer,
    options: Options,
    gauge: Option<Gauge>,
}

impl Live {
    /// Shows what `request` asks for. The cloth starts anew if it would move in another way.
    ///
    /// # Errors
    /// Those of the scene, its textures and its size; then all stays as it was.
    pub(crate) fn load(&mut self, request: Request) -> Result<Value> {
        let loaded = request.read()?;
        let (scene, options) = (loaded.scene, request.options()?);
        let [width, height] = scene.render.size;
        let samples = u64::from(width) * u64::from(height) * u64::from(scene.render.samples);
        if samples > MAX_SAMPLES {
            let message =
                format!("{width} x {height} pixels of {} samples are too many", scene.render.samples);
            let help = format!("in a browser, pixels times samples may be at most {MAX_SAMPLES}");
            return Err(Error::new(Kind::Scene, message).with_help(help));
        }
        let source = TextureSource::Memory(self.textures.clone());
        let (values, objects) = (values(&scene)?, objects(&scene));
        let anew = match &mut self.stage {
            Some(stage) => stage.change(&request, scene, options, &source)?,
            None => {
                self.stage = Some(Stage::new(&request, scene, options, &source)?);
                true
            }
        };
        Ok(json!({
            "anew": anew,
            "warnings": texts(&loaded.warnings),
            "values": values,
            "objects": objects,
            "gauge": self.stage.as_ref().and_then(|stage| stage.gauge.as_ref()),
            "textures": self.textures.keys().filter(|name| !name.contains('/')).collect::<Vec<_>>(),
        }))
    }

    /// Adds a texture of the user's own, by the name of its file without ending, such as `plaid` or `sky/posx`.
    ///
    /// # Errors
    /// [`Kind::Scene`] if it is not a picture.
    pub(crate) fn add_texture(&mut self, name: &str, bytes: Vec<u8>) -> Result<()> {
        Texture::decode(name, &bytes)?;
        self.textures.insert(name.to_owned(), bytes);
        // What was read under this name before is not the same any more.
        if let Some(stage) = &mut self.stage {
            let source = TextureSource::Memory(self.textures.clone());
            stage.renderer = Renderer::new(&stage.scene, &source)?;
        }
        Ok(())
    }

    /// Starts the cloth anew.
    ///
    /// # Errors
    /// As [`Simulation::new`].
    pub(crate) fn reset(&mut self) -> Result<()> {
        if let Some(stage) = &mut self.stage {
            stage.simulation = start(&stage.request, &stage.scene)?;
        }
        Ok(())
    }

    /// Moves the cloth on by one frame.
    ///
    /// # Errors
    /// [`Kind::Unstable`] when it blows up, or is certain to before its first step.
    pub(crate) fn advance(&mut self) -> Result<()> {
        let Some(stage) = &mut self.stage else { return Ok(()) };
        if stage.simulation.steps() == 0 {
            check_start(&stage.request, &stage.scene)?;
        }
        stage.simulation.advance_frame()
    }

    /// The frame, the time in seconds, the energies in J (kinetic, spring, gravitational), and, if a ledger is
    /// recorded, what each part put in, in the order of [`Live::ledger_names`].
    pub(crate) fn row(&self) -> Vec<f64> {
        let Some(stage) = &self.stage else { return Vec::new() };
        let simulation = &stage.simulation;
        let Energy { kinetic, spring, gravitational } = simulation.energy();
        #[expect(clippy::cast_precision_loss, reason = "a number of frames is far below 2^53")]
        let frame = simulation.frame() as f64;
        let ledger = simulation.ledger().filter(|_| stage.request.ledger);
        let entries = ledger.into_iter().flat_map(|ledger| ledger.entries().map(|(_, energy)| energy));
        [frame, simulation.time(), kinetic, spring, gravitational].into_iter().chain(entries).collect()
    }

    /// The names of the ledger's entries.
    pub(crate) fn ledger_names() -> Vec<&'static str> {
        drape::diagnostics::ledger::Ledger::default().entries().map(|(name, _)| name).collect()
    }

    /// The frame.
    pub(crate) fn frame(&self) -> u64 {
        self.stage.as_ref().map_or(0, |stage| stage.simulation.frame())
    }

    /// Length over rest length of the spring that is stretched most.
    pub(crate) fn stretch(&self) -> f64 {
        self.stage.as_ref().map_or(0.0, |stage| stage.simulation.largest_stretch())
    }

    /// The hash of the state.
    pub(crate) fn state_hash(&self) -> u64 {
        self.stage.as_ref().map_or(0, |stage| stage.simulation.state_hash())
    }

    /// Draws the picture: red, green, blue and 255 of each pixel, top row first.
    pub(crate) fn draw(&mut self) -> Vec<u8> {
        let Some(stage) = &mut self.stage else { return Vec::new() };
        let Stage { renderer, framebuffer, simulation, options, .. } = stage;
        renderer.draw_into(framebuffer, simulation.positions(), options);
        framebuffer.rgba()
    }

    /// Width and height of the picture.
    pub(crate) fn size(&self) -> [u32; 2] {
        self.stage.as_ref().map_or([0, 0], |stage| stage.scene.render.size)
    }

    /// The picture as the bytes of the file that `drape render` writes.
    ///
    /// # Errors
    /// As [`png::encode`].
    pub(crate) fn png(&mut self) -> Result<Vec<u8>> {
        let [width, height] = self.size();
        let rgb: Vec<u8> =
            self.draw().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        png::encode(width, height, &rgb, Effort::Fast)
    }

    /// The positions as `drape simulate --positions` writes them.
    pub(crate) fn positions(&self) -> Vec<u8> {
        self.stage.as_ref().map_or_else(Vec::new, |stage| {
            let points = stage.simulation.positions();
            raw::points(&points.x, &points.y, &points.z)
        })
    }

    /// The whole state as `drape simulate --save-state` writes it.
    pub(crate) fn state(&self) -> Vec<u8> {
        self.stage.as_ref().map_or_else(Vec::new, |stage| stage.simulation.snapshot(&stage.scene).encode())
    }

    /// The command for the picture.
    pub(crate) fn command(&self) -> String {
        let Some(stage) = &self.stage else { return String::new() };
        let Images { textures, environments } = Images::of(&stage.scene);
        let own = |name: &String| {
            self.textures.contains_key(name) || self.textures.contains_key(&format!("{name}/posx"))
        };
        command(&stage.request, stage.simulation.frame(), textures.iter().chain(&environments).any(own))
    }
}

impl Stage {
    fn new(request: &Request, scene: Scene, options: Options, source: &TextureSource) -> Result<Self> {
        let renderer = Renderer::new(&scene, source)?;
        let framebuffer = renderer.framebuffer();
        let (simulation, gauge) = (start(request, &scene)?, gauge(&scene)?);
        Ok(Self { request: request.clone(), scene, simulation, renderer, framebuffer, options, gauge })
    }

    /// Shows another request; whether the cloth starts anew, which it does if it would move in another way. After an
    /// error all is as before.
    fn change(
        &mut self,
        request: &Request,
        scene: Scene,
        options: Options,
        source: &TextureSource,
    ) -> Result<bool> {
        let anew = !(self.scene.moves_like(&scene)
            && self.request.ledger == request.ledger
            && self.request.allow_unstable == request.allow_unstable);
        let started = if anew { Some((start(request, &scene)?, gauge(&scene)?)) } else { None };
        self.renderer.change_scene(&scene, source)?;
        if let Some((simulation, gauge)) = started {
            (self.simulation, self.gauge) = (simulation, gauge);
        }
        self.framebuffer = self.renderer.framebuffer();
        (self.request, self.scene, self.options) = (request.clone(), scene, options);
        Ok(anew)
    }
}

/// The simulation of `scene` at its start. As on the command line, a ledger guards a cloth that may blow up while the
/// stretch limit hides it.
fn start(request: &Request, scene: &Scene) -> Result<Simulation> {
    let mut simulation = Simulation::new(scene)?;
    if request.allow_unstable {
        simulation.allow_unstable();
    }
    let hidden = !request.allow_unstable && scene.sim.stretch_limit.is_some();
    let may_blow_up = |cloth| has_step_bound(cloth, &scene.sim) && !is_always_stable(cloth, &scene.sim);
    let guarded = hidden && scene.cloth.as_ref().is_some_and(may_blow_up);
    if guarded || request.ledger {
        simulation.record_ledger()?;
    }
    Ok(simulation)
}

/// Refuses a step that is certain to fail.
fn check_start(request: &Request, scene: &Scene) -> Result<()> {
    let Some(cloth) = scene.cloth.as_ref().filter(|_| !request.allow_unstable) else { return Ok(()) };
    match Stability::of_bounded(cloth, &scene.sim)?.filter(Stability::is_unstable_at_rest) {
        Some(stability) => Err(unstable_at_rest(&stability, cloth.ks, scene.sim.steps_per_frame)),
        None => Ok(()),
    }
}

/// The hash of a picture with 255 after each pixel's blue, which the hash leaves out.
pub(crate) fn hash(rgba: &[u8]) -> u64 {
    let mut hash = StateHash::default();
    rgba.chunks_exact(4).for_each(|pixel| hash.write(&pixel[..3]));
    hash.finish()
}
