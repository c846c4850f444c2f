//! A signal stops after the current frame, or soon in the middle of a frame, a wait or a program that hangs; a second
//! one at once. Neither leaves a file, and what a killed process leaves the next run removes.
#![cfg(unix)]

use std::fs;
use std::io::{BufRead, BufReader};
use std::os::unix::fs::PermissionsExt;
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

/// Whether the tests run under `nohup`, which the program obeys too.
fn outlives_the_terminal() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:")).unwrap_or_default();
    u64::from_str_radix(mask.trim(), 16).is_ok_and(|mask| mask & 1 == 1)
}

/// The signals that end a run, with the exit codes.
const SIGNALS: [(&str, i32); 4] = [("-INT", 130), ("-TERM", 143), ("-HUP", 129), ("-QUIT", 131)];

#[test]
fn the_first_signal_stops_and_leaves_no_file() {
    let scratch = Scratch::new();
    for (signal, code) in
        SIGNALS.into_iter().filter(|(signal, _)| *signal != "-HUP" || !outlives_the_terminal())
    {
        let mut long = Long::start(&scratch, "30");
        long.signal(signal);
        let output = long.end();
        assert_eq!(output.status.code(), Some(code), "{signal}");
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.starts_with("error: stopped by signal"), "{message}");
        assert!(message.contains("nothing was written (simulating: "), "{message}");
        assert_eq!(scratch.names(), ["small.json"]);
    }
}

/// A frame that would take hours.
const ENDLESS: &str = "1000000000";

#[test]
fn one_signal_ends_in_the_middle_of_a_frame() {
    let scratch = Scratch::new();
    for (signal, code) in
        SIGNALS.into_iter().filter(|(signal, _)| *signal != "-HUP" || !outlives_the_terminal())
    {
        let mut long = Long::start(&scratch, ENDLESS);
        // Time to get from the hash of frame 0 into the first frame.
        assert!(long.is_running_after(Duration::from_millis(100)));
        long.signal(signal);
        let output = long.end();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{signal}: {message}");
        assert!(message.contains("no file is left incomplete"), "{message}");
        assert_eq!(scratch.names(), ["small.json"]);
    }
}

#[test]
fn the_second_signal_ends_at_once() {
    let scratch = Scratch::new();
    let mut long = Long::start(&scratch, ENDLESS);
    assert!(long.is_running_after(Duration::from_millis(500)));
    let first = Instant::now();
    long.signal("-INT");
    let waits = long.is_running_after(Duration::from_millis(100));
    if waits {
        long.signal("-INT");
    }
    let output = long.end();
    assert_eq!((output.status.code(), waits), (Some(130), true), "{output:?}");
    // One signal takes a grace of 1.2 s.
    assert!(first.elapsed() < Duration::from_millis(1100), "{:?}", first.elapsed());
}

/// Starts the program, waits until `ready`, sends SIGTERM, and returns the exit code.
fn terminated(scratch: &Scratch, command: &mut Command, ready: impl Fn() -> bool) -> Option<i32> {
    let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
    let mut long = Long(Some(child));
    let started = Instant::now();
    while !ready() {
        assert!(started.elapsed() < Duration::from_secs(20), "it does not begin");
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(long.is_running_after(Duration::from_millis(100)), "it runs");
    long.signal("-TERM");
    let code = long.end().status.code();
    assert!(!scratch.names().iter().any(|name| name.starts_with(".drape-")), "{:?}", scratch.names());
    code
}

#[test]
fn a_signal_ends_a_wait_for_a_scene_and_for_a_program_that_hangs() {
    let scratch = Scratch::new();
    let pipe = scratch.path("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    // Nobody writes into the pipe.
    let code = terminated(&scratch, &mut scratch.command(&["render", "pipe", "out.png"]), || true);
    assert_eq!(code, Some(143));

    // It answers, takes no pictures and heeds no signal.
    let hanging =
        "#!/bin/sh\n[ \"$1\" = -version ] && exit 0\ntrap '' TERM INT HUP\necho $$ > begun\nexec sleep 60\n";
    let program = scratch.path("ffmpeg");
    fs::write(&program, hanging).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", scratch.path("").display(), std::env::var("PATH").unwrap());
    let mut command = scratch.command(&["animate", "small.json", "out.mp4", "--frames", "0..100"]);
    let code = terminated(&scratch, command.env("PATH", path), || {
        fs::read(scratch.path("begun")).is_ok_and(|number| number.ends_with(b"\n"))
    });
    assert_eq!(code, Some(143));
    assert!(!scratch.path("out.mp4").exists());
    let number = String::from_utf8(scratch.read("begun")).unwrap();
    let status = || fs::read_to_string(format!("/proc/{}/stat", number.trim())).unwrap_or_default();
    let started = Instant::now();
    // One that has ended may wait for whoever has to notice.
    while !(status().is_empty() || status().contains(") Z ")) {
        assert!(started.elapsed() < Duration::from_secs(20), "it still runs: {}", status());
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn what_a_killed_process_leaves_is_removed_by_the_next() {
    let scratch = Scratch::new();
    let temporary = || scratch.names().into_iter().find(|name| name.starts_with(".drape-"));
    let arguments = ["animate", "small.json", "out.apng", "--frames", "0..100000", "--size", "64x64"];
    let child = scratch.command(&arguments).stderr(Stdio::null()).spawn().expect("it starts");
    let mut long = Long(Some(child));
    let started = Instant::now();
    while temporary().is_none() {
        assert!(started.elapsed() < Duration::from_secs(20), "it does not begin");
        std::thread::sleep(Duration::from_millis(2));
    }
    let left = temporary();
    // One that runs keeps its file while others write beside it.
    scratch.succeed(&["render", "small.json", "a.png", "--size", "8x8", "--frame", "0", "-q"]);
    assert_eq!(temporary(), left);
    long.signal("-KILL");
    long.end();
    assert_eq!(temporary(), left);
    scratch.succeed(&["render", "small.json", "a.png", "--size", "8x8", "--frame", "0", "-q"]);
    assert_eq!(temporary(), None);
    assert_eq!(scratch.names(), ["a.png", "small.json"]);
}

#[test]
fn a_command_that_is_to_outlive_its_terminal_does() {
    let scratch = Scratch::new();
    let program = assert_cmd::cargo::cargo_bin!("drape").display().to_string();
    let script = format!("trap '' HUP; exec {program} simulate small.json --frames 100000000 -q");
    let mut command = Command::new("sh");
    let child = command.current_dir(scratch.path("")).args(["-c", &script]).stdout(Stdio::null()).spawn();
    let mut long = Long(Some(child.expect("it starts")));
    assert!(long.is_running_after(Duration::from_millis(300)));
    long.signal("-HUP");
    assert!(long.is_running_after(Duration::from_millis(300)), "it ended at SIGHUP");
    long.signal("-TERM");
    assert_eq!(long.end().status.code(), Some(143));
}

/// More than a pipe holds, in one message.
#[test]
fn a_signal_and_the_time_limit_end_a_command_whose_messages_nobody_reads() {
    let scratch = Scratch::new();
    let name = "x".repeat(100_000);
    for (limit, code) in [("1000", 143), ("0.2", 6)] {
        let mut command = scratch.command(&["render", &name, "--time-limit", limit]);
        let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it starts");
        let mut long = Long(Some(child));
        assert!(long.is_running_after(Duration::from_millis(500)), "its message was read");
        if code == 143 {
            long.signal("-TERM");
        }
        assert_eq!(long.end().status.code(), Some(code), "{limit}");
    }
}
