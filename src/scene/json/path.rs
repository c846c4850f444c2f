//! Where the reader is while it builds a document's tree.

use super::text::join;

/// The way from the top of a document to a value; a list on the call stack.
pub(crate) struct Path<'a> {
    parent: Option<&'a Self>,
    step: Step<'a>,
    pub(crate) level: usize,
}

/// One step of the way.
#[derive(Clone, Copy)]
pub(crate) enum Step<'a> {
    Name(&'a str),
    Number(usize),
}

impl<'a> Path<'a> {
    /// The document itself.
    pub(crate) const ROOT: Self = Self { parent: None, step: Step::Number(0), level: 0 };

    /// The way one step further.
    pub(crate) fn then(&'a self, step: Step<'a>) -> Self {
        Self { parent: Some(self), step, level: self.level + 1 }
    }

    /// The way as errors and `--set` write it: `cloth.pinned.0`.
    pub(crate) fn dotted(&self) -> String {
        let Some(parent) = self.parent else { return String::new() };
        match self.step {
            Step::Name(name) => join(&parent.dotted(), name),
            Step::Number(number) => join(&parent.dotted(), &number.to_string()),
        }
    }
}
