//! The grammar of the command line.

use std::io::{self, IsTerminal};

use clap::builder::RangedU64ValueParser;
use clap::error::ErrorKind;
use clap::{Parser, Subcommand};

use super::compare;
use super::ui::{self, Color, Ui};
use crate::error::{Error, Kind, Result};
use crate::output::atomic;

/// A reference cloth simulator and the software rasteriser that shows it.
#[derive(Parser)]
#[command(name = "drape", version, max_term_width = 100, disable_help_subcommand = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
    /// Threads to use, 1 to 1024 (default: all cores); the results are the same bytes for every number
    #[arg(long, global = true, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=1024))]
    threads: Option<usize>,
    /// Errors only on standard error
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Say what is done and how long it took
    #[arg(short, long, global = true)]
    verbose: bool,
    /// When to colour messages
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    color: Color,
    /// Print the result as one JSON object, and errors as JSON on standard error
    #[arg(long, global = true)]
    json: bool,
}

/// What to do.
#[derive(Subcommand)]
pub(super) enum Command {
    /// Tell how two pictures, or the pictures of two folders, differ
    Compare(compare::Args),
}

impl Arguments {
    /// How to speak on standard error.
    pub(super) fn ui(&self) -> Ui {
        let color = self.color.applies(ui::stderr_is_terminal());
        Ui { json: self.json, quiet: self.quiet, verbose: self.verbose, color }
    }

    /// The number of threads; 0 stands for all cores.
    pub(super) fn threads(&self) -> usize {
        self.threads.unwrap_or(0)
    }
}

/// What to make of arguments that name no command: help and version go to standard output,
/// anything else is an error of use.
pub(super) fn refuse(refusal: &clap::Error) -> Result<()> {
    if matches!(refusal.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        let text = refusal.render();
        let colored = Color::Auto.applies(io::stdout().is_terminal());
        return atomic::write_stdout(
            if colored { text.ansi().to_string() } else { text.to_string() }.as_bytes(),
        );
    }
    let text = refusal.render().to_string();
    let (message, rest) = text.split_once("\n\n").unwrap_or((&text, ""));
    let message = message.strip_prefix("error: ").unwrap_or(message);
    Err(Error::new(Kind::Usage, message.trim()).with_help(rest.trim()))
}
