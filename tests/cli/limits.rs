//! Limits of time and memory, those of the command line and those of the system: an exit code of the contract, a
//! sentence, and no file that is not whole.
#![cfg(target_os = "linux")]

use std::collections::BTreeSet;
use std::process::{Command, Stdio};

use crate::scratch::{Run, Scratch};

#[test]
fn the_time_limit_ends_between_frames_and_within_one() {
    let scratch = Scratch::new();
    let long =
        ["simulate", "small.json", "--frames", "100000000", "--positions", "out", "--time-limit", "0.3"];
    let run = scratch.run(&long);
    assert_eq!(run.code, Some(6), "{}", run.stderr);
    assert!(run.stderr.contains("stopped by the time limit of 0.3 s; nothing was written (simulating: "));
    let endless = [&long[..], &["--allow-unstable", "--set", "sim.steps_per_frame=1000000000"]].concat();
    let run = scratch.run(&[&endless[..], &["--json"]].concat());
    let error = run.error();
    assert_eq!((run.code, &error["kind"]), (Some(6), &"limit".into()), "{error}");
    let message = error["error"].as_str().unwrap();
    assert!(message.contains("no file is left incomplete (simulating: 0 of 100000000)"), "{message}");
    assert_eq!(scratch.names(), ["small.json"]);
    scratch.succeed(&["simulate", "small.json", "--frames", "2", "--time-limit", "1000", "-q"]);
}

#[test]
fn what_is_kept_at_the_time_limit_is_said_and_is_whole() {
    let scratch = Scratch::new();
    let arguments = [
        "animate",
        "small.json",
        "f/%d.png",
        "--frames",
        "0..1000000",
        "--size",
        "16x16",
        "--time-limit",
        "0.5",
    ];
    let run = scratch.run(&arguments);
    assert_eq!(run.code, Some(6), "{}", run.stderr);
    assert!(run.stderr.contains("the finished pictures are kept"), "{}", run.stderr);
    assert!(scratch.path("f/0.png").exists());
    let last = ["render", "small.json", "0.png", "--frame", "0", "--size", "16x16", "-q"];
    scratch.succeed(&last);
    scratch.succeed(&["compare", "f/0.png", "0.png"]);
}

#[test]
fn the_memory_limit_is_held_against_an_estimate_and_against_what_is_used() {
    let scratch = Scratch::new();
    let large =
        ["render", "small.json", "out.png", "--frame", "0", "--size", "4000x4000", "--memory-limit", "100M"];
    let run = scratch.run(&large);
    assert_eq!(run.code, Some(6), "{}", run.stderr);
    let message = "the picture takes at least 256000000 bytes of memory, 104857600 are allowed";
    assert!(run.stderr.contains(message), "{}", run.stderr);
    let grid = ["cloth.num_width_points=2000", "cloth.num_height_points=2000", "cloth.thickness=0.0001"];
    let sets: Vec<&str> = grid.iter().flat_map(|set| ["--set", set]).collect();
    let cloth =
        [&["simulate", "small.json", "--memory-limit", "100M", "--set", "cloth.pinned=[]"], &sets[..]]
            .concat();
    let run = scratch.run(&cloth);
    assert_eq!(run.code, Some(6), "{}", run.stderr);
    assert!(run.stderr.contains("the cloth takes at least"), "{}", run.stderr);
    // More than the arrays that the estimate knows of.
    let run = scratch.run(&["simulate", "small.json", "--frames", "100000000", "--memory-limit", "1M"]);
    assert_eq!(run.code, Some(6), "{}", run.stderr);
    assert!(run.stderr.contains("stopped by the memory limit"), "{}", run.stderr);
    assert_eq!(scratch.names(), ["small.json"]);
    scratch.succeed(&["simulate", "small.json", "--frames", "2", "--memory-limit", "1G", "-q"]);
}

#[test]
fn limits_that_make_no_sense_are_2() {
    let scratch = Scratch::new();
    for limit in [
        ["--time-limit", "-1"],
        ["--time-limit", "x"],
        ["--memory-limit", "1.5G"],
        ["--memory-limit", "1X"],
        ["--memory-limit", ""],
    ] {
        assert_eq!(scratch.run(&[&["info", "small.json"], &limit[..]].concat()).code, Some(2), "{limit:?}");
    }
}

/// Commands of every kind that writes, with their output.
const COMMANDS: [(&str, &str); 7] = [
    ("render small.json out.png --frame 2 --size 64x64", "out.png"),
    ("render small.json out.png --frame 2 --size 64x64 --shader custom --samples 4", "out.png"),
    ("animate small.json out.apng --frames 0..3 --size 64x64", "out.apng"),
    ("animate small.json out.gif --frames 0..3 --size 64x64 --fps 50", "out.gif"),
    ("simulate small.json --frames 2 --positions out.npy", "out.npy"),
    ("export small.json out.glb --frames 0..3", "out.glb"),
    ("horizon small.json out.html --frame 2", "out.html"),
];

/// Runs a command line of the program in a shell, after `setting`.
fn run_in(scratch: &Scratch, setting: &str, arguments: &str) -> Run {
    let program = assert_cmd::cargo::cargo_bin!("drape").display().to_string();
    let script = format!("{setting}; exec {program} {arguments}");
    let mut command = Command::new("bash");
    command.args(["-c", &script]).current_dir(scratch.path("")).stdin(Stdio::null());
    command.output().expect("bash").into()
}

/// The least address space in KiB in which the system can load the program. It grows with the program.
fn least_space(scratch: &Scratch) -> u32 {
    let (mut too_little, mut enough) = (1000, 100_000);
    while enough - too_little > 50 {
        let middle = u32::midpoint(too_little, enough);
        let run = run_in(scratch, &format!("ulimit -v {middle}"), "--version");
        let loaded = matches!(run.code, Some(0 | 6));
        *if loaded { &mut enough } else { &mut too_little } = middle;
    }
    assert!(enough < 30_000, "the program needs {enough} KiB to start");
    enough
}

#[test]
fn limits_of_the_system_end_in_an_error_or_in_the_same_bytes() {
    let scratch = Scratch::new();
    let least = least_space(&scratch);
    let space = |more: u32| format!("ulimit -v {}", least + more);
    let spaces = [0, 1000, 2500, 5500, 9000, 24_500].map(space);
    let mut failed = 0;
    for (arguments, out) in COMMANDS {
        let run = run_in(&scratch, ":", arguments);
        assert_eq!(run.code, Some(0), "{arguments}: {}", run.stderr);
        let right = scratch.read(out);
        for setting in spaces.iter().map(String::as_str).chain([
            "ulimit -n 4",
            "ulimit -n 6",
            "ulimit -f 0",
            "ulimit -f 1",
            "ulimit -s 256",
            "unset HOME TMPDIR",
            "exec <&-",
            "exec >&-",
            "exec 2>&-",
            "exec <&- >&- 2>&-",
        ]) {
            std::fs::remove_file(scratch.path(out)).unwrap();
            let run = run_in(&scratch, setting, arguments);
            let told = setting.contains("2>&-") || !run.stderr.is_empty();
            match run.code {
                Some(0) => assert_eq!(scratch.read(out), right, "{setting}: {arguments}"),
                // A limit of files may be too low for the system to load the program.
                Some(6 | 127) if told => failed += 1,
                code => panic!("{setting}: {arguments}: {code:?} {}", run.stderr),
            }
            std::fs::write(scratch.path(out), &right).unwrap();
            let mut names = scratch.names();
            names.retain(|name| name != "small.json" && name != out);
            assert!(
                names.iter().all(|name| name.starts_with(".drape-")),
                "{setting}: {arguments}: {names:?}"
            );
        }
        std::fs::remove_file(scratch.path(out)).unwrap();
    }
    // Most of the limits of files and memory, for each command.
    assert!(failed >= 3 * COMMANDS.len(), "{failed} runs failed");
    scratch.succeed(&["render", "small.json", "out.png", "--frame", "0", "--size", "8x8", "-q"]);
    assert_eq!(scratch.names(), ["out.png", "small.json"], "the next run has removed what was left");
}

#[test]
fn memory_that_runs_out_at_any_place_ends_in_6() {
    let scratch = Scratch::new();
    let arguments = "render small.json out.png --frame 0 --size 600x500 --shader custom --samples 4 -q";
    assert_eq!(run_in(&scratch, ":", arguments).code, Some(0));
    let right = scratch.read("out.png");
    let mut messages = BTreeSet::new();
    let least = least_space(&scratch);
    for kibibytes in (least..least + 74_000).step_by(2000) {
        std::fs::remove_file(scratch.path("out.png")).unwrap();
        let run = run_in(&scratch, &format!("ulimit -v {kibibytes}"), arguments);
        match run.code {
            Some(0) => assert!(scratch.read("out.png") == right, "{kibibytes}"),
            Some(6) => {
                let words =
                    run.stderr.split_whitespace().filter(|word| word.chars().all(char::is_alphabetic));
                messages.insert(words.collect::<Vec<_>>().join(" "));
            }
            code => panic!("{kibibytes}: {code:?} {}", run.stderr),
        }
        std::fs::write(scratch.path("out.png"), &right).unwrap();
    }
    // Before the picture, in its textures, and where nobody asks before.
    for place in ["for the picture", "texels", "memory allocation"] {
        assert!(messages.iter().any(|message| message.contains(place)), "{place}: {messages:?}");
    }
}

/// Processes are limited for a user, and the administrator's are not.
#[test]
fn fewer_threads_than_asked_for_give_the_same_bytes() {
    let scratch = Scratch::new();
    let sound = |(arguments, out): (&str, &str)| {
        assert_eq!(run_in(&scratch, ":", &format!("{arguments} --threads 4")).code, Some(0));
        let right = scratch.read(out);
        std::fs::remove_file(scratch.path(out)).unwrap();
        let run = run_in(&scratch, "ulimit -v 150000", &format!("{arguments} --threads 64"));
        assert_eq!(run.code, Some(0), "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains("of 64 threads could be started"), "{}", run.stderr);
        assert_eq!(scratch.read(out), right, "{arguments}");
        std::fs::remove_file(scratch.path(out)).unwrap();
    };
    COMMANDS.into_iter().for_each(sound);
}

/// What a thread sets aside and does not use is not missing for the work: where a limit suffices, larger ones do.
#[test]
fn more_addresses_never_lead_from_success_to_failure() {
    let scratch = Scratch::new();
    for threads in [1, 2, 64] {
        let arguments = format!(
            "render small.json out.png --frame 0 --size 64x64 --shader custom --samples 4 -q --threads {threads}"
        );
        let code = |kibibytes| run_in(&scratch, &format!("ulimit -v {kibibytes}"), &arguments).code;
        let codes: Vec<_> = (50_000..300_000).step_by(15_500).map(code).collect();
        let failed = codes.iter().take_while(|&&code| code == Some(6)).count();
        assert!(failed > 0 && failed < codes.len(), "{threads} threads: {codes:?}");
        assert!(codes[failed..].iter().all(|&code| code == Some(0)), "{threads} threads: {codes:?}");
    }
}

/// Its springs are for several threads. Where one can be started that one may be the one that draws.
#[test]
fn a_large_cloth_under_any_limit_waits_for_no_thread() {
    let scratch = Scratch::new();
    let set = "cloth.thickness=0.001 --set cloth.num_width_points=100 --set cloth.num_height_points=100";
    let arguments = format!("animate small.json out.gif --frames 0..3 --size 16x16 -q --set {set}");
    assert_eq!(run_in(&scratch, ":", &arguments).code, Some(0));
    let right = scratch.read("out.gif");
    let mut codes = BTreeSet::new();
    for kibibytes in (19_000..31_000).step_by(500) {
        std::fs::remove_file(scratch.path("out.gif")).unwrap();
        let run =
            run_in(&scratch, &format!("ulimit -v {kibibytes}"), &format!("{arguments} --time-limit 60"));
        codes.insert(run.code);
        match run.code {
            Some(0) => assert!(scratch.read("out.gif") == right, "{kibibytes}"),
            code => {
                let named = run.stderr.contains("memory") && !run.stderr.contains("internal");
                assert!(named, "{kibibytes}: {code:?} {}", run.stderr);
            }
        }
        std::fs::write(scratch.path("out.gif"), &right).unwrap();
    }
    assert_eq!(codes, BTreeSet::from([Some(0), Some(3), Some(6)]));
}

/// Those of its help and of its refusals too, which need no more than the arguments.
#[test]
fn a_file_beyond_the_limit_is_a_failed_write_of_every_text() {
    let scratch = Scratch::new();
    for (arguments, code) in [
        ("--help > out", 6),
        ("--version > out", 6),
        ("help render > out", 6),
        ("man > out", 6),
        ("nonsense 2> out", 2),
    ] {
        let run = run_in(&scratch, "ulimit -f 0", arguments);
        assert_eq!(run.code, Some(code), "{arguments}: {}", run.stderr);
        assert!(arguments.contains("2>") || run.stderr.contains("standard output"), "{}", run.stderr);
    }
}

#[test]
fn the_environment_does_not_make_stacks_too_small_or_too_large() {
    let scratch = Scratch::new();
    let arguments = "animate small.json out.apng --frames 0..3 --size 64x64 --threads 3";
    for size in ["0", "99999999999999"] {
        let run = run_in(&scratch, &format!("export RUST_MIN_STACK={size}"), arguments);
        assert_eq!(run.code, Some(0), "{size}: {}", run.stderr);
        assert!(!run.stderr.contains("threads could be started"), "{size}: {}", run.stderr);
    }
}
