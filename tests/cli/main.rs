//! The command line keeps its contract: exit codes, clean standard output, errors that programs
//! can read, and no file left behind by a failure.

mod animate;
mod disk;
mod errors;
mod files;
#[path = "../naive/mod.rs"]
mod naive;
mod positions;
mod results;
mod scratch;
mod signals;
mod simulating;
mod texts;
mod threads;
