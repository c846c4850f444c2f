//! The gallery: its pictures are those of the commands that it shows, from any folder and for any
//! number of threads.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

/// Figures that take little time, of several simulations and shaders.
const FIGURES: [&str; 5] = ["part1-struct+bend", "part4-hd1", "part4-lk1", "part5-disp16", "part5-cballb"];

fn drape(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("drape"));
    command.current_dir(folder).args(arguments).output().expect("the program starts")
}

/// Runs a line that begins with `drape` as a shell does.
fn shell(folder: &Path, line: &str) -> Output {
    let program = format!("'{}'", assert_cmd::cargo::cargo_bin!("drape").display());
    let line = line.replacen("drape", &program, 1);
    Command::new("sh").args(["-c", &line]).current_dir(folder).output().expect("the shell starts")
}

fn gallery(folder: &Path, out: &str, threads: &str) -> Output {
    let only = FIGURES.iter().flat_map(|name| ["--only", name]);
    let arguments: Vec<&str> = ["gallery", out, "--threads", threads].into_iter().chain(only).collect();
    drape(folder, &arguments)
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn read(path: PathBuf) -> Vec<u8> {
    fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Everything between `open` and the next `close`.
fn between<'a>(text: &'a str, open: &str, close: &str) -> Vec<&'a str> {
    text.split(open).skip(1).map(|rest| rest.split(close).next().unwrap_or_default()).collect()
}

#[test]
fn every_command_on_the_page_makes_its_picture() {
    let folder = folder();
    let output = gallery(folder.path(), "out", "2");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stdout.is_empty());
    let page = String::from_utf8(read(folder.path().join("out/index.html"))).expect("UTF-8");
    let scenes = crate::repository::path("scenes");
    symlink(scenes, folder.path().join("scenes")).expect("a link to the scenes");
    let commands = between(&page, "<pre>", "</pre>");
    assert_eq!(commands.len(), FIGURES.len());
    assert!(commands.iter().any(|command| command.contains("'camera.target=[")), "lists are quoted");
    for (command, name) in commands.iter().zip(FIGURES) {
        assert!(
            command.starts_with("drape render ") && command.contains(&format!(" {name}.png ")),
            "{command}"
        );
        let output = shell(folder.path(), command);
        assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
        let file = format!("{name}.png");
        assert!(read(folder.path().join(&file)) == read(folder.path().join("out").join(&file)), "{command}");
        let size = &read(folder.path().join("out").join(&file))[16..24];
        assert_eq!(size, [0, 0, 4, 0, 0, 0, 3, 32], "{name} is 1024 x 800");
    }
}

#[test]
fn page_and_pictures_are_the_same_bytes_for_every_number_of_threads() {
    let folder = folder();
    for threads in ["1", "3"] {
        assert!(gallery(folder.path(), threads, threads).status.success());
    }
    let mut names: Vec<_> = FIGURES.iter().map(|name| format!("{name}.png")).collect();
    names.push("index.html".to_owned());
    for name in names {
        let [one, three] = ["1", "3"].map(|out| read(folder.path().join(out).join(&name)));
        assert!(one == three, "{name}");
    }
}

/// The files of states that are kept in a folder, in order.
fn states(folder: &Path) -> Vec<PathBuf> {
    let within = |folder: &Path| {
        fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path()).collect::<Vec<_>>()
    };
    let files = within(&folder.join("cells")).into_iter().flat_map(|folder| within(&folder));
    let mut states: Vec<PathBuf> =
        files.filter(|file| file.extension().is_some_and(|e| e == "state")).collect();
    states.sort();
    states
}

#[test]
fn parts_in_any_order_kills_and_damage_change_no_byte() {
    let folder = folder();
    // Three moments of one simulation, one of another, and the start of a third.
    let only = ["part4-hd1", "part4-hd2", "part4-hd3", "part4-lk1", "part1-all"];
    let run = |out: &str, more: &[&str]| {
        let only = only.iter().flat_map(|name| ["--only", name]);
        let words = ["gallery", out, "--size", "64x50"].into_iter().chain(only).chain(more.iter().copied());
        let mut command = Command::new(assert_cmd::cargo::cargo_bin!("drape"));
        command.current_dir(folder.path()).args(words).stderr(Stdio::piped()).stdout(Stdio::null());
        command
    };
    let said = |mut command: Command| {
        let output = command.output().expect("the program starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    let whole = said(run("whole", &[]));
    assert!(!whole.contains("damaged"), "{whole}");
    let [whole, parts] = ["whole", "parts"].map(|out| folder.path().join(out));
    let count = states(&whole).len();
    assert_eq!(count, 4);

    // One part is killed once it has a state.
    let mut killed = run("parts", &["--part", "1/2"]).spawn().expect("the program starts");
    while states(&parts).is_empty() && killed.try_wait().expect("a status").is_none() {
        std::thread::sleep(Duration::from_millis(5));
    }
    killed.kill().expect("a signal");
    killed.wait().expect("a status");
    said(run("parts", &["--part", "1/2"]));
    assert_eq!(states(&parts).len(), 3, "the longest simulation");
    said(run("parts", &["--part", "2/2"]));
    assert!(!parts.join("part4-hd1.png").exists(), "a part takes no picture");
    assert_eq!(states(&parts).len(), count);
    assert!(said(run("parts", &["--part", "1/2"])).contains(": 0 results made, "), "nothing is run again");
    let damaged = &states(&parts)[1];
    let mut bytes = read(damaged.clone());
    bytes[5000] ^= 1;
    fs::write(damaged, &bytes).expect("a file");
    let warned = said(run("parts", &[]));
    assert_eq!(warned.matches("warning: the result `").count(), 1, "{warned}");
    assert!(warned.contains("was damaged\n  = help: it was made again"), "{warned}");
    let pictures = only.iter().map(|name| format!("{name}.png"));
    for name in pictures.chain(["index.html".to_owned()]) {
        let [whole, parts] = [&whole, &parts].map(|out| read(out.join(&name)));
        assert!(whole == parts, "{name}");
    }
    for (a, b) in states(&whole).into_iter().zip(states(&parts)) {
        assert!(a.file_name() == b.file_name() && read(a) == read(b));
    }
}

#[test]
fn a_page_of_some_figures_shows_these() {
    let folder = folder();
    let only = ["gallery", "--only", "part1-all", "--only", "part3-plane", "--size", "64x50"];
    let output = drape(folder.path(), &only);
    assert!(output.status.success());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.ends_with("gallery/index.html: figures 2, pictures 3\n"), "{said}");
    let mut names: Vec<_> =
        fs::read_dir(folder.path().join("gallery")).expect("the folder").flatten().collect();
    names.sort_by_key(fs::DirEntry::file_name);
    let names: Vec<_> = names.iter().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    assert_eq!(
        names,
        ["cells", "index.html", "part1-all.png", "part3-plane-textured.png", "part3-plane.png"]
    );
    let page = String::from_utf8(read(folder.path().join("gallery/index.html"))).expect("UTF-8");
    assert_eq!(between(&page, "<section id=\"", "\""), ["part1-all", "part3-plane"]);
}

#[test]
fn an_unknown_figure_is_refused_before_anything_is_made() {
    let folder = folder();
    let output = drape(folder.path(), &["gallery", "--only", "art1-all"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("no figure `art1-all`") && said.contains("part5-cclothr"), "{said}");
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 0);
}
