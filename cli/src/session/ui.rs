//! Messages on standard error: notes, warnings, errors.

use std::io::{self, IsTerminal, Write};

use drape::error::{Diagnostic, Error, Kind};
use drape_lab::printable;

/// When to use colours (`--color`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Color {
    /// On a terminal, if the variable `NO_COLOR` is not set.
    Auto,
    /// On everything.
    Always,
    /// On nothing.
    Never,
}

impl Color {
    /// Whether a stream gets colours.
    pub(crate) fn applies(self, is_terminal: bool) -> bool {
        match self {
            Self::Always => true,
            Self::Never => false,
            Self::Auto => is_terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
        }
    }
}

/// What is printed on standard error, and how.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ui {
    /// Errors and warnings as one JSON object a line.
    pub(crate) json: bool,
    /// Errors only.
    pub(crate) quiet: bool,
    /// Remarks too.
    pub(crate) verbose: bool,
    /// When to use colours.
    pub(crate) color: Color,
}

impl Ui {
    /// The settings before the arguments are parsed: only whether `--json` is among them is known.
    pub(crate) fn before_parsing(json: bool) -> Self {
        Self { json, quiet: false, verbose: false, color: Color::Auto }
    }

    /// Prints a line only with `-v`.
    pub(crate) fn remark(&self, text: &str) {
        if self.verbose && !self.json {
            line(&printable::lines(text));
        }
    }

    /// Prints a line, unless with `-q`.
    pub(crate) fn note(&self, text: &str) {
        if !self.quiet && !self.json {
            line(&printable::line(text));
        }
    }

    /// Prints a text of several lines, unless with `-q`.
    pub(crate) fn text(&self, text: &str) {
        if !self.quiet && !self.json {
            line(&printable::lines(text));
        }
    }

    /// Prints a warning about a scene, unless with `-q`.
    pub(crate) fn warn(&self, warning: &Diagnostic) {
        if self.quiet {
        } else if self.json {
            line(&printable::json(&serde_json::json!({ "warning": warning }).to_string()));
        } else {
            line(&self.paint(&warning.rendered));
        }
    }

    /// Prints a warning that belongs to no place in a file, unless with `-q` or `--json`.
    pub(crate) fn caution(&self, message: &str, help: &str) {
        if !self.quiet && !self.json {
            line(&self.paint(&format!("warning: {}{}", printable::line(message), help_lines(help))));
        }
    }

    /// Prints an error.
    pub(crate) fn error(&self, error: &Error) {
        line(&if self.json { printable::json(&json(error)) } else { self.pretty(error) });
    }

    /// Whether progress is shown.
    pub(crate) fn shows_progress(&self) -> bool {
        !self.quiet && !self.json
    }

    fn pretty(&self, error: &Error) -> String {
        let mut blocks: Vec<_> = error.diagnostics.iter().map(|d| self.paint(&d.rendered)).collect();
        // The number of errors is added only where there are several.
        if blocks.len() != 1 {
            blocks.push(self.paint(&format!("error: {}", printable::line(&error.message))));
        }
        blocks.join("\n\n") + &printable::lines(&help_lines(&error.help))
    }

    fn paint(&self, text: &str) -> String {
        paint(text, self.color.applies(stderr_is_terminal()))
    }
}

/// The lines that follow a message and say what to do; nothing for an empty `help`.
pub(crate) fn help_lines(help: &str) -> String {
    if help.is_empty() {
        String::new()
    } else {
        format!("\n  = help: {}", help.replace('\n', "\n          "))
    }
}

/// A message of which a terminal only shows the text; the word before the first colon is coloured, if `colored`.
pub(crate) fn paint(text: &str, colored: bool) -> String {
    let text = printable::lines(text);
    match text.split_once(':') {
        Some((word, rest)) if colored => {
            let color = if word.starts_with("error") { "\x1b[1;31m" } else { "\x1b[1;33m" };
            format!("{color}{word}\x1b[0m:{rest}")
        }
        _ => text,
    }
}

/// Writes a line to standard error. A failure to do so cannot be reported anywhere.
fn line(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Whether standard error is a terminal.
pub(crate) fn stderr_is_terminal() -> bool {
    io::stderr().is_terminal()
}

fn json(error: &Error) -> String {
    serde_json::json!({
        "error": error.message,
        "kind": kind_name(error.kind),
        "exit_code": error.kind.exit_code(),
        "help": error.help,
        "diagnostics": error.diagnostics,
    })
    .to_string()
}

fn kind_name(kind: Kind) -> &'static str {
    match kind {
        Kind::Difference => "difference",
        Kind::Usage => "usage",
        Kind::Scene => "scene",
        Kind::Nothing => "nothing",
        Kind::Unstable => "unstable",
        Kind::Io => "io",
        Kind::Limit => "limit",
        Kind::Internal => "internal",
        Kind::Signal(_) => "signal",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: Ui = Ui { json: false, quiet: false, verbose: false, color: Color::Never };

    fn diagnostic(message: &str) -> Diagnostic {
        Diagnostic {
            code: "scene::unknown_key",
            message: message.to_owned(),
            file: "a.json".to_owned(),
            line: 2,
            column: 3,
            key: "cloth".to_owned(),
            help: String::new(),
            rendered: format!("error[scene::unknown_key]: {message}\n --> a.json:2:3"),
        }
    }

    #[test]
    fn one_diagnostic_stands_alone_and_several_are_counted() {
        let one = PLAIN.pretty(&Error::scene(vec![diagnostic("x")]));
        assert_eq!(one, "error[scene::unknown_key]: x\n --> a.json:2:3");
        let two = PLAIN.pretty(&Error::scene(vec![diagnostic("x"), diagnostic("y")]));
        assert!(two.contains("]: x\n") && two.contains("]: y\n"), "{two}");
        assert!(two.ends_with("\n\nerror: 2 errors in the scene"), "{two}");
    }

    #[test]
    fn an_error_shows_its_help_and_colour_only_when_asked() {
        let error = Error::new(Kind::Io, "no: luck").with_help("try again");
        assert_eq!(PLAIN.pretty(&error), "error: no: luck\n  = help: try again");
        let colored = Ui { color: Color::Always, ..PLAIN }.pretty(&error);
        assert_eq!(colored, "\x1b[1;31merror\x1b[0m: no: luck\n  = help: try again");
        assert_eq!(paint("warning[x]: y", true), "\x1b[1;33mwarning[x]\x1b[0m: y");
    }

    #[test]
    fn json_errors_carry_everything() {
        let error = Error::scene(vec![diagnostic("x \"y\"\n")]);
        let text = json(&error);
        assert_eq!(text.lines().count(), 1);
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["exit_code"], 3);
        assert_eq!(value["kind"], "scene");
        assert_eq!(value["diagnostics"][0]["line"], 2);
        assert_eq!(value["diagnostics"][0]["message"], "x \"y\"\n");
    }

    #[test]
    fn colour_follows_the_flag_before_the_terminal() {
        assert!(Color::Always.applies(false));
        assert!(!Color::Never.applies(true));
        assert!(!Color::Auto.applies(false));
    }
}
