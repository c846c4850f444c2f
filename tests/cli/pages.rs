//! The pages that the program writes are opened in a real browser.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::browser::{self, Browser};

/// A cloth and a ball with a texture: a scene in which every part of every page has something to show.
const SCENE: &str = r#"{"cloth": {"width": 1, "height": 1, "num_width_points": 6,
    "num_height_points": 6, "thickness": 0.0095, "orientation": 0, "pinned": [[0, 0], [5, 0]],
    "damping": 0.2, "density": 150, "ks": 5000, "enable_structural": true,
    "enable_shearing": true, "enable_bending": true},
    "sphere": {"origin": [0.5, 0.2, 0.5], "radius": 0.2, "friction": 0.3},
    "material": {"shader": "texture"}, "render": {"size": [64, 50], "time": 0.1}}"#;

/// Runs the program on the scene in `folder`; the page that it writes to `page`.
fn page(folder: &Path, arguments: &[&str], page: &str) -> PathBuf {
    std::fs::write(folder.join("scene.json"), SCENE).unwrap();
    let run = Command::new(assert_cmd::cargo::cargo_bin!("drape"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap();
    assert!(run.status.success(), "{run:?}");
    folder.join(page)
}

/// A page at both widths and in both themes, whose paper must differ.
fn opened(page: &Path, browser: &Browser) -> [browser::Found; 2] {
    let [wide, narrow] = [(1280, false), (390, true)].map(|(width, dark)| browser.open(page, width, dark));
    wide.check(1280);
    narrow.check(390);
    assert_eq!((wide.paper(), narrow.paper()), ("rgb(255, 255, 255)", "rgb(23, 23, 26)"));
    [wide, narrow]
}

#[test]
fn the_study_shows_its_plots_and_pictures() {
    let Some(browser) = Browser::find() else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = page(folder.path(), &["study", "scene.json", "out", "--quick"], "out/index.html");
    for found in opened(&page, &browser) {
        assert_eq!(found.count("plots"), 5, "two for each stiffness, one for pictures: {found:?}");
        assert!(found.count("images") >= 5, "converged, and two for each way that is shown: {found:?}");
        assert!(found.count("marks") > 50, "{found:?}");
    }
}

#[test]
fn the_stability_map_shows_a_panel_for_each_density() {
    let Some(browser) = Browser::find() else { return };
    let folder = tempfile::tempdir().unwrap();
    // At so few frames a second every threshold is within these steps: marks beyond are not drawn.
    let ranges = ["--ks", "500,5000", "--density", "5,15,150", "--steps", "1..40:log5", "--time", "0.1"];
    let ranges = [&ranges[..], &["--set", "sim.fps=10"]].concat();
    let page =
        page(folder.path(), &[&["stability", "scene.json", "out"], &ranges[..]].concat(), "out/index.html");
    for found in opened(&page, &browser) {
        assert_eq!(found.count("plots"), 3, "{found:?}");
        assert_eq!(found.count("marks"), 2 * 2 * 3, "two thresholds for each column: {found:?}");
    }
    // Three in a row would be too small to be read here.
    browser.open(&page, 900, false).check(900);
}

/// What a reader does with the page of a sweep; an error is seen on the console, and success as one more plot.
const CLICKS: &str = r#"<script>{
const same = (found, expected) => { if (found !== expected) throw Error(`${found}, not ${expected}`); };
const order = () => [...document.querySelectorAll('.cases tbody tr')].map(row => row.cells[0].textContent).join();
const head = name => [...document.querySelectorAll('th button')].find(button => button.textContent === name);
same(order(), '1,2,3,4,5,6,7,8');
head('cloth.ks').click();
head('cloth.ks').click();
same(order(), '7,8,5,6,3,4,1,2');
same(document.querySelector('th[aria-sort]').textContent, 'cloth.ks');
head('case').click();
document.querySelector('.tile[data-case="3"]').click();
const dialog = document.querySelector('dialog');
same(dialog.open, true);
same(dialog.querySelector('h2').textContent, 'Case 3');
same(dialog.querySelector('img').naturalWidth, 40);
same(dialog.querySelector('pre').textContent,
  'drape render scene.json case.png --size 40x30 --set cloth.ks=500 --set cloth.density=15 --time 0.1');
dialog.close();
dialog.querySelector('img').remove();
document.body.insertAdjacentHTML('beforeend', '<svg width="300" height="9"><g><path d="M0 0h9"/></g></svg>');
}</script></body>"#;

#[test]
fn the_sweep_shows_its_cases_sorts_them_and_opens_one() {
    let Some(browser) = Browser::find() else { return };
    let folder = tempfile::tempdir().unwrap();
    let spec = r#"{"scene": "scene.json", "set": {"cloth.ks": [50, 500, 5000, 1e9], "cloth.density": [15, 150]},
        "time": 0.1, "measure": ["total", "largest_stretch", "hash"], "render": {"size": [40, 30]}}"#;
    std::fs::write(folder.path().join("spec.json"), spec).unwrap();
    let page = page(folder.path(), &["sweep", "run", "spec.json", "out"], "out/index.html");
    for found in opened(&page, &browser) {
        assert_eq!(found.count("plots"), 4, "lines and a map for each of two numbers: {found:?}");
        assert_eq!(found.count("images"), 6, "two cases are unstable: {found:?}");
        assert!(found.count("marks") >= 12, "{found:?}");
    }
    let text = std::fs::read_to_string(&page).unwrap();
    std::fs::write(&page, text.replace("</body>", CLICKS)).unwrap();
    for found in opened(&page, &browser) {
        assert_eq!(found.count("plots"), 5, "{found:?}");
    }
}

#[test]
fn the_gallery_shows_its_figures() {
    let Some(browser) = Browser::find() else { return };
    let folder = tempfile::tempdir().unwrap();
    let only = ["--only", "part5-mball", "--only", "part1-all", "--size", "128x100"];
    let page = page(folder.path(), &[&["gallery", "out"], &only[..]].concat(), "out/index.html");
    for found in opened(&page, &browser) {
        assert_eq!(found.count("images"), 2, "{found:?}");
    }
}

/// The helper itself sees what is wrong.
#[test]
fn a_broken_page_is_found_out() {
    let Some(browser) = Browser::find() else { return };
    let folder = tempfile::tempdir().unwrap();
    let open = |body: &str| {
        let page = folder.path().join("page.html");
        std::fs::write(&page, format!("<!DOCTYPE html><body style=\"margin:0\">{body}</body>")).unwrap();
        let found = browser.open(&page, 390, false);
        std::panic::catch_unwind(|| found.check(390)).is_ok()
    };
    let plot = |size: f64| {
        format!("<svg viewBox=\"0 0 100 100\" width=\"300\"><text font-size=\"{size}\">text</text></svg>")
    };
    assert!(open("<p>Nothing wrong</p>") && open(&plot(4.0)));
    for body in [
        "<img src=\"data:image/png;base64,AAAA\">".to_owned(),
        "<div style=\"width:500px\">wide</div>".to_owned(),
        "<script>console.log('a word')</script>".to_owned(),
        "<script>nothing()</script>".to_owned(),
        plot(3.0),
    ] {
        assert!(!open(&body), "{body}");
    }
}
