//! Files are given to the live page, by drop and by paste, and taken away from it.

use std::fs;
use std::thread;
use std::time::{Duration, Instant};

use drape::output::png::{self, Effort};
use serde_json::json;

use super::command::{check_command, hash_of};
use super::devtools::DevTools;
use super::{PAUSED, go, opened, settle};
use crate::scratch::{SMALL, Scratch};

/// Drops or pastes what an expression of the page's language puts into `d`, a `DataTransfer`.
fn give(tools: &mut DevTools, event: &str, filling: &str) {
    let event = match event {
        "drop" => "new DragEvent('drop', {dataTransfer: d, bubbles: true, cancelable: true})",
        _ => "new ClipboardEvent('paste', {clipboardData: d, bubbles: true, cancelable: true})",
    };
    tools.eval(&format!(
        "(async () => {{ const d = new DataTransfer(); {filling}; document.body.dispatchEvent({event}); }})()"
    ));
}

/// Drops a file with a text on the page.
fn drop_file(tools: &mut DevTools, name: &str, text: &str) {
    give(tools, "drop", &format!("d.items.add(new File([{text:?}], {name:?}))"));
}

/// Drops pictures of one colour each, drawn by the browser itself: names without ending, and colours.
fn drop_pictures(tools: &mut DevTools, pictures: &[(&str, &str)]) {
    let pictures = json!(pictures);
    give(
        tools,
        "drop",
        &format!(
            "for (const [name, color] of {pictures}) {{ const c = new OffscreenCanvas(4, 4); const p = c.getContext('2d'); \
             p.fillStyle = color; p.fillRect(0, 0, 4, 4); \
             d.items.add(new File([await c.convertToBlob()], `${{name}}.png`, {{type: 'image/png'}})); }}"
        ),
    );
}

/// The colour of a pixel of the canvas.
fn pixel(tools: &mut DevTools, [x, y]: [u32; 2]) -> String {
    let data = format!(
        "[...document.getElementById('view').getContext('2d').getImageData({x}, {y}, 1, 1).data].join()"
    );
    tools.eval(&data).as_str().unwrap().to_owned()
}

#[test]
fn a_scene_of_ones_own_has_the_errors_of_the_command_line() {
    let Some(mut tools) = opened(PAUSED, 390, false) else { return };
    settle(&mut tools);
    let scratch = Scratch::new();
    let picture = tools.text("picture-hash");
    let broken = SMALL.replace("\"damping\": 0.2", "\"dampning\": 0.2");
    fs::write(scratch.path("mine.json"), &broken).unwrap();
    drop_file(&mut tools, "mine.json", &broken);
    tools.wait("document.getElementById('errors').textContent");
    let run = scratch.run(&["render", "mine.json", "mine.png"]);
    assert_eq!(run.stderr.trim_end(), tools.text("errors"));
    assert_eq!(tools.text("status"), tools.text("errors"));
    assert_eq!(tools.text("picture-hash"), picture, "the picture stays");
    give(&mut tools, "paste", &format!("d.setData('text/plain', {broken:?})"));
    let pasted = run.stderr.trim_end().replace("mine.json", "pasted.json");
    tools.wait(&format!("document.getElementById('errors').textContent === {pasted:?}"));
    fs::write(scratch.path("pasted.json"), SMALL).unwrap();
    give(&mut tools, "paste", &format!("d.setData('text/plain', {SMALL:?})"));
    tools.wait("Number(document.getElementById('frame').textContent) > 3");
    tools.key("p", "KeyP");
    settle(&mut tools);
    assert!(tools.text("command").contains("pasted.json"), "{}", tools.text("command"));
    check_command(&mut tools, &scratch);
    fs::write(scratch.path("mine.json"), SMALL).unwrap();
    drop_file(&mut tools, "mine.json", SMALL);
    tools.wait("document.getElementById('status').textContent === 'running'");
    tools.wait("Number(document.getElementById('frame').textContent) > 10");
    tools.key("p", "KeyP");
    settle(&mut tools);
    assert_eq!(tools.text("status"), "paused");
    check_command(&mut tools, &scratch);
    go(&mut tools, "scene=sphere&frame=x");
    assert!(tools.text("status").contains("must be a whole number"), "{}", tools.text("status"));
    assert_eq!(tools.console, Vec::<String>::new());
}

#[test]
fn a_texture_and_a_cube_map_are_dropped() {
    let Some(mut tools) = opened(PAUSED, 1400, false) else { return };
    settle(&mut tools);
    let scratch = Scratch::new();
    let before = tools.text("picture-hash");
    drop_pictures(&mut tools, &[("blue", "#336699")]);
    tools.wait("document.getElementById('command').textContent.includes('material.texture')");
    settle(&mut tools);
    assert_ne!(tools.text("picture-hash"), before);
    assert!(tools.text("command").contains("--textures textures"), "{}", tools.text("command"));
    assert_eq!(pixel(&mut tools, [160, 200]), "51,102,153,255");
    // Six faces are a cube map, which the mirrors show.
    let faces = [
        ("posx", "#ff0000"),
        ("negx", "#00ff00"),
        ("posy", "#0000ff"),
        ("negy", "#ffff00"),
        ("posz", "#ff00ff"),
        ("negz", "#00ffff"),
    ];
    go(&mut tools, "scene=plane&frame=0&paused&size=64x50&shader=mirror");
    let built_in = tools.text("picture-hash");
    // Some of the faces alone change nothing, and the page says what it waits for.
    drop_pictures(&mut tools, &faces[..4]);
    tools.wait("document.getElementById('faces').textContent.includes('4 of 6 faces')");
    assert!(tools.text("faces").ends_with("still missing: posz, negz"), "{}", tools.text("faces"));
    drop_pictures(&mut tools, &faces[4..5]);
    tools.wait("document.getElementById('faces').textContent.includes('5 of 6 faces')");
    assert_eq!(tools.text("picture-hash"), built_in);
    drop_pictures(&mut tools, &faces[5..]);
    tools.wait(&format!("document.getElementById('picture-hash').textContent !== '{built_in}'"));
    settle(&mut tools);
    fs::create_dir_all(scratch.path("textures/cube")).unwrap();
    for (name, color) in faces {
        let byte = |at: usize| u8::from_str_radix(&color[at..at + 2], 16).unwrap();
        let rgb = [byte(1), byte(3), byte(5)].repeat(16);
        let face = png::encode(4, 4, &rgb, Effort::Small).unwrap();
        fs::write(scratch.path(&format!("textures/cube/{name}.png")), face).unwrap();
    }
    check_command(&mut tools, &scratch);
    assert_eq!(tools.console, Vec::<String>::new());
}

#[test]
fn the_scene_and_the_files_of_a_moment_can_be_taken_away() {
    let Some(mut tools) = opened(PAUSED, 1400, false) else { return };
    settle(&mut tools);
    let scratch = Scratch::new();
    let folder = scratch.path("");
    tools.call("Browser.setDownloadBehavior", &json!({"behavior": "allow", "downloadPath": folder}));
    go(&mut tools, "scene=plane&frame=20&paused&shader=normal&size=64x50&set=cloth.ks=700");
    let mut take = |button: &str, name: &str| {
        tools.click(button);
        let started = Instant::now();
        while !scratch.path(name).exists() {
            assert!(started.elapsed() < Duration::from_secs(60), "no {name}: {:?}", scratch.names());
            thread::sleep(Duration::from_millis(5));
        }
    };
    take("save-scene", "plane.json");
    take("save-png", "plane-20.png");
    take("save-positions", "plane-20.bin");
    take("save-state", "plane-20.state");
    // The scene with its changes is the scene that is shown.
    let hash = scratch.succeed(&["render", "plane.json", "--frame", "20", "--hash"]);
    assert_eq!(String::from_utf8(hash).unwrap().trim(), tools.text("picture-hash"));
    assert_eq!(hash_of(&scratch, "plane-20.png"), tools.text("picture-hash"));
    // The files are those of the command line, which goes on from the state.
    let simulate = ["simulate", "plane.json", "-q", "--frames"];
    let files = ["20", "--positions", "points", "--save-state", "state"];
    scratch.succeed(&[&simulate[..], &files].concat());
    assert!(scratch.read("plane-20.bin") == scratch.read("points"), "the positions");
    assert!(scratch.read("plane-20.state") == scratch.read("state"), "the state");
    let on = ["22", "--from-state", "plane-20.state", "--positions", "on"];
    scratch.succeed(&[&simulate[..], &on].concat());
    scratch.succeed(&[&simulate[..], &["22", "--positions", "whole"]].concat());
    assert!(scratch.read("on") == scratch.read("whole"), "what follows");
    assert_eq!(tools.console, Vec::<String>::new());
}
