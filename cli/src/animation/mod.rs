//! Animations: the pictures of a scene in motion, in one file or in a PNG file each.
//!
//! A format of one file is a file of this folder and a row of [`target::FORMATS`].

pub(crate) mod schedule;
pub(crate) mod format;
pub(crate) mod changes;
pub(crate) mod seen;
pub(crate) mod apng;
pub(crate) mod palette;
pub(crate) mod reduced;
pub(crate) mod comment;
pub(crate) mod gif;
pub(crate) mod mp4;
pub(crate) mod pattern;
pub(crate) mod sequence;
pub(crate) mod target;
pub(crate) mod pipeline;
pub(crate) mod reel;
