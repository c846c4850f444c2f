//! The first signal stops after the current frame and leaves no file, the second ends at once.
#![cfg(unix)]

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::scratch::Scratch;

/// A simulation that would run for minutes. It is ended with the test, whatever happens.
struct Long(Option<Child>);

impl Long {
    /// Starts it and waits until it runs: until the hash of frame 0 is printed.
    fn start(scratch: &Scratch, steps_per_frame: &str) -> Self {
        let steps = format!("sim.steps_per_frame={steps_per_frame}");
        let arguments = ["simulate", "small.json", "--frames", "100000000", "--hash", "--positions", "out"];
        let mut command = scratch.command(&[&arguments[..], &["--allow-unstable", "--set", &steps]].concat());
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts");
        let mut stdout = BufReader::new(child.stdout.take().expect("a pipe"));
        stdout.read_line(&mut String::new()).expect("a line");
        // Keeps the pipe open and empty.
        std::thread::spawn(move || std::io::copy(&mut stdout, &mut std::io::sink()));
        Self(Some(child))
    }

    fn child(&mut self) -> &mut Child {
        self.0.as_mut().expect("it runs")
    }

    fn signal(&mut self, name: &str) {
        let pid = self.child().id().to_string();
        assert!(Command::new("kill").args([name, &pid]).status().expect("kill runs").success());
    }

    fn is_running_after(&mut self, time: Duration) -> bool {
        std::thread::sleep(time);
        self.child().try_wait().expect("its state").is_none()
    }

    /// Waits for its end, which must come soon.
    fn end(mut self) -> Output {
        let started = Instant::now();
        while self.is_running_after(Duration::from_millis(5)) {
            assert!(started.elapsed() < Duration::from_secs(20), "it does not stop");
        }
        self.0.take().expect("it ran").wait_with_output().expect("its output")
    }
}

impl Drop for Long {
    fn drop(&mut self) {
        if let Some(child) = &mut self.0 {
            // It may have ended by itself.
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

#[test]
fn the_first_signal_stops_and_leaves_no_file() {
    let scratch = Scratch::new();
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let mut long = Long::start(&scratch, "30");
        long.signal(signal);
        let output = long.end();
        assert_eq!(output.status.code(), Some(code), "{signal}");
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.starts_with("error: stopped by signal"), "{message}");
        assert_eq!(scratch.names(), ["small.json"]);
    }
}

#[test]
fn the_second_signal_ends_in_the_middle_of_a_frame() {
    let scratch = Scratch::new();
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let mut long = Long::start(&scratch, "1000000000");
        // Time to get from the hash of frame 0 into the first frame.
        assert!(long.is_running_after(Duration::from_millis(500)));
        long.signal(signal);
        let waits = long.is_running_after(Duration::from_millis(300));
        if waits {
            long.signal(signal);
        }
        let output = long.end();
        assert_eq!((output.status.code(), waits), (Some(code), true), "{signal}: {output:?}");
        assert_eq!(scratch.names(), ["small.json"]);
    }
}
