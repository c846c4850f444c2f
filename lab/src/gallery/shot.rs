//! Pictures of many moments: pictures that can share a simulation do, and simulations run side by side.

use rayon::prelude::*;
use serde::Serialize;

use drape::diagnostics::energy::Energy;
use drape::diagnostics::ledger::Ledger;
use drape::diagnostics::stability::Stability;
use drape::error::Result;
use drape::output::png::{self, Effort};
use drape::output::provenance::Provenance;
use drape::render::{Options, Picture, Renderer};
use drape::scene::Scene;
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;

/// A picture to take.
#[derive(Clone, Debug)]
pub struct Shot {
    /// The scene.
    pub scene: Scene,
    /// The options of the renderer.
    pub options: Options,
    /// The frame of the picture.
    pub frame: u64,
    /// Whether the cloth may become unstable.
    pub allow_unstable: bool,
    /// What the picture says of itself, but for its hashes.
    pub provenance: Provenance,
}

/// A picture that was taken.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The bytes of its PNG file, those that `drape render` writes.
    pub png: Vec<u8>,
    /// The picture at half its width and height, as PNG; each pixel is the mean of four.
    pub half: Vec<u8>,
    /// The cloth at this moment.
    pub state: State,
}

/// A cloth at the moment of a picture, in numbers.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct State {
    /// The frame.
    pub frame: u64,
    /// Simulated time, in seconds.
    pub time: f64,
    /// The hash of the state.
    #[serde(serialize_with = "hexadecimal")]
    pub state_hash: u64,
    /// The energies, in J.
    pub energy: Energy,
    /// The energy that each phase put in so far, in J, if it was recorded and there is a cloth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ledger: Option<Ledger>,
    /// The bounds of the step, if there is a cloth.
    pub stability: Option<Stability>,
}

fn hexadecimal<S: serde::Serializer>(hash: &u64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("{hash:016x}"))
}

impl Shot {
    /// Whether two pictures are moments of one simulation: their scenes differ at most in how they are drawn.
    fn shares_simulation(&self, other: &Self) -> bool {
        self.scene.moves_like(&other.scene) && self.allow_unstable == other.allow_unstable
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

/// The number of frames that [`take`] simulates for `shots`.
pub fn frames(shots: &[Shot]) -> u64 {
    let last = |places: &Vec<usize>| places.iter().filter_map(|&place| Some(shots.get(place)?.frame)).max();
    simulations(shots).iter().filter_map(last).sum()
}

/// Takes the pictures `shots` and returns them in this order; records an energy ledger if `ledger` is true.
/// `each_frame` is called after every frame, from many threads.
///
/// # Errors
/// Those of the simulations, of the pictures and of `each_frame`.
pub fn take(
    shots: &[Shot],
    ledger: bool,
    each_frame: &(impl Fn() -> Result<()> + Sync),
) -> Result<Vec<Shown>> {
    let taken: Vec<Result<Vec<(usize, Shown)>>> = simulations(shots)
        .par_iter()
        .with_max_len(1)
        .map(|places| film(shots, places, ledger, each_frame))
        .collect();
    let mut taken: Vec<_> = taken.into_iter().collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
    taken.sort_by_key(|(place, _)| *place);
    Ok(taken.into_iter().map(|(_, shown)| shown).collect())
}

/// The pictures at the indices `places`, which share a simulation.
fn film(
    shots: &[Shot],
    places: &[usize],
    ledger: bool,
    each_frame: &impl Fn() -> Result<()>,
) -> Result<Vec<(usize, Shown)>> {
    let mut shots = places.iter().filter_map(|&place| Some((place, shots.get(place)?))).peekable();
    let Some((_, first)) = shots.peek() else { return Ok(Vec::new()) };
    let mut simulation = Simulation::new(&first.scene)?;
    if first.allow_unstable {
        simulation.allow_unstable();
    }
    if ledger {
        simulation.record_ledger()?;
    }
    let cloth = first.scene.cloth.as_ref();
    let stability = cloth.map(|cloth| Stability::of_bounded(cloth, &first.scene.sim)).transpose()?.flatten();
    shots
        .map(|(place, shot)| {
            while simulation.frame() < shot.frame {
                simulation.advance_frame()?;
                each_frame()?;
            }
            Ok((place, show(shot, &simulation, stability)?))
        })
        .collect()
}

/// The picture of `shot` at the moment of `simulation`.
fn show(shot: &Shot, simulation: &Simulation, stability: Option<Stability>) -> Result<Shown> {
    let renderer = Renderer::new(&shot.scene, &TextureSource::BuiltIn)?;
    let picture = renderer.draw(simulation.positions(), &shot.options);
    let state = State {
        frame: simulation.frame(),
        time: simulation.time(),
        state_hash: simulation.state_hash(),
        energy: simulation.energy(),
        ledger: simulation.ledger(),
        stability,
    };
    let texts = shot.provenance.of_picture(state.state_hash, picture.hash()).texts();
    let png = png::encode_with(picture.width, picture.height, &picture.rgb, Effort::Fast, &texts)?;
    Ok(Shown { png, half: half(&picture)?, state })
}

/// The picture at half its size as PNG bytes; a last odd row or column is left out.
fn half(picture: &Picture) -> Result<Vec<u8>> {
    let [width, height] = [picture.width, picture.height].map(|side| (side / 2).max(1));
    let sample = |x: u32, y: u32, channel: usize| {
        let (x, y) = (x.min(picture.width - 1), y.min(picture.height - 1));
        u32::from(picture.rgb[(y as usize * picture.width as usize + x as usize) * 3 + channel])
    };
    let mut rgb = Vec::with_capacity(width as usize * height as usize * 3);
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (2 * y, 2 * x))) {
        for channel in 0..3 {
            let corners = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
            let sum: u32 = corners.iter().map(|&(x, y)| sample(x, y, channel)).sum();
            #[expect(clippy::cast_possible_truncation, reason = "the mean of four bytes is a byte")]
            rgb.push(((sum + 2) / 4) as u8);
        }
    }
    png::encode(width, height, &rgb, Effort::Small)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape::scene::{Overrides, load_stock};
    use std::path::Path;

    fn shot(scene: &str, sets: &[&str], frame: u64) -> Shot {
        let sets = sets.iter().map(ToString::to_string).collect();
        let overrides = Overrides { sets, ..Overrides::default() };
        let scene = load_stock(Path::new(scene), &overrides).unwrap().scene;
        Shot {
            scene,
            options: Options::default(),
            frame,
            allow_unstable: false,
            provenance: Provenance::default(),
        }
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
        assert_eq!(frames(&shots), 9 + 7);
    }

    #[test]
    fn half_a_picture_is_the_mean_of_four_pixels() {
        let rgb = [0, 10, 255, 1, 10, 255, 0, 20, 255, 1, 21, 254].to_vec();
        let stats = drape::raster::Stats::default();
        let picture = Picture { width: 2, height: 2, rgb, depth: Vec::new(), ids: Vec::new(), stats };
        assert_eq!(half(&picture).unwrap(), png::encode(1, 1, &[1, 15, 255], Effort::Small).unwrap());
    }
}
