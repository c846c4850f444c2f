//! A page opened in a real browser, and what is found there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// What is read off a page after it was laid out: sizes in CSS pixels.
const PROBE: &str = "<script>addEventListener('load',()=>{const all=s=>[...document.querySelectorAll(s)];\
const box=e=>e.getBoundingClientRect();\
const found={width:innerWidth,page:document.documentElement.scrollWidth,\
images:all('img').length,loaded:all('img').filter(i=>i.complete&&i.naturalWidth>0&&box(i).width>0).length,\
plots:all('svg').length,seen:all('svg').filter(p=>box(p).width>200&&box(p).right<=innerWidth+1).length,\
marks:all('svg g path').length,\
text:Math.min(...all('svg text').map(t=>parseFloat(getComputedStyle(t).fontSize)*\
Math.hypot(t.getScreenCTM().a,t.getScreenCTM().b))),\
paper:getComputedStyle(document.body).backgroundColor};\
const pre=document.createElement('pre');pre.id='probe';pre.textContent=JSON.stringify(found);\
document.body.append(pre)})</script>";

/// Chromium, without a window.
pub(crate) struct Browser {
    program: PathBuf,
    profile: tempfile::TempDir,
}

/// What was found on a page.
#[derive(Debug)]
pub(crate) struct Found {
    /// What the browser wrote to its console.
    pub(crate) console: Vec<String>,
    probe: Value,
}

impl Browser {
    /// The browser on the `PATH`; nothing, after a line that says so, if there is none.
    ///
    /// # Panics
    /// If there is none and the variable `DRAPE_REQUIRE_BROWSER` is set.
    #[allow(clippy::print_stdout, reason = "a test says that it was skipped")]
    pub(crate) fn find() -> Option<Self> {
        let folders = std::env::var_os("PATH").unwrap_or_default();
        let program = std::env::split_paths(&folders).map(|f| f.join("chromium")).find(|p| p.is_file());
        if program.is_none() {
            assert!(std::env::var_os("DRAPE_REQUIRE_BROWSER").is_none(), "no chromium on the PATH");
            #[allow(clippy::print_stdout, reason = "a test that did not run must say so")]
            {
                println!("skipped: no chromium on the PATH");
            }
        }
        let profile = tempfile::tempdir().expect("a folder for the browser");
        Some(Self { program: program?, profile })
    }

    /// The file of the browser.
    pub(crate) fn program(&self) -> &Path {
        &self.program
    }

    /// Opens a page in a window of `width` pixels, with a light or a dark theme.
    pub(crate) fn open(&self, page: &Path, width: u32, dark: bool) -> Found {
        let probed = self.profile.path().join("probed.html");
        let text = fs::read_to_string(page).expect("the page");
        assert!(text.contains("</body>"), "a whole page");
        // A frame is as wide as is asked for, a window not less than 500 pixels.
        let inner =
            text.replace("</body>", &format!("{PROBE}</body>")).replace('&', "&amp;").replace('"', "&quot;");
        let outer = format!(
            "<body style=\"margin:0\"><iframe style=\"border:0;width:{width}px;height:900px\" srcdoc=\"{inner}\"></iframe>\
            <script>addEventListener('load',()=>{{document.body.dataset.probe=frames[0].document.getElementById('probe').textContent}})</script></body>"
        );
        fs::write(&probed, outer).expect("a copy with the probe");
        let run = self.run(&probed, dark, &["--dump-dom"]);
        let dom = String::from_utf8_lossy(&run.stdout);
        let (_, rest) = dom.split_once("data-probe=\"").unwrap_or_else(|| panic!("no probe: {run:?}"));
        let json = rest.split('"').next().unwrap_or_default().replace("&quot;", "\"");
        let log = String::from_utf8_lossy(&run.stderr);
        Found {
            console: log.lines().filter(|line| line.contains("CONSOLE")).map(str::to_owned).collect(),
            probe: serde_json::from_str(&json).unwrap_or_else(|e| panic!("{e}: {json}")),
        }
    }

    fn run(&self, page: &Path, dark: bool, arguments: &[&str]) -> Output {
        let theme = format!("--blink-settings=preferredColorScheme={}", i32::from(!dark));
        Command::new(&self.program)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--window-size=1400,1000"])
            .args(["--enable-logging=stderr", "--virtual-time-budget=10000", &theme])
            .arg(format!("--user-data-dir={}", self.profile.path().display()))
            .args(arguments)
            .arg(format!("file://{}", page.display()))
            .output()
            .expect("the browser starts")
    }
}

impl Found {
    /// A number that was read off the page: `images`, `plots` or `marks`.
    pub(crate) fn count(&self, what: &str) -> u64 {
        self.probe[what].as_u64().unwrap_or_else(|| panic!("no {what} in {self:?}"))
    }

    /// The colour of the paper, as the browser computed it.
    pub(crate) fn paper(&self) -> &str {
        self.probe["paper"].as_str().unwrap_or_default()
    }

    /// Checks what holds for every page at a width: the console is silent, the page is no wider than the
    /// window, every picture is decoded, every plot inside the window, its text not too small to be read.
    pub(crate) fn check(&self, width: u64) {
        assert_eq!(self.console, Vec::<String>::new(), "a silent console");
        assert_eq!(self.count("width"), width, "{self:?}");
        assert!(self.count("page") <= width, "the page scrolls sideways: {self:?}");
        assert_eq!(self.count("loaded"), self.count("images"), "a picture is broken: {self:?}");
        assert_eq!(self.count("seen"), self.count("plots"), "a plot is cut off: {self:?}");
        let text = self.probe["text"].as_f64().unwrap_or(f64::INFINITY);
        assert!(text >= 9.5, "text of a plot is {text} pixels high");
    }
}
