//! Self-contained web pages, and the plots, tables and pictures on them.

mod html;
pub mod axis;
pub mod comparison;
pub mod live;
pub mod plot;

pub use html::{Cells, END, escape, head, image, short, table};
