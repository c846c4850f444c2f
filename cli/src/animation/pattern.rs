//! The names of numbered files: `pictures/%04d.png` stands for `pictures/0000.png` and so on.

use std::fs;
use std::path::{Path, PathBuf};

use crate::session::files::numbered::{Place, place};
use crate::session::ui::Ui;
use drape::error::{Error, Kind, Result};

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
    /// The pattern in a path whose file name holds one `%d`, or `%04d` for at least four digits; none if there is no such
    /// place.
    ///
    /// # Errors
    /// [`Kind::Usage`] when the place has a width that no number is filled up to: the file would have the pattern as
    /// its name. As [`place()`].
    pub(crate) fn parse(path: &Path) -> Result<Option<Self>> {
        let Some(Place { around: [before, after], width }) = place(path)? else { return Ok(None) };
        let digits = match width.strip_prefix('0') {
            Some(digits) => digits.parse().ok().filter(|digits| (1..=MAX_DIGITS).contains(digits)),
            None => width.is_empty().then_some(1),
        };
        let digits = digits.ok_or_else(|| {
            let message = format!(
                "`{}`: %{width}d is no place for a number; the limit is {MAX_DIGITS} digits, and at least 1",
                path.display()
            );
            let help = "write %04d for four digits, or %d for as many as a number has";
            Error::new(Kind::Usage, message).with_help(help)
        })?;
        let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        Ok(Some(Self { folder, before, digits, after }))
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

    /// Warns of those numbered files that are there and whose number `is_left` by an earlier run: a program that
    /// reads all of them mixes both.
    pub(crate) fn caution(&self, is_left: impl Fn(u64) -> bool, ui: &Ui) {
        let left: Vec<PathBuf> =
            self.files().into_iter().filter(|(number, _)| is_left(*number)).map(|(_, file)| file).collect();
        if let Some(first) = left.first() {
            let message =
                format!("{} numbered files from {} on are of an earlier run", left.len(), first.display());
            ui.caution(&message, "remove them, or programs that read all files mix both");
        }
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
        let parse = |text: &str| Pattern::parse(Path::new(text));
        for (text, file) in [
            ("a/%04d.png", "a/0007.png"),
            ("%d.png", "7.png"),
            ("a b/x%03dy.png", "a b/x007y.png"),
            ("100%/%01d.png", "100%/7.png"),
            ("%019d.png", "0000000000000000007.png"),
            ("100%%-%d.png", "100%-7.png"),
            ("5%x%d%%d", "5%x7%d"),
        ] {
            let pattern = parse(text).unwrap().unwrap();
            assert_eq!(pattern.path(7), Path::new(file), "{text}");
            assert_eq!(pattern.number(Path::new(file)), Some(7));
            assert_eq!(pattern.number(Path::new("a/00000000007.png")), None);
        }
        for none in ["a.png", "%d/a.png", "%.png", "%%d.png", "%x.png", "5% dark.png"] {
            assert_eq!(parse(none), Ok(None), "{none}");
        }
        assert_eq!(parse("%d-%02d.png").unwrap_err().message, "`%d-%02d.png` has 2 places for a number");
        for width in ["4", "0", "00", "020", "099999999999999999999999"] {
            let error = parse(&format!("a/%{width}d.png")).unwrap_err();
            assert_eq!(error.kind, Kind::Usage, "{width}");
            assert!(
                error.message.contains(&format!("%{width}d"))
                    && error.message.contains("the limit is 19 digits"),
                "{error:?}"
            );
        }
        assert_eq!(parse("%02d.png").unwrap().unwrap().path(12345), Path::new("12345.png"));
    }
}
