//! The name of an output that is one file.

use clap::builder::{PathBufValueParser, TypedValueParser};

use crate::session::files::numbered::one;

/// Parses the name of one file, in which `%%` is a percent sign.
pub(crate) fn output() -> impl TypedValueParser {
    PathBufValueParser::new().try_map(|path| one(&path).map_err(|e| format!("{}; {}", e.message, e.help)))
}
