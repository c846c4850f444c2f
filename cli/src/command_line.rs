//! The grammar of the command line.

use std::io::{self, IsTerminal};

use clap::builder::RangedU64ValueParser;
use clap::error::ErrorKind;
use clap::{Parser, Subcommand};

use crate::commands::{
    animate, check, compare, compare_positions, export, gallery, info, meta, render, simulate, stability,
    study,
};
use crate::session::files::atomic;
use crate::session::ui::{Color, Ui};
use drape::error::{Error, Kind, Result};

/// A reference cloth simulator and the software rasteriser that shows it.
#[derive(Parser)]
#[command(name = "drape", version, max_term_width = 100, after_long_help = EXIT_CODES)]
pub(crate) struct CommandLine {
    #[command(subcommand)]
    pub(crate) command: Command,
    #[command(flatten, next_help_heading = "Global options")]
    global: Global,
}

/// What a command's end says to scripts.
const EXIT_CODES: &str = "Exit codes: 0 ok, 1 a difference was found, 2 usage, 3 scene or texture invalid, \
    4 nothing to do, 5 simulation unstable, 6 input or output, 70 internal error, 130 and 143 stopped by a signal.";

/// What holds for every command.
#[derive(clap::Args)]
struct Global {
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
pub(crate) enum Command {
    /// Simulate a scene and draw one picture of it
    Render(render::Args),
    /// Draw a scene in motion: PNG files, an animated PNG, a GIF or a film
    Animate(animate::Args),
    /// Simulate a scene without drawing it
    Simulate(simulate::Args),
    /// Write the simulated cloth as a mesh (OBJ)
    Export(export::Args),
    /// Tell how two pictures, or the pictures of two folders, differ
    Compare(compare::Args),
    /// Tell where the positions of another program part from the method, and by which mistake
    ComparePositions(compare_positions::Args),
    /// Measure speed against accuracy: methods and steps against a reference, ways of drawing
    ///
    /// It compares the start of the motion alone, at 0.1, 0.2 and 0.5 s (--quick: 0.1 and 0.2 s), with damping per
    /// second and without stretch limit and self-collision, whatever the scene says. Besides the scene's cloth it tries
    /// cloths of 1/1000 and 1/100000 of its density (--quick: 1/1000), which are harder to simulate.
    Study(study::Args),
    /// Tell what a scene needs and what is therefore left out
    Info(info::Args),
    /// Tell everything that is wrong in scene files
    Check(check::Args),
    /// Map where a cloth is stable, over stiffness, density and step
    Stability(stability::Args),
    /// Make every figure of the report, and a page of them
    Gallery(gallery::Args),
    /// Print the JSON schema of scene files: every key with its meaning, default and range
    Schema,
    /// Print the script that completes this program's commands and options in a shell
    Completions(meta::CompletionsArgs),
    /// Print the manual page of this program or of a command
    Man(meta::ManArgs),
}

impl CommandLine {
    /// How to speak on standard error.
    pub(crate) fn ui(&self) -> Ui {
        Ui {
            json: self.global.json,
            quiet: self.global.quiet,
            verbose: self.global.verbose,
            color: self.global.color,
        }
    }

    /// The number of threads; 0 stands for all cores.
    pub(crate) fn threads(&self) -> usize {
        self.global.threads.unwrap_or(0)
    }
}

/// What to make of arguments that name no command: help and version go to standard output,
/// anything else is an error of use. No arguments at all are answered with the help alone.
pub(crate) fn refuse(refusal: &clap::Error, ui: &Ui) -> u8 {
    if refusal.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        ui.note(refusal.render().to_string().trim_end());
        return Kind::Usage.exit_code();
    }
    crate::session::exit_code(ui, refused(refusal))
}

fn refused(refusal: &clap::Error) -> Result<()> {
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
    Err(Error::new(Kind::Usage, message.trim()).with_help(rest.trim().replace("\n\n", "\n")))
}
