//! How long pictures take: every shader, one and four samples, cloths and pictures of growing size.
//!
//! `cargo bench --bench pictures` prints a table for one thread and one for two. A word after `--` chooses the
//! rows that hold it, `--threads=N` asks for one table, `--level=avx2` or `--level=baseline` allows no wider vectors, and `--test` only shows that
//! it runs; `--plot=FILE` also draws how times grow, for `docs/speed.md`. The last column tells whether two tables are of the same pictures.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a benchmark may fail, and its table is for the terminal"
)]

mod plot;
#[path = "../../tests/support/repository.rs"]
mod repository;
mod rows;

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use drape::lanes::level::Level;
use drape::render::{Options, Renderer};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;

/// Turns that are not counted: memory is touched for the first time.
const WARM_UP: usize = 2;

/// Time that a row may take at most, once it was drawn often enough.
const ENOUGH: Duration = Duration::from_millis(400);

/// Pictures of a row, at least.
const LEAST: usize = 7;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let value = |name: &str| arguments.iter().find_map(|argument| argument.strip_prefix(name));
    match value("--level=") {
        Some("avx2") => Level::Avx2.limit(),
        Some("baseline") => Level::Baseline.limit(),
        _ => {}
    }
    if let Some(threads) = value("--threads=") {
        let filter = arguments.iter().find(|argument| !argument.starts_with("--"));
        let test = arguments.iter().any(|argument| argument == "--test");
        rayon::ThreadPoolBuilder::new().num_threads(threads.parse().unwrap()).build_global().unwrap();
        return table(threads, filter.map_or("", String::as_str), test);
    }
    let tables = ["1", "2"].map(|threads| {
        let mut child = Command::new(std::env::current_exe().unwrap());
        child.args(&arguments).arg(format!("--threads={threads}"));
        let output = child.stderr(Stdio::inherit()).output().unwrap();
        assert!(output.status.success());
        let table = String::from_utf8(output.stdout).unwrap();
        print!("{table}");
        table
    });
    if let Some(path) = value("--plot=") {
        std::fs::write(path, plot::plot(&tables)).unwrap();
    }
}

fn table(threads: &str, filter: &str, test: bool) {
    println!("\n| ms, {threads} thread(s) | least | median | fragments | picture |\n|---|--:|--:|--:|---|");
    for row in rows::all().into_iter().filter(|row| row.name.contains(filter)) {
        let scene = row.scene();
        let start = Simulation::new(&scene).unwrap();
        let renderer = Renderer::new(&scene, &TextureSource::BuiltIn).unwrap();
        let mut framebuffer = renderer.framebuffer();
        let options = Options::default();
        let mut draw = || renderer.draw_into(&mut framebuffer, start.positions(), &options);
        let fragments = draw().fragments;
        let times = if test { vec![Duration::ZERO] } else { times(|| _ = draw()) };
        let hash = renderer.draw(start.positions(), &options).hash();
        let [least, median] = [times[0], times[times.len() / 2]].map(|time| time.as_secs_f64() * 1e3);
        println!("| {} | {least:.2} | {median:.2} | {fragments} | {hash:016x} |", row.name);
    }
}

/// The times of a piece of work, least first.
fn times(mut work: impl FnMut()) -> Vec<Duration> {
    (0..WARM_UP).for_each(|_| work());
    let (begin, mut times) = (Instant::now(), Vec::new());
    while times.len() < LEAST || begin.elapsed() < ENOUGH {
        let started = Instant::now();
        work();
        times.push(started.elapsed());
    }
    times.sort_unstable();
    times
}
