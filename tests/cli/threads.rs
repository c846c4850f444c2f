//! The same bytes for every number of threads.

use crate::scratch::{Scratch, scene};

#[test]
fn every_number_of_threads_gives_the_same_bytes() {
    let scratch = Scratch::new();
    let sphere = scene("sphere.json");
    let outputs = |threads: &str| {
        let hashes =
            scratch.succeed(&["simulate", &sphere, "--frames", "20", "--hash", "--threads", threads]);
        let arguments =
            ["render", &sphere, "out.png", "--size", "320x250", "--time", "0.6", "--samples", "4"];
        let raw = ["--depth", "d", "--ids", "i", "--shader", "custom", "--threads", threads];
        scratch.succeed(&[&arguments[..], &raw[..]].concat());
        (hashes, ["out.png", "d", "i"].map(|name| scratch.read(name)))
    };
    let one = outputs("1");
    for threads in ["2", "3", "7", "16"] {
        assert!(outputs(threads) == one, "{threads} threads differ from one");
    }
}
