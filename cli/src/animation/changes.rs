//! The part of a picture that differs from the picture before it.

/// Bytes of a row that are compared at once.
const BLOCK: usize = 64;

/// A rectangle of pixels, at least one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rectangle {
    pub(crate) left: usize,
    pub(crate) top: usize,
    pub(crate) width: usize,
    pub(crate) height: usize,
}

/// The part of each picture that differs from the one before.
#[derive(Debug)]
pub(crate) struct Changes {
    row: usize,
    before: Vec<u8>,
}

impl Changes {
    /// For pictures of `width` pixels a row.
    pub(crate) fn new(width: u32) -> Self {
        Self { row: 3 * width as usize, before: Vec::new() }
    }

    /// The smallest rectangle outside of which `rgb` is as the picture before, and its pixels: the
    /// whole picture at first, one pixel if nothing changes.
    pub(crate) fn next(&mut self, rgb: &[u8]) -> (Rectangle, Vec<u8>) {
        let rectangle = if self.before.is_empty() { self.whole(rgb) } else { self.changed(rgb) };
        self.before.clear();
        self.before.extend_from_slice(rgb);
        let Rectangle { left, top, width, height } = rectangle;
        let rows = rgb.chunks_exact(self.row).skip(top).take(height);
        let parts: Vec<&[u8]> = rows.map(|row| &row[3 * left..3 * (left + width)]).collect();
        (rectangle, parts.concat())
    }

    fn whole(&self, rgb: &[u8]) -> Rectangle {
        Rectangle { left: 0, top: 0, width: self.row / 3, height: rgb.len() / self.row }
    }

    fn changed(&self, rgb: &[u8]) -> Rectangle {
        let rows = self.before.chunks_exact(self.row).zip(rgb.chunks_exact(self.row)).enumerate();
        let mut found: Option<[usize; 4]> = None;
        for (y, (before, now)) in rows.filter(|(_, (before, now))| before != now) {
            let [first, last] = differing_bytes(before, now);
            let [top, _, left, right] = found.unwrap_or([y, y, first, last]);
            found = Some([top, y, left.min(first), right.max(last)]);
        }
        let [top, bottom, left, right] = found.unwrap_or_default();
        let (left, right) = (left / 3, right / 3);
        Rectangle { left, top, width: right - left + 1, height: bottom - top + 1 }
    }
}

/// The first and the last byte in which two rows differ. Blocks are compared first, which is much faster than byte by byte.
fn differing_bytes(before: &[u8], now: &[u8]) -> [usize; 2] {
    let blocks = || before.chunks(BLOCK).zip(now.chunks(BLOCK));
    let bytes = |block: usize| {
        let end = before.len().min((block + 1) * BLOCK);
        (block * BLOCK..end).zip(&before[block * BLOCK..end]).zip(&now[block * BLOCK..end])
    };
    let first = blocks().position(|(before, now)| before != now).unwrap_or(0);
    let last = blocks().rposition(|(before, now)| before != now).unwrap_or(0);
    let differs = |((at, before), now): ((usize, &u8), &u8)| (before != now).then_some(at);
    [bytes(first).find_map(differs).unwrap_or(0), bytes(last).rev().find_map(differs).unwrap_or(0)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn pasting_the_changes_gives_every_picture_and_no_smaller_rectangle_would(
            (width, height) in (1_usize..50, 1_usize..6), seed in any::<u64>(),
        ) {
            let mut changes = Changes::new(u32::try_from(width).unwrap());
            let mut canvas = vec![0; 3 * width * height];
            for k in 0..6 {
                // Few pixels differ from black, and of those one channel; rows are longer than a block.
                let random = |i: usize| drape::math::splitmix64(seed ^ (i as u64 + 1000 * k));
                let picture: Vec<u8> = (0..canvas.len()).map(|i| u8::from(random(i) % 40 == 0)).collect();
                let old = canvas.clone();
                let (rectangle, pixels) = changes.next(&picture);
                let Rectangle { left, top, width: w, height: h } = rectangle;
                for (y, row) in pixels.chunks_exact(3 * w).enumerate() {
                    let at = 3 * ((top + y) * width + left);
                    canvas[at..at + row.len()].copy_from_slice(row);
                }
                prop_assert_eq!(pixels.len(), 3 * w * h);
                prop_assert_eq!(&canvas, &picture);
                let differs = |x: usize, y: usize| {
                    let at = 3 * (y * width + x);
                    old[at..at + 3] != picture[at..at + 3]
                };
                if k > 0 && old != picture {
                    prop_assert!((top..top + h).any(|y| differs(left, y)) && (top..top + h).any(|y| differs(left + w - 1, y)));
                    prop_assert!((left..left + w).any(|x| differs(x, top)) && (left..left + w).any(|x| differs(x, top + h - 1)));
                }
            }
        }
    }
}
