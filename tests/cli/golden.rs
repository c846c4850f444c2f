//! Pictures stay what they are: every pixel, for every number of threads.
//!
//! A golden is replaced by `DRAPE_BLESS="reason" cargo test --release --test cli golden`, which
//! fails after it has written; the next run compares. What differs is shown in `target/golden/`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::goldens::files::{Goldens, check_size, half, save};
use super::goldens::program::{Case, Figure, draw, gallery, repository};
use drape::output::png::{self, Effort, Pixels};
use drape_lab::gallery::table;
use rayon::prelude::*;

/// Pictures kept as files beside the figures of the gallery: name, scene, arguments of `render`.
const PICTURES: &[Case] = &[
    ("ball-nearest", "sphere.json", NEAREST),
    ("sphere-samples", "sphere.json", "--patch scenes/look/draped.json --time 1 --size 192x150 --samples 4"),
    ("table", "table.json", "--size 192x150 --samples 4"),
    (
        "pinned2-wireframe",
        "pinned2.json",
        "--time 0.4 --size 256x200 --shader wireframe --springs structural --set camera.polar=60",
    ),
];

/// Figures that take more than 20 KiB at 256 x 200. A hash holds every pixel of these, and the
/// file shows them at half the size.
const HALVED: &[&str] = &[
    "part2-med-high-ks",
    "part2-low-density",
    "part2-final",
    "part3-sphere-500",
    "part3-sphere-50000",
    "part3-plane-textured",
    "part5-tball",
    "part5-tcloth",
    "part5-mball",
    "part5-mcloth",
    "part5-cballw",
    "part5-cballp",
    "part5-cballb",
    "part5-cclothw",
    "part5-cclothr",
];

/// The grid of letters, looked up without weights.
const NEAREST: &str = "--patch scenes/look/ball.json --size 160x125 --shader texture \
    --set render.filter=nearest --set material.texture=texture_4";

/// Pictures kept as a hash only, so of any size.
const HASHES: &[Case] = &[
    ("sphere", "sphere.json", ""),
    ("sphere-mirror-8", "sphere.json", "--shader mirror --samples 8 --size 640x480"),
    ("plane-displacement", "plane.json", "--shader displacement --set camera.polar=60"),
    ("selfCollision", "selfCollision.json", "--set camera.polar=75 --set camera.azimuth=40"),
];

/// Numbers of threads that each picture is drawn with.
const THREADS: [usize; 2] = [1, 3];

fn goldens() -> Goldens {
    Goldens {
        folder: repository().join("golden"),
        failures: output_folder(),
        bless: std::env::var("DRAPE_BLESS").ok(),
        unattended: std::env::var_os("CI").is_some(),
    }
}

/// `target/golden`
fn output_folder() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("golden")
}

/// Draws every case with every number of threads; all failures are told at once.
fn check_all(cases: &[Case], check: impl Fn(&str, &Pixels) -> Result<(), String>) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let drawn: Vec<_> = cases
        .par_iter()
        .flat_map(|&case| THREADS.par_iter().map(move |&threads| (case, threads)))
        .map(|(case, threads)| {
            let file = folder.path().join(format!("{}-{threads}.png", case.0));
            (case.0, threads, draw(case, threads, &file))
        })
        .collect();
    let failures: Vec<_> = drawn
        .into_iter()
        .filter_map(|(name, threads, picture)| {
            let failure = picture.and_then(|picture| check(name, &picture)).err()?;
            Some(format!("with {threads} threads: {failure}"))
        })
        .collect();
    assert!(failures.is_empty(), "\n{}\n", failures.join("\n"));
}

#[test]
fn every_picture_is_its_golden() {
    let goldens = goldens();
    check_all(PICTURES, |name, picture| goldens.check(name, picture));
}

/// The names of all pictures of the gallery.
fn figures() -> Vec<String> {
    let parts = table::parts().expect("the table of figures");
    let figures = parts.into_iter().flat_map(|part| part.figures);
    figures.flat_map(|figure| figure.pictures).map(|picture| picture.name).collect()
}

/// Compares a figure and the state of its cloth.
fn check_figure(goldens: &Goldens, figure: &Figure) -> Result<(), String> {
    let Figure { name, state, picture } = figure;
    let pixels = if HALVED.contains(&name.as_str()) {
        // Both are compared, and blessed, whatever the other says.
        let (whole, halved) = (goldens.check_hash(name, picture), goldens.check(name, &half(picture)));
        whole.and(halved)
    } else {
        goldens.check(name, picture)
    };
    // A state that differs explains a picture that does.
    match (goldens.check_state(name, state), pixels) {
        (Err(state), Err(pixels)) => Err(format!("{state}\n  {pixels}")),
        (state, pixels) => state.and(pixels),
    }
}

#[test]
fn every_figure_is_its_golden() {
    let goldens = goldens();
    let failures: Vec<String> = THREADS
        .par_iter()
        .flat_map(|&threads| {
            let folder = tempfile::tempdir().expect("a temporary folder");
            let made = gallery(threads, folder.path()).expect("a gallery");
            let names: Vec<_> = made.iter().map(|figure| figure.name.clone()).collect();
            assert_eq!(names, figures());
            let failed = made.iter().filter_map(|figure| check_figure(&goldens, figure).err());
            failed.map(|failure| format!("with {threads} threads: {failure}")).collect::<Vec<_>>()
        })
        .collect();
    assert!(failures.is_empty(), "\n{}\n", failures.join("\n"));
}

/// Leaves each picture that passes in `target/golden/full/`, for comparisons with other builds.
#[test]
fn every_full_picture_has_its_hash() {
    let goldens = goldens();
    check_all(HASHES, |name, picture| {
        goldens.check_hash(name, picture)?;
        save(&output_folder().join("full").join(format!("{name}.png")), picture, Effort::Fast)
    });
}

#[test]
fn every_golden_is_small_and_belongs_to_a_case() {
    let goldens = goldens();
    let sorted = |names: Vec<String>| {
        let set: BTreeSet<_> = names.iter().cloned().collect();
        assert_eq!(set.len(), names.len(), "a name is used twice: {names:?}");
        set.into_iter().collect::<Vec<_>>()
    };
    let cases = |cases: &[Case]| cases.iter().map(|case| case.0.to_owned()).collect::<Vec<_>>();
    let pictures = [cases(PICTURES), figures()].concat();
    let hashes = [cases(HASHES), HALVED.iter().map(ToString::to_string).collect()].concat();
    let all = [pictures.clone(), cases(HASHES)].concat();
    let files = sorted(pictures.iter().map(|name| format!("{name}.png")).collect());
    assert_eq!(goldens.names(), [files.clone(), sorted(hashes), sorted(figures()), sorted(all)]);
    for picture in files {
        check_size(&goldens.folder.join(picture)).unwrap();
    }
}

#[test]
fn all_goldens_differ_from_each_other() {
    let folder = goldens().folder;
    let names = PICTURES.iter().map(|case| case.0.to_owned()).chain(figures());
    let read = |name: String| (png::read(&folder.join(format!("{name}.png"))).unwrap(), name);
    let pictures: Vec<_> = names.map(read).collect();
    for (index, (picture, name)) in pictures.iter().enumerate() {
        for (same, other) in &pictures[..index] {
            assert!(picture != same, "{name} and {other} show the same");
        }
    }
    let hashes = std::fs::read_to_string(folder.join("hashes.txt")).unwrap();
    let distinct: BTreeSet<_> = hashes.lines().map(|line| line.split_once(' ').unwrap().1).collect();
    assert_eq!(distinct.len(), HASHES.len() + HALVED.len());
}

/// The harness itself: each of its refusals is seen to happen.
mod harness {
    use super::*;

    fn picture(seed: u8) -> Pixels {
        Pixels { width: 2, height: 1, rgba: vec![[seed, 0, 0, 255], [0, seed, 0, 255]] }
    }

    fn fresh(dir: &Path, bless: Option<&str>, unattended: bool) -> Goldens {
        Goldens {
            folder: dir.join("golden"),
            failures: dir.join("failures"),
            bless: bless.map(str::to_owned),
            unattended,
        }
    }

    #[test]
    fn a_missing_golden_fails_and_writes_nothing() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::create_dir(dir.path().join("golden")).unwrap();
        let goldens = fresh(dir.path(), None, false);
        assert!(goldens.check("a", &picture(1)).unwrap_err().contains("no golden"));
        assert!(goldens.check_hash("a", &picture(1)).unwrap_err().contains("no hash"));
        assert_eq!(goldens.names(), [const { Vec::<String>::new() }; 4]);
    }

    #[test]
    fn blessing_needs_a_reason_and_somebody_who_watches() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::create_dir(dir.path().join("golden")).unwrap();
        for (bless, unattended) in [(" ", false), ("a reason", true)] {
            let goldens = fresh(dir.path(), Some(bless), unattended);
            assert!(goldens.check("a", &picture(1)).is_err());
            assert!(goldens.check_hash("a", &picture(1)).is_err());
            assert!(goldens.check_state("a", "12").is_err());
            assert_eq!(goldens.names(), [const { Vec::<String>::new() }; 4]);
        }
    }

    #[test]
    fn blessing_writes_and_still_fails() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::create_dir(dir.path().join("golden")).unwrap();
        let blessing = fresh(dir.path(), Some("first"), false);
        assert!(blessing.check("a", &picture(1)).unwrap_err().contains("blessed"));
        assert!(blessing.check_hash("b", &picture(1)).unwrap_err().contains("blessed"));
        assert!(blessing.check_state("c", "12").unwrap_err().contains("blessed"));
        let goldens = fresh(dir.path(), None, true);
        assert_eq!(goldens.check("a", &picture(1)), Ok(()));
        assert_eq!(goldens.check_hash("b", &picture(1)), Ok(()));
        assert_eq!(goldens.check_state("c", "12"), Ok(()));
        assert!(goldens.check_state("c", "13").unwrap_err().contains("not 12"));
        assert_eq!(
            goldens.names(),
            [vec!["a.png"], vec!["b"], vec!["c"], vec!["a", "b", "c"]]
                .map(|n| n.iter().map(ToString::to_string).collect::<Vec<_>>())
        );
        let reasons = std::fs::read_to_string(dir.path().join("golden/blessed.txt")).unwrap();
        assert_eq!(reasons, "a first\nb first\nc first\n");
        let wide = Pixels { width: 257, height: 1, rgba: vec![[0, 0, 0, 255]; 257] };
        assert!(blessing.check("wide", &wide).unwrap_err().contains("too large"));
    }

    #[test]
    fn a_halved_picture_is_the_mean_of_four() {
        let rgba = [[0, 0, 0, 255], [1, 0, 0, 255], [1, 255, 0, 255], [0, 255, 0, 255]].to_vec();
        let halved = half(&Pixels { width: 2, height: 2, rgba });
        assert_eq!(halved, Pixels { width: 1, height: 1, rgba: vec![[1, 128, 0, 255]] });
    }

    #[test]
    fn a_difference_fails_and_shows_the_triptych() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::create_dir(dir.path().join("golden")).unwrap();
        let blessing = fresh(dir.path(), Some("first"), false);
        assert!(blessing.check("a", &picture(1)).is_err() && blessing.check_hash("a", &picture(1)).is_err());
        let goldens = fresh(dir.path(), None, false);
        let mut other = picture(1);
        other.rgba[1][2] = 1;
        let message = goldens.check("a", &other).unwrap_err();
        assert!(message.contains("1 pixels differ by up to 1"), "{message}");
        assert_eq!(png::read(&dir.path().join("failures/a.png")).unwrap().width, 3 * 2 + 8);
        let page = std::fs::read_to_string(dir.path().join("failures/a.html")).unwrap();
        assert_eq!(page.matches("data:image/png;base64,").count(), 3);
        assert!(goldens.check_hash("a", &other).is_err());
        let turned = Pixels { width: 1, height: 2, rgba: picture(1).rgba };
        assert!(goldens.check("a", &turned).is_err() && goldens.check_hash("a", &turned).is_err());
    }
}
