//! What the unit tests of documents share.

use super::diagnostic::Diagnostics;
use super::node::Node;
use super::parse::parse;

/// The value that `text` is.
pub(crate) fn node(text: &str) -> Node {
    let mut diagnostics = Diagnostics::default();
    let source = diagnostics.add_source("x.json", text);
    parse(&mut diagnostics, source, 0).unwrap()
}
