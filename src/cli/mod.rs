//! The command line: one file a command.
//!
//! Standard output carries the result that was asked for and nothing else; everything else goes
//! to standard error. The exit code is that of the error's [`Kind`].

mod advance;
mod animate;
mod arguments;
mod bench;
mod check;
mod compare;
mod compare_positions;
mod counts;
mod export;
mod film;
mod gallery;
mod guard;
mod info;
mod look;
mod moments;
mod outputs;
mod progress;
mod render;
mod scene;
mod signals;
mod simulate;
mod stability;
mod study;
mod table;
mod target;
mod texts;
mod ui;

use std::process::ExitCode;

use clap::Parser;
use serde::Serialize;

use self::arguments::{Arguments, Command};
use self::signals::Signals;
use self::ui::Ui;
use crate::error::{Error, Kind, Result};
use crate::output::atomic;

/// What every command shares.
struct Session {
    ui: Ui,
    signals: Signals,
}

impl Session {
    /// Prints a result: as JSON if asked for, else as text.
    fn print(&self, value: &impl Serialize, text: &str) -> Result<()> {
        if self.ui.json { self.print_json(value) } else { atomic::write_stdout(text.as_bytes()) }
    }

    /// Prints a result that is always JSON: one object on one line.
    fn print_json(&self, value: &impl Serialize) -> Result<()> {
        let json = serde_json::to_string(value)
            .map_err(|e| Error::new(Kind::Internal, format!("cannot write JSON: {e}")))?;
        atomic::write_stdout((json + "\n").as_bytes())
    }
}

/// Runs the program on the arguments of the process.
pub fn run() -> ExitCode {
    let json = std::env::args_os().any(|argument| argument == "--json");
    ExitCode::from(guard::guarded(json, || match Arguments::try_parse() {
        Ok(arguments) => {
            let ui = arguments.ui();
            exit_code(&ui, execute(&arguments, ui))
        }
        Err(refusal) => arguments::refuse(&refusal, &Ui::before_parsing(json)),
    }))
}

/// Tells the error, if any. A reader that has gone wants no message and no failure.
fn exit_code(ui: &Ui, result: Result<()>) -> u8 {
    match result {
        Ok(()) => 0,
        Err(error) if error.kind == Kind::Signal(atomic::SIGPIPE) => 0,
        Err(error) => {
            ui.error(&error);
            error.kind.exit_code()
        }
    }
}

fn execute(arguments: &Arguments, ui: Ui) -> Result<()> {
    let session = Session { ui, signals: Signals::install()? };
    rayon::ThreadPoolBuilder::new().num_threads(arguments.threads()).build_global().map_err(|e| {
        Error::new(Kind::Io, format!("cannot start the threads: {e}"))
            .with_help("ask for fewer with --threads")
    })?;
    match &arguments.command {
        Command::Render(args) => render::run(args, &session),
        Command::Animate(args) => animate::run(args, &session),
        Command::Simulate(args) => simulate::run(args, &session),
        Command::Export(args) => export::run(args, &session),
        Command::Compare(args) => compare::run(args, &session),
        Command::ComparePositions(args) => compare_positions::run(args, &session),
        Command::Info(args) => info::run(args, &session),
        Command::Study(args) => study::run(args, &session),
        Command::Check(args) => check::run(args, &session),
        Command::Schema => texts::schema(),
        Command::Completions(args) => texts::completions(args),
        Command::Man(args) => texts::man(args),
        Command::Stability(args) => stability::run(args, &session),
        Command::Gallery(args) => gallery::run(args, &session),
    }
}
