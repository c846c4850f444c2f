//! Where the reader is while it builds a document's tree.

use super::words::join;

/// The way from the top of a document to a value; a list on the call stack.
pub(super) struct Path<'a> {
    parent: Option<&'a Self>,
    step: Step<'a>,
    pub(super) level: usize,
}

/// One step of the way.
#[derive(Clone, Copy)]
pub(super) enum Step<'a> {
    Name(&'a str),
    Number(usize),
}

impl<'a> Path<'a> {
    /// The document itself.
    pub(super) const ROOT: Self = Self { parent: None, step: Step::Number(0), level: 0 };

    /// The way one step further.
    pub(super) fn then(&'a self, step: Step<'a>) -> Self {
        Self { parent: Some(self), step, level: self.level + 1 }
    }

    /// The way as errors and `--set` write it: `cloth.pinned.0`.
    pub(super) fn dotted(&self) -> String {
        let Some(parent) = self.parent else { return String::new() };
        match self.step {
            Step::Name(name) => join(&parent.dotted(), name),
            Step::Number(number) => join(&parent.dotted(), &number.to_string()),
        }
    }
}
