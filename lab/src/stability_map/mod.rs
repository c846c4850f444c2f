//! The stability map: the outcome of runs over stiffness, density and step, compared with the bounds
//! that theory gives.

pub mod range;
pub mod outcome;
pub mod threshold;
mod map;
mod legend;
mod panel;
pub mod extremes;
pub mod page;

pub use map::{Axes, Cell, Column, Map};
