//! The programs of `docs/recipes.md` in other languages run, with the files that its commands make.

use std::fs;
use std::process::Command;

use super::{installed, not_checked, program};
use crate::readme::{folder, lines_of, shell};
use crate::repository;

/// The block of a page that starts with ```` ```LANGUAGE ````.
fn block(language: &str) -> String {
    let text = fs::read_to_string(repository::path("docs/recipes.md")).expect("the page");
    let (_, rest) = text.split_once(&format!("```{language}\n")).unwrap_or_else(|| panic!("no {language}"));
    rest.split("```").next().expect("its end").to_owned()
}

/// What a program in Python prints after the command of the page that has `word`; nothing without the module.
fn python_after(word: &str, language: &str, module: &str) -> Option<String> {
    let interpreter = installed("venv/bin/python");
    let has = |module: &str| {
        Command::new(&interpreter)
            .args(["-c", &format!("import {module}")])
            .output()
            .is_ok_and(|o| o.status.success())
    };
    if !interpreter.exists() || !has(module) {
        if module == "bpy" {
            println!("not checked: {language}: there is no `bpy`");
        } else {
            not_checked(language, ".ci/install-readers has not run");
        }
        return None;
    }
    let folder = folder();
    let line =
        lines_of("docs/recipes.md", "sh").into_iter().find(|line| line.contains(word)).expect("a command");
    assert!(shell(&line, folder.path()).status.success(), "{line}");
    let run =
        Command::new(interpreter).args(["-c", &block(language)]).current_dir(folder.path()).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    Some(String::from_utf8_lossy(&run.stdout).into_owned())
}

#[test]
fn the_notebook_reads_points_and_pictures() {
    let Some(said) = python_after("points.npy", "python notebook", "PIL") else { return };
    assert!(said.contains("lowest point 0.") && said.contains("(250, 320, 3)"), "{said}");
}

#[test]
fn blender_opens_the_animation() {
    let Some(said) = python_after("cloth.glb", "python blender", "bpy") else { return };
    assert!(said.contains("400 points, 31 shapes"), "{said}");
}

#[test]
fn the_film_is_made_where_ffmpeg_is() {
    let scratch = crate::scratch::Scratch::new();
    if program(&scratch, "ffmpeg", &["-version"]).is_none() {
        return;
    }
    let folder = folder();
    let line = block("shell");
    let run = shell(line.trim(), folder.path());
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    assert!(folder.path().join("film.mp4").exists());
}
