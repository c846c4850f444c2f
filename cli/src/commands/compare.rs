//! `drape compare`: how two pictures, or the pictures of two folders, differ.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::session::Session;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use drape::error::{Error, Kind, Result};
use drape::output::compare::{Budget, Difference, difference_picture};
use drape::output::png::{self, Effort, Pixels};
use drape_lab::page::{self, comparison::Row};

/// The arguments of `compare`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The expected picture (PNG), or a folder of pictures
    #[arg(value_name = "A")]
    expected: PathBuf,
    /// The actual picture, or a folder of pictures with the same names
    #[arg(value_name = "B")]
    actual: PathBuf,
    /// Allow COUNT pixels to differ by up to MAGNITUDE (1 to 255); repeatable. No pixel may differ by more
    #[arg(long, value_name = "MAGNITUDE:COUNT")]
    budget: Vec<Budget>,
    /// Write the difference of two pictures to this PNG file (`-` for standard output)
    #[arg(long, value_name = "FILE")]
    diff: Option<PathBuf>,
    /// Write a page that shows the expected picture, the difference and the actual picture side by side
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
}

/// How one pair of pictures differs.
#[derive(Serialize)]
struct Comparison {
    a: String,
    b: String,
    size_a: [u32; 2],
    size_b: [u32; 2],
    pixels: u64,
    differing: u64,
    max: usize,
    rmse: f64,
    /// Pixels per magnitude, for the magnitudes above 0 that occur.
    histogram: BTreeMap<usize, u64>,
    within_budget: bool,
}

/// How the pictures of two folders differ.
#[derive(Serialize)]
struct Folders {
    pictures: Vec<Comparison>,
    only_in_a: Vec<String>,
    only_in_b: Vec<String>,
}

/// Compares and prints; a difference beyond the budgets is an error of [`Kind::Difference`].
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let inputs = [args.expected.clone(), args.actual.clone()];
    let files = [(&args.diff, Content::Binary), (&args.html, Content::Text)];
    outputs::check(&inputs, files.iter().filter_map(|(path, content)| Some((path.as_deref()?, *content))))?;
    for path in &inputs {
        fs::metadata(path)
            .map_err(|e| Error::new(Kind::Io, format!("cannot read `{}`: {e}", path.display())))?;
    }
    match inputs.map(|path| path.is_dir()) {
        [false, false] => compare_files(args, session),
        [true, true] => compare_folders(args, session),
        _ => Err(Error::new(Kind::Usage, "one of A and B is a folder and the other is a file")),
    }
}

fn compare_files(args: &Args, session: &Session) -> Result<()> {
    let (comparison, pictures) = compare_pair(&args.expected, &args.actual, &args.budget)?;
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

fn compare_folders(args: &Args, session: &Session) -> Result<()> {
    if args.diff.is_some() {
        return Err(Error::new(Kind::Usage, "--diff compares two pictures, not folders")
            .with_help("use --html for folders"));
    }
    let [in_a, in_b] = [picture_names(&args.expected)?, picture_names(&args.actual)?];
    if in_a.is_empty() && in_b.is_empty() {
        return Err(Error::new(Kind::Nothing, "neither folder contains a PNG picture"));
    }
    let mut text = page::head("Comparison");
    let mut folders = Folders {
        pictures: Vec::new(),
        only_in_a: in_a.difference(&in_b).map(shown).collect(),
        only_in_b: in_b.difference(&in_a).map(shown).collect(),
    };
    for name in in_a.intersection(&in_b) {
        session.signals.check()?;
        let (comparison, pictures) =
            compare_pair(&args.expected.join(name), &args.actual.join(name), &args.budget)?;
        if args.html.is_some() {
            text += &row(&comparison, &pictures)?;
        }
        folders.pictures.push(comparison);
    }
    if let Some(path) = &args.html {
        atomic::write(path, (text + page::END).as_bytes())?;
    }
    if !outputs::takes_stdout(&[&args.html]) {
        session.print(&folders, &folders.lines())?;
    }
    folders.verdict()
}

fn compare_pair(a: &Path, b: &Path, budgets: &[Budget]) -> Result<(Comparison, [Pixels; 2])> {
    let pictures = [png::read(a)?, png::read(b)?];
    let difference = Difference::between(&pictures[0], &pictures[1]);
    let [size_a, size_b] = [0, 1].map(|i: usize| [pictures[i].width, pictures[i].height]);
    let comparison = Comparison {
        a: shown(a),
        b: shown(b),
        size_a,
        size_b,
        pixels: difference.pixels(),
        differing: difference.differing(),
        max: difference.max(),
        rmse: difference.rmse,
        histogram: difference.histogram().collect(),
        within_budget: difference.is_within(budgets),
    };
    Ok((comparison, pictures))
}

impl Comparison {
    fn line(&self) -> String {
        if self.size_a != self.size_b {
            let ([aw, ah], [bw, bh]) = (self.size_a, self.size_b);
            return format!("{aw} x {ah} against {bw} x {bh} pixels");
        }
        let within = if self.differing > 0 && self.within_budget { ", within the budget" } else { "" };
        let Self { differing, pixels, max, rmse, .. } = self;
        format!("{differing} of {pixels} pixels, max {max}, rmse {rmse:.6}{within}")
    }

    fn block(&self) -> String {
        let ([aw, ah], [bw, bh]) = (self.size_a, self.size_b);
        let size = if self.size_a == self.size_b {
            format!("{aw} x {ah}")
        } else {
            format!("{aw} x {ah} against {bw} x {bh}")
        };
        let counts: Vec<_> =
            self.histogram.iter().map(|(magnitude, count)| format!("{magnitude}:{count}")).collect();
        format!(
            "size       {size}\ndiffering  {} of {} pixels\nmax        {}\nrmse       {}\nhistogram  {}\n",
            self.differing,
            self.pixels,
            self.max,
            self.rmse,
            if counts.is_empty() { "-".to_owned() } else { counts.join(" ") },
        )
    }
}

impl Folders {
    fn lines(&self) -> String {
        let mut text = String::new();
        for comparison in &self.pictures {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}: {}", comparison.b, comparison.line());
        }
        text.extend(self.only_in_a.iter().map(|name| format!("{name}: only in A\n")));
        text.extend(self.only_in_b.iter().map(|name| format!("{name}: only in B\n")));
        text
    }

    /// A picture that differs or is missing in B is an error before one that is missing in A.
    fn verdict(&self) -> Result<()> {
        let differing = self.pictures.iter().filter(|c| !c.within_budget).count();
        let missing = self.only_in_a.len();
        verdict(differing + missing == 0, || {
            format!("pictures that differ: {differing}, pictures that are missing in B: {missing}")
        })?;
        match self.only_in_b.as_slice() {
            [] => Ok(()),
            [name, ..] => {
                Err(Error::new(Kind::Nothing, format!("A has no picture named `{name}` to compare with")))
            }
        }
    }
}

fn verdict(same: bool, message: impl Fn() -> String) -> Result<()> {
    if same { Ok(()) } else { Err(Error::new(Kind::Difference, message())) }
}

fn row(comparison: &Comparison, pictures: &[Pixels; 2]) -> Result<String> {
    let [expected, actual] = pictures;
    Row { title: &comparison.b, verdict: &comparison.line(), pictures: [expected, actual] }.html()
}

fn shown(path: impl AsRef<Path>) -> String {
    path.as_ref().display().to_string()
}

/// The PNG files in a folder and the folders in it, as paths from there.
fn picture_names(folder: &Path) -> Result<BTreeSet<PathBuf>> {
    let mut names = BTreeSet::new();
    collect(folder, Path::new(""), &mut names)
        .map_err(|e| Error::new(Kind::Io, format!("cannot read the folder `{}`: {e}", folder.display())))?;
    Ok(names)
}

fn collect(root: &Path, within: &Path, names: &mut BTreeSet<PathBuf>) -> std::io::Result<()> {
    for entry in fs::read_dir(root.join(within))? {
        let entry = entry?;
        let name = within.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            collect(root, &name, names)?;
        } else if name.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png")) {
            names.insert(name);
        }
    }
    Ok(())
}
