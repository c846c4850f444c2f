//! The live page is used as a person uses it: with mouse, keys and links.

use drape::math;

use super::command::{check_command, hash_of};
use super::devtools::DevTools;
use super::{PAUSED, go, opened, settle};
use crate::scratch::Scratch;

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
    tools.drag("left", "#view", [0.5, 0.5], [0.6, 0.4]);
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

/// Waits until another picture is shown than the one with the hash `before`; its hash.
fn next_picture(tools: &mut DevTools, before: &str) -> String {
    tools.wait(&format!("document.getElementById('picture-hash').textContent !== {before:?}"));
    settle(tools);
    tools.text("picture-hash")
}

/// Distance, target, polar angle and azimuth of the camera.
fn camera(tools: &mut DevTools) -> Vec<f64> {
    let found = tools.eval("[camera.distance, ...camera.target, camera.polar, camera.azimuth]");
    found.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

#[test]
fn wheel_and_buttons_of_the_mouse_move_the_camera() {
    let Some(mut tools) = opened(PAUSED, 1400, false) else { return };
    settle(&mut tools);
    let (state, before) = (tools.text("state-hash"), tools.text("picture-hash"));
    let first = camera(&mut tools);
    // The wheel towards the hand zooms out, and nothing else.
    tools.wheel("#view", 100.0);
    let zoomed_picture = next_picture(&mut tools, &before);
    let zoomed = camera(&mut tools);
    assert!((zoomed[0] / first[0] - math::exp(0.1)).abs() < 1e-3, "{first:?} {zoomed:?}");
    assert_eq!(zoomed[1..], first[1..]);
    // The right button moves the target: what is seen follows the hand.
    tools.drag("right", "#view", [0.5, 0.5], [0.6, 0.5]);
    next_picture(&mut tools, &zoomed_picture);
    let moved = camera(&mut tools);
    assert_eq!([moved[0], moved[4], moved[5]], [zoomed[0], zoomed[4], zoomed[5]]);
    let shape = tools.eval("(({clientWidth: w, clientHeight: h}) => w / h)(document.getElementById('view'))");
    let expected = 0.1 * shape.as_f64().unwrap() * 2.0 * zoomed[0] * math::tan(17.5_f64.to_radians());
    assert!((zoomed[1] - moved[1] - expected).abs() < 0.02 * expected, "{zoomed:?} {moved:?} {expected}");
    assert_eq!(tools.text("state-hash"), state, "the cloth does not move");
    check_command(&mut tools, &Scratch::new());
    assert_eq!(tools.console, Vec::<String>::new());
}

#[test]
fn fingers_turn_move_and_zoom() {
    let Some(mut tools) = opened(PAUSED, 390, false) else { return };
    settle(&mut tools);
    let (state, mut picture) = (tools.text("state-hash"), tools.text("picture-hash"));
    let first = camera(&mut tools);
    // One finger turns: what is seen follows it.
    tools.touch("#view", &[[[0.4, 0.5], [0.6, 0.5]]]);
    picture = next_picture(&mut tools, &picture);
    let turned = camera(&mut tools);
    assert_eq!(turned[..5], first[..5]);
    assert!(turned[5] < first[5], "{first:?} {turned:?}");
    // Two fingers that part to twice their distance bring the camera to half of its.
    tools.touch("#view", &[[[0.4, 0.5], [0.3, 0.5]], [[0.6, 0.5], [0.7, 0.5]]]);
    picture = next_picture(&mut tools, &picture);
    let zoomed = camera(&mut tools);
    assert!((zoomed[0] / turned[0] - 0.5).abs() < 0.02, "{turned:?} {zoomed:?}");
    assert_eq!(zoomed[4..], turned[4..], "it does not turn");
    // Two fingers that move together move the target.
    tools.touch("#view", &[[[0.4, 0.4], [0.4, 0.6]], [[0.6, 0.4], [0.6, 0.6]]]);
    next_picture(&mut tools, &picture);
    let moved = camera(&mut tools);
    assert!((moved[0] / zoomed[0] - 1.0).abs() < 0.02 && moved[2] > zoomed[2], "{zoomed:?} {moved:?}");
    assert_eq!(tools.text("state-hash"), state, "the cloth does not move");
    check_command(&mut tools, &Scratch::new());
    assert_eq!(tools.console, Vec::<String>::new());
}

#[test]
fn the_keyboard_alone_reaches_every_control_and_shows_where_it_is() {
    let Some(mut tools) = opened(&format!("{PAUSED}&shader=custom"), 1400, false) else { return };
    settle(&mut tools);
    tools.eval("document.querySelector('details').open = true");
    let every = "[...document.querySelectorAll('button, input, select, textarea, summary, [tabindex=\"0\"]')]\
        .filter((e) => e.checkVisibility())";
    let count = tools.eval(&format!("(window.every = {every}).length")).as_u64().unwrap();
    assert!(count > 40, "{count}");
    let mut walked = Vec::new();
    for _ in 0..count {
        tools.key("Tab", "Tab");
        walked.push(tools.eval("every.indexOf(document.activeElement)").as_u64());
        let outline = tools.eval("getComputedStyle(document.activeElement).outlineStyle");
        assert_eq!(outline, "solid", "{:?}", tools.eval("document.activeElement.outerHTML"));
    }
    assert_eq!(walked, (0..count).map(Some).collect::<Vec<_>>(), "in the order of the page");
    // A slider and a button do by keys what they do by mouse.
    tools.eval("document.querySelector('[id=\"slider-cloth.ks\"]').focus()");
    tools.key("ArrowRight", "ArrowRight");
    tools.wait("document.getElementById('command').textContent.includes('--set cloth.ks=')");
    tools.eval("document.getElementById('defaults').focus()");
    tools.key("Enter", "Enter");
    tools.wait("!document.getElementById('command').textContent.includes('cloth.ks')");
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
    tools.drag("left", "[id=\"slider-cloth.ks\"]", [from, 0.5], [0.3, 0.5]);
    settle(&mut tools);
    assert!(tools.text("command").contains("--set cloth.ks="), "{}", tools.text("command"));
    let after = (tools.text("state-hash"), tools.text("gauge"));
    assert!(before.0 != after.0 && before.1 != after.1, "{after:?}");
    assert_eq!(tools.text("frame"), "5", "the moment stays");
    check_command(&mut tools, &scratch);
    // The address is a link to this moment.
    tools.wait("location.hash === link()");
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
