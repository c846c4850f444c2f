//! A picture to sample from: decoded once, then a plain array of texels.

use std::io::Cursor;
use std::sync::OnceLock;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use crate::container::{jpeg_end, png_end};
use crate::error::{Error, Kind, Result};
use crate::exif::orientation;
use crate::fence::fenced;
use crate::lanes::Texels;

/// Longest side of a texture, texels.
pub const MAX_SIDE: u32 = 16_384;

/// Most texels of a texture: 2^26, one gibibyte once decoded. A few kilobytes of compressed file
/// can ask for far more, so the header is held against this before anything is allocated.
pub const MAX_TEXELS: u64 = 1 << 26;

/// Most texels of all textures of a scene, four gibibytes.
pub const MAX_ALL_TEXELS: u64 = 1 << 28;

/// Bytes of a decoded texel.
const TEXEL_BYTES: u64 = 16;

/// Most bytes a decoder may hold: [`MAX_TEXELS`] of RGBA at 16 bits, and as much again for its work.
const MAX_DECODER_BYTES: u64 = 16 * MAX_TEXELS;

/// A picture of `width` × `height` texels. The first row is the top one (v = 0 in texture space).
#[derive(Clone, Debug)]
pub struct Texture {
    width: usize,
    height: usize,
    texels: Vec<[f32; 4]>,
    transparent: bool,
    /// Red alone, once it was asked for.
    red: OnceLock<Vec<f32>>,
    /// What [`Texture::pack_all`] gives, once it was asked for.
    packed: OnceLock<Option<Vec<u32>>>,
}

/// Checks that `count` texels of several textures are at most [`MAX_ALL_TEXELS`].
///
/// # Errors
/// [`Kind::Scene`] with the bytes that they take.
pub(crate) fn check_all_texels(count: u64) -> Result<()> {
    if count <= MAX_ALL_TEXELS {
        return Ok(());
    }
    let bytes = count.saturating_mul(TEXEL_BYTES);
    let message = format!("the textures are too large: {count} texels take {bytes} bytes");
    Err(Error::new(Kind::Scene, message).with_help(format!("together they may have {MAX_ALL_TEXELS} texels")))
}

impl PartialEq for Texture {
    /// What was asked for makes no difference.
    fn eq(&self, other: &Self) -> bool {
        let Self { width, height, texels, transparent, red: _, packed: _ } = self;
        *width == other.width
            && *height == other.height
            && *texels == other.texels
            && *transparent == other.transparent
    }
}

impl Texture {
    /// Decodes a PNG or JPEG of at most [`MAX_SIDE`] a side and [`MAX_TEXELS`] in all.
    ///
    /// Every sample becomes c / 255 (or c / 65535 at 16 bits), rounded once to `f32`. Grey fills
    /// all three channels. The picture is turned and mirrored as its Exif data say. Alpha, gamma and colour profiles
    /// are left out. A JPEG has
    /// no checksum, so damage inside its coded data can pass for a picture.
    ///
    /// # Errors
    /// [`Kind::Scene`], with `name` in the message, if the bytes are of another format, too large,
    /// corrupt or cut short; [`Kind::Io`] if there is no memory for the texels.
    pub fn decode(name: &str, bytes: &[u8]) -> Result<Self> {
        let image = fenced(|| picture(name, bytes)).unwrap_or_else(|why| Err(invalid(name, &why)))?;
        let (width, height) = (image.width(), image.height());
        // A picture that was decoded can be converted, if there is memory for it; the converter panics where not.
        let texture = fenced(|| Self::from_image(image)).ok().flatten();
        texture.ok_or_else(|| {
            let bytes = u64::from(width) * u64::from(height) * TEXEL_BYTES;
            let message =
                format!("there is no memory for the {width} x {height} texels of {name}, {bytes} bytes");
            Error::new(Kind::Io, message)
        })
    }

    /// Nothing if there is no memory for the texels.
    fn from_image(image: DynamicImage) -> Option<Self> {
        let (width, height) = (image.width() as usize, image.height() as usize);
        let mut texels = Vec::new();
        texels.try_reserve_exact(width * height).ok()?;
        let transparent = if image.color().bytes_per_pixel() == image.color().channel_count() {
            bytes_to_texels(&image, &mut texels)
        } else {
            words_to_texels(image, &mut texels)
        };
        Some(Self { width, height, texels, transparent, red: OnceLock::new(), packed: OnceLock::new() })
    }

    /// A texture of `width` × `height` from RGB in 0..=1, row by row from the top.
    ///
    /// # Errors
    /// [`Kind::Internal`] if a side is 0 or `rgb` does not hold `width * height` texels.
    pub fn from_rgb(width: usize, height: usize, rgb: &[[f32; 3]]) -> Result<Self> {
        if rgb.is_empty() || width.checked_mul(height) != Some(rgb.len()) {
            let message = format!("a texture of {width} x {height} from {} texels", rgb.len());
            return Err(Error::new(Kind::Internal, message));
        }
        let texels = rgb.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
        Ok(Self { width, height, texels, transparent: false, red: OnceLock::new(), packed: OnceLock::new() })
    }

    /// Whether the file had transparent pixels, which are drawn opaque.
    pub fn was_transparent(&self) -> bool {
        self.transparent
    }

    /// Texels in a row, at least 1.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows, at least 1.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Red, green, blue in 0..=1 and a fourth number that is always 1, of column `x` from the left
    /// and row `y` from the top.
    ///
    /// # Panics
    /// If `y` is not below the height, or `x` leads past the last texel.
    pub fn texel(&self, x: usize, y: usize) -> [f32; 4] {
        debug_assert!(x < self.width, "column {x} of {}", self.width);
        self.texels[y * self.width + x]
    }

    /// All texels, row by row from the top.
    pub fn texels(&self) -> &[[f32; 4]] {
        &self.texels
    }

    /// The red of all texels, as height maps are read: a quarter of the memory to look into. It is computed when it
    /// is asked for the first time.
    pub fn red(&self) -> &[f32] {
        self.red.get_or_init(|| self.texels.iter().map(|&[red, ..]| red).collect())
    }

    /// All texels for bilinear look-ups, which may ask for them packed. Where 8 bits a channel are enough, those are a
    /// quarter of the memory to look into, which the caches hold for longer.
    pub fn for_look_ups(&self, packed: bool) -> Texels<'_> {
        let packed = if packed { self.packed.get_or_init(|| self.pack_all()).as_deref() } else { None };
        Texels { full: &self.texels, packed }
    }

    /// All texels with 8 bits a channel. `None` if some have more, or if there is no memory for them: they only save time.
    fn pack_all(&self) -> Option<Vec<u32>> {
        let mut packed = Vec::new();
        packed.try_reserve_exact(self.texels.len()).ok()?;
        for &texel in &self.texels {
            packed.push(pack(texel)?);
        }
        Some(packed)
    }
}

/// Appends the texels of a picture of 8 bits a channel; whether one is transparent.
fn bytes_to_texels(image: &DynamicImage, texels: &mut Vec<[f32; 4]>) -> bool {
    let unit = |sample: u8| f32::from(sample) / 255.0;
    let mut transparent = false;
    for pixel in image.as_bytes().chunks_exact(image.color().channel_count().into()) {
        let (rgb, alpha) = match *pixel {
            [grey] => ([grey; 3], u8::MAX),
            [grey, alpha] => ([grey; 3], alpha),
            [r, g, b] => ([r, g, b], u8::MAX),
            [r, g, b, alpha] => ([r, g, b], alpha),
            _ => unreachable!("a picture has one to four channels"),
        };
        transparent |= alpha != u8::MAX;
        let [r, g, b] = rgb.map(unit);
        texels.push([r, g, b, 1.0]);
    }
    transparent
}

/// Appends the texels of any other picture; whether one is transparent.
fn words_to_texels(image: DynamicImage, texels: &mut Vec<[f32; 4]>) -> bool {
    let unit = |sample: u16| f32::from(sample) / 65535.0;
    let has_alpha = image.color().has_alpha();
    let transparent = has_alpha && image.to_rgba16().pixels().any(|pixel| pixel[3] != u16::MAX);
    texels.extend(image.into_rgb16().pixels().map(|p| [unit(p[0]), unit(p[1]), unit(p[2]), 1.0]));
    transparent
}

/// The channels of a texel with 8 bits each, red lowest; `None` if one is no multiple of 1/255.
fn pack([r, g, b, _]: [f32; 4]) -> Option<u32> {
    let mut bytes = [0; 4];
    for (byte, channel) in bytes.iter_mut().zip([r, g, b]) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "compared below")]
        let nearest = (channel * 255.0).round() as u8;
        if channel.to_bits() != (f32::from(nearest) / 255.0).to_bits() {
            return None;
        }
        *byte = nearest;
    }
    Some(u32::from_le_bytes(bytes))
}

/// The picture in a file, turned as it says.
fn picture(name: &str, bytes: &[u8]) -> Result<DynamicImage> {
    let invalid = |why: &dyn std::fmt::Display| invalid(name, why);
    let mut reader = ImageReader::new(Cursor::new(bytes));
    match image::guess_format(bytes) {
        Ok(ImageFormat::Png) if png_end(bytes).is_none() => return Err(invalid(&"the PNG is cut short")),
        Ok(ImageFormat::Jpeg) if jpeg_end(bytes).is_none() => return Err(invalid(&"the JPEG is cut short")),
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => reader.set_format(format),
        _ => return Err(invalid(&"it is neither a PNG nor a JPEG")),
    }
    let mut limits = Limits::default();
    limits.max_alloc = Some(MAX_DECODER_BYTES);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(|error| invalid(&error))?;
    let (width, height) = decoder.dimensions();
    if width.max(height) > MAX_SIDE || u64::from(width) * u64::from(height) > MAX_TEXELS {
        return Err(invalid(&format_args!("{width} x {height} is too large")));
    }
    let mut image = DynamicImage::from_decoder(decoder).map_err(|error| invalid(&error))?;
    image.apply_orientation(orientation(bytes));
    Ok(image)
}

/// The error of a texture called `name`.
fn invalid(name: &str, why: &dyn std::fmt::Display) -> Error {
    Error::new(Kind::Scene, format!("texture {name} cannot be decoded: {why}"))
        .with_help(format!("a texture is a PNG or JPEG of at most {MAX_SIDE} a side and {MAX_TEXELS} texels"))
}
