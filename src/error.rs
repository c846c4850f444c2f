//! The one error type. Every error says what happened, where, what is allowed and what to try,
//! and knows the exit code of the command line (see [`Kind`]).

use std::fmt;

/// What kind of failure an [`Error`] is. Each kind has one process exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A comparison or check found a difference: exit code 1.
    Difference,
    /// The command line makes no sense: exit code 2.
    Usage,
    /// A scene or texture is invalid: exit code 3.
    Scene,
    /// There is nothing to do, or a golden is missing: exit code 4.
    Nothing,
    /// The simulation is unstable or has diverged: exit code 5.
    Unstable,
    /// Input or output failed, or an outside tool is missing: exit code 6.
    Io,
    /// A limit of time or memory that the user has set was reached: exit code 6.
    Limit,
    /// A fault of this program: exit code 70.
    Internal,
    /// Stopped by signal number N: exit code 128 + N (130 for Ctrl-C, 143 for SIGTERM).
    Signal(u8),
}

impl Kind {
    /// The process exit code of this kind.
    pub fn exit_code(self) -> u8 {
        match self {
            Self::Difference => 1,
            Self::Usage => 2,
            Self::Scene => 3,
            Self::Nothing => 4,
            Self::Unstable => 5,
            Self::Io | Self::Limit => 6,
            Self::Internal => 70,
            Self::Signal(number) => 128_u8.saturating_add(number),
        }
    }
}

/// One thing that is wrong in an input file, with the place where it stands.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Diagnostic {
    /// Stable identifier such as `scene::unknown_key`.
    pub code: &'static str,
    /// What is wrong, one sentence without a full stop.
    pub message: String,
    /// File name as given (of the scene or of a patch), or `--set PATH=JSON`.
    pub file: String,
    /// One-based line; 0 when there is no place in a text.
    pub line: usize,
    /// One-based column, counted in characters; 0 when there is no place in a text.
    pub column: usize,
    /// Dotted path of the key, such as `cloth.ks`; empty when there is none.
    pub key: String,
    /// What to try; empty when there is nothing to suggest.
    pub help: String,
    /// The message drawn for people: the line of the file with a caret under the place.
    #[serde(skip)]
    pub rendered: String,
}

/// What failed, for people and for programs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The kind, which decides the exit code.
    pub kind: Kind,
    /// What happened: one line, with the value found and what is allowed.
    pub message: String,
    /// What to try next; may be empty.
    pub help: String,
    /// Everything that is wrong in an input file; empty for other errors.
    pub diagnostics: Vec<Diagnostic>,
}

/// `std::result::Result` with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

impl Error {
    /// An error of `kind` that says `message`.
    pub fn new(kind: Kind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into(), help: String::new(), diagnostics: Vec::new() }
    }

    /// The same error with a hint.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }

    /// The error of a scene file in which `diagnostics` were found (at least one).
    pub fn scene(diagnostics: Vec<Diagnostic>) -> Self {
        let message = match diagnostics.as_slice() {
            [one] => format!("{}:{}:{}: {}", one.file, one.line, one.column, one.message),
            many => format!("{} errors in the scene", many.len()),
        };
        Self { kind: Kind::Scene, message, help: String::new(), diagnostics }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        if !self.help.is_empty() {
            write!(f, "; {}", self.help)?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}
