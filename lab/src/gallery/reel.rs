//! The simulations behind the pictures: pictures that can share a simulation do, and simulations run side by side.
//!
//! The state at the moment of each picture is kept in a store. From one moment to the next a simulation goes on from
//! there if the store has the next state, and step by step if not: both give the same bits. So work that was stopped
//! goes on at the last state, and several machines can share the simulations.

use rayon::prelude::*;

use super::shot::{Shot, Shown};
use crate::store::{Address, Store, key};
use drape::diagnostics::stability::Stability;
use drape::error::Result;
use drape::simulation::Simulation;
use drape::simulation::snapshot::Snapshot;

/// The ending of the files of states.
const STATE: &str = ".state";

/// Hears of every frame that is simulated, from many threads; an error that it returns ends the work.
pub type Watch<'a> = &'a (dyn Fn() -> Result<()> + Sync);

/// Sees the simulation at the moment of the picture with this index, and the bounds of its step.
type Visit<'a> = &'a mut dyn FnMut(usize, &Simulation, Option<Stability>) -> Result<()>;

/// The simulations of some pictures.
pub struct Reel<'a> {
    shots: &'a [Shot],
    /// The indices of the pictures of each simulation in the order of their frames, the longest simulation first.
    simulations: Vec<Vec<usize>>,
    /// Whether an energy ledger is recorded.
    ledger: bool,
    store: &'a Store,
}

impl<'a> Reel<'a> {
    /// The simulations of `shots`, with an energy ledger if `ledger` is true, whose states are kept in `store`.
    pub fn new(shots: &'a [Shot], ledger: bool, store: &'a Store) -> Self {
        Self { shots, simulations: simulations(shots), ledger, store }
    }

    /// Only the simulations whose numbers, from 0, `takes` accepts.
    pub fn only(mut self, takes: impl Fn(u64) -> bool) -> Self {
        let mut numbers = 0..;
        self.simulations.retain(|_| numbers.next().is_some_and(&takes));
        self
    }

    /// The number of frames to simulate: those before moments that the store does not have.
    pub fn frames(&self) -> u64 {
        self.simulations.iter().map(|places| self.missing(places)).sum()
    }

    /// The frames to simulate for the pictures at `places`.
    fn missing(&self, places: &[usize]) -> u64 {
        let (mut missing, mut now) = (0, 0);
        for shot in places.iter().filter_map(|&place| self.shots.get(place)) {
            if shot.frame > now && !self.store.has(self.key(shot)) {
                missing += shot.frame - now;
            }
            now = shot.frame;
        }
        missing
    }

    /// Simulates all moments that the store does not have.
    ///
    /// # Errors
    /// Those of the simulations, of the store and of `each_frame`.
    pub fn simulate(&self, each_frame: Watch<'_>) -> Result<()> {
        self.simulations
            .par_iter()
            .with_max_len(1)
            .try_for_each(|places| self.film(places, each_frame, &mut |_, _, _| Ok(())))
    }

    /// As [`Reel::simulate`], and takes the pictures, which are in the order of the shots.
    ///
    /// # Errors
    /// As [`Reel::simulate`], and those of the pictures.
    pub fn take(&self, each_frame: Watch<'_>) -> Result<Vec<Shown>> {
        let take = |places: &Vec<usize>| {
            let mut taken = Vec::new();
            self.film(places, each_frame, &mut |place, simulation, stability| {
                let shot = self.shots.get(place).map(|shot| shot.take(simulation, stability)).transpose()?;
                taken.extend(shot.map(|shown| (place, shown)));
                Ok(())
            })?;
            Ok(taken)
        };
        let taken: Vec<Result<Vec<_>>> = self.simulations.par_iter().with_max_len(1).map(take).collect();
        let mut taken: Vec<_> =
            taken.into_iter().collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
        taken.sort_by_key(|(place, _)| *place);
        Ok(taken.into_iter().map(|(_, shown)| shown).collect())
    }

    /// Calls `visit` at the moments of the pictures at `places`, which share a simulation.
    fn film(&self, places: &[usize], each_frame: Watch<'_>, visit: Visit<'_>) -> Result<()> {
        let mut shots = places.iter().filter_map(|&place| Some((place, self.shots.get(place)?))).peekable();
        let Some((_, first)) = shots.peek() else { return Ok(()) };
        let mut simulation = Simulation::new(&first.scene)?;
        if first.allow_unstable {
            simulation.allow_unstable();
        }
        if self.ledger {
            simulation.record_ledger()?;
        }
        let cloth = first.scene.cloth.as_ref();
        let stability =
            cloth.map(|cloth| Stability::of_bounded(cloth, &first.scene.sim)).transpose()?.flatten();
        for (place, shot) in shots {
            self.advance(&mut simulation, shot, each_frame)?;
            visit(place, &simulation, stability)?;
        }
        Ok(())
    }

    /// Takes `simulation` to the moment of `shot`.
    fn advance(&self, simulation: &mut Simulation, shot: &Shot, each_frame: Watch<'_>) -> Result<()> {
        if simulation.frame() == shot.frame {
            return Ok(());
        }
        let key = self.key(shot);
        if let Some(state) = self.store.get_file(key, STATE, Snapshot::decode) {
            self.store.count_found();
            return simulation.restore(&shot.scene, &state);
        }
        while simulation.frame() < shot.frame {
            simulation.advance_frame()?;
            each_frame()?;
        }
        self.store.put_file(key, STATE, &simulation.snapshot(&shot.scene).encode())
    }

    /// The address of the state at the moment of `shot`.
    fn key(&self, shot: &Shot) -> Address {
        let Shot { scene, frame, allow_unstable, .. } = shot;
        key("gallery state", &(scene.motion(), frame, allow_unstable, self.ledger))
    }
}

/// The indices of `shots` grouped by simulation, each group in the order of the frames, the longest simulation
/// first.
fn simulations(shots: &[Shot]) -> Vec<Vec<usize>> {
    let mut simulations: Vec<Vec<usize>> = Vec::new();
    for (place, shot) in shots.iter().enumerate() {
        let same = |places: &&mut Vec<usize>| {
            places.first().and_then(|&first| shots.get(first)).is_some_and(|f| f.shares_simulation(shot))
        };
        match simulations.iter_mut().find(same) {
            Some(places) => places.push(place),
            None => simulations.push(vec![place]),
        }
    }
    let frame = |&place: &usize| shots.get(place).map_or(0, |shot| shot.frame);
    simulations.iter_mut().for_each(|places| places.sort_by_key(frame));
    simulations.sort_by_key(|places| std::cmp::Reverse(places.last().map_or(0, frame)));
    simulations
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape::output::provenance::Provenance;
    use drape::render::Options;
    use drape::scene::{Overrides, load_stock};
    use std::path::Path;

    fn shot(scene: &str, sets: &[&str], frame: u64) -> Shot {
        let sets = sets.iter().map(ToString::to_string).collect();
        let overrides = Overrides { sets, ..Overrides::default() };
        let scene = load_stock(Path::new(scene), &overrides).unwrap().scene;
        let (options, provenance) = (Options::default(), Provenance::default());
        Shot { scene, options, frame, allow_unstable: false, provenance }
    }

    #[test]
    fn looks_share_a_simulation_and_worlds_do_not() {
        let looks =
            ["material.shader=bump", "sphere.resolution=[9,9]", "camera.polar=4", "light.color=[1,0,0]"];
        let mut bare = shot("scenes/plane.json", &[], 0);
        bare.scene.cloth = None;
        let shots = [
            shot("scenes/sphere.json", &[], 7),
            shot("scenes/sphere.json", &["cloth.ks=4"], 9),
            shot("scenes/sphere.json", &looks, 3),
            shot("scenes/sphere.json", &["sphere.radius=0.1"], 0),
            shot("scenes/sphere.json", &["sim.fps=30"], 0),
            shot("scenes/plane.json", &[], 0),
            shot("scenes/plane.json", &["plane.friction=0.1"], 0),
            bare,
            Shot { allow_unstable: true, ..shot("scenes/plane.json", &[], 0) },
        ];
        let expected: [&[usize]; 8] = [&[1], &[2, 0], &[3], &[4], &[5], &[6], &[7], &[8]];
        assert_eq!(simulations(&shots), expected);
        let folder = tempfile::tempdir().unwrap();
        let store = Store::new(folder.path(), |_, _| Ok(())).unwrap();
        assert_eq!(Reel::new(&shots, true, &store).frames(), 9 + 7);
    }
}
