//! What leaves the engine.

mod comparator;
