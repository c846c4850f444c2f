//! A sweep: one scene with many changes, as a file (SPEC) describes it.
//!
//! Data flows `text -> json -> Spec`. Which scenes come of it, and what is measured of them, is not known here.

mod axis;
mod rules;

use serde_json::Value;

pub use axis::{Axis, Scale};

use super::json::diagnostic::Diagnostics;
use super::json::finding::Finding;
use super::json::key::{Key, Row};
use super::json::list::Counts;
use super::json::node::Node;
use super::json::object::{self, Object};
use super::json::range::{POSITIVE, from_to};
use super::json::scalar::{Count, Flag};
use super::load::file;
use crate::error::{Error, Kind, Result};
use rules::{Changes, Names, Text};

/// Most frames of a case.
const MOST_FRAMES: u64 = 1 << 52;

/// What a sweep does.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// The scene file, relative to the SPEC file.
    pub scene: String,
    /// The keys that change, each with its values.
    pub set: Vec<Axis>,
    /// Whether the first values of all keys make the first case, the second values the second case and so on,
    /// instead of each value with each.
    pub zip: bool,
    /// How long each case is simulated.
    pub until: Until,
    /// What is measured, in this order.
    pub measure: Vec<String>,
    /// The picture of each case, if there is one.
    pub render: Option<Picture>,
    /// Seconds of running time after which a case is given up.
    pub time_limit: Option<f64>,
}

/// How long a case is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Until {
    /// To the scene's `render.time`.
    Scene,
    /// For so many seconds, rounded to the nearest frame.
    Time(f64),
    /// For so many frames.
    Frames(u64),
}

/// The picture of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Keys of the material of every object, with their values.
    pub material: Vec<(String, Value)>,
    /// Width and height in pixels.
    pub size: [u32; 2],
}

const SCENE: Row = Row::new("scene", &["The scene file, relative to the file of the sweep."]);
const SET: Row = Row::new("set", &["Keys of the scene, each with its values."]);
const ZIP: Row = Row::new("zip", &["Whether the values of all keys go in step."]);
const TIME: Row = Row::new("time", &["Simulated time of each case, rounded to a frame."]);
const FRAMES: Row = Row::new("frames", &["Frames of each case, instead of `time`."]);
const MEASURE: Row = Row::new("measure", &["What is measured at the end of each case."]);
const RENDER: Row = Row::new("render", &["The picture of each case."]);
const LIMIT: Row = Row::new("time_limit", &["Running time after which a case is given up, in seconds."]);
const MATERIAL: Row = Row::new("material", &["Keys of the material of every object."]);
const SIZE: Row = Row::new("size", &["Width and height of the picture in pixels."]);

impl Spec {
    /// The sweep in the text of a file, which errors call `name`; `measures` is what can be measured.
    ///
    /// # Errors
    /// [`Kind::Scene`] with everything that is wrong in it, each with its place.
    pub fn parse(name: &str, text: &str, measures: &[&str]) -> Result<Self> {
        let mut diagnostics = Diagnostics::of("the sweep");
        let document = file(&mut diagnostics, name, text.as_bytes());
        let read = |at: &mut Object| Self::read(at, measures);
        let spec = document.and_then(|document| {
            let spec = object::read(&mut diagnostics, &document, Self::keys, read)?;
            spec.validate(&mut diagnostics, &document);
            Some(spec)
        });
        diagnostics.finish()?;
        spec.ok_or_else(|| Error::new(Kind::Internal, "no sweep and no error"))
    }

    /// Every key of a SPEC file.
    fn keys() -> Vec<Key> {
        object::list(|at| Self::read(at, &[]))
    }

    fn read(at: &mut Object, measures: &[&str]) -> Self {
        let scene = at.required(SCENE, Text("the path of a scene file"));
        let set = at.required(SET, Changes);
        let zip = at.optional(ZIP, false, Flag);
        let time = at.has("time").then(|| at.required(TIME, from_to(0.0, 1e6).unit("s")));
        let frames = at.has("frames").then(|| at.required(FRAMES, Count(0, MOST_FRAMES)));
        let measure = at.required(MEASURE, Names(measures));
        let render = at.maybe(RENDER, Picture::read);
        let time_limit = at.has("time_limit").then(|| at.required(LIMIT, POSITIVE.unit("s")));
        let until = match (time, frames) {
            (_, Some(frames)) => Until::Frames(frames),
            (Some(time), None) => Until::Time(time),
            (None, None) => Until::Scene,
        };
        Self { scene, set, zip, until, measure, render, time_limit }
    }

    /// Checks what several keys say together.
    fn validate(&self, diagnostics: &mut Diagnostics, document: &Node) {
        if let (Some(time), Some(frames)) = (document.get("time"), document.get("frames")) {
            let finding = Finding::new("sweep::two_ends", "`time` and `frames` both say how long a case is")
                .at(frames.span, "given too")
                .also(Some(time.span), "given here")
                .key("frames")
                .help("keep one of the two");
            diagnostics.error(finding);
        }
        let lengths: Vec<usize> = self.set.iter().map(|axis| axis.values.len()).collect();
        if self.zip && lengths.windows(2).any(|pair| pair[0] != pair[1]) && diagnostics.clean("set") {
            let place = document.get("zip").map_or(document.span, |zip| zip.span);
            let counts: Vec<String> =
                self.set.iter().map(|axis| format!("`{}` has {}", axis.path, axis.values.len())).collect();
            let message = format!("`zip` asks for as many values of each key, but {}", counts.join(", "));
            diagnostics.error(Finding::new("sweep::unequal", message).at(place, "asked for here").key("zip"));
        }
    }

    /// How many cases there are; the largest number if there are more.
    pub fn cases(&self) -> u64 {
        let lengths = self.set.iter().map(|axis| axis.values.len() as u64);
        if self.zip {
            return lengths.min().unwrap_or(1);
        }
        lengths.fold(1, u64::saturating_mul)
    }

    /// Of each key the place of its value in case `index` (below [`Spec::cases`]): the last key changes fastest.
    pub fn places(&self, index: u64) -> Vec<usize> {
        let mut rest = index;
        let place = |axis: &Axis| {
            let length = (axis.values.len() as u64).max(1);
            let place = if self.zip { index } else { rest % length };
            rest /= length;
            #[expect(clippy::cast_possible_truncation, reason = "below the length of a list")]
            let place = place as usize;
            place
        };
        let mut places: Vec<usize> = self.set.iter().rev().map(place).collect();
        places.reverse();
        places
    }

    /// The value of each key in case `index` (below [`Spec::cases`]).
    pub fn values(&self, index: u64) -> Vec<&Value> {
        let places = self.places(index);
        self.set.iter().zip(places).filter_map(|(axis, place)| axis.values.get(place)).collect()
    }
}

impl Picture {
    fn read(at: &mut Object) -> Self {
        let material = at.optional(MATERIAL, Vec::new(), rules::Material);
        let size = at.optional(SIZE, [128, 100], Counts(Count(1, 16384), Count(1, 16384)));
        Self { material, size }
    }
}
