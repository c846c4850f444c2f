//! The plan of a sweep: the folder OUT with all that workers on any machine need.
//!
//! `plan.json` has the texts of the SPEC file and of the scene as they were, so that nothing that is edited later
//! mixes with it; `cases.jsonl` has a line for each case; `results/` is the store of the records.

use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::case::Case;
use super::measures;
use crate::store::{Store, WriteFile};
use drape::bounded;
use drape::error::{Error, Kind, Result};
use drape::scene::sweep::Spec;
use drape::version::VERSION;

/// The files of a plan.
const PLAN: &str = "plan.json";
const CASES: &str = "cases.jsonl";
const RESULTS: &str = "results";

/// Most cases of a plan: their lines take some 100 GB.
const MOST_CASES: u64 = 1_000_000_000;

/// A text with the name that messages give it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Text {
    /// The name.
    pub name: String,
    /// The content.
    pub text: String,
}

/// What `plan.json` says.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Stored {
    version: String,
    cases: u64,
    /// Results in the store that belong to earlier plans.
    others: u64,
    spec: Text,
    scene: Text,
}

/// A planned sweep.
#[derive(Debug)]
pub struct Plan {
    folder: PathBuf,
    stored: Stored,
    /// What the SPEC file says.
    pub spec: Spec,
    settings: String,
    /// The records.
    pub store: Store,
}

impl Plan {
    /// Reads a SPEC file, which errors call `name`.
    ///
    /// # Errors
    /// As [`Spec::parse`].
    pub fn spec(name: &str, text: &str) -> Result<Spec> {
        let names = measures::names();
        Spec::parse(name, text, &names.iter().map(String::as_str).collect::<Vec<_>>())
    }

    /// Plans the sweep of `spec` over `scene` in `folder`: writes the cases to `cases`, one after the other, then the
    /// plan. `each` is called for every case. Records that are there stay.
    ///
    /// # Errors
    /// [`Kind::Scene`] as [`Plan::spec`], and for more than a billion cases; [`Kind::Io`] when a file cannot be written; those of `each`.
    pub fn make(
        folder: &Path,
        [spec, scene]: [Text; 2],
        write: WriteFile,
        cases: &mut dyn Write,
        each: &mut dyn FnMut() -> Result<()>,
    ) -> Result<Self> {
        let count = Self::spec(&spec.name, &spec.text)?.cases();
        if count > MOST_CASES {
            let message = format!("{}: the sweep has {count} cases, more than {MOST_CASES}", spec.name);
            return Err(Error::new(Kind::Scene, message).with_help("give fewer values, or `zip`"));
        }
        let stored = Stored { version: VERSION.to_owned(), cases: count, others: 0, spec, scene };
        let mut plan = Self::new(folder, stored, write)?;
        let failed = |e| Error::new(Kind::Io, format!("cannot write `{}`: {e}", plan.cases_path().display()));
        let (before, mut known) = (plan.store.count()?, 0);
        for number in 0..count {
            let case = Case::new(number, &plan.spec, &plan.settings);
            known += u64::from(before > 0 && plan.store.has(case.address));
            cases.write_all(case.line().as_bytes()).map_err(failed)?;
            each()?;
        }
        cases.flush().map_err(failed)?;
        plan.stored.others = before.saturating_sub(known);
        Ok(plan)
    }

    /// Writes `plan.json`, after which workers can begin.
    ///
    /// # Errors
    /// [`Kind::Io`] when that fails.
    pub fn publish(&self, write: WriteFile) -> Result<()> {
        let json = serde_json::to_vec_pretty(&self.stored)
            .map_err(|e| Error::new(Kind::Internal, format!("cannot write JSON: {e}")))?;
        write(&self.folder.join(PLAN), &json)
    }

    /// The plan in `folder`.
    ///
    /// # Errors
    /// [`Kind::Io`] when there is none, or it is one of another version.
    pub fn load(folder: &Path, write: WriteFile) -> Result<Self> {
        let path = folder.join(PLAN);
        let failed = |cause: String| {
            let error = Error::new(Kind::Io, format!("cannot read the plan `{}`: {cause}", path.display()));
            error.with_help("plan the sweep first: drape sweep plan SPEC OUT")
        };
        let bytes = bounded::read(&path, bounded::MOST).map_err(|e| failed(e.to_string()))?;
        let stored: Stored = serde_json::from_slice(&bytes).map_err(|e| failed(e.to_string()))?;
        if stored.version != VERSION {
            return Err(failed(format!(
                "it is of version {}, and this is version {VERSION}",
                stored.version
            )));
        }
        Self::new(folder, stored, write)
    }

    fn new(folder: &Path, stored: Stored, write: WriteFile) -> Result<Self> {
        let spec = Self::spec(&stored.spec.name, &stored.spec.text)?;
        // Which cases there are does not change what a case gives.
        let kept = Spec { set: Vec::new(), zip: false, scene: String::new(), ..spec.clone() };
        let settings = format!("{kept:?} {:?}", stored.scene.text);
        let store = Store::new(&folder.join(RESULTS), write)?;
        Ok(Self { folder: folder.to_owned(), stored, spec, settings, store })
    }

    /// The path of `cases.jsonl` in `folder`.
    pub fn cases_path_in(folder: &Path) -> PathBuf {
        folder.join(CASES)
    }

    fn cases_path(&self) -> PathBuf {
        Self::cases_path_in(&self.folder)
    }

    /// The name and the text of the scene.
    pub fn scene(&self) -> &Text {
        &self.stored.scene
    }

    /// How many cases there are.
    pub fn count(&self) -> u64 {
        self.stored.cases
    }

    /// How many cases of this plan have a record, as far as counting files tells.
    ///
    /// # Errors
    /// As [`Store::count`].
    pub fn finished(&self) -> Result<u64> {
        Ok(self.store.count()?.saturating_sub(self.stored.others).min(self.count()))
    }

    /// The cases, read one after the other.
    ///
    /// # Errors
    /// [`Kind::Io`] when the file of the cases cannot be read, or a line is not one of this plan.
    pub fn cases(&self) -> Result<impl Iterator<Item = Result<Case>> + Send + '_> {
        let path = self.cases_path();
        let failed = move |e| Error::new(Kind::Io, format!("cannot read `{}`: {e}", path.display()));
        let file = File::open(self.cases_path()).map_err(&failed)?;
        let lines = (0..).zip(BufReader::new(file).lines());
        Ok(lines.map(move |(number, line)| {
            line.map_err(&failed).and_then(|line| Case::read(number, &line, &self.spec, &self.settings))
        }))
    }
}
