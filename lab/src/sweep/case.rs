//! One case of a sweep: the scene with one set of changes.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::store::Address;
use drape::error::{Error, Kind, Result};
use drape::scene::sweep::Spec;

/// A case.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Its number in the plan, from 0.
    pub number: u64,
    /// Where its record is stored.
    pub address: Address,
    /// The keys that change with their values, in the order of the SPEC file.
    pub changes: Vec<(String, Value)>,
}

/// A case as a line of `cases.jsonl`.
#[derive(Serialize, Deserialize)]
struct Line {
    id: String,
    changes: Map<String, Value>,
}

impl Case {
    /// Case `number` of `spec`; `settings` is all that its record depends on besides the changes.
    pub(super) fn new(number: u64, spec: &Spec, settings: &str) -> Self {
        let paths = spec.set.iter().map(|axis| axis.path.clone());
        let changes: Vec<(String, Value)> = paths.zip(spec.values(number).into_iter().cloned()).collect();
        let address = address(&changes, settings);
        Self { number, address, changes }
    }

    /// The line of the case, with a line feed.
    pub(super) fn line(&self) -> String {
        let line = Line { id: self.address.to_string(), changes: self.changes.iter().cloned().collect() };
        // Text and JSON values are always JSON.
        serde_json::to_string(&line).unwrap_or_default() + "\n"
    }

    /// Case `number` of `spec`, whose line is `text`.
    ///
    /// # Errors
    /// [`Kind::Io`] when the line is not one of this plan.
    pub(super) fn read(number: u64, text: &str, spec: &Spec, settings: &str) -> Result<Self> {
        let wrong = || {
            let message = format!("line {} of cases.jsonl is not one of this plan", number + 1);
            Error::new(Kind::Io, message).with_help("plan again: drape sweep plan SPEC OUT")
        };
        let line: Line = serde_json::from_str(text).map_err(|_| wrong())?;
        let change = |path: &String| Some((path.clone(), line.changes.get(path)?.clone()));
        let changes: Option<Vec<_>> = spec.set.iter().map(|axis| change(&axis.path)).collect();
        let changes = changes.filter(|changes| changes.len() == line.changes.len()).ok_or_else(wrong)?;
        let address = address(&changes, settings);
        if address.to_string() != line.id {
            return Err(wrong());
        }
        Ok(Self { number, address, changes })
    }

    /// The changes as `--set` takes them: `cloth.ks=500`.
    pub fn sets(&self) -> Vec<String> {
        self.changes.iter().map(|(path, value)| format!("{path}={value}")).collect()
    }
}

fn address(changes: &[(String, Value)], settings: &str) -> Address {
    let changes: Vec<String> = changes.iter().map(|(path, value)| format!("{path}={value}")).collect();
    Address::of("case", &format!("{settings} {changes:?}"))
}
