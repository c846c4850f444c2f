//! Where the pictures of an animation go: the format is found by the ending of the file name.

use std::path::{Path, PathBuf};

use super::apng::APNG;
use super::format::{Animation, Format, MAX_FPS, Playback};
use super::gif::GIF;
use super::mp4::MP4;
use super::pattern::Pattern;
use crate::session::files::numbered;
use crate::session::stop::Stop;
use drape::error::{Error, Kind, Result};
use drape::output::provenance::Provenance;

/// The formats of one file.
pub(crate) const FORMATS: &[&Format] = &[&APNG, &GIF, &MP4];

/// One file, or a file for each picture.
pub(crate) enum Target {
    /// A PNG for each picture.
    Sequence(Pattern),
    /// A file of a format of the table.
    File(PathBuf, &'static Format),
}

/// The help for the path of a target.
pub(crate) fn help() -> String {
    let formats: Vec<String> =
        FORMATS.iter().map(|Format { ending, note, .. }| format!(".{ending} ({note})")).collect();
    format!(
        "The file to write, in the format of its ending: {}. A .png name with %d or %04d in it, such as \
         frames/%04d.png, means a numbered file for each picture; pictures that an earlier run has written from the \
         same scene and options are kept",
        formats.join(", ")
    )
}

/// The endings of the formats that can show `fps` pictures per second, such as `.apng, .mp4`.
fn endings(fps: u16) -> String {
    let fast = FORMATS.iter().filter(|format| format.max_fps >= fps);
    fast.map(|format| format!(".{}", format.ending)).collect::<Vec<_>>().join(", ")
}

impl Target {
    /// What a path stands for.
    ///
    /// # Errors
    /// [`Kind::Usage`] when no format has its ending, when a PNG has no place for the number, or another file has one.
    pub(crate) fn parse(path: &Path) -> Result<Self> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let format = FORMATS.iter().copied().find(|format| Some(format.ending) == ending.as_deref());
        if let Some(format) = format {
            return Ok(Self::File(numbered::one(path)?, format));
        }
        let pattern = Pattern::parse(path)?.filter(|_| ending.as_deref() == Some("png"));
        pattern.map(Self::Sequence).ok_or_else(|| {
            let message = format!("`{}` does not name an animation", path.display());
            let help = format!("the formats are {}, and numbered PNG files: frames/%04d.png", endings(1));
            Error::new(Kind::Usage, message).with_help(help)
        })
    }

    /// The names of the pictures, if each has a file.
    pub(crate) fn pattern(&self) -> Option<&Pattern> {
        match self {
            Self::Sequence(pattern) => Some(pattern),
            Self::File(..) => None,
        }
    }

    /// Whether its files have a place for what they say of themselves.
    pub(crate) fn says(&self) -> bool {
        match self {
            Self::Sequence(_) => true,
            Self::File(_, format) => format.says,
        }
    }

    /// The pictures per second: those asked for, or every simulated frame as far as the format can.
    ///
    /// # Errors
    /// [`Kind::Usage`] when the format cannot show so many.
    pub(crate) fn fps(&self, asked: Option<u16>, simulated: f64) -> Result<u16> {
        let (ending, most) = match self {
            Self::Sequence(_) => ("png", MAX_FPS),
            Self::File(_, format) => (format.ending, format.max_fps),
        };
        let every = simulated.round().clamp(1.0, f64::from(most));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 1000")]
        let fps = asked.unwrap_or(every as u16);
        if fps <= most {
            return Ok(fps);
        }
        let message = format!("--fps {fps}: a .{ending} file shows at most {most} pictures per second");
        let help = format!("lower --fps to {most}, or choose another format: {}", endings(fps));
        Err(Error::new(Kind::Usage, message).with_help(help))
    }

    /// Checks, before long work, that the file can be encoded.
    ///
    /// # Errors
    /// [`Kind::Io`] when a program that it takes is missing.
    pub(crate) fn check(&self, playback: Playback) -> Result<()> {
        match self {
            Self::File(path, format) => (format.check)(path, playback),
            Self::Sequence(_) => Ok(()),
        }
    }

    /// The file for `count` pictures, which says `provenance` of itself; none if each has its own.
    ///
    /// # Errors
    /// [`Kind::Io`] when it cannot be written; [`Kind::Usage`] when the format cannot hold the pictures.
    pub(crate) fn open(
        &self,
        playback: Playback,
        count: u64,
        provenance: Provenance,
    ) -> Result<Option<Box<dyn Animation>>> {
        match self {
            Self::File(path, format) => (format.create)(path, playback, count, provenance).map(Some),
            Self::Sequence(_) => Ok(None),
        }
    }

    /// Fails once the command has to end; numbered pictures are kept.
    ///
    /// # Errors
    /// As [`Stop::check`].
    pub(crate) fn check_stop(&self, stop: &Stop) -> Result<()> {
        match self {
            Self::Sequence(_) => stop.check_keeping("finished pictures"),
            Self::File(..) => stop.check(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_decides() {
        let kind = |path: &str| Target::parse(Path::new(path));
        assert!(matches!(kind("a/%04d.png"), Ok(Target::Sequence(_))));
        assert!(matches!(kind("a.apng"), Ok(Target::File(_, format)) if format.ending == "apng"));
        assert!(matches!(kind("a.GIF"), Ok(Target::File(_, format)) if format.ending == "gif"));
        assert!(matches!(kind("a.b.mp4"), Ok(Target::File(_, format)) if format.ending == "mp4"));
        for wrong in ["-", "a", "a.png", "a.webm", "%04d", ".gif", "%d/a.png"] {
            assert_eq!(kind(wrong).err().map(|e| e.kind), Some(Kind::Usage), "{wrong}");
        }
    }

    #[test]
    fn the_rate_has_the_limit_of_the_format() {
        let fps =
            |path: &str, asked, simulated| Target::parse(Path::new(path)).unwrap().fps(asked, simulated);
        assert_eq!(fps("a.gif", None, 90.0), Ok(50));
        assert_eq!(fps("a.mp4", None, 90.4), Ok(90));
        assert_eq!(fps("%d.png", None, 1e9), Ok(1000));
        assert_eq!(fps("a.apng", None, 0.1), Ok(1));
        let error = fps("a.gif", Some(51), 90.0).unwrap_err();
        assert_eq!(
            (error.kind, &*error.help),
            (Kind::Usage, "lower --fps to 50, or choose another format: .apng, .mp4")
        );
    }

    #[test]
    fn the_help_names_every_format() {
        assert!(FORMATS.iter().all(|format| help().contains(&format!(".{} (", format.ending))), "{}", help());
    }
}
