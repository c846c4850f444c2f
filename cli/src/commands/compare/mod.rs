//! `drape compare`: how two pictures or animations, or those of two folders, differ.

mod verdict;
mod mask;
mod pair;
mod folders;

use std::fs;
use std::path::PathBuf;

use crate::args::output::output;
use crate::session::Session;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use drape::error::{Error, Kind, Result};
use drape::output::compare::{Budget, difference_picture};
use drape::output::png::{self, Effort, Pixels};
use drape_lab::page::{self, comparison::Row};
use folders::{Folders, Listed};
use mask::Mask;
use pair::{Comparison, Rules};
use verdict::{shown, verdict};

/// The arguments of `compare`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The expected picture (PNG, JPEG) or animation (APNG, GIF), or a folder of them
    #[arg(value_name = "A")]
    expected: PathBuf,
    /// The actual picture or animation, or a folder with the same names
    #[arg(value_name = "B")]
    actual: PathBuf,
    /// Allow COUNT pixels, or P% of a picture's pixels, to differ by up to MAGNITUDE (1 to 255); P% alone allows any
    /// magnitude; repeatable. No pixel may differ by more
    #[arg(long, value_name = "MAGNITUDE:COUNT|P%")]
    budget: Vec<Budget>,
    /// Compare only the pixels that are not black in this PNG
    #[arg(long, value_name = "FILE")]
    mask: Option<PathBuf>,
    /// Write the difference of two pictures to this PNG file (`-` for standard output); of animations that of the
    /// first picture that differs
    #[arg(long, value_name = "FILE", value_parser = output())]
    diff: Option<PathBuf>,
    /// Write a page that shows the expected picture, the difference and the actual picture side by side; of animations
    /// the first picture that differs
    #[arg(long, value_name = "FILE", value_parser = output())]
    html: Option<PathBuf>,
}

/// Compares and prints; a difference beyond the budgets is an error of [`Kind::Difference`].
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let inputs = [args.expected.clone(), args.actual.clone()];
    let mask = args.mask.as_deref().map(Mask::read).transpose()?;
    let rules = Rules { budgets: &args.budget, mask: mask.as_ref() };
    let files = [(&args.diff, Content::Binary), (&args.html, Content::Text)];
    let read: Vec<PathBuf> = inputs.iter().chain(&args.mask).cloned().collect();
    outputs::check(&read, files.iter().filter_map(|(path, content)| Some((path.as_deref()?, *content))))?;
    for path in &inputs {
        fs::metadata(path)
            .map_err(|e| Error::new(Kind::Io, format!("cannot read `{}`: {e}", path.display())))?;
    }
    match inputs.map(|path| path.is_dir()) {
        [false, false] => compare_files(args, &rules, session),
        [true, true] => compare_folders(args, &rules, session),
        _ => Err(Error::new(Kind::Usage, "one of A and B is a folder and the other is a file")),
    }
}

fn compare_files(args: &Args, rules: &Rules<'_>, session: &Session) -> Result<()> {
    let (comparison, pictures) = pair::compare(&args.expected, &args.actual, rules)?;
    if let Some(path) = &args.diff {
        let shown = difference_picture(&pictures[0], &pictures[1]);
        let bytes = png::encode(shown.width, shown.height, shown.rgba.as_flattened(), Effort::Fast)?;
        atomic::write(path, &bytes)?;
    }
    if let Some(path) = &args.html {
        let page = page::head("Comparison") + &row(&comparison, &pictures)? + page::END;
        atomic::write(path, page.as_bytes())?;
    }
    if !outputs::takes_stdout(&[&args.diff, &args.html]) {
        session.print(&comparison, &comparison.block())?;
    }
    verdict(comparison.within_budget, || format!("the pictures differ: {}", comparison.line()))
}

fn compare_folders(args: &Args, rules: &Rules<'_>, session: &Session) -> Result<()> {
    if args.diff.is_some() {
        return Err(Error::new(Kind::Usage, "--diff compares two pictures, not folders")
            .with_help("use --html for folders"));
    }
    let [a, b] = [Listed::of(&args.expected), Listed::of(&args.actual)];
    let (in_a, in_b) = (a.pictures, b.pictures);
    let unread = || a.unread.iter().chain(&b.unread);
    if in_a.is_empty() && in_b.is_empty() && unread().next().is_none() {
        return Err(Error::new(Kind::Nothing, "neither folder contains a picture"));
    }
    let compared: Vec<PathBuf> = [(&args.expected, &in_a), (&args.actual, &in_b)]
        .into_iter()
        .flat_map(|(folder, names)| names.iter().map(|name| folder.join(name)))
        .collect();
    outputs::check(&compared, args.html.as_deref().map(|path| (path, Content::Text)))?;
    let mut text = page::head("Comparison");
    let mut folders = Folders {
        pictures: Vec::new(),
        only_in_a: in_a.difference(&in_b).map(shown).collect(),
        only_in_b: in_b.difference(&in_a).map(shown).collect(),
        unreadable: Vec::new(),
        not_compared: a.others.union(&b.others).map(shown).collect(),
    };
    for (name, why) in unread() {
        folders.note_unread(name, why.clone(), &mut text);
    }
    for name in in_a.intersection(&in_b) {
        session.stop.check()?;
        match pair::compare(&args.expected.join(name), &args.actual.join(name), rules) {
            Ok((comparison, pictures)) => {
                if args.html.is_some() {
                    text += &row(&comparison, &pictures)?;
                }
                folders.pictures.push(comparison);
            }
            Err(error) if error.kind == Kind::Io => folders.note_unread(name, error.message, &mut text),
            Err(error) => return Err(error),
        }
    }
    if let Some(path) = &args.html {
        atomic::write(path, (text + page::END).as_bytes())?;
    }
    if !outputs::takes_stdout(&[&args.html]) {
        session.print(&folders, &folders.lines())?;
    }
    folders.verdict()
}

fn row(comparison: &Comparison, pictures: &[Pixels; 2]) -> Result<String> {
    let [expected, actual] = pictures;
    Row { title: &comparison.b, verdict: &comparison.line(), pictures: [expected, actual] }.html()
}
