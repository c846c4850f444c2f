//! What is measured of a cloth: energies, extremes, rest, and whether its step is stable.

pub mod advice;
pub mod energy;
pub(crate) mod energy_bound;
pub mod extremes;
pub mod geometry;
pub mod ledger;
pub mod memory;
pub mod rest;
pub mod stability;
