//! How much a study runs.

use super::method::MODEL;

/// Options that a model may keep although they have no limit as the step shrinks, as keys of `sim`.
pub const KEPT: [&str; 2] = ["stretch_limit", "self_collision"];

/// How much is run: the size of the matrix, and the limits of cost and time.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent {
    /// The moments at which positions are compared, in tenths of a second, ascending.
    pub tenths: Vec<u32>,
    /// Fractions of the scene's density: each is a panel of another stiffness over mass.
    pub densities: Vec<f64>,
    /// Steps per second as multiples of the stable rate.
    pub rates: Vec<f64>,
    /// Most springs visited in one run; cells that are known to need more are left out.
    pub most_springs: f64,
    /// Most springs visited in one run of a reference.
    pub most_reference: f64,
    /// How often each run is timed.
    pub repeats: usize,
    /// Wall time after which a run is not repeated, in seconds.
    pub patience: f64,
    /// Width of the pictures in pixels.
    pub picture_width: u32,
    /// Latitude counts of drawn spheres; longitudes are as many.
    pub resolutions: Vec<u32>,
    /// Selects runs by part of their name or by their integrator, and makes no pictures; everything if empty.
    pub only: Vec<String>,
    /// Options of the scene that the model keeps although they have no limit as the step shrinks: some of [`KEPT`].
    pub kept: Vec<&'static str>,
    /// Part K of N of the runs, counted from 0, and no pictures.
    pub part: Option<[usize; 2]>,
}

impl Extent {
    /// The full study: under 20 minutes for a cloth of 50 × 50 points on two cores.
    pub fn full() -> Self {
        Self {
            tenths: vec![1, 2, 5],
            densities: vec![1.0, 1e-3, 1e-5],
            rates: vec![0.5, 0.9, 1.02, 1.5, 2.0, 4.0, 8.0],
            most_springs: 3e9,
            most_reference: 5e10,
            repeats: 3,
            patience: 6.0,
            picture_width: 512,
            resolutions: vec![16, 40, 128],
            only: Vec::new(),
            kept: Vec::new(),
            part: None,
        }
    }

    /// A small study: under two minutes for the same cloth.
    pub fn quick() -> Self {
        Self {
            tenths: vec![1, 2],
            densities: vec![1.0, 1e-3],
            rates: vec![0.5, 1.02, 2.0],
            most_springs: 2e8,
            most_reference: 1e10,
            repeats: 3,
            patience: 1.5,
            picture_width: 256,
            resolutions: vec![16, 128],
            only: Vec::new(),
            kept: Vec::new(),
            part: None,
        }
    }

    /// The same up to `tenth`, in tenths of a second, with moments at the same parts of the whole.
    pub fn up_to(mut self, tenth: u32) -> Self {
        let last = f64::from(self.last().max(1));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most `tenth`")]
        let part = |moment: u32| (f64::from(moment) / last * f64::from(tenth)).round().max(1.0) as u32;
        self.tenths = self.tenths.into_iter().map(part).collect();
        self.tenths.dedup();
        self
    }

    /// The changes that turn a scene into the model: [`MODEL`] without what is kept.
    pub fn model(&self) -> Vec<&'static str> {
        let is_kept = |set: &&str| {
            self.kept.iter().any(|key| set.strip_prefix("sim.").is_some_and(|set| set.starts_with(key)))
        };
        MODEL.into_iter().filter(|set| !is_kept(set)).collect()
    }

    /// The last moment, in tenths of a second.
    pub fn last(&self) -> u32 {
        self.tenths.last().copied().unwrap_or(0)
    }
}
