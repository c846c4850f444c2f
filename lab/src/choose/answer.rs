//! What was found.

use std::fmt::Write;

use serde::Serialize;

use super::level::{Level, Settings};
use crate::accuracy::measure::Measure;
use drape::scene::Integrator;

/// The answer to a question of accuracy.
#[derive(Clone, Debug, Serialize)]
pub struct Answer {
    /// The cheapest settings that are within what was asked; `None` if there are none.
    pub choice: Option<Choice>,
    /// Everything that was run.
    pub candidates: Vec<Candidate>,
    /// Springs visited in the whole search; [`Answer::model`] takes more runs.
    pub springs_visited: u64,
    /// The time from which on positions cannot be told to what was asked, because copies that differ by rounding
    /// have parted that far, in seconds; `None` if they have not by the moment, as far as was looked.
    pub horizon: Option<f64>,
    /// How far the scene as it is written is from the limit, and which of its settings have none.
    pub model: Vec<Model>,
    /// Why there is no choice.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    #[serde(skip)]
    pub(super) measure: Measure,
}

/// Settings, and what they give.
#[derive(Clone, Debug, Serialize)]
pub struct Choice {
    /// The changes of the scene, as `--set` takes them.
    pub set: Vec<String>,
    /// The estimated distance from the limit, in metres or pixels.
    pub error: f64,
    /// How much larger or smaller the error may be.
    pub uncertainty: f64,
    /// Springs visited: to compute a force, to multiply with the stiffness matrix, or to limit a stretch.
    pub springs_visited: u64,
    /// Wall time of the simulation, in milliseconds.
    pub ms: f64,
}

/// One run.
#[derive(Clone, Debug, Serialize)]
pub struct Candidate {
    /// The integrator, as `sim.integrator` names it.
    pub integrator: &'static str,
    /// Steps per frame.
    pub steps_per_frame: u32,
    /// The estimated distance from the limit, if that is known and the run was finished.
    pub error: Option<f64>,
    /// How much larger or smaller the error may be.
    pub uncertainty: Option<f64>,
    /// Springs visited.
    pub springs_visited: u64,
    /// Wall time of the simulation, in milliseconds; `None` if it was not finished.
    pub ms: Option<f64>,
    /// How a run ended that was not finished.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ended: Option<&'static str>,
}

/// A difference that no step cures.
#[derive(Clone, Debug, Serialize)]
pub struct Model {
    /// What differs, in words.
    pub what: &'static str,
    /// The distance that it makes at the moment, in metres or pixels.
    pub error: f64,
}

impl Choice {
    pub(super) fn new(settings: &Settings, level: &Level, [error, uncertainty]: [f64; 2]) -> Self {
        let (set, springs_visited) = (settings.sets(), level.springs);
        Self { set, error, uncertainty, springs_visited, ms: level.time.as_secs_f64() * 1e3 }
    }

    /// The choice as a JSON merge patch of the scene.
    pub fn patch(&self) -> serde_json::Value {
        let sim = self.set.iter().filter_map(|set| {
            let (path, value) = set.split_once('=')?;
            let value = value.parse::<u64>().map_or_else(|_| value.into(), serde_json::Value::from);
            Some((path.strip_prefix("sim.")?.to_owned(), value))
        });
        serde_json::json!({ "sim": sim.collect::<serde_json::Map<_, _>>() })
    }
}

impl Candidate {
    pub(super) fn of(integrator: Integrator, steps: u32, springs: u64) -> Self {
        Self {
            integrator: integrator.name(),
            steps_per_frame: steps,
            error: None,
            uncertainty: None,
            springs_visited: springs,
            ms: None,
            ended: None,
        }
    }
}

impl Answer {
    /// A line for each candidate, what no step cures, and the choice or why there is none.
    pub fn text(&self) -> String {
        let unit = self.measure.unit();
        let mut text = String::new();
        for candidate in &self.candidates {
            let Candidate { integrator, steps_per_frame, springs_visited, .. } = candidate;
            let end = match (candidate.error.zip(candidate.uncertainty), candidate.ms, candidate.ended) {
                (_, _, Some(ended)) => ended.to_owned(),
                (Some((error, uncertainty)), Some(ms), _) => {
                    format!("{error:.2e} {unit} ± {uncertainty:.0e}, {ms:.0} ms")
                }
                (_, ms, _) => format!("no estimate, {:.0} ms", ms.unwrap_or_default()),
            };
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{integrator:15} {steps_per_frame:>6} steps a frame, {springs_visited:>12} springs: {end}"
            );
        }
        for Model { what, error } in &self.model {
            let _ = writeln!(text, "{what}: {error:.2e} {unit}");
        }
        match &self.choice {
            Some(choice) => {
                let sets: Vec<String> = choice.set.iter().map(|set| format!("--set {set}")).collect();
                let _ = writeln!(text, "{}", sets.join(" "));
            }
            None => text.extend(self.reason.iter().map(|reason| format!("{reason}\n"))),
        }
        text
    }
}
