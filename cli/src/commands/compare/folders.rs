//! How the pictures of two folders differ.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::pair::Comparison;
use super::verdict::{shown, verdict};
use crate::animation::reel::ENDINGS;
use drape::error::{Error, Kind, Result};
use drape_lab::page;
use drape_lab::printable::line;

/// How the pictures of two folders differ.
#[derive(Serialize)]
pub(super) struct Folders {
    pub(super) pictures: Vec<Comparison>,
    pub(super) only_in_a: Vec<String>,
    pub(super) only_in_b: Vec<String>,
    /// Pictures in both folders of which one cannot be read, and folders that cannot.
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
    /// Adds what was not compared, to the page `text` too.
    pub(super) fn note_unread(&mut self, name: &Path, why: String, text: &mut String) {
        let name = if name.as_os_str().is_empty() { ".".to_owned() } else { shown(name) };
        *text += &page::comparison::unread(&name, &why);
        self.unreadable.push(Unreadable { name, why });
    }

    /// A line a picture.
    pub(super) fn lines(&self) -> String {
        let mut text = String::new();
        for comparison in &self.pictures {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}: {}", line(&comparison.b), comparison.line());
        }
        for Unreadable { name, why } in &self.unreadable {
            let _ = writeln!(text, "{}: not compared: {}", line(name), line(why));
        }
        text.extend(self.only_in_a.iter().map(|name| format!("{}: only in A\n", line(name))));
        text.extend(self.only_in_b.iter().map(|name| format!("{}: only in B\n", line(name))));
        if !self.not_compared.is_empty() {
            text += &format!("not pictures, and not compared: {}\n", line(&self.not_compared.join(", ")));
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
                "pictures or folders that cannot be read: {}, pictures that differ: {differing}, pictures that are missing in B: \
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

/// The most folders that cannot be listed until the search for more ends.
const MOST_UNREAD: usize = 100;

/// The files in a folder and the folders in it, as paths from there.
#[derive(Default)]
pub(super) struct Listed {
    pub(super) pictures: BTreeSet<PathBuf>,
    pub(super) others: BTreeSet<PathBuf>,
    /// Folders that cannot be listed or lead back to one above them, and why.
    pub(super) unread: BTreeMap<PathBuf, String>,
}

impl Listed {
    /// Lists a folder. Symbolic links are followed.
    pub(super) fn of(folder: &Path) -> Self {
        let mut listed = Self::default();
        listed.collect(folder, Path::new(""), &mut Vec::new());
        listed
    }

    /// Adds what is in `within`, which lies in the folders `above`, or why that cannot be told.
    fn collect(&mut self, root: &Path, within: &Path, above: &mut Vec<PathBuf>) {
        // Links that lead to each other make more ways than anybody waits for.
        if self.unread.len() >= MOST_UNREAD {
            return;
        }
        let folder = root.join(within);
        let depth = above.len();
        let found = fs::canonicalize(&folder).and_then(|here| {
            if above.contains(&here) {
                return Err(io::Error::other("it leads back to a folder above it"));
            }
            above.push(here);
            self.collect_entries(root, within, above)
        });
        if let Err(e) = found {
            let why = format!("cannot read the folder `{}`: {e}", folder.display());
            self.unread.insert(within.to_owned(), why);
        }
        above.truncate(depth);
    }

    fn collect_entries(&mut self, root: &Path, within: &Path, above: &mut Vec<PathBuf>) -> io::Result<()> {
        for entry in fs::read_dir(root.join(within))? {
            let name = within.join(entry?.file_name());
            let ending = name.extension().map(|ending| ending.to_string_lossy().to_lowercase());
            // A link that leads nowhere is no folder, and a picture that cannot be read.
            if root.join(&name).is_dir() {
                self.collect(root, &name, above);
            } else if ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str())) {
                self.pictures.insert(name);
            } else {
                self.others.insert(name);
            }
        }
        Ok(())
    }
}
