//! `drape schema`, `completions` and `man`: descriptions of scene files and of this program.

use clap::Command;
use clap_complete::Shell;

use crate::session::Session;
use drape::error::{Error, Kind, Result};
use drape::scene;

/// The arguments of `completions`.
#[derive(clap::Args)]
pub(crate) struct CompletionsArgs {
    /// The shell to print the script for
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

/// The arguments of `man`.
#[derive(clap::Args)]
pub(crate) struct ManArgs {
    /// The command to print the page of (default: the page of drape, which lists all commands)
    #[arg(value_name = "COMMAND")]
    command: Option<String>,
}

/// Prints the schema of scene files, indented.
pub(crate) fn schema(session: &Session) -> Result<()> {
    session.print_text(format!("{:#}\n", scene::schema()))
}

/// Prints the completion script for `drape`, the grammar of the whole command line.
pub(crate) fn completions(args: &CompletionsArgs, mut drape: Command, session: &Session) -> Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut drape, "drape", &mut script);
    session.print_text(script)
}

/// Prints the manual page, in the language of `man`, of `drape` or of one of its commands.
pub(crate) fn man(args: &ManArgs, mut drape: Command, session: &Session) -> Result<()> {
    // Gives every command its whole name and the global options.
    drape.build();
    let page = match &args.command {
        None => drape,
        Some(name) => drape.find_subcommand(name).cloned().ok_or_else(|| unknown(name))?,
    };
    let name = page.get_display_name().unwrap_or("drape").to_owned();
    let mut text = Vec::new();
    clap_mangen::Man::new(page.name(name).version(env!("CARGO_PKG_VERSION")))
        .render(&mut text)
        .map_err(|e| Error::new(Kind::Internal, format!("cannot write the manual page: {e}")))?;
    session.print_text(text)
}

fn unknown(name: &str) -> Error {
    Error::new(Kind::Usage, format!("there is no command `{name}`")).with_help("`drape help` lists them")
}
