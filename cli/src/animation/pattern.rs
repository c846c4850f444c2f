//! The names of numbered files: `pictures/%04d.png` stands for `pictures/0000.png` and so on.

use std::fs;
use std::path::{Path, PathBuf};

/// Most digits that a number is filled up to.
const MAX_DIGITS: usize = 19;

/// The names of numbered files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pattern {
    folder: PathBuf,
    before: String,
    digits: usize,
    after: String,
}

impl Pattern {
    /// The pattern in a path whose file name holds one `%d`, or `%04d` for at least four digits.
    /// None if there is no such place, or several, or `%` elsewhere in the name.
    pub(crate) fn parse(path: &Path) -> Option<Self> {
        let (before, rest) = path.file_name()?.to_str()?.split_once('%')?;
        let (digits, after) = rest.split_once('d')?;
        let digits = match digits.strip_prefix('0') {
            Some(digits) => digits.parse().ok().filter(|digits| (1..=MAX_DIGITS).contains(digits))?,
            None if digits.is_empty() => 1,
            None => return None,
        };
        let folder = path.parent()?.to_path_buf();
        (!after.contains('%')).then(|| Self { folder, before: before.into(), digits, after: after.into() })
    }

    /// The folder of all files; empty for the current one.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// The file of picture `number`.
    pub(crate) fn path(&self, number: u64) -> PathBuf {
        let Self { folder, before, digits, after } = self;
        folder.join(format!("{before}{number:0digits$}{after}"))
    }

    /// The numbered files that are there, with their numbers in order.
    pub(crate) fn files(&self) -> Vec<(u64, PathBuf)> {
        let folder = if self.folder.as_os_str().is_empty() { Path::new(".") } else { &self.folder };
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        let mut files: Vec<(u64, PathBuf)> = entries
            .filter_map(|entry| self.number(Path::new(&entry.file_name())))
            .map(|number| (number, self.path(number)))
            .collect();
        files.sort_unstable();
        files
    }

    /// The number of the picture whose file name `path` has, in whatever folder.
    pub(crate) fn number(&self, path: &Path) -> Option<u64> {
        let name = path.file_name()?.to_str()?;
        let number = name.strip_prefix(&self.before)?.strip_suffix(&self.after)?.parse().ok()?;
        (self.path(number).file_name() == path.file_name()).then_some(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pattern_has_one_place_for_the_number() {
        let name = |text: &str| Pattern::parse(Path::new(text)).map(|pattern| pattern.path(7));
        for (pattern, file) in [
            ("a/%04d.png", "a/0007.png"),
            ("%d.png", "7.png"),
            ("a b/x%03dy.png", "a b/x007y.png"),
            ("100%/%01d.png", "100%/7.png"),
        ] {
            assert_eq!(name(pattern), Some(file.into()), "{pattern}");
            let pattern = Pattern::parse(Path::new(pattern)).unwrap();
            assert_eq!(pattern.number(Path::new(file)), Some(7));
            assert_eq!(pattern.number(Path::new("a/00000000007.png")), None);
        }
        for wrong in ["a.png", "%d/a.png", "%.png", "%4d.png", "%00d.png", "%020d.png", "%d%d.png", "%x.png"]
        {
            assert_eq!(name(wrong), None, "{wrong}");
        }
        assert_eq!(Pattern::parse(Path::new("%02d.png")).unwrap().path(12345), Path::new("12345.png"));
    }
}
