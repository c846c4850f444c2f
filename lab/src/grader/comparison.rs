//! The result of a comparison.

use serde::Serialize;

use super::case::Case;
use super::divergence::Difference;
use super::precision::Precision;
use super::trials::Tried;
use super::verdict::Verdict;
use super::watch::Watch;
use drape::error::Result;

/// How the positions of another program differ from ours.
#[derive(Serialize)]
pub struct Comparison {
    states: usize,
    first_frame: u64,
    tolerance: f64,
    /// Largest distance of two points in all states, in metres; absent where a position is no number.
    largest: Option<f64>,
    /// The first difference, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub difference: Option<Difference>,
    /// The mistakes that were run, the best first.
    mistakes: Vec<Tried>,
    verdict: String,
}

impl Comparison {
    /// Compares the states of `case`, and, if there is a `watch`, looks for the cause of a difference beyond
    /// `tolerance`, in metres; 0 asks for equal bits.
    ///
    /// # Errors
    /// Those of the simulations and of `watch`.
    pub fn new(case: &Case<'_>, tolerance: f64, watch: Option<Watch<'_>>) -> Result<Self> {
        let difference = Difference::first(case, tolerance);
        let Verdict { words: verdict, mistakes } = match (&difference, watch) {
            (None, _) if tolerance > 0.0 => {
                Verdict::only("the positions are within the tolerance of the method's")
            }
            (None, _) => Verdict::only("the positions are those of the method: every bit is equal"),
            (Some(_), None) => Verdict::only("the positions differ; the cause was not looked for"),
            (Some(_), Some(watch)) => Verdict::of(case, tolerance, watch)?,
        };
        let (states, first_frame) = (case.theirs.len(), case.first_frame);
        let distances = case.distances(0..states, case.ours, &Precision::WHOLE);
        let largest = Some(distances.into_iter().fold(0.0, f64::max)).filter(|metres| metres.is_finite());
        Ok(Self { states, first_frame, tolerance, largest, difference, mistakes, verdict })
    }

    /// The result as text.
    pub fn text(&self) -> String {
        let mut text = format!("states      {} from frame {}\n", self.states, self.first_frame);
        let metres = |value: Option<f64>| value.map_or("no number".to_owned(), |m| format!("{m:.3e} m"));
        if let Some(found) = &self.difference {
            let Difference { frame, point: [i, j], ours, theirs, .. } = found;
            let theirs = theirs.map(|value| value.unwrap_or(f64::NAN));
            text += &format!(
                "parts at    frame {frame}, column {i}, row {j}\n  ours      {ours:?}\n  theirs    {theirs:?}\n\
                 distance    {}, the largest there {}, in the last frame {}\n",
                metres(found.distance),
                metres(found.largest),
                metres(found.largest_at_the_end),
            );
            let helps = self.mistakes.iter().filter(|tried| tried.left < 0.9);
            text += &helps.take(3).map(Tried::line).collect::<String>();
        } else {
            text += &format!("distance    at most {}\n", metres(self.largest));
        }
        text + &format!("verdict     {}\n", self.verdict)
    }
}
