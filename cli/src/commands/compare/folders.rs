//! How the pictures of two folders differ.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::pair::Comparison;
use super::verdict::{shown, verdict};
use crate::animation::reel::ENDINGS;
use drape::error::{Error, Kind, Result};

/// How the pictures of two folders differ.
#[derive(Serialize)]
pub(super) struct Folders {
    pub(super) pictures: Vec<Comparison>,
    pub(super) only_in_a: Vec<String>,
    pub(super) only_in_b: Vec<String>,
    /// Pictures in both folders of which one cannot be read.
    pub(super) unreadable: Vec<Unreadable>,
    /// Files that are no pictures by their names, and are not compared.
    pub(super) not_compared: Vec<String>,
}

/// A pair that was not compared.
#[derive(Serialize)]
pub(super) struct Unreadable {
    pub(super) name: String,
    pub(super) why: String,
}

impl Folders {
    /// A line a picture.
    pub(super) fn lines(&self) -> String {
        let mut text = String::new();
        for comparison in &self.pictures {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}: {}", comparison.b, comparison.line());
        }
        text.extend(
            self.unreadable.iter().map(|Unreadable { name, why }| format!("{name}: not compared: {why}\n")),
        );
        text.extend(self.only_in_a.iter().map(|name| format!("{name}: only in A\n")));
        text.extend(self.only_in_b.iter().map(|name| format!("{name}: only in B\n")));
        if !self.not_compared.is_empty() {
            text += &format!("not pictures, and not compared: {}\n", self.not_compared.join(", "));
        }
        text
    }

    /// What cannot be read is an error before a picture that differs or is missing in B, and that before one
    /// that is missing in A.
    pub(super) fn verdict(&self) -> Result<()> {
        let differing = self.pictures.iter().filter(|c| !c.within_budget).count();
        let missing = self.only_in_a.len();
        if let [Unreadable { why, .. }, ..] = self.unreadable.as_slice() {
            let message = format!(
                "pictures that cannot be read: {}, pictures that differ: {differing}, pictures that are missing in B: \
                 {missing}",
                self.unreadable.len()
            );
            return Err(Error::new(Kind::Io, message).with_help(why.clone()));
        }
        verdict(differing + missing == 0, || {
            format!("pictures that differ: {differing}, pictures that are missing in B: {missing}")
        })?;
        match self.only_in_b.as_slice() {
            [] => Ok(()),
            [name, ..] => {
                Err(Error::new(Kind::Nothing, format!("A has no picture named `{name}` to compare with")))
            }
        }
    }
}

/// The files in a folder and the folders in it, as paths from there.
#[derive(Default)]
pub(super) struct Listed {
    pub(super) pictures: BTreeSet<PathBuf>,
    pub(super) others: BTreeSet<PathBuf>,
}

impl Listed {
    /// Lists a folder. Symbolic links are followed.
    ///
    /// # Errors
    /// [`Kind::Io`] when a folder cannot be read, or contains itself.
    pub(super) fn of(folder: &Path) -> Result<Self> {
        let mut listed = Self::default();
        let failed = |e| Error::new(Kind::Io, format!("cannot read the folder `{}`: {e}", folder.display()));
        listed.collect(folder, Path::new(""), &mut Vec::new()).map_err(failed)?;
        Ok(listed)
    }

    /// Adds what is in `within`, which lies in the folders `above`.
    fn collect(&mut self, root: &Path, within: &Path, above: &mut Vec<PathBuf>) -> io::Result<()> {
        let here = fs::canonicalize(root.join(within))?;
        if above.contains(&here) {
            return Err(io::Error::other(format!(
                "the link `{}` leads back to a folder above it",
                shown(within)
            )));
        }
        above.push(here);
        for entry in fs::read_dir(root.join(within))? {
            let name = within.join(entry?.file_name());
            let ending = name.extension().map(|ending| ending.to_string_lossy().to_lowercase());
            // A link that leads nowhere is no folder, and a picture that cannot be read.
            if root.join(&name).is_dir() {
                self.collect(root, &name, above)?;
            } else if ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str())) {
                self.pictures.insert(name);
            } else {
                self.others.insert(name);
            }
        }
        above.pop();
        Ok(())
    }
}
