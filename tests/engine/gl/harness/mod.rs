//! The OpenGL side of the parity test: Mesa's software driver without a window, the project's own
//! GLSL files, and the same meshes and uniforms as `drape::render` makes, put together here a
//! second time from the public parts.

#![allow(unsafe_code, reason = "OpenGL is a C interface: every call of it is unsafe")]
#![allow(
    clippy::undocumented_unsafe_blocks,
    reason = "one condition holds for all calls here: the context is current on this thread, as long as \
              the `Context` that all other types borrow from is alive"
)]

pub(crate) mod alone;
pub(crate) mod context;
pub(crate) mod device;
pub(crate) mod lines;
pub(crate) mod object;
pub(crate) mod program;
pub(crate) mod target;
pub(crate) mod samples;
pub(crate) mod seams;
pub(crate) mod table;
pub(crate) mod tally;
