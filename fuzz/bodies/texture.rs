//! Pictures: a damaged or malicious file is an error, and costs no more memory than a good one.

use drape::error::Kind;
use drape::texture::{MAX_SIDE, MAX_TEXELS, Texture};

/// Most texels of a picture that is decoded here. Larger ones, up to what is allowed, only take time.
const MOST_TEXELS: u64 = 1 << 20;

/// Most bytes that decoding may hold at once where a picture has no more than [`MOST_TEXELS`], or is refused for its
/// size: 16 for a texel, those of the decoder, and what a chunk of a small file unpacks to.
const MOST_BYTES: u64 = 64 << 20;

/// Decodes the bytes as a texture.
pub(crate) fn run(bytes: &[u8]) {
    if sizes(bytes).any(|[width, height]| is_slow(width, height)) {
        return;
    }
    let mut decoded = None;
    let memory = allocation_counter::measure(|| decoded = Some(Texture::decode("picture", bytes)));
    assert!(memory.bytes_max <= MOST_BYTES, "{memory:?}");
    match decoded.expect("it was decoded") {
        Ok(texture) => {
            let (width, height) = (texture.width(), texture.height());
            assert_eq!(texture.texels().len(), width * height);
            assert!(width.max(height) <= MAX_SIDE as usize && width.min(height) > 0);
            let unit = |channel: &f32| (0.0..=1.0).contains(channel);
            assert!(texture.texels().iter().all(|texel| texel[..3].iter().all(unit) && texel[3] == 1.0));
            assert_eq!(texture.red().len(), width * height);
        }
        Err(error) => assert_eq!(error.kind, Kind::Scene, "{error:?}"),
    }
}

/// Whether a picture is allowed, but too large to be decoded here.
fn is_slow(width: u64, height: u64) -> bool {
    (MOST_TEXELS + 1..=MAX_TEXELS).contains(&(width * height))
}

/// Every width and height that a header in the bytes may give: that of a PNG, and of each frame of a JPEG.
fn sizes(bytes: &[u8]) -> impl Iterator<Item = [u64; 2]> {
    let number = |bytes: &[u8]| bytes.iter().fold(0, |number, &byte| number << 8 | u64::from(byte));
    let png = bytes.get(16..24).map(|size| [number(&size[..4]), number(&size[4..])]);
    let frames = bytes.windows(9).filter(|window| window[0] == 0xFF && window[1] & 0xF0 == 0xC0);
    frames.map(move |window| [number(&window[7..9]), number(&window[5..7])]).chain(png)
}
