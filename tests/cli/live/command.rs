//! The command that the page shows, run by a shell.

use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;

use drape::math::StateHash;
use drape::output::png;

use super::devtools::DevTools;
use crate::scratch::Scratch;

/// The hash of the picture that the page's command makes, run by a shell in a folder with the scenes.
fn picture_of_command(scratch: &Scratch, command: &str) -> String {
    if !scratch.path("scenes").exists() {
        symlink(crate::repository::path("scenes"), scratch.path("scenes")).unwrap();
    }
    let program = assert_cmd::cargo::cargo_bin!("drape");
    let line = command.replacen("drape", &program.display().to_string(), 1);
    let run = Command::new("bash").args(["-c", &line]).current_dir(scratch.path("")).output().unwrap();
    assert!(run.status.success(), "{command}: {}", String::from_utf8_lossy(&run.stderr));
    let name = scratch.names().into_iter().find(|name| name.ends_with(".png")).unwrap();
    let hash = hash_of(scratch, &name);
    fs::remove_file(scratch.path(&name)).unwrap();
    hash
}

/// The hash of a picture in a file.
pub(super) fn hash_of(scratch: &Scratch, name: &str) -> String {
    let picture = png::read(&scratch.path(name)).unwrap();
    let mut hash = StateHash::default();
    picture.rgba.iter().for_each(|pixel| hash.write(&pixel[..3]));
    format!("{:016x}", hash.finish())
}

/// The command of what is shown gives the picture that is shown.
pub(super) fn check_command(tools: &mut DevTools, scratch: &Scratch) {
    let (command, shown) = (tools.text("command"), tools.text("picture-hash"));
    assert_eq!(picture_of_command(scratch, &command), shown, "{command}");
}
