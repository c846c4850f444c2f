//! What other programs are told: schema, completions, manual pages.

use std::process::Command;

use crate::scratch::Scratch;

/// The commands, as the help lists them.
fn commands(scratch: &Scratch) -> Vec<String> {
    let help = String::from_utf8(scratch.succeed(&["--help"])).expect("text");
    let list = help.split("Commands:").nth(1).and_then(|rest| rest.split("\n\n").next()).expect("a list");
    let lines = list.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names: Vec<String> =
        lines.filter_map(|line| line.split_whitespace().next()).map(str::to_owned).collect();
    assert!(names.len() > 8 && names.contains(&"animate".to_owned()), "{names:?}");
    names
}

#[test]
fn the_schema_is_that_of_the_library() {
    let printed = Scratch::new().succeed(&["schema"]);
    let schema: serde_json::Value = serde_json::from_slice(&printed).unwrap();
    assert_eq!(schema, drape::scene::schema());
}

#[test]
fn completions_know_every_command_in_every_shell() {
    let scratch = Scratch::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = String::from_utf8(scratch.succeed(&["completions", shell])).unwrap();
        for command in commands(&scratch) {
            assert!(script.contains(&command), "{shell}: {command}");
        }
        assert!(script.contains("until-rest"), "{shell}");
        // The others complete no values.
        let values = ["bash", "zsh", "fish"].contains(&shell);
        assert_eq!(script.contains("displacement"), values, "{shell}");
    }
}

#[cfg(unix)]
#[test]
fn bash_completes_with_its_script() {
    let scratch = Scratch::new();
    std::fs::write(scratch.path("script"), scratch.succeed(&["completions", "bash"])).unwrap();
    let complete = |words: &str, last: &str| {
        let line = format!(
            "source ./script; COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); \
             _drape drape '{last}' x; echo ${{COMPREPLY[@]}}"
        );
        let output = Command::new("bash").args(["-c", &line]).current_dir(scratch.path("")).output().unwrap();
        String::from_utf8(output.stdout).unwrap().trim().to_owned()
    };
    assert_eq!(complete("drape ani", "ani"), "animate");
    assert_eq!(complete("drape animate --fra", "--fra"), "--frames");
}

#[test]
fn every_command_has_a_manual_page() {
    let scratch = Scratch::new();
    let page =
        |arguments: &[&str]| String::from_utf8(scratch.succeed(&[&["man"], arguments].concat())).unwrap();
    let all = page(&[]);
    assert!(all.contains(".TH drape 1"), "{all}");
    for command in commands(&scratch) {
        let listed = format!("drape-{command}(1)").replace('-', "\\-");
        assert!(all.contains(&listed), "{command}: {all}");
        let own = page(&[&command]);
        assert!(own.contains(&format!(".TH drape-{command} 1")), "{own}");
        assert!(
            own.contains(".SH SYNOPSIS") && own.contains(&format!("drape {command}").replace('-', "\\-")),
            "{own}"
        );
    }
    let render = page(&["render"]);
    for option in ["shader", "until\\-rest", "threads"] {
        assert!(render.contains(&format!("\\-\\-{option}")), "{option}: {render}");
    }
}
