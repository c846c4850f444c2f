//! The cloth: the method to the bit, its laws, its energy, its cures.

mod cures;
mod energy;
mod energy_bound;
mod laws;
mod method_bits;
mod restless;
mod unresolved;
