//! MP4 (H.264) through the program `ffmpeg`, which is given the pictures as raw bytes.

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};

use super::{Animation, Format};
use crate::session::files::staged::Staged;
use drape::error::{Error, Kind, Result};

/// What the film is encoded with, wherever the pictures come from. Players want even sides and
/// chroma at half the resolution.
const ENCODING: [&str; 6] =
    ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-pix_fmt", "yuv420p"];

/// Most bytes of what ffmpeg says that an error repeats.
const MOST_SAID: u64 = 2000;

/// A film that ffmpeg is encoding.
pub(crate) struct Mp4 {
    // Dropped first, so that nothing is written to the file any more when it goes.
    ffmpeg: Running,
    staged: Staged,
    pictures: Option<ChildStdin>,
    said: File,
}

/// A program that is ended when nobody waits for it any more.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Finds out before long work whether ffmpeg can be started.
///
/// # Errors
/// [`Kind::Io`] with the line that makes `film` of the pictures `film`_0000.png and so on.
pub(crate) fn find_ffmpeg(film: &Path, fps: u16) -> Result<()> {
    let quiet = |command: &mut Command| {
        command.arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status()
    };
    match quiet(&mut Command::new("ffmpeg")) {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(missing(film, fps, &format!("ffmpeg does not work ({status})"))),
        Err(e) => Err(missing(film, fps, &format!("ffmpeg cannot be started: {e}"))),
    }
}

fn missing(film: &Path, fps: u16, cause: &str) -> Error {
    let folder = film.with_extension("");
    let pictures = folder.join("%04d.png");
    let help = format!(
        "animate to {0} instead, then run where ffmpeg is:\nffmpeg -framerate {fps} -i {0} {1} {2}",
        quoted(&pictures.to_string_lossy()),
        ENCODING.map(quoted).join(" "),
        quoted(&film.to_string_lossy()),
    );
    Error::new(Kind::Io, cause).with_help(help)
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./%:".contains(c);
    if word.chars().all(plain) { word.to_owned() } else { format!("'{}'", word.replace('\'', r"'\''")) }
}

impl Mp4 {
    /// A film at `path`.
    ///
    /// # Errors
    /// [`Kind::Io`] when ffmpeg cannot be started or the file not be written.
    pub(crate) fn create(path: &Path, format: Format) -> Result<Self> {
        let staged = Staged::create(path)?;
        let said = tempfile::tempfile().map_err(|e| staged.failed(&e))?;
        let stderr = said.try_clone().map_err(|e| staged.failed(&e))?;
        let mut ffmpeg = Command::new("ffmpeg")
            .args(arguments(staged.temporary(), format))
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(stderr)
            .spawn()
            .map_err(|e| missing(path, format.fps, &format!("ffmpeg cannot be started: {e}")))?;
        let pictures = ffmpeg.stdin.take();
        Ok(Self { ffmpeg: Running(ffmpeg), staged, pictures, said })
    }

    /// What went wrong, in the words of ffmpeg once it has ended.
    fn failed(&mut self, cause: &str) -> Error {
        // Nothing more comes, so it ends.
        self.pictures = None;
        let status = self.ffmpeg.0.wait().map_or_else(|e| e.to_string(), |status| status.to_string());
        let mut said = Vec::new();
        let read = self.said.seek(SeekFrom::Start(0));
        let read = read.and_then(|_| (&self.said).take(MOST_SAID).read_to_end(&mut said));
        let said = String::from_utf8_lossy(&said).trim().to_owned();
        let error = Error::new(Kind::Io, format!("ffmpeg made no film: {cause} ({status})"));
        if read.is_ok() && !said.is_empty() { error.with_help(format!("it says: {said}")) } else { error }
    }
}

impl Animation for Mp4 {
    fn add(&mut self, rgb: &[u8]) -> Result<()> {
        let written = self.pictures.as_mut().map_or(Ok(()), |pictures| pictures.write_all(rgb));
        written.map_err(|e: io::Error| self.failed(&e.to_string()))
    }

    fn finish(mut self: Box<Self>) -> Result<()> {
        self.pictures = None;
        match self.ffmpeg.0.wait() {
            Ok(status) if status.success() => {}
            Ok(_) => return Err(self.failed("it failed")),
            Err(e) => return Err(self.failed(&e.to_string())),
        }
        self.staged.finish()
    }
}

fn arguments(film: &Path, format: Format) -> Vec<OsString> {
    let Format { width, height, fps } = format;
    let (size, fps) = (format!("{width}x{height}"), fps.to_string());
    let input = ["-f", "rawvideo", "-pixel_format", "rgb24", "-video_size", &size, "-framerate", &fps];
    let first = ["-y", "-loglevel", "error"].into_iter().chain(input).chain(["-i", "-"]);
    let all = first.chain(ENCODING).chain(["-f", "mp4"]).map(OsString::from);
    all.chain([film.as_os_str().to_owned()]).collect()
}
