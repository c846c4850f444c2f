//! The live page is used as a person uses it: with mouse and keys, files and links.

use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;

use drape::math::StateHash;
use drape::output::png;

use super::devtools::DevTools;
use super::{go, opened, settle};
use crate::scratch::{SMALL, Scratch};

const PAUSED: &str = "scene=sphere&frame=5&paused&size=320x250";

/// Drops a file with a text on the page.
fn drop_file(tools: &mut DevTools, name: &str, text: &str) {
    tools.eval(&format!(
        "(() => {{ const d = new DataTransfer(); d.items.add(new File([{text:?}], {name:?})); \
         document.body.dispatchEvent(new DragEvent('drop', {{dataTransfer: d, bubbles: true, cancelable: true}})); }})()"
    ));
}

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
fn hash_of(scratch: &Scratch, name: &str) -> String {
    let picture = png::read(&scratch.path(name)).unwrap();
    let mut hash = StateHash::default();
    picture.rgba.iter().for_each(|pixel| hash.write(&pixel[..3]));
    format!("{:016x}", hash.finish())
}

/// The command of what is shown gives the picture that is shown.
fn check_command(tools: &mut DevTools, scratch: &Scratch) {
    let (command, shown) = (tools.text("command"), tools.text("picture-hash"));
    assert_eq!(picture_of_command(scratch, &command), shown, "{command}");
}

#[test]
fn keys_and_buttons_move_the_cloth() {
    let Some(mut tools) = opened(PAUSED, 1400, false) else { return };
    settle(&mut tools);
    let still = tools.text("state-hash");
    tools.key("n", "KeyN");
    tools.wait("document.getElementById('frame').textContent === '6'");
    tools.click("step");
    tools.wait("document.getElementById('frame').textContent === '7'");
    assert_ne!(tools.text("state-hash"), still);
    tools.click("play");
    tools.wait("Number(document.getElementById('frame').textContent) > 12");
    assert_eq!(tools.text("status"), "running");
    tools.key("p", "KeyP");
    settle(&mut tools);
    assert_eq!(tools.text("status"), "paused");
    tools.key("r", "KeyR");
    tools.wait("document.getElementById('frame').textContent === '0'");
    // The camera: turned by the mouse and by keys, and back.
    settle(&mut tools);
    let (straight, state) = (tools.text("picture-hash"), tools.text("state-hash"));
    tools.drag("#view", [0.5, 0.5], [0.6, 0.4]);
    settle(&mut tools);
    let turned = tools.text("picture-hash");
    tools.key("ArrowLeft", "ArrowLeft");
    settle(&mut tools);
    let further = tools.text("picture-hash");
    assert!(straight != turned && turned != further);
    tools.key(" ", "Space");
    settle(&mut tools);
    assert_eq!((tools.text("picture-hash"), tools.text("state-hash")), (straight, state));
    assert_eq!(tools.console, Vec::<String>::new());
}

#[test]
fn a_slider_changes_the_cloth_and_its_command() {
    let link = PAUSED.replace("sphere", "pinned2");
    let Some(mut tools) = opened(&link, 1400, true) else { return };
    settle(&mut tools);
    let scratch = Scratch::new();
    check_command(&mut tools, &scratch);
    let before = (tools.text("state-hash"), tools.text("gauge"));
    let place = "Number(document.querySelector('[id=\"slider-cloth.ks\"]').value) / 1000";
    let from = tools.eval(place).as_f64().unwrap();
    tools.drag("[id=\"slider-cloth.ks\"]", [from, 0.5], [0.3, 0.5]);
    settle(&mut tools);
    assert!(tools.text("command").contains("--set cloth.ks="), "{}", tools.text("command"));
    let after = (tools.text("state-hash"), tools.text("gauge"));
    assert!(before.0 != after.0 && before.1 != after.1, "{after:?}");
    assert_eq!(tools.text("frame"), "5", "the moment stays");
    check_command(&mut tools, &scratch);
    // The address is a link to this moment.
    let (link, picture) = (tools.eval("location.hash"), tools.text("picture-hash"));
    go(&mut tools, "scene=plane&frame=0&paused");
    go(&mut tools, link.as_str().unwrap().trim_start_matches('#'));
    assert_eq!(tools.text("picture-hash"), picture);
    // Beyond its mark the step is refused as on the command line.
    let mark = "document.querySelector('.track .mark:not([hidden])') !== null";
    assert_eq!(tools.eval(mark), true);
    go(&mut tools, "scene=sphere&frame=3&paused&set=cloth.ks=400000");
    let run =
        scratch.run(&["render", "scenes/sphere.json", "x.png", "--frame", "3", "--set", "cloth.ks=400000"]);
    assert_eq!((run.code, run.stderr.trim_end()), (Some(5), tools.text("status").as_str()));
    assert_eq!(tools.console, Vec::<String>::new());
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
fn the_page_fits_every_window_and_names_every_control() {
    for (width, dark, paper) in [(1400, false, "rgb(255, 255, 255)"), (390, true, "rgb(23, 23, 26)")] {
        let Some(mut tools) = opened(&format!("{PAUSED}&ledger"), width, dark) else { return };
        settle(&mut tools);
        tools.eval("document.querySelector('details').open = true");
        let sizes = tools.eval("[innerWidth, document.documentElement.scrollWidth]");
        assert!(sizes[0] == width && sizes[1].as_u64() <= Some(width.into()), "{width}: {sizes}");
        assert_eq!(tools.eval("getComputedStyle(document.body).backgroundColor"), paper);
        let nameless = tools.eval(
            "[...document.querySelectorAll('button, input, select, textarea, canvas')].filter((e) => \
             !(e.labels?.length || e.getAttribute('aria-label') || e.textContent.trim())).map((e) => e.outerHTML)",
        );
        assert_eq!(nameless, serde_json::json!([]));
        assert_eq!(tools.console, Vec::<String>::new());
    }
}

#[test]
fn textures_are_dropped_and_the_scene_can_be_taken_away() {
    let Some(mut tools) = opened(PAUSED, 1400, false) else { return };
    settle(&mut tools);
    let scratch = Scratch::new();
    let before = tools.text("picture-hash");
    // A texture of one colour, drawn by the browser itself.
    tools.eval(
        "(async () => { const c = new OffscreenCanvas(4, 4); const p = c.getContext('2d'); p.fillStyle = '#336699'; \
         p.fillRect(0, 0, 4, 4); const d = new DataTransfer(); \
         d.items.add(new File([await c.convertToBlob()], 'blue.png', {type: 'image/png'})); \
         document.body.dispatchEvent(new DragEvent('drop', {dataTransfer: d, bubbles: true, cancelable: true})); })()",
    );
    tools.wait("document.getElementById('command').textContent.includes('material.texture')");
    settle(&mut tools);
    assert_ne!(tools.text("picture-hash"), before);
    assert!(tools.text("command").contains("--textures textures"), "{}", tools.text("command"));
    let pixel =
        "[...document.getElementById('view').getContext('2d').getImageData(160, 200, 1, 1).data].join()";
    assert_eq!(tools.eval(pixel), "51,102,153,255");
    // The scene with its changes, as a file, is the scene that is shown.
    go(&mut tools, "scene=plane&frame=20&paused&shader=normal&size=64x50&set=cloth.ks=700");
    let text = tools.eval("document.getElementById('text').value");
    fs::write(scratch.path("taken.json"), text.as_str().unwrap()).unwrap();
    let hash = scratch.succeed(&["render", "taken.json", "--frame", "20", "--hash"]);
    assert_eq!(String::from_utf8(hash).unwrap().trim(), tools.text("picture-hash"));
    assert_eq!(tools.console, Vec::<String>::new());
}

#[test]
fn the_gallery_links_to_the_moment_of_a_picture() {
    let Some(mut tools) = opened(PAUSED, 1400, false) else { return };
    settle(&mut tools);
    let scratch = Scratch::new();
    let figure = ["gallery", "out", "--only", "part5-bump16", "--only", "part1-shear"];
    scratch.succeed(&[&figure[..], &["--live", "live.html"]].concat());
    let page = String::from_utf8(scratch.read("out/index.html")).unwrap();
    for name in ["part1-shear", "part5-bump16"] {
        let (_, section) = page.split_once(&format!("<section id=\"{name}\">")).unwrap();
        let (_, link) = section.split_once("<a href=\"live.html#").unwrap();
        let link = link.split('"').next().unwrap().replace("&amp;", "&");
        go(&mut tools, &link);
        assert_eq!(tools.text("picture-hash"), hash_of(&scratch, &format!("out/{name}.png")), "{link}");
    }
    assert_eq!(tools.console, Vec::<String>::new());
}
