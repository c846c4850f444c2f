//! Every command of the README and of the pages in `docs/` does what it says, run in an empty folder.

use std::{
    fs,
    os::unix::fs::symlink,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use rayon::prelude::*;

fn repository() -> PathBuf {
    crate::repository::path("")
}

/// The pages whose commands are run here, each with the number of its `sh` lines: a page that loses one fails.
const PAGES: [(&str, usize); 6] = [
    ("README.md", 14),
    ("docs/commands.md", 19),
    ("docs/contact.md", 2),
    ("docs/gallery.md", 22),
    ("docs/recipes.md", 6),
    ("docs/verify.md", 3),
];

/// Pages with commands that other tests run or that only print times: `docs.rs`, `findings.rs` and `restless.rs` hold
/// their figures.
const ELSEWHERE: [&str; 6] = [
    "docs/cluster.md",
    "docs/findings.md",
    "docs/restless.md",
    "docs/speed.md",
    "docs/speed-history.md",
    "docs/stability.md",
];

fn text(page: &str) -> String {
    fs::read_to_string(repository().join(page)).unwrap_or_else(|error| panic!("{page}: {error}"))
}

/// The lines of all fenced blocks of a language in a page.
pub(crate) fn lines_of(page: &str, language: &str) -> Vec<String> {
    let (text, fence) = (text(page), format!("```{language}\n"));
    let blocks = text.split(&fence).skip(1);
    let lines = blocks.flat_map(|block| block.split("```").next().unwrap_or_default().lines());
    lines.map(str::to_owned).collect()
}

/// Every page for users: the README and `docs/*.md`.
fn pages() -> Vec<String> {
    let entries =
        fs::read_dir(repository().join("docs")).expect("the docs").map(|entry| entry.expect("an entry"));
    let names = entries.map(|entry| format!("docs/{}", entry.file_name().to_string_lossy()));
    names.filter(|name| name.ends_with(".md")).chain(["README.md".to_owned()]).collect()
}

/// A folder with `drape` on the path and the repository's scenes in it.
pub(crate) fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    symlink(repository().join("scenes"), folder.path().join("scenes")).expect("a link to the scenes");
    fs::create_dir(folder.path().join("bin")).expect("a folder");
    symlink(assert_cmd::cargo::cargo_bin!("drape"), folder.path().join("bin/drape")).expect("a link");
    folder
}

pub(crate) fn shell(line: &str, folder: &Path) -> Output {
    let path = std::env::var("PATH").expect("a path");
    Command::new("bash")
        .args(["-euo", "pipefail", "-c", line])
        .current_dir(folder)
        .env("PATH", format!("{}:{path}", folder.join("bin").display()))
        .output()
        .expect("bash runs")
}

/// The files that a line names as its outputs.
fn outputs(line: &str) -> Vec<&str> {
    let code = line.split('#').next().unwrap_or_default();
    let words = code.split_whitespace().filter(|word| !word.contains(['/', '$']));
    words
        .filter(|word| {
            [".png", ".apng", ".obj", ".ply", ".glb", ".gif"].iter().any(|ending| word.ends_with(ending))
        })
        .collect()
}

/// What a command left in the folder; folders end in `/`.
fn left(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder").map(|entry| entry.expect("an entry"));
    let name = |entry: fs::DirEntry| {
        let slash = if entry.path().is_dir() { "/" } else { "" };
        format!("{}{slash}", entry.file_name().to_string_lossy())
    };
    entries.map(name).filter(|name| !["scenes/", "bin/"].contains(&name.as_str())).collect()
}

/// Whether `.gitignore` has `/NAME`, or `/*.ENDING` for the name's ending.
fn ignored(name: &str) -> bool {
    let text = fs::read_to_string(repository().join(".gitignore")).expect("a .gitignore");
    let ending = name.rsplit_once('.').map(|(_, ending)| format!("/*.{ending}"));
    text.lines().any(|line| line == format!("/{name}") || Some(line) == ending.as_deref())
}

#[test]
fn every_command_runs_and_leaves_what_it_names() {
    let lines = PAGES.map(|(page, count)| {
        let lines = lines_of(page, "sh");
        assert_eq!(lines.len(), count, "commands of {page}");
        lines
    });
    all_run(&lines.concat());
}

#[test]
#[ignore = "takes minutes"]
fn every_long_command_runs() {
    let lines = lines_of("README.md", "bash");
    assert_eq!(lines.len(), 3);
    all_run(&lines);
}

#[test]
fn no_page_has_commands_that_nobody_runs() {
    let run = |page: &String| {
        let here = PAGES.iter().any(|(name, _)| name == page);
        let (short, long) = (lines_of(page, "sh").is_empty(), lines_of(page, "bash").is_empty());
        (short || here || ELSEWHERE.contains(&page.as_str())) && (long || page == "README.md")
    };
    assert_eq!(pages().into_iter().filter(|page| !run(page)).collect::<Vec<_>>(), Vec::<String>::new());
}

fn all_run(lines: &[String]) {
    let failed: Vec<String> = lines
        .par_iter()
        .filter_map(|line| {
            let folder = folder();
            let output = shell(line, folder.path());
            let missing: Vec<_> =
                outputs(line).into_iter().filter(|name| !folder.path().join(name).is_file()).collect();
            let said = String::from_utf8_lossy(&output.stderr);
            let seen_by_git =
                left(folder.path()).into_iter().filter(|name| !ignored(name)).collect::<Vec<_>>();
            let wrong = !output.status.success() || !missing.is_empty() || !seen_by_git.is_empty();
            wrong.then(|| {
                format!(
                    "{line}\n  {}, missing {missing:?}, not ignored {seen_by_git:?}\n{said}",
                    output.status
                )
            })
        })
        .collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn the_loop_over_stiffness_leaves_a_picture_each() {
    let line =
        lines_of("README.md", "sh").into_iter().find(|line| line.starts_with("for ks")).expect("the loop");
    let folder = folder();
    assert!(shell(&line, folder.path()).status.success(), "{line}");
    let pictures =
        ["ks-500.png", "ks-5000.png", "ks-50000.png"].map(|name| fs::read(folder.path().join(name)).ok());
    assert!(pictures.iter().all(Option::is_some), "{line}");
    assert!(pictures[0] != pictures[1] && pictures[1] != pictures[2], "stiffness shows");
}

/// An animation that a page shows is the one that its command makes now, and not that of an earlier program.
#[test]
fn the_folding_cloth_that_the_readme_shows_is_that_of_its_command() {
    let lines = lines_of("README.md", "sh");
    let line = lines.iter().find(|line| line.starts_with("drape animate")).expect("the animation");
    let folder = folder();
    assert!(shell(line, folder.path()).status.success(), "{line}");
    let shown = repository().join("docs/media/selfCollision.apng");
    let compared = shell(&format!("drape compare selfCollision.apng '{}'", shown.display()), folder.path());
    assert!(compared.status.success(), "{}", String::from_utf8_lossy(&compared.stderr));
}

/// The least and the largest number in some columns of a table, after the start of its first line.
fn extent(table: &str, columns: &[usize]) -> String {
    let table = table.lines().skip(2);
    let numbers = table.take_while(|line| line.starts_with('|')).flat_map(|line| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        columns.iter().map(|&column| cells[column].parse().expect("a number")).collect::<Vec<f64>>()
    });
    let (least, most) = numbers.fold((f64::MAX, 0_f64), |(least, most), n| (least.min(n), most.max(n)));
    format!("{least:.1} to {most:.1} times")
}

#[test]
fn the_speed_that_the_readme_names_is_that_of_the_tables() {
    let (readme, page) = (text("README.md"), text("docs/speed.md"));
    for (head, columns) in [("| ms a picture", &[4, 7][..]), ("| µs a step, after a second", &[4])] {
        // One of each machine.
        let tables: Vec<&str> = page.split(head).skip(1).collect();
        assert_eq!(tables.len(), 3, "{head}");
        for table in tables {
            let speed = extent(table, columns);
            assert!(readme.contains(&speed), "{head}: {speed}");
        }
    }
}

#[test]
fn the_mistake_is_shown_as_the_readme_shows_it() {
    let folder = folder();
    let scene = fs::read_to_string(repository().join("scenes/pinned2.json")).expect("a scene");
    fs::write(folder.path().join("cloth.json"), scene.replace("\"damping\"", "\"dampning\""))
        .expect("a file");
    let said = shell("drape check cloth.json", folder.path()).stdout;
    let expected = lines_of("README.md", "text").join("\n");
    assert!(expected.starts_with("error["), "the README shows a mistake");
    assert!(String::from_utf8_lossy(&said).contains(&expected), "{}", String::from_utf8_lossy(&said));
}
