//! `drape info`: what a scene needs and does not need, and whether its step is stable.

use serde::Serialize;

use super::unlit;
use crate::args::scene::{SceneArgs, frame_at};
use crate::session::Session;
use drape::cloth::{Params, springs};
use drape::diagnostics::advice::largest_ks;
use drape::diagnostics::geometry::{Concern, concerns};
use drape::diagnostics::memory::Memory;
use drape::diagnostics::stability::Stability;
use drape::error::Result;
use drape::scene::{Cloth, Item, PerKind, Scene, plan};

/// The arguments of `info`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
}

/// What is known about a scene without simulating it.
#[derive(Serialize)]
struct Info {
    size: [u32; 2],
    samples: u32,
    fps: f64,
    steps_per_frame: u32,
    time: f64,
    frames: u64,
    cloth: Option<ClothInfo>,
    #[serde(flatten)]
    colliders: PerKind<usize>,
    memory: Memory,
    needs: Vec<Item>,
    /// The part of what is seen at the start that only ambient light reaches, from 0 to 1; nothing where no lit object
    /// is seen.
    #[serde(skip_serializing_if = "Option::is_none")]
    unlit: Option<f64>,
    /// What to do about that, in words.
    #[serde(skip)]
    hint: String,
}

/// The size of the cloth, and its step.
#[derive(Serialize)]
struct ClothInfo {
    points: [usize; 2],
    structural: usize,
    shearing: usize,
    bending: usize,
    pinned: usize,
    /// Mass of a point, kg.
    mass: f64,
    dt: f64,
    integrator: &'static str,
    /// The stability bound; nothing for an integrator that has none.
    #[serde(flatten)]
    bound: Option<Bound>,
    stable: &'static str,
}

/// The step of an explicit integrator and its stability bound, which depends on the fastest vibration of the
/// springs (`dt·ω`).
#[derive(Serialize)]
struct Bound {
    dt_omega_rest: f64,
    dt_omega_worst: f64,
    dt_omega_limit: f64,
    /// The limit at worst, which is lower without damping.
    dt_omega_limit_worst: f64,
    fewest_steps_rest: f64,
    fewest_steps_worst: f64,
    /// The largest stable ks at this step, N/m; nothing for springs without stiffness.
    largest_ks_rest: Option<f64>,
    largest_ks_worst: Option<f64>,
    #[serde(skip)]
    steps_per_frame: u32,
}

/// Prints what the scene needs.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let scene = args.scene.load(session)?;
    let info = Info::of(&scene)?;
    for Concern { message, help, .. } in concerns(&scene)? {
        session.ui.caution(&message, &help);
    }
    session.print(&info, &info.text())
}

impl Info {
    fn of(scene: &Scene) -> Result<Self> {
        let unlit = unlit::part(scene)?;
        Ok(Self {
            size: scene.render.size,
            samples: scene.render.samples,
            fps: scene.sim.fps,
            steps_per_frame: scene.sim.steps_per_frame,
            time: scene.render.time,
            frames: frame_at(None, scene),
            cloth: scene.cloth.as_ref().map(|cloth| ClothInfo::of(cloth, scene)).transpose()?,
            colliders: scene.collider_counts(),
            memory: Memory::of(scene),
            needs: plan(scene),
            unlit,
            hint: unlit::hint(scene, unlit)?,
        })
    }

    fn text(&self) -> String {
        let [width, height] = self.size;
        let needs: String = self.needs.iter().map(need).collect();
        let colliders: Vec<String> =
            self.colliders.entries().map(|(plural, count)| format!("{plural} {count}")).collect();
        format!(
            "picture     {width} x {height} pixels, samples {}\ntime        {} s = frame {}, at {} frames per second and {} steps per frame\n{}\
             objects     {}\nmemory      at least {} bytes for the cloth, {} for the picture\n\n{needs}",
            self.samples,
            self.time,
            self.frames,
            self.fps,
            self.steps_per_frame,
            self.cloth.as_ref().map_or_else(|| "cloth       none\n".to_owned(), ClothInfo::text),
            colliders.join(", "),
            self.memory.cloth,
            self.memory.picture,
        ) + &self.hint
    }
}

impl ClothInfo {
    fn of(cloth: &Cloth, scene: &Scene) -> Result<Self> {
        let [structural, shearing, bending] = springs::counts(cloth);
        let stability = Stability::of_bounded(cloth, &scene.sim)?;
        let Params { mass, dt, .. } = Params::new(cloth, &scene.sim);
        Ok(Self {
            points: [cloth.num_width_points, cloth.num_height_points],
            structural,
            shearing,
            bending,
            pinned: cloth.pinned.len(),
            mass,
            dt,
            integrator: scene.sim.integrator.name(),
            bound: stability
                .as_ref()
                .map(|stability| Bound::of(stability, cloth.ks, scene.sim.steps_per_frame)),
            stable: stability.as_ref().map_or("no step bound", verdict),
        })
    }

    fn text(&self) -> String {
        let [w, h] = self.points;
        let Self { structural, shearing, bending, pinned, mass, dt, integrator, stable, .. } = self;
        let step = match &self.bound {
            Some(bound) => bound.text(stable),
            None => ", no stability bound; the energy is checked during the run\n".into(),
        };
        format!(
            "cloth       {w} x {h} = {} points, pinned {pinned}, {mass} kg each\n\
             springs     {} = structural {structural}, shearing {shearing}, bending {bending}\n\
             integrator  {integrator}\n\
             step        {dt} s{step}",
            w * h,
            structural + shearing + bending,
        )
    }
}

impl Bound {
    fn of(stability: &Stability, ks: f64, steps_per_frame: u32) -> Self {
        let Stability { dt, limit, limit_worst, omega_rest, omega_safe, .. } = *stability;
        let [largest_ks_rest, largest_ks_worst] =
            largest_ks(stability, ks).map(|ks| Some(ks).filter(|ks| ks.is_finite()));
        Self {
            dt_omega_rest: dt * omega_rest,
            dt_omega_worst: dt * omega_safe,
            dt_omega_limit: limit,
            dt_omega_limit_worst: limit_worst,
            fewest_steps_rest: stability.fewest_steps_rest(),
            fewest_steps_worst: stability.fewest_steps_worst(),
            largest_ks_rest,
            largest_ks_worst,
            steps_per_frame,
        }
    }

    fn text(&self, stable: &str) -> String {
        let steps = self.steps_per_frame;
        let ks = self.largest_ks_rest.zip(self.largest_ks_worst).map_or_else(String::new, |(rest, worst)| {
            format!("ks          at most {rest} N/m at rest, {worst} at worst, at {steps} steps per frame\n")
        });
        let undamped = if self.dt_omega_limit_worst < self.dt_omega_limit {
            format!(" at rest and {:.4} at worst", self.dt_omega_limit_worst)
        } else {
            String::new()
        };
        format!(
            ", dt·ω {:.4} at rest and {:.4} at worst, limit {:.4}{undamped}: {stable}\n\
             steps       at least {} per frame at rest, {} at worst\n{ks}",
            self.dt_omega_rest,
            self.dt_omega_worst,
            self.dt_omega_limit,
            self.fewest_steps_rest,
            self.fewest_steps_worst,
        )
    }
}

fn verdict(stability: &Stability) -> &'static str {
    if stability.is_always_stable() {
        "stable"
    } else if stability.is_unstable_at_rest() {
        "unstable"
    } else {
        "stable at rest"
    }
}

fn need(item: &Item) -> String {
    let verdict = if item.needed { "needed  " } else { "left out" };
    format!("{verdict}  {}: {}\n", item.name, item.reason)
}
