//! The place for a number in the name of a file: `%d`, or `%04d` for four digits. `%%` is a percent sign, as in printf, and
//! a `%` that begins neither is one too.

use std::path::{Path, PathBuf};

use drape::error::{Error, Kind, Result};

/// A name of numbered files.
pub(crate) struct Place {
    /// What stands before and behind the number.
    pub(crate) around: [String; 2],
    /// What stands between `%` and `d`.
    pub(crate) width: String,
}

/// What a name says.
struct Parts {
    /// The texts before, between and behind the places.
    texts: Vec<String>,
    widths: Vec<String>,
}

/// The place for a number in the name of a file, if it has one.
///
/// # Errors
/// [`Kind::Usage`] when it has several.
pub(crate) fn place(path: &Path) -> Result<Option<Place>> {
    let Some(Parts { texts, widths }) = parts(path) else { return Ok(None) };
    match (<[String; 2]>::try_from(texts), <[String; 1]>::try_from(widths)) {
        (Ok(around), Ok([width])) => Ok(Some(Place { around, width })),
        (Err(texts), _) if texts.len() > 2 => {
            let message = format!("`{}` has {} places for a number", path.display(), texts.len() - 1);
            Err(Error::new(Kind::Usage, message).with_help("leave one; %% is a percent sign"))
        }
        _ => Ok(None),
    }
}

/// The file that `path` names where one file is meant.
///
/// # Errors
/// [`Kind::Usage`] when the name has a place for a number.
pub(crate) fn one(path: &Path) -> Result<PathBuf> {
    let Some(Parts { texts, widths }) = parts(path) else { return Ok(path.to_path_buf()) };
    let Some(width) = widths.first() else {
        return Ok(path.with_file_name(texts.concat()));
    };
    let message = format!("`{}` is one file, and %{width}d stands for the number of many", path.display());
    let help = format!("leave %{width}d out of the name, or write %%{width}d for a percent sign");
    Err(Error::new(Kind::Usage, message).with_help(help))
}

/// The parts of a name with a percent sign in it.
fn parts(path: &Path) -> Option<Parts> {
    let mut rest = path.file_name()?.to_str()?;
    let (mut texts, mut widths, mut text) = (Vec::new(), Vec::new(), String::new());
    let mut found = false;
    while let Some((before, after)) = rest.split_once('%') {
        found = true;
        text += before;
        let (width, behind) = after.split_at(after.bytes().take_while(u8::is_ascii_digit).count());
        if let Some(behind) = behind.strip_prefix('d') {
            widths.push(width.to_owned());
            texts.push(std::mem::take(&mut text));
            rest = behind;
        } else {
            text.push('%');
            rest = after.strip_prefix('%').unwrap_or(after);
        }
    }
    texts.push(text + rest);
    found.then_some(Parts { texts, widths })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_percent_signs_are_one() {
        let one = |name: &str| one(Path::new(name)).map_err(|e| e.help);
        for (name, file) in [
            ("a.png", "a.png"),
            ("./b/../a.png", "./b/../a.png"),
            ("b%%/a.png", "b%%/a.png"),
            ("100%%dark.png", "100%dark.png"),
            ("%%%%04d.png", "%%04d.png"),
            ("5% x%.png", "5% x%.png"),
            ("%4%%d", "%4%d"),
            ("-", "-"),
        ] {
            assert_eq!(one(name), Ok(file.into()), "{name}");
        }
        let help = "leave %04d out of the name, or write %%04d for a percent sign";
        assert_eq!(one("%%%04d.png"), Err(help.into()));
    }
}
