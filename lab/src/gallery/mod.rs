//! The figures of the report: a table of pictures, the simulations that they share, and the page
//! that shows them.

pub mod table;
pub mod shot;
pub mod reel;
mod facts;
pub mod page;
