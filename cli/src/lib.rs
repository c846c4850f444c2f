//! The program `drape`. Modules stand in the order in which data flows; each uses only those above it.
//!
//! Standard output carries the result that was asked for and nothing else: progress, warnings and errors
//! go to standard error. The exit code is that of the error's [`Kind`](drape::error::Kind).

#![forbid(unsafe_code)]

mod session;
mod run;
mod args;
mod animation;
mod commands;
mod command_line;

use std::process::ExitCode;

use clap::{CommandFactory, Parser};
use drape::error::Result;

use command_line::{Command, CommandLine};
use commands::{
    animate, check, choose, compare, compare_positions, export, gallery, horizon, info, meta, render,
    simulate, stability, study, sweep, verify,
};
use session::stop::{self, Stop};
use session::ui::Ui;
use session::{Session, exit_code, guard, one_arena, threads};

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    stop::exit_without_memory();
    stop::fail_writes_beyond_limit();
    one_arena::ensure();
    let json = std::env::args_os().any(|argument| argument == "--json");
    ExitCode::from(guard::guarded(json, || match CommandLine::try_parse() {
        Ok(arguments) => {
            let ui = arguments.ui();
            exit_code(&ui, execute(&arguments, ui))
        }
        Err(refusal) => command_line::refuse(&refusal, &Ui::before_parsing(json)),
    }))
}

fn execute(arguments: &CommandLine, ui: Ui) -> Result<()> {
    let session = Session { ui, stop: Stop::install(arguments.limits(), ui)? };
    threads::start(arguments.threads(), &session)?;
    match &arguments.command {
        Command::Render(args) => render::run(args, &session),
        Command::Animate(args) => animate::run(args, &session),
        Command::Simulate(args) => simulate::run(args, &session),
        Command::Export(args) => export::run(args, &session),
        Command::Compare(args) => compare::run(args, &session),
        Command::ComparePositions(args) => compare_positions::run(args, &session),
        Command::Verify(args) => verify::run(args, &session),
        Command::Info(args) => info::run(args, &session),
        Command::Study(args) => study::run(args, &session),
        Command::Sweep(args) => sweep::run(args, &session),
        Command::Choose(args) => choose::run(args, &session),
        Command::Horizon(args) => horizon::run(args, &session),
        Command::Check(args) => check::run(args, &session),
        Command::Schema => meta::schema(&session),
        Command::Completions(args) => meta::completions(args, CommandLine::command(), &session),
        Command::Man(args) => meta::man(args, CommandLine::command(), &session),
        Command::Stability(args) => stability::run(args, &session),
        Command::Gallery(args) => gallery::run(args, &session),
    }
}
