//! A picture of a scene at a moment, with the numbers that the page shows.

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
    pub(super) fn shares_simulation(&self, other: &Self) -> bool {
        self.scene.moves_like(&other.scene) && self.allow_unstable == other.allow_unstable
    }

    /// The picture at the moment of `simulation`, whose step has these bounds.
    ///
    /// # Errors
    /// Those of the renderer.
    pub(super) fn take(&self, simulation: &Simulation, stability: Option<Stability>) -> Result<Shown> {
        let renderer = Renderer::new(&self.scene, &TextureSource::BuiltIn)?;
        let picture = renderer.draw(simulation.positions(), &self.options);
        let state = State {
            frame: simulation.frame(),
            time: simulation.time(),
            state_hash: simulation.state_hash(),
            energy: simulation.energy(),
            ledger: simulation.ledger(),
            stability,
        };
        let texts = self.provenance.of_picture(state.state_hash, picture.hash()).texts();
        let png = png::encode_with(picture.width, picture.height, &picture.rgb, Effort::Fast, &texts)?;
        Ok(Shown { png, half: half(&picture)?, state })
    }
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
    #[test]
    fn half_a_picture_is_the_mean_of_four_pixels() {
        let rgb = [0, 10, 255, 1, 10, 255, 0, 20, 255, 1, 21, 254].to_vec();
        let stats = drape::raster::Stats::default();
        let picture = Picture { width: 2, height: 2, rgb, depth: Vec::new(), ids: Vec::new(), stats };
        assert_eq!(half(&picture).unwrap(), png::encode(1, 1, &[1, 15, 255], Effort::Small).unwrap());
    }
}
