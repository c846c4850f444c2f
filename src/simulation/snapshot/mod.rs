//! The whole state of a simulation, taken between two steps, from which it goes on with the same bits as if it had
//! never stopped.
//!
//! Data flows `Simulation -> Snapshot -> bytes -> Snapshot -> Simulation`. What a scene alone decides (springs, pins,
//! the side of a plane on which a point starts, the energy bound) is made again from the scene.

mod bytes;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::Simulation;
use super::ledger_recorder::LedgerRecorder;
use crate::cloth::{Counters, Points};
use crate::diagnostics::ledger::Ledger;
use crate::diagnostics::rest::Quiet;
use crate::error::{Error, Kind, Result};
use crate::scene::Scene;
use crate::version::VERSION;

/// What who watches a simulation knows of its last frames, which the state alone does not tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seen {
    /// For how long the cloth has been quiet.
    pub quiet: Quiet,
    /// Springs that the stretch limit shortened in the last frame.
    pub springs_limited: u64,
}

impl Seen {
    /// Whether nothing was seen, which a file need not say.
    fn is_nothing(&self) -> bool {
        *self == Self::default()
    }
}

/// The state of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// The version of the program that took it.
    version: String,
    /// What the scene says of the motion, see [`Scene::motion`].
    scene: Vec<(String, Value)>,
    steps: u64,
    steps_per_frame: u64,
    counters: Counters,
    /// The ledger, if one was recorded.
    ledger: Option<Ledger>,
    /// What was seen of the motion; nothing if it was not watched.
    pub seen: Seen,
    /// Positions, last positions, positions at the start of the frame, and what the integrator remembers, in
    /// metres and metres per second; nothing without a cloth.
    arrays: Vec<Points>,
}

impl Snapshot {
    /// The number of complete frames before it.
    pub fn frame(&self) -> u64 {
        self.steps / self.steps_per_frame
    }

    /// Checks that it was taken by this version, of a simulation of `scene`.
    fn check(&self, scene: &Scene) -> Result<()> {
        if self.version != VERSION {
            let message =
                format!("the state was saved by version {}, and this is version {VERSION}", self.version);
            return Err(Error::new(Kind::Scene, message)
                .with_help("another version may compute other bits: simulate from the start"));
        }
        let differences = differences(&self.scene, &scene.motion());
        if differences.is_empty() {
            return Ok(());
        }
        let message = format!("the state is of another scene: {}", differences.join("; "));
        Err(Error::new(Kind::Scene, message)
            .with_help("give the scene and the changes that it was saved with"))
    }
}

/// Most differences that are told.
const MOST_TOLD: usize = 5;

/// How two scenes differ, in words.
fn differences(saved: &[(String, Value)], given: &[(String, Value)]) -> Vec<String> {
    let value = |list: &[(String, Value)], path: &str| {
        let found = list.iter().find(|(known, _)| known == path);
        found.map_or_else(|| "absent".to_owned(), |(_, value)| value.to_string())
    };
    let added = given.iter().filter(|(path, _)| !saved.iter().any(|(known, _)| known == path));
    let paths = saved.iter().chain(added).map(|(path, _)| path);
    let told = paths.filter_map(|path| {
        let [saved, given] = [saved, given].map(|list| value(list, path));
        (saved != given).then(|| format!("`{path}` is {saved} in the state and {given} in the scene"))
    });
    let mut told: Vec<String> = told.collect();
    let more = told.len().saturating_sub(MOST_TOLD);
    told.truncate(MOST_TOLD);
    told.extend((more > 0).then(|| format!("{more} more")));
    told
}

impl Simulation {
    /// The whole state of this simulation of `scene`, without what was seen of it.
    pub fn snapshot(&self, scene: &Scene) -> Snapshot {
        let arrays = self.cloth.iter().flat_map(|cloth| {
            let now = [&cloth.x, &cloth.last].into_iter().chain(cloth.frame_start.first());
            now.chain(cloth.integrator.memory())
        });
        Snapshot {
            version: VERSION.to_owned(),
            scene: scene.motion(),
            steps: self.steps,
            steps_per_frame: self.steps_per_frame,
            counters: self.observers.counters,
            ledger: self.ledger(),
            seen: Seen::default(),
            arrays: arrays.cloned().collect(),
        }
    }

    /// Takes over the state of another simulation of the same `scene`: from here on this one has the same bits. If it
    /// records a ledger, that goes on too, where the other one recorded one.
    ///
    /// # Errors
    /// [`Kind::Scene`] when the state is of another scene, or of another version of this program, with what differs.
    pub fn restore(&mut self, scene: &Scene, snapshot: &Snapshot) -> Result<()> {
        snapshot.check(scene)?;
        if let Some(cloth) = &mut self.cloth {
            let now = [&mut cloth.x, &mut cloth.last].into_iter().chain(cloth.frame_start.first_mut());
            let arrays: Vec<&mut Points> = now.chain(cloth.integrator.memory_mut()).collect();
            let points = snapshot.arrays.iter().all(|array| array.len() == cloth.grid.len());
            if !points || arrays.len() != snapshot.arrays.len() {
                return Err(Error::new(Kind::Scene, "the state has another number of points than the scene"));
            }
            arrays.into_iter().zip(&snapshot.arrays).for_each(|(array, saved)| array.copy_from(saved));
        }
        self.steps = snapshot.steps;
        self.observers.counters = snapshot.counters;
        let recorder = self.observers.ledger.as_mut();
        if let Some((LedgerRecorder { ledger, .. }, saved)) = recorder.zip(snapshot.ledger) {
            *ledger = saved;
        }
        Ok(())
    }

    /// Where the points were at the start of the last frame, in metres.
    pub fn positions_at_frame_start(&self) -> &Points {
        self.cloth.as_ref().and_then(|cloth| cloth.frame_start.first()).unwrap_or(&self.no_points)
    }
}
