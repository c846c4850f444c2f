//! A simulation as users run it: checked at its start, and what is measured on the way.

mod stability;
pub mod start;
pub mod table;
pub mod warning;
