//! What was verified, and the verdict.

use serde::Serialize;

use drape::error::{Error, Kind, Result};
use drape::output::provenance::{Arguments, Provenance};
use drape::version::VERSION;
use drape_lab::printable::line;

/// One thing that the file says, and what was found.
#[derive(Serialize)]
struct Check {
    what: &'static str,
    equal: bool,
    /// What the file says.
    said: String,
    found: String,
}

/// What was verified, in this order, up to the first difference.
#[derive(Serialize)]
pub(super) struct Report {
    file: String,
    equal: bool,
    /// What differs first, and how.
    differs: Option<&'static str>,
    why: Option<String>,
    /// The version that wrote the file, and this one.
    version: String,
    program: &'static str,
    arguments: Arguments,
    checks: Vec<Check>,
    /// Pixels that differ, if all was drawn again.
    differing_pixels: Option<u64>,
    /// The number of the picture, the column and the row of the first of them, from 0.
    first: Option<[u64; 3]>,
}

impl Report {
    /// A report of `file`, in which nothing is checked yet.
    pub(super) fn new(file: String, provenance: &Provenance) -> Self {
        Self {
            file,
            equal: true,
            differs: None,
            why: None,
            version: provenance.version.clone(),
            program: VERSION,
            arguments: provenance.arguments.clone(),
            checks: Vec::new(),
            differing_pixels: None,
            first: None,
        }
    }

    /// Whether another version wrote the file.
    pub(super) fn is_of_another_version(&self) -> bool {
        self.version != self.program
    }

    /// Whether nothing differs so far.
    pub(super) fn is_equal(&self) -> bool {
        self.equal
    }

    /// Notes what the file says of `what` and what was found. The first difference is told by `why`.
    pub(super) fn check(
        &mut self,
        what: &'static str,
        said: &str,
        found: &str,
        why: impl FnOnce() -> String,
    ) {
        let equal = said == found;
        self.checks.push(Check { what, equal, said: said.to_owned(), found: found.to_owned() });
        if !equal && self.equal {
            (self.equal, self.differs, self.why) = (false, Some(what), Some(why()));
        }
    }

    /// Notes how many pixels differ, and the first of them.
    pub(super) fn note_pixels(&mut self, differing: u64, first: Option<[u64; 3]>) {
        (self.differing_pixels, self.first) = (Some(differing), first);
    }

    /// The report as lines.
    pub(super) fn text(&self) -> String {
        let Self { program, .. } = self;
        let version = line(&self.version);
        let mut text = match self.is_of_another_version() {
            true => format!("version   written by {version}, verified by {program}\n"),
            false => format!("version   {version}\n"),
        };
        for Check { what, equal, said, found } in &self.checks {
            let found = if *equal { "equal".to_owned() } else { format!("differs, found {}", line(found)) };
            text += &format!("{what:<9} {} {found}\n", line(said));
        }
        text + if self.equal { "equal\n" } else { "" }
    }

    /// An error of [`Kind::Difference`] unless all is equal.
    pub(super) fn verdict(&self) -> Result<()> {
        let Some(why) = &self.why else { return Ok(()) };
        let Self { file, version, program, .. } = self;
        let error = Error::new(Kind::Difference, format!("`{file}` differs: {why}"));
        Err(match self.is_of_another_version() {
            true => error.with_help(format!(
                "version {version} wrote it, and this is {program}: another version may draw other pictures"
            )),
            false => error,
        })
    }
}
