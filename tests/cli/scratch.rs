//! An empty folder in which the real program is run.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::Value;

/// A cloth of 5 x 5 points, which a frame takes no time for.
pub(crate) const SMALL: &str = r#"{"cloth": {"width": 1, "height": 1, "num_width_points": 5,
    "num_height_points": 5, "thickness": 0.0095, "orientation": 0, "pinned": [[0, 0], [4, 0]],
    "damping": 0.2, "density": 150, "ks": 5000, "enable_structural": true,
    "enable_shearing": true, "enable_bending": true},
    "sphere": {"origin": [0.5, 0.2, 0.5], "radius": 0.2, "friction": 0.3}}"#;

/// A folder for one test, removed with it.
pub(crate) struct Scratch(tempfile::TempDir);

/// What a run of the program gave.
#[derive(Debug)]
pub(crate) struct Run {
    /// The exit code; `None` when a signal ended the program.
    pub(crate) code: Option<i32>,
    pub(crate) stdout: Vec<u8>,
    pub(crate) stderr: String,
}

impl Scratch {
    /// A folder that holds `small.json`.
    pub(crate) fn new() -> Self {
        let scratch = Self(tempfile::tempdir().expect("a temporary folder"));
        fs::write(scratch.path("small.json"), SMALL).expect("a file in it");
        scratch
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// The names of everything in the folder, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("the folder");
        let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").file_name();
        let mut names: Vec<_> = entries.map(|entry| name(entry).to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// All files below a folder in it, by their path within that folder.
    pub(crate) fn tree(&self, folder: &str) -> BTreeMap<String, Vec<u8>> {
        let top = self.path(folder);
        let (mut found, mut folders) = (BTreeMap::new(), vec![top.clone()]);
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).expect("a folder") {
                let path = entry.expect("an entry").path();
                if path.is_dir() {
                    folders.push(path);
                } else {
                    let name = path.strip_prefix(&top).expect("it is below").display().to_string();
                    found.insert(name, fs::read(path).expect("a file"));
                }
            }
        }
        found
    }

    /// The program, to be run in the folder. Its standard streams are no terminals.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(assert_cmd::cargo::cargo_bin!("drape"));
        command.current_dir(self.0.path()).args(arguments).env_remove("NO_COLOR");
        command
    }

    /// Runs the program to its end.
    pub(crate) fn run(&self, arguments: &[&str]) -> Run {
        self.command(arguments).output().expect("the program starts").into()
    }

    /// Runs the program, which must succeed.
    pub(crate) fn succeed(&self, arguments: &[&str]) -> Vec<u8> {
        let run = self.run(arguments);
        assert_eq!(run.code, Some(0), "{arguments:?}: {}", run.stderr);
        run.stdout
    }

    /// Runs the program, which must succeed and print one JSON object and nothing else.
    pub(crate) fn json(&self, arguments: &[&str]) -> Value {
        let run = self.run(arguments);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{arguments:?}");
        run.object()
    }
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        let stderr = String::from_utf8(output.stderr).expect("messages in UTF-8");
        Self { code: output.status.code(), stdout: output.stdout, stderr }
    }
}

impl Run {
    /// Standard output as one JSON object on one line.
    pub(crate) fn object(&self) -> Value {
        let text = std::str::from_utf8(&self.stdout).expect("JSON in UTF-8");
        assert_eq!(text.matches('\n').count(), 1, "one line: {text}");
        let value: Value = serde_json::from_str(text).unwrap_or_else(|e| panic!("{e}: {text}"));
        assert!(value.is_object(), "{text}");
        value
    }

    /// Standard error as one JSON object: the error.
    pub(crate) fn error(&self) -> Value {
        serde_json::from_str(&self.stderr).unwrap_or_else(|e| panic!("{e}: {}", self.stderr))
    }
}

/// The folder of the stock scenes.
pub(crate) fn scene(name: &str) -> String {
    let path = crate::repository::path("scenes").join(name);
    path.to_str().expect("a path in UTF-8").to_owned()
}
