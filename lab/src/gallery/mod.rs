//! The figures of the report: a table of pictures, the simulations that they share, and the page
//! that shows them.

mod facts;
pub mod page;
pub mod shot;
pub mod table;
