//! The grammar of the command line: the commands, and the options of all of them.

use std::io::{self, IsTerminal};
use std::time::Duration;

use clap::builder::RangedU64ValueParser;
use clap::error::ErrorKind;
use clap::{Parser, Subcommand};

use crate::args::limit;
use crate::commands::{
    animate, check, choose, compare, compare_positions, export, gallery, horizon, info, meta, render,
    simulate, stability, study, sweep, verify,
};
use crate::session::files::atomic;
use crate::session::stop::Limits;
use crate::session::ui::{Color, Ui};
use drape::error::{Error, Kind, Result};

/// A reference cloth simulator and software rasteriser: exact, deterministic, on the CPU alone.
#[derive(Parser)]
#[command(name = "drape", version = drape::version::VERSION, max_term_width = 100, after_long_help = EXIT_CODES)]
pub(crate) struct CommandLine {
    #[command(subcommand)]
    pub(crate) command: Command,
    #[command(flatten, next_help_heading = "Global options")]
    global: Global,
}

/// The exit codes, for scripts.
const EXIT_CODES: &str = "Exit codes: 0 success, 1 a comparison or check found a difference, 2 wrong usage, \
    3 a scene or texture is invalid, 4 nothing to do, 5 the simulation is unstable, 6 a file or an external program \
    failed or a limit was reached, 70 internal error, 128 + N stopped by signal N (130 Ctrl-C, 143 SIGTERM).";

/// The options of every command.
#[derive(clap::Args)]
struct Global {
    /// Number of threads, 1 to 1024 (default: all cores). Results have the same bytes for every number
    #[arg(long, global = true, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=1024))]
    threads: Option<usize>,
    /// End after this many seconds with exit code 6; whole files are kept
    #[arg(long, global = true, value_name = "S", value_parser = limit::seconds)]
    time_limit: Option<Duration>,
    /// End with exit code 6 when more memory is in use, such as 500M or 2G; whole files are kept
    #[arg(long, global = true, value_name = "SIZE", value_parser = limit::bytes)]
    memory_limit: Option<u64>,
    /// Print only errors on standard error
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Print more on standard error, such as how long the simulation took
    #[arg(short, long, global = true)]
    verbose: bool,
    /// When to print colours
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    color: Color,
    /// Print the result as one JSON object, and errors as JSON on standard error
    #[arg(long, global = true)]
    json: bool,
}

/// The commands.
#[derive(Subcommand)]
pub(crate) enum Command {
    /// Simulate a scene and draw one picture of it
    Render(render::Args),
    /// Draw a scene in motion, as an animation or as numbered pictures
    Animate(animate::Args),
    /// Simulate a scene without drawing it
    Simulate(simulate::Args),
    /// Simulate a scene and write the cloth as a mesh (OBJ)
    Export(export::Args),
    /// Compare two pictures, or the pictures of two folders
    Compare(compare::Args),
    /// Compare positions computed by another program with ours, and find the mistake that explains a difference
    ComparePositions(compare_positions::Args),
    /// Measure cost against accuracy: integrators and steps against a reference run, and ways of drawing
    ///
    /// Only the start of the motion is compared: at 0.1, 0.2 and 0.5 s, with --quick at 0.1 and 0.2 s. For this the
    /// scene is changed: damping is per second, and there is no stretch limit and no self-collision. Besides the
    /// cloth of the scene, the study simulates cloths of 1/1000 and 1/100000 of its density (with --quick of 1/1000),
    /// which need more steps.
    Study(study::Args),
    /// Run one scene with many changes, on one machine or on many that share a folder
    Sweep(sweep::Args),
    /// Find the cheapest integrator and steps for an accuracy, or the most accurate for a time
    ///
    /// The error is that of the positions at the moment, against the limit of ever smaller steps of the same scene,
    /// contact and limits included; damping per step, which has no limit, is replaced by damping per second.
    Choose(choose::Args),
    /// Tell for how long positions can be trusted: run a scene beside copies that differ by rounding
    Horizon(horizon::Args),
    /// Make a picture or animation again from what it says of itself, and tell whether it is equal
    Verify(verify::Args),
    /// Show what a scene needs and what it does not, its size in memory, and whether its step is stable
    Info(info::Args),
    /// List every error of scene files, and what would stop a later command, without simulating
    Check(check::Args),
    /// Map where a cloth is stable, over stiffness, density and steps per frame
    Stability(stability::Args),
    /// Draw every figure of the report, and write a page that shows them
    Gallery(gallery::Args),
    /// Print the JSON schema of scene files: every key with its meaning, default and range
    Schema,
    /// Print the script that completes commands and options in a shell
    Completions(meta::CompletionsArgs),
    /// Print the manual page of drape or of one of its commands
    Man(meta::ManArgs),
}

impl CommandLine {
    /// What is printed on standard error, and how.
    pub(crate) fn ui(&self) -> Ui {
        Ui {
            json: self.global.json,
            quiet: self.global.quiet,
            verbose: self.global.verbose,
            color: self.global.color,
        }
    }

    /// The limits of time and memory.
    pub(crate) fn limits(&self) -> Limits {
        Limits { time: self.global.time_limit, memory: self.global.memory_limit }
    }

    /// The number of threads; 0 means all cores.
    pub(crate) fn threads(&self) -> usize {
        self.global.threads.unwrap_or(0)
    }
}

/// Answers arguments that were not accepted and returns the exit code: help and version go to standard
/// output, everything else is an error of usage. Without any arguments the help goes to standard error.
pub(crate) fn refuse(refusal: &clap::Error, ui: &Ui) -> u8 {
    if refusal.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        ui.text(refusal.render().to_string().trim_end());
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
    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
    Err(Error::new(Kind::Usage, message).with_help(rest.trim().replace("\n\n", "\n")))
}
