//! `drape sweep`: one scene with many changes, by any number of workers.

use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use clap::Subcommand;
use serde::Serialize;

use crate::args::part::Part;
use crate::commands::cells;
use crate::session::Session;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::staged::Staged;
use crate::session::progress::Progress;
use drape::bounded;
use drape::error::{Error, Kind, Result};
use drape::scene::MAX_FILE;
use drape_lab::sweep::idle::idle;
use drape_lab::sweep::plan::{Plan, Text};
use drape_lab::sweep::report::{self, Counts};
use drape_lab::sweep::work::{self, Event};

/// The arguments of `sweep`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(subcommand)]
    step: Step,
}

/// The steps of a sweep.
#[derive(Subcommand)]
enum Step {
    /// Plan, run every case on all cores, and report
    ///
    /// A sweep that was stopped goes on where it was: cases that have a result are not run again.
    Run(Spec),
    /// Write the cases of SPEC to OUT/cases.jsonl, for workers on any number of machines that share OUT
    Plan(Spec),
    /// Run the cases in OUT that have no result; any number of workers may do so at once
    Work(Work),
    /// Write OUT/results.csv, OUT/results.json and OUT/index.html from the results that there are
    ///
    /// If cases have no result yet, the report says so and the exit code is 1.
    Report(Out),
}

#[derive(clap::Args)]
struct Spec {
    /// The file that describes the sweep (JSON): scene, set, measure, and zip, time, frames, render, time_limit. See
    /// docs/cluster.md
    #[arg(value_name = "SPEC")]
    spec: PathBuf,
    #[command(flatten)]
    out: Out,
}

#[derive(clap::Args)]
struct Work {
    #[command(flatten)]
    out: Out,
    /// Run only every Nth case, from the Kth on: for N workers, each with its own K from 1 to N
    #[arg(long, value_name = "K/N")]
    part: Option<Part>,
}

#[derive(clap::Args)]
struct Out {
    /// The folder of the sweep
    #[arg(value_name = "OUT")]
    folder: PathBuf,
}

/// The summary.
#[derive(Serialize)]
struct Summary {
    folder: String,
    cases: u64,
    /// Cases that this run simulated.
    #[serde(skip_serializing_if = "Option::is_none")]
    made: Option<u64>,
    /// Cases that ended in an error, and cases without a result, if a report was made.
    #[serde(skip_serializing_if = "Option::is_none")]
    failed: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    missing: Option<u64>,
}

/// Makes one step of a sweep, or all.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    match &args.step {
        Step::Plan(spec) => {
            let plan = plan(spec, session)?;
            let line = format!("{}: {} cases planned", spec.out.folder.display(), plan.count());
            session.report(&summary(&spec.out, &plan), &line)
        }
        Step::Work(args) => {
            let plan = Plan::load(&args.out.folder, atomic::write)?;
            work(&plan, args.part.unwrap_or(Part::WHOLE), session)?;
            let [made, _] = plan.store.counts();
            let line = format!("{}: {made} cases run", args.out.folder.display());
            session.report(&Summary { made: Some(made), ..summary(&args.out, &plan) }, &line)
        }
        Step::Report(out) => report(out, &Plan::load(&out.folder, atomic::write)?, None, session),
        Step::Run(spec) => {
            let plan = plan(spec, session)?;
            work(&plan, Part::WHOLE, session)?;
            let [made, _] = plan.store.counts();
            report(&spec.out, &plan, Some(made), session)
        }
    }
}

fn summary(out: &Out, plan: &Plan) -> Summary {
    let folder = out.folder.display().to_string();
    Summary { folder, cases: plan.count(), made: None, failed: None, missing: None }
}

/// Reads SPEC and its scene, and writes the plan.
fn plan(args: &Spec, session: &Session) -> Result<Plan> {
    let spec = text(&args.spec, args.spec.display().to_string())?;
    let name = Plan::spec(&spec.name, &spec.text)?.scene;
    let folder = args.spec.parent().unwrap_or(Path::new(""));
    let scene = text(&folder.join(&name), name)?;
    let out = &args.out.folder;
    outputs::make_folder(out)?;
    let staged = Staged::create(&Plan::cases_path_in(out))?;
    let mut cases = BufWriter::new(staged.file()?);
    let mut check = || session.stop.check();
    let plan = Plan::make(out, [spec, scene], atomic::write, &mut cases, &mut check)?;
    staged.finish()?;
    plan.publish(atomic::write)?;
    for sentence in idle(&plan) {
        session.ui.caution(&sentence, "leave it out: its values make cases that differ in nothing else");
    }
    Ok(plan)
}

/// A text file, with the name that messages give it.
fn text(path: &Path, name: String) -> Result<Text> {
    let failed = |cause: String| Error::new(Kind::Io, format!("cannot read {}: {cause}", path.display()));
    let text = bounded::read_text(path, MAX_FILE).map_err(|e| failed(e.to_string()))?;
    Ok(Text { name, text })
}

/// Runs the cases of a part.
fn work(plan: &Plan, part: Part, session: &Session) -> Result<()> {
    let tally = Mutex::new(Tally::new(plan, session)?);
    let watch = |event| {
        match event {
            Event::Frame => {}
            Event::Finished => {
                // The lock is poisoned only when a panic is about to end the program.
                if let Ok(mut tally) = tally.lock() {
                    tally.add()?;
                }
            }
            Event::Damaged(what) => session.ui.caution(&what, "it is run again"),
        }
        cells::check_stop(session)
    };
    work::work(plan, |number| part.takes(number), u64::from(std::process::id()), &watch)
}

/// Writes the report.
fn report(out: &Out, plan: &Plan, made: Option<u64>, session: &Session) -> Result<()> {
    let [csv, json, index] = ["results.csv", "results.json", "index.html"].map(|name| out.folder.join(name));
    let staged = [Staged::create(&csv)?, Staged::create(&json)?];
    let [mut csv, mut json] = [BufWriter::new(staged[0].file()?), BufWriter::new(staged[1].file()?)];
    let watch = |event| {
        if let Event::Damaged(what) = event {
            session.ui.caution(&what, "run `drape sweep work` again");
        }
        session.stop.check()
    };
    let (page, counts) = report::write(plan, [&mut csv as &mut dyn Write, &mut json], &watch)?;
    staged.into_iter().try_for_each(Staged::finish)?;
    atomic::write(&index, page.as_bytes())?;
    let Counts { cases, failed, missing } = counts;
    let line =
        format!("{}: {cases} cases, {failed} ended in an error, {missing} without a result", index.display());
    let summary = Summary { made, failed: Some(failed), missing: Some(missing), ..summary(out, plan) };
    session.report(&summary, &line)?;
    if missing == 0 {
        return Ok(());
    }
    let message = format!("{missing} of {cases} cases have no result yet");
    Err(Error::new(Kind::Difference, message).with_help("run `drape sweep work` again, then the report"))
}

/// The progress of all workers, by counting results in the shared folder now and then.
struct Tally<'a> {
    plan: &'a Plan,
    progress: Progress<'a>,
    /// Cases that had a result when they were last counted, and cases that this worker has finished since.
    counted: u64,
    since: u64,
    last: Instant,
    pause: Duration,
}

/// Shortest time between two counts, and how many times as long as a count the time between two is.
const PAUSE: Duration = Duration::from_secs(2);
const RARE: u32 = 50;

impl<'a> Tally<'a> {
    fn new(plan: &'a Plan, session: &'a Session) -> Result<Self> {
        let counted = plan.finished()?;
        let progress =
            Progress::starting_at(&session.ui, "cases finished by all workers", plan.count(), counted);
        Ok(Self { plan, progress, counted, since: 0, last: Instant::now(), pause: PAUSE })
    }

    /// Another case is finished.
    fn add(&mut self) -> Result<()> {
        self.since += 1;
        if self.last.elapsed() >= self.pause {
            let started = Instant::now();
            (self.counted, self.since) = (self.plan.finished()?, 0);
            self.pause = PAUSE.max(started.elapsed() * RARE);
            self.last = Instant::now();
        }
        self.progress.set((self.counted + self.since).min(self.plan.count()));
        Ok(())
    }
}
