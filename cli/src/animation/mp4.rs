//! MP4 (H.264) through the program `ffmpeg`, which is given the pictures as raw bytes.

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::process::{ChildStdin, Command, Stdio};

use super::format::{Animation, Format, MAX_FPS, Playback};
use crate::session::files::staged::Staged;
use crate::session::files::target::no_temporary;
use crate::session::program::Program;
use drape::error::{Error, Kind, Result};

/// The row of the table.
pub(crate) const MP4: Format = Format {
    ending: "mp4",
    note: "H.264, encoded by the program ffmpeg, which must be installed",
    max_fps: MAX_FPS,
    says: false,
    check: find_ffmpeg,
    create: |path, playback, _, _| Ok(Box::new(Mp4::create(path, playback)?)),
};

/// The options of the encoder, wherever the pictures come from. Most players need even sides, chroma at half the
/// resolution, and the index before the pictures. Colours are converted to those of BT.709 and tagged so: a
/// player takes what has no tag for BT.601 or BT.709, by its size.
fn encoding(playback: Playback) -> Vec<String> {
    let [r, g, b] = playback.background;
    let filter = format!(
        "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=0x{r:02x}{g:02x}{b:02x},\
         scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int,format=yuv420p"
    );
    let tags =
        ["-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"];
    let first = ["-vf", &filter, "-c:v", "libx264", "-pix_fmt", "yuv420p"];
    first.into_iter().chain(tags).chain(["-movflags", "+faststart"]).map(str::to_owned).collect()
}

/// Most bytes of the messages of ffmpeg that an error quotes.
const MOST_QUOTED: u64 = 2000;

/// A video that ffmpeg is encoding.
struct Mp4 {
    // Dropped first, so that nothing writes to the file when it is removed.
    ffmpeg: Program,
    staged: Staged,
    pictures: Option<ChildStdin>,
    messages: File,
}

/// Checks, before long work, that ffmpeg can be started.
///
/// # Errors
/// [`Kind::Io`] with the command that encodes `video` from numbered pictures.
fn find_ffmpeg(video: &Path, playback: Playback) -> Result<()> {
    let quiet = |command: &mut Command| {
        command.arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        Program::start(command).and_then(|program| program.wait())
    };
    match quiet(&mut Command::new("ffmpeg")) {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(missing(video, playback, &format!("ffmpeg does not work ({status})"))),
        Err(e) => Err(missing(video, playback, &format!("ffmpeg cannot be started: {e}"))),
    }
}

fn missing(video: &Path, playback: Playback, cause: &str) -> Error {
    let Playback { fps, .. } = playback;
    let encoding: Vec<String> = encoding(playback).iter().map(|word| quoted(word)).collect();
    let folder = video.with_extension("");
    let pictures = folder.join("%04d.png");
    let help = format!(
        "animate to {0} instead, then run this where ffmpeg is installed:\nffmpeg -framerate {fps} -i {0} {1} {2}",
        quoted(&pictures.to_string_lossy()),
        encoding.join(" "),
        quoted(&video.to_string_lossy()),
    );
    Error::new(Kind::Io, cause).with_help(help)
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./%:".contains(c);
    if word.chars().all(plain) { word.to_owned() } else { format!("'{}'", word.replace('\'', r"'\''")) }
}

impl Mp4 {
    /// A video at `path`.
    ///
    /// # Errors
    /// [`Kind::Io`] when ffmpeg cannot be started or the file not be written.
    fn create(path: &Path, playback: Playback) -> Result<Self> {
        let staged = Staged::create(path)?;
        let messages = tempfile::tempfile().map_err(|e| no_temporary(&e))?;
        let stderr = messages.try_clone().map_err(|e| staged.failed(&e))?;
        let mut command = Command::new("ffmpeg");
        command.args(arguments(staged.temporary(), playback));
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(stderr);
        let ffmpeg = Program::start(&mut command)
            .map_err(|e| missing(path, playback, &format!("ffmpeg cannot be started: {e}")))?;
        let pictures = ffmpeg.input();
        Ok(Self { ffmpeg, staged, pictures, messages })
    }

    /// The error of a failed run, with what ffmpeg wrote to standard error.
    fn failed(&mut self, cause: &str) -> Error {
        // At the end of its input ffmpeg exits.
        self.pictures = None;
        let status = self.ffmpeg.wait().map_or_else(|e| e.to_string(), |status| status.to_string());
        let mut messages = Vec::new();
        let read = self.messages.seek(SeekFrom::Start(0));
        let read = read.and_then(|_| (&self.messages).take(MOST_QUOTED).read_to_end(&mut messages));
        let messages = String::from_utf8_lossy(&messages).trim().to_owned();
        let error = Error::new(Kind::Io, format!("ffmpeg wrote no video: {cause} ({status})"));
        if read.is_ok() && !messages.is_empty() {
            error.with_help(format!("ffmpeg reports: {messages}"))
        } else {
            error
        }
    }
}

impl Animation for Mp4 {
    fn add(&mut self, rgb: &[u8]) -> Result<()> {
        let written = self.pictures.as_mut().map_or(Ok(()), |pictures| pictures.write_all(rgb));
        written.map_err(|e: io::Error| self.failed(&e.to_string()))
    }

    fn finish(mut self: Box<Self>, _state: u64) -> Result<()> {
        self.pictures = None;
        match self.ffmpeg.wait() {
            Ok(status) if status.success() => {}
            Ok(_) => return Err(self.failed("it ended with an error")),
            Err(e) => return Err(self.failed(&e.to_string())),
        }
        self.staged.finish()
    }
}

fn arguments(video: &Path, playback: Playback) -> Vec<OsString> {
    let Playback { width, height, fps, .. } = playback;
    let (size, fps) = (format!("{width}x{height}"), fps.to_string());
    let input = ["-f", "rawvideo", "-pixel_format", "rgb24", "-video_size", &size, "-framerate", &fps];
    let first = ["-y", "-loglevel", "error"].into_iter().chain(input).chain(["-i", "-"]).map(OsString::from);
    let all = first.chain(encoding(playback).into_iter().map(OsString::from));
    all.chain(["-f", "mp4"].map(OsString::from)).chain([video.as_os_str().to_owned()]).collect()
}
