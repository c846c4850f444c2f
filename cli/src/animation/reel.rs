//! The pictures of a file: one, or those of an animation in the order in which they are shown.

use std::io::Cursor;
use std::path::Path;

use image::codecs::gif::GifDecoder;
use image::codecs::jpeg::JpegDecoder;
use image::codecs::png::PngDecoder;
use image::metadata::{LoopCount, Orientation};
use image::{
    AnimationDecoder, ColorType, Delay, DynamicImage, Frame, Frames, ImageDecoder, ImageFormat, Limits,
};

use drape::bounded;
use drape::container::{gif_end, has_cover, jpeg_end, png_end};
use drape::error::{Error, Kind, Result};
use drape::exif::orientation;
use drape::fence::fenced;
use drape::output::png::{Pixels, refusal};
use drape::texture::MAX_SIDE;

/// Endings of the names of files with pictures, in lower case.
pub(crate) const ENDINGS: [&str; 5] = ["png", "apng", "gif", "jpg", "jpeg"];

/// A file that is being read, picture after picture.
pub(crate) struct Reel {
    name: String,
    /// How often an animation is shown; 0 for ever.
    pub(crate) plays: u32,
    pictures: Pictures,
}

enum Pictures {
    Still(Option<Pixels>),
    Moving(Frames<'static>),
}

/// One picture and how long it is shown, as a fraction of a millisecond count; none of a single picture.
pub(crate) struct Shown {
    pub(crate) pixels: Pixels,
    pub(crate) delay: Option<(u32, u32)>,
}

impl Reel {
    /// Opens a PNG, an animated PNG, a GIF or a JPEG; what it is stands in its first bytes.
    ///
    /// # Errors
    /// [`Kind::Io`] when it cannot be read or is none of these.
    pub(crate) fn open(path: &Path) -> Result<Self> {
        let name = path.display().to_string();
        let bytes = bounded::read(path, bounded::MOST).map_err(|e| failed(&name, &e))?;
        Self::of(name, bytes)
    }

    /// The pictures in the bytes of a file called `name`.
    ///
    /// # Errors
    /// As [`Reel::open`].
    pub(crate) fn of(name: String, bytes: Vec<u8>) -> Result<Self> {
        let opened = fenced(|| match image::guess_format(&bytes) {
            Ok(ImageFormat::Png) => png(bytes),
            Ok(ImageFormat::Gif) => gif(bytes),
            Ok(ImageFormat::Jpeg) => jpeg(bytes),
            _ => Err("it is no PNG, animated PNG, GIF or JPEG".to_owned()),
        });
        let opened = opened.unwrap_or_else(|why| Err(why.to_owned()));
        let (plays, pictures) = opened.map_err(|e| failed(&name, &e))?;
        Ok(Self { name, plays, pictures })
    }

    /// Whether the file is an animation, of however many pictures.
    pub(crate) fn moves(&self) -> bool {
        matches!(self.pictures, Pictures::Moving(_))
    }

    /// The next picture; nothing after the last.
    ///
    /// # Errors
    /// [`Kind::Io`] when it cannot be decoded or has no pixels, which the format of a GIF allows.
    pub(crate) fn next(&mut self) -> Result<Option<Shown>> {
        match self.decoded()? {
            Some(shown) if shown.pixels.rgba.is_empty() => Err(failed(&self.name, &"it has no pixels")),
            next => Ok(next),
        }
    }

    fn decoded(&mut self) -> Result<Option<Shown>> {
        match &mut self.pictures {
            Pictures::Still(picture) => Ok(picture.take().map(|pixels| Shown { pixels, delay: None })),
            Pictures::Moving(frames) => {
                let next = fenced(|| frames.next().transpose()).map_err(|why| failed(&self.name, &why))?;
                next.map(|frame| frame.map(shown)).map_err(|e| failed(&self.name, &refusal(&e)))
            }
        }
    }
}

fn shown(frame: Frame) -> Shown {
    let delay = Some(frame.delay().numer_denom_ms());
    Shown { pixels: pixels(DynamicImage::ImageRgba8(frame.into_buffer())), delay }
}

type Opened = std::result::Result<(u32, Pictures), String>;

fn png(bytes: Vec<u8>) -> Opened {
    if png_end(&bytes) != Some(bytes.len()) {
        return Err("the PNG is cut short, or has more behind its end".to_owned());
    }
    let kept = bytes.clone();
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits()).map_err(|e| refusal(&e))?;
    // Cutting 16 bits down to 8 would hide differences.
    if !matches!(decoder.color_type(), ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8) {
        return Err("it has 16 bits a channel; only 8 are compared".to_owned());
    }
    if !decoder.is_apng().map_err(|e| refusal(&e))? {
        return still(decoder, orientation(&kept));
    }
    let decoder = decoder.apng().map_err(|e| refusal(&e))?;
    let cover = if has_cover(&kept) { Some(cover(kept)?) } else { None };
    let plays = plays(decoder.loop_count());
    let frames = cover.into_iter().map(Ok).chain(decoder.into_frames());
    Ok((plays, Pictures::Moving(Frames::new(Box::new(frames)))))
}

/// The picture of an animated PNG that is no part of the animation, which is shown for no time.
fn cover(bytes: Vec<u8>) -> std::result::Result<Frame, String> {
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits()).map_err(|e| refusal(&e))?;
    let picture = DynamicImage::from_decoder(decoder).map_err(|e| refusal(&e))?;
    Ok(Frame::from_parts(picture.into_rgba8(), 0, 0, Delay::from_numer_denom_ms(0, 1)))
}

fn gif(bytes: Vec<u8>) -> Opened {
    // The decoder stops there: what follows, such as another GIF, would not be compared.
    if gif_end(&bytes).is_some_and(|end| end != bytes.len()) {
        return Err("the GIF has more behind its end".to_owned());
    }
    let mut decoder = GifDecoder::new(Cursor::new(bytes)).map_err(|e| refusal(&e))?;
    decoder.set_limits(limits()).map_err(|e| refusal(&e))?;
    Ok((plays(decoder.loop_count()), Pictures::Moving(decoder.into_frames())))
}

fn jpeg(bytes: Vec<u8>) -> Opened {
    if jpeg_end(&bytes) != Some(bytes.len()) {
        return Err("the JPEG is cut short, or has more behind its end".to_owned());
    }
    let orientation = orientation(&bytes);
    let mut decoder = JpegDecoder::new(Cursor::new(bytes)).map_err(|e| refusal(&e))?;
    decoder.set_limits(limits()).map_err(|e| refusal(&e))?;
    still(decoder, orientation)
}

/// The picture as it is shown: turned as its Exif data say.
fn still(decoder: impl ImageDecoder, orientation: Orientation) -> Opened {
    let mut decoded = DynamicImage::from_decoder(decoder).map_err(|e| refusal(&e))?;
    decoded.apply_orientation(orientation);
    Ok((0, Pictures::Still(Some(pixels(decoded)))))
}

fn pixels(picture: DynamicImage) -> Pixels {
    let picture = picture.into_rgba8();
    let rgba = picture.pixels().map(|pixel| pixel.0).collect();
    Pixels { width: picture.width(), height: picture.height(), rgba }
}

fn plays(count: LoopCount) -> u32 {
    match count {
        LoopCount::Infinite => 0,
        LoopCount::Finite(count) => count.get(),
    }
}

fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits
}

fn failed(name: &str, cause: &dyn std::fmt::Display) -> Error {
    Error::new(Kind::Io, format!("cannot read `{name}`: {cause}"))
}
