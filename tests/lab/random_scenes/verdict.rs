//! What the program does with a scene, and whether that is right.

use drape::error::{Error, Kind};
use drape::scene::{Cloth, Contact, Integrator, Scene, SelfCollision, Sim};

use super::course::{finer, run};

/// How much more energy than the finer run has is a blow-up.
const WIDE: f64 = 100.0;

/// What the program does with a scene, settled; in the order of the columns of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Deserialize)]
pub(super) enum Verdict {
    /// It ends, and agrees with the finer run.
    EndsSound,
    /// It ends and does not agree, without a blow-up.
    EndsOff,
    /// It ends with a blow-up.
    EndsBlownUp,
    /// It ends with something that is no number.
    EndsNoNumber,
    /// It is refused before the first step, and blows up or does not agree with the finer run.
    RefusedRightly,
    /// It is refused for a step that is too long for the springs, and agrees.
    RefusedSound,
    /// It is refused for a step that is too short for the positions, and agrees.
    StuckSound,
    /// It is stopped, and blows up.
    StoppedBlownUp,
    /// It is stopped, and contact with objects or of the cloth with itself had put in most energy.
    StoppedContact,
    /// It is stopped, does not agree with the finer run, and does not blow up.
    StoppedOff,
    /// It is stopped, and agrees.
    StoppedSound,
}

impl Verdict {
    /// Every one, in order.
    pub(super) const ALL: [Self; 11] = [
        Self::EndsSound,
        Self::EndsOff,
        Self::EndsBlownUp,
        Self::EndsNoNumber,
        Self::RefusedRightly,
        Self::RefusedSound,
        Self::StuckSound,
        Self::StoppedBlownUp,
        Self::StoppedContact,
        Self::StoppedOff,
        Self::StoppedSound,
    ];

    /// Whether no scene may have it.
    pub(super) fn is_wrong(self) -> bool {
        matches!(self, Self::EndsBlownUp | Self::EndsNoNumber | Self::StuckSound | Self::StoppedSound)
    }
}

/// The verdict of the program on `scene`, run for so many `frames`.
pub(super) fn verdict(scene: &Scene, frames: u64) -> Verdict {
    let told = match run(scene, frames, true) {
        Ok(told) => told,
        Err(error) => return of_refusal(scene, frames, &error),
    };
    if let Some(message) = &told.stopped {
        return of_stop(scene, frames, message);
    }
    match Judged::new(scene, frames, 8) {
        _ if !told.finite => Verdict::EndsNoNumber,
        Judged { blown_up: true, visible: true, .. } => Verdict::EndsBlownUp,
        Judged { sound: true, .. } => Verdict::EndsSound,
        _ => Verdict::EndsOff,
    }
}

fn of_refusal(scene: &Scene, frames: u64, error: &Error) -> Verdict {
    assert_eq!(error.kind, Kind::Unstable, "{error}");
    let keeps_velocity = scene.sim.integrator == Integrator::Rk4;
    let judged = Judged::new(scene, frames, 8);
    if !error.message.starts_with("stuck") {
        return if judged.sound { Verdict::RefusedSound } else { Verdict::RefusedRightly };
    }
    // Rounding takes more of 8 times the steps: that both agree tells something only where gravity hardly counts, or does
    // not act through differences of positions.
    let known = keeps_velocity || judged.gravity_hardly_counts;
    if judged.sound && judged.near && known { Verdict::StuckSound } else { Verdict::RefusedRightly }
}

fn of_stop(scene: &Scene, frames: u64, message: &str) -> Verdict {
    let contact = ["self_collision", "planes", "spheres", "boxes"];
    if contact.iter().any(|phase| message.contains(&format!("most energy came from {phase}"))) {
        return Verdict::StoppedContact;
    }
    match Judged::new(scene, frames, 8) {
        Judged { blown_up: true, .. } => Verdict::StoppedBlownUp,
        // What gains energy may gain it with 8 times the steps, too.
        Judged { sound: true, .. } if Judged::new(scene, frames, 64).sound => Verdict::StoppedSound,
        _ => Verdict::StoppedOff,
    }
}

/// A run without checks, held against the same with more steps.
struct Judged {
    /// Whether both agree in places, to a tenth of the way and rounding, and in energies, to a factor of 2.
    sound: bool,
    /// Whether they agree in places to a tenth of the way.
    near: bool,
    /// Whether it blows up.
    blown_up: bool,
    /// Whether the points end farther apart than a hundredth of the cloth's longer side.
    visible: bool,
    /// Whether all that gravity can do is less than a tenth of the way of the points.
    gravity_hardly_counts: bool,
}

impl Judged {
    /// The judgement by `times` the steps.
    fn new(scene: &Scene, frames: u64, times: u32) -> Self {
        let free = |scene: &Scene| run(scene, frames, false).unwrap();
        let (here, truth) = (free(scene), free(&finer(scene, times)));
        let cloth = scene.cloth.as_ref().unwrap();
        let steps = frames as f64 * f64::from(scene.sim.steps_per_frame);
        let rounding = truth.rounding(cloth, scene.sim.precision, steps);
        let (apart, agrees) = (here.apart(&truth), 0.1 * truth.way);
        let lost = here.stopped.is_some() || truth.stopped.is_some();
        let floor = energy_of_rounding(scene, cloth, rounding);
        let most = truth.most + given_in_a_step(scene, cloth);
        let time = frames as f64 / scene.sim.fps;
        Self {
            sound: !lost && apart <= agrees + rounding && here.most <= 2.0 * most + floor,
            near: apart <= agrees && truth.way > 0.0,
            blown_up: here.stopped.is_some() || here.rise > WIDE * most + floor,
            visible: lost || apart > 0.01 * cloth.width.max(cloth.height),
            gravity_hardly_counts: 0.5 * scene.sim.gravity.norm() * time * time < 0.1 * here.way,
        }
    }
}

/// Energy that every step gives, however right it is, in J: at the speed that gravity gives in a step, or at that of one
/// push of self-collision.
fn given_in_a_step(scene: &Scene, cloth: &Cloth) -> f64 {
    let Sim { fps, steps_per_frame, gravity, self_collision, contact, .. } = &scene.sim;
    let fall = gravity.norm() / (fps * f64::from(*steps_per_frame));
    let pushes = *self_collision != SelfCollision::Off && *contact != Contact::Coulomb;
    let push = if pushes { 2.0 * cloth.thickness * fps } else { 0.0 };
    cloth.width * cloth.height * cloth.density * fall.max(push) * fall.max(push)
}

/// The energy of springs that `rounding`, in metres, stretches, and of points that it moves in a step; in J.
fn energy_of_rounding(scene: &Scene, cloth: &Cloth, rounding: f64) -> f64 {
    let rate = scene.sim.fps * f64::from(scene.sim.steps_per_frame);
    let points = (cloth.num_width_points * cloth.num_height_points) as f64;
    let mass = cloth.width * cloth.height * cloth.density;
    (36.0 * cloth.ks * points + mass * rate * rate) * rounding * rounding
}
