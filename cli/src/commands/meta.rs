//! `drape schema`, `completions` and `man`: what other programs want to know of this one.

use clap::CommandFactory;
use clap_complete::Shell;

use crate::arguments::Arguments;
use crate::session::atomic;
use drape::error::{Error, Kind, Result};
use drape::scene;

/// What `completions` takes.
#[derive(clap::Args)]
pub(crate) struct CompletionsArgs {
    /// The shell that reads the script
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

/// What `man` takes.
#[derive(clap::Args)]
pub(crate) struct ManArgs {
    /// The command whose page is wanted (default: the page that lists all)
    #[arg(value_name = "COMMAND")]
    command: Option<String>,
}

/// Prints the schema of scene files, for people to read.
pub(crate) fn schema() -> Result<()> {
    atomic::write_stdout(format!("{:#}\n", scene::schema()).as_bytes())
}

/// Prints the script.
pub(crate) fn completions(args: &CompletionsArgs) -> Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Arguments::command(), "drape", &mut script);
    atomic::write_stdout(&script)
}

/// Prints the page in the language of `man`.
pub(crate) fn man(args: &ManArgs) -> Result<()> {
    let mut all = Arguments::command();
    // Gives every command its whole name and the global options.
    all.build();
    let page = match &args.command {
        None => all,
        Some(name) => all.find_subcommand(name).cloned().ok_or_else(|| unknown(name))?,
    };
    let name = page.get_display_name().unwrap_or("drape").to_owned();
    let mut text = Vec::new();
    clap_mangen::Man::new(page.name(name).version(env!("CARGO_PKG_VERSION")))
        .render(&mut text)
        .map_err(|e| Error::new(Kind::Internal, format!("cannot write the page: {e}")))?;
    atomic::write_stdout(&text)
}

fn unknown(name: &str) -> Error {
    Error::new(Kind::Usage, format!("there is no command `{name}`")).with_help("`drape help` lists them")
}
