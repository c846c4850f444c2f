//! What is doubtful about a run.

/// Something that a run was not refused for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// What it is.
    pub message: String,
    /// What to try.
    pub help: String,
}
