//! The grader: compares the positions of another program with those of the method, and looks for the
//! cause of a difference.
//!
//! It knows mistakes that programs make, runs each of them, and reports the one that comes nearest to the
//! other program's positions.

mod watch;
mod states;
mod precision;
mod case;
mod divergence;
mod plain;
mod mistakes;
mod numbers;
mod pair;
mod trials;
mod chaos;
mod verdict;
mod comparison;

pub use case::{Case, Ours};
pub use comparison::Comparison;
pub use divergence::{Difference, start_of};
pub use pair::Pair;
pub use states::{Numbers, State, read, read_numbers};
pub use trials::Tried;
pub use watch::{Event, Watch};
