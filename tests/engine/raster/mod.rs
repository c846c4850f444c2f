//! The rasteriser: what is covered, what is seen, what is interpolated.

mod clipping;
mod coverage;
mod extremes;
mod interpolation;
mod lines;
mod quantisation;
mod samples;
mod visibility;
mod whole_tiles;
