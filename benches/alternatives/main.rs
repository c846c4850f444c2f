//! How fast the project is next to others, in one run: what is compared takes turns, and the
//! table has medians and their ratio.
//!
//! `cargo bench --bench alternatives` prints a table for one thread and one for two. With `-- --test` it only shows that it runs.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::cast_possible_truncation,
    reason = "a benchmark may fail, and its table is for the terminal"
)]

mod drawing;
#[allow(dead_code, reason = "the test that it belongs to needs more of it")]
#[path = "../../tests/engine/gl/harness/mod.rs"]
mod gl;
#[path = "../../tests/support/repository.rs"]
mod repository;
mod stepping;
#[path = "../../examples/textbook_cloth.rs"]
mod textbook_cloth;

use std::process::Command;
use std::time::{Duration, Instant};

use drape::scene::{Overrides, Scene, load};

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let rounds = if arguments.iter().any(|argument| argument == "--test") { 1 } else { 21 };
    if let Some(threads) = arguments.iter().find_map(|argument| argument.strip_prefix("--threads=")) {
        return tables(threads, rounds);
    }
    // The driver reads its number of threads once, when it starts; 0 is the one that calls it.
    for (threads, of_driver) in [("1", "0"), ("2", "2")] {
        let mut child = Command::new(std::env::current_exe().unwrap());
        child.args(&arguments[1..]).arg(format!("--threads={threads}"));
        child.env("RAYON_NUM_THREADS", threads).env("LP_NUM_THREADS", of_driver);
        assert!(child.status().unwrap().success());
    }
}

fn tables(threads: &str, rounds: usize) {
    println!("\n{threads} thread(s), medians of {rounds} runs in turn\n");
    drawing::table(rounds);
    if threads == "1" {
        stepping::table(rounds);
    }
}

/// A stock scene with changes.
fn scene(name: &str, sets: &[&str]) -> Scene {
    let path = repository::path(&format!("scenes/{name}.json"));
    let sets = sets.iter().map(|set| (*set).to_owned()).collect();
    load(&path, &Overrides { sets, ..Overrides::default() }).unwrap().scene
}

/// Turns that are not counted: the driver compiles, memory is touched for the first time.
const WARM_UP: usize = 5;

/// The median times of two pieces of work that take turns.
fn medians(rounds: usize, mut first: impl FnMut(), mut second: impl FnMut()) -> [Duration; 2] {
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..WARM_UP + rounds {
        for (times, work) in times.iter_mut().zip([&mut first as &mut dyn FnMut(), &mut second]) {
            let started = Instant::now();
            work();
            times.push(started.elapsed());
        }
    }
    times.map(|mut times| {
        times.drain(..WARM_UP);
        times.sort_unstable();
        times[times.len() / 2]
    })
}
