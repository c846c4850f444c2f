//! Binning: which primitives of a chunk may touch a tile, in submission order.

use super::{setup::Bounds, tiling::tile_of};

/// The primitives of a chunk by tile. Only the rectangle of tiles that the chunk touches is kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Bins {
    /// First column and row of tiles that are touched.
    first: [usize; 2],
    /// Columns and rows of tiles from there.
    size: [usize; 2],
    /// Per tile, row by row, where its primitives start in `entries`; one more at the end.
    offsets: Vec<u32>,
    entries: Vec<u32>,
}

impl Bins {
    /// Sorts primitives with these bounds into the tiles that they touch, keeping their order. What the bins held
    /// does not matter; their memory is used.
    pub(super) fn set(&mut self, bounds: impl ExactSizeIterator<Item = Bounds> + Clone) {
        self.set_around(bounds.clone());
        for bounds in bounds.clone() {
            self.touched(bounds, |bins, tile| bins.offsets[tile + 2] += 1);
        }
        for tile in 2..self.offsets.len() {
            self.offsets[tile] += self.offsets[tile - 1];
        }
        self.entries.resize(self.offsets.last().map_or(0, |&last| last as usize), 0);
        for (i, bounds) in (0..).zip(bounds) {
            // Entry t + 1 runs from the start of tile t up to its end, where tile t + 1 starts.
            self.touched(bounds, |bins, tile| {
                let next = &mut bins.offsets[tile + 1];
                bins.entries[*next as usize] = i;
                *next += 1;
            });
        }
    }

    /// No primitives yet, in the rectangle of tiles that these bounds touch.
    fn set_around(&mut self, bounds: impl ExactSizeIterator<Item = Bounds>) {
        self.offsets.clear();
        self.size = [0; 2];
        if bounds.len() == 0 {
            return;
        }
        let (mut first, mut last) = ([u16::MAX; 2], [0; 2]);
        for Bounds { x, y } in bounds {
            first = [first[0].min(x[0]), first[1].min(y[0])];
            last = [last[0].max(x[1]), last[1].max(y[1])];
        }
        let [first, last] = [first, last].map(tile_of);
        self.first = first;
        self.size = [last[0] + 1 - first[0], last[1] + 1 - first[1]];
        self.offsets.resize(self.size[0] * self.size[1] + 2, 0);
    }

    /// Calls `visit` with the number of every tile that bounds touch.
    fn touched(&mut self, Bounds { x, y }: Bounds, mut visit: impl FnMut(&mut Self, usize)) {
        let (first, last) = (tile_of([x[0], y[0]]), tile_of([x[1], y[1]]));
        for row in first[1]..=last[1] {
            for column in first[0]..=last[0] {
                visit(self, (row - self.first[1]) * self.size[0] + column - self.first[0]);
            }
        }
    }

    /// The primitives that may touch the tile in this column and row of tiles.
    pub(super) fn in_tile(&self, [column, row]: [usize; 2]) -> &[u32] {
        let (x, y) = (column.wrapping_sub(self.first[0]), row.wrapping_sub(self.first[1]));
        if x >= self.size[0] || y >= self.size[1] {
            return &[];
        }
        let tile = y * self.size[0] + x;
        &self.entries[self.offsets[tile] as usize..self.offsets[tile + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{math::splitmix64, raster::tiling::TILE};

    /// Bounds somewhere in a picture of 1000 × 1000 pixels, from a pixel to half the picture.
    fn any_bounds(i: u64) -> Bounds {
        let range = |k: u64| {
            let bits = splitmix64(2 * i + k);
            let first = bits % 1000;
            let last = (first + (bits >> 32) % (1 << (bits >> 16 & 7)) * 4).min(999);
            [first, last].map(|p| u16::try_from(p).unwrap())
        };
        Bounds { x: range(0), y: range(1) }
    }

    #[test]
    fn a_tile_lists_what_touches_it_in_order() {
        let mut bins = Bins::default();
        for count in [0, 1, 2, 500, 50, 0] {
            let all: Vec<Bounds> = (0..count).map(|i| any_bounds(1000 * count + i)).collect();
            bins.set(all.iter().copied());
            for (column, row) in (0..17).flat_map(|row| (0..17).map(move |column| (column, row))) {
                let meets = |[first, last]: [u16; 2], tile: usize| {
                    usize::from(first) < (tile + 1) * TILE && usize::from(last) >= tile * TILE
                };
                let touching: Vec<u32> = (0..)
                    .zip(&all)
                    .filter(|(_, b)| meets(b.x, column) && meets(b.y, row))
                    .map(|(i, _)| i)
                    .collect();
                assert_eq!(bins.in_tile([column, row]), touching, "{count}: {column}, {row}");
            }
        }
    }
}
