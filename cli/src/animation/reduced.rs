//! Pictures as a GIF shows them: of each the part that changes, in at most 256 colours.

use super::changes::{Changes, Rectangle};
use super::palette::Palette;

/// A picture of a GIF.
pub(crate) struct Patch {
    /// The part that changes.
    pub(crate) rectangle: Rectangle,
    /// Red, green and blue of each colour.
    pub(crate) palette: Vec<u8>,
    /// The number of each pixel's colour.
    pub(crate) indices: Vec<u8>,
}

/// Picture after picture, and what is seen of each.
pub(crate) struct Reduced {
    changes: Changes,
    row: usize,
    seen: Vec<u8>,
}

impl Reduced {
    /// For pictures of `width` pixels a row.
    pub(crate) fn new(width: u32) -> Self {
        Self { changes: Changes::new(width), row: 3 * width as usize, seen: Vec::new() }
    }

    /// The next picture, three bytes a pixel.
    pub(crate) fn next(&mut self, rgb: &[u8]) -> Patch {
        let (rectangle, pixels) = self.changes.next(rgb);
        let (palette, indices) = Palette::of(&pixels);
        let palette = palette.into_bytes();
        self.seen.resize(rgb.len(), 0);
        let Rectangle { left, top, width, height } = rectangle;
        let rows = self.seen.chunks_exact_mut(self.row).skip(top).take(height);
        for (row, indices) in rows.zip(indices.chunks_exact(width)) {
            let pixels = row[3 * left..].as_chunks_mut::<3>().0;
            for (pixel, &index) in pixels.iter_mut().zip(indices) {
                *pixel = palette.as_chunks::<3>().0[usize::from(index)];
            }
        }
        Patch { rectangle, palette, indices }
    }

    /// What is seen of the last picture, three bytes a pixel.
    pub(crate) fn seen(&self) -> &[u8] {
        &self.seen
    }
}
