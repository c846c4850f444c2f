//! The pictures as functions of place. Only + - × ÷, square roots and `drape::math`.

mod bridge;
mod color;
mod environment;
mod grid;
mod landscape;
mod mask;
mod noise;
mod plaid;
mod stone;
mod street;
mod sunset;

use rayon::prelude::*;

use color::{Color, to_bytes};

/// Texels along each side of every picture.
pub(crate) const SIZE: usize = 512;

/// `SIZE` × `SIZE` texels of RGB, row by row from the top.
pub(crate) type Picture = Vec<[u8; 3]>;

/// All pictures with their names.
pub(crate) fn all() -> Vec<(&'static str, Picture)> {
    let mut pictures = vec![
        ("texture_1", sunset::paint()),
        ("texture_2", stone::paint()),
        ("texture_3", plaid::paint()),
        ("texture_4", grid::paint()),
    ];
    pictures.extend(environment::paint());
    pictures
}

/// Paints each texel with the colour of its middle (u, v) in 0..1, v downward.
fn paint(color: impl Fn(f64, f64) -> Color + Sync) -> Picture {
    let texel = |index: usize| {
        let middle = |i: usize| (i as f64 + 0.5) / SIZE as f64;
        to_bytes(color(middle(index % SIZE), middle(index / SIZE)))
    };
    (0..SIZE * SIZE).into_par_iter().map(texel).collect()
}
