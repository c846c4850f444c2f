//! Where a picture is made: colour and depth per pixel, kept tile by tile so
//! that each tile is one disjoint piece of memory for one thread.

use std::borrow::Cow;

use rayon::prelude::*;

use super::{
    assemble::Chunk,
    depth::DepthPlane,
    handle::Handle,
    scratch::Scratch,
    tiling::{TILE, TILE_PIXELS},
    vertex::VertexBuffer,
};
use crate::mesh::Mesh;

/// A picture in the making, with depth and visibility per sample.
#[derive(Clone, Debug)]
pub struct Framebuffer {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) samples: usize,
    pub(super) columns: usize,
    pub(super) tiles: Vec<Tile>,
    /// Of the picture before: nothing but memory, which the next one need not ask for again.
    pub(super) buffers: Vec<VertexBuffer>,
    pub(super) chunks: Vec<Chunk>,
    /// The same, for each thread that draws tiles.
    pub(super) scratch: Vec<Scratch>,
    /// The same, for the mesh of the cloth.
    pub(crate) mesh: Mesh,
}

/// One tile. Pixel (x, y) of the tile is element `y * TILE + x`; buffers with several samples hold
/// all pixels of sample 0 first.
#[derive(Clone, Debug)]
pub(super) struct Tile {
    /// Picture column of the tile's left column.
    pub(super) left: usize,
    /// Picture row of the tile's top row.
    pub(super) top: usize,
    /// Stored colour: red in the lowest byte, green, blue, and alpha, which is always 255.
    pub(super) color: Vec<u32>,
    /// Window depth per sample; 1 where nothing was drawn. Not kept where there is a plane.
    pub(super) depth: Vec<f32>,
    /// Where a triangle covers the tile alone, its depths: they are computed when they are asked for.
    pub(super) plane: Option<DepthPlane>,
    /// While the tile is drawn, the primitive seen per sample; 0 where nothing was drawn. Its memory is the
    /// drawing thread's, so that it stays in the cache.
    pub(super) visible: Vec<Handle>,
    /// Object and triangle per pixel (of sample 0), if asked for.
    pub(super) ids: Vec<u32>,
    /// The colour that the tile was cleared to, if nothing was drawn since.
    pub(super) cleared: Option<u32>,
}

impl Tile {
    /// Column and row of the tile in the picture.
    pub(super) fn position(&self) -> [usize; 2] {
        [self.left / TILE, self.top / TILE]
    }

    /// Clears colour and depth, if anything else is there.
    pub(super) fn clear(&mut self, color: u32) {
        if self.cleared != Some(color) {
            self.color.fill(color);
            self.depth.fill(1.0);
            self.cleared = Some(color);
        }
    }

    /// Clears depth and visibility. Colours wait until it is known where the background is seen.
    #[inline(always)]
    pub(super) fn begin(&mut self) {
        self.depth.fill(1.0);
        // Filled, and not emptied and made longer, which the compiler does not do in vectors.
        self.visible.resize(self.depth.len(), 0);
        self.visible.fill(0);
        self.cleared = None;
    }
}

impl Framebuffer {
    /// A framebuffer of `width` × `height` pixels with `samples` (1, 4, 8 or 16) samples each.
    pub fn new(width: u32, height: u32, samples: u32) -> Self {
        let (width, height, samples) = (width as usize, height as usize, samples as usize);
        let columns = width.div_ceil(TILE);
        let tiles = (0..columns * height.div_ceil(TILE))
            .map(|i| Tile {
                left: i % columns * TILE,
                top: i / columns * TILE,
                color: vec![0; TILE_PIXELS],
                depth: vec![1.0; TILE_PIXELS * samples],
                plane: None,
                visible: Vec::new(),
                ids: Vec::new(),
                cleared: None,
            })
            .collect();
        Self {
            width,
            height,
            samples,
            columns,
            tiles,
            buffers: Vec::new(),
            chunks: Vec::new(),
            scratch: Vec::new(),
            mesh: Mesh::default(),
        }
    }

    /// Stored colours, three bytes a pixel, top row first.
    pub fn rgb(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.width * self.height * 3);
        for row in self.rows(|tile| &tile.color) {
            for color in row {
                let [r, g, b, _] = color.to_le_bytes();
                bytes.extend_from_slice(&[r, g, b]);
            }
        }
        bytes
    }

    /// As [`Framebuffer::rgb`], with 255 after each pixel's blue.
    pub fn rgba(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.width * self.height * 4);
        for row in self.rows(|tile| &tile.color) {
            for color in row {
                let [r, g, b, _] = color.to_le_bytes();
                bytes.extend_from_slice(&[r, g, b, 255]);
            }
        }
        bytes
    }

    /// Window depth in 0..=1 per pixel, top row first: that of the pixel's first sample.
    pub fn depth(&self) -> Vec<f32> {
        let tiles: Vec<Cow<'_, [f32]>> = self.tiles.par_iter().map(|tile| self.depths(tile)).collect();
        let mut depths = Vec::with_capacity(self.width * self.height);
        for y in 0..self.height {
            for (column, tile) in tiles[y / TILE * self.columns..][..self.columns].iter().enumerate() {
                depths.extend_from_slice(&tile[y % TILE * TILE..][..TILE.min(self.width - column * TILE)]);
            }
        }
        depths
    }

    /// The depths of a tile's pixels.
    fn depths<'a>(&self, tile: &'a Tile) -> Cow<'a, [f32]> {
        match &tile.plane {
            Some(plane) => Cow::Owned(plane.depths([tile.left, tile.top], self.height, self.samples)),
            None => Cow::Borrowed(&tile.depth),
        }
    }

    /// Ids per pixel, top row first, of the pixel's first sample; empty if they were not asked for.
    pub fn ids(&self) -> Vec<u32> {
        if self.tiles.iter().all(|tile| tile.ids.is_empty()) {
            return Vec::new();
        }
        self.rows(|tile| &tile.ids).flatten().copied().collect()
    }

    /// The values of one buffer in picture order: a slice for each row of each tile.
    fn rows<'a, T: 'a>(
        &'a self,
        buffer: impl Fn(&'a Tile) -> &'a Vec<T> + Copy,
    ) -> impl Iterator<Item = &'a [T]> {
        (0..self.height).flat_map(move |y| {
            (0..self.columns).map(move |column| {
                let tile = &self.tiles[y / TILE * self.columns + column];
                let row = y % TILE * TILE;
                &buffer(tile)[row..row + TILE.min(self.width - tile.left)]
            })
        })
    }
}
