//! What every measurement of accuracy stands on: the scene with the changes of a run, a run that is timed and whose work
//! is counted, and the distance of two states of a cloth.

pub mod source;
pub mod measure;
pub mod run;
