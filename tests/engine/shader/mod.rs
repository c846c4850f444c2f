//! The programs against their GLSL and their formulas.

mod cube_sampling;
mod glsl;
mod height_maps;
mod relief;
mod sampling;
mod shading;
