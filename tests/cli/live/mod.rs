//! The live page, as `web/build` makes it.

mod command;
mod devtools;
mod files;
mod same_bits;
mod using;

use std::path::PathBuf;

use crate::browser::Browser;
use devtools::DevTools;

/// A link to a moment.
const PAUSED: &str = "scene=sphere&frame=5&paused&size=320x250";

/// The page; nothing, after a line that says so, if it was not built.
///
/// # Panics
/// If it was not and the variable `DRAPE_REQUIRE_WEB` is set.
fn built() -> Option<PathBuf> {
    let page = crate::repository::path("web/dist/index.html");
    if !page.is_file() {
        assert!(std::env::var_os("DRAPE_REQUIRE_WEB").is_none(), "web/build was not run");
        #[allow(clippy::print_stdout, reason = "a test that did not run must say so")]
        {
            println!("skipped: web/build was not run");
        }
        return None;
    }
    Some(page)
}

/// The page in a browser, at the moment of a link (the part after `#`).
fn opened(link: &str, width: u32, dark: bool) -> Option<DevTools> {
    let page = built()?;
    let browser = Browser::find()?;
    let mut tools = DevTools::start(browser.program(), width, dark);
    tools.open(&format!("file://{}#{link}", page.display()));
    Some(tools)
}

/// Goes to the moment of a link and waits until it is shown.
fn go(tools: &mut DevTools, link: &str) {
    // The page hears of the change of its address first, and then this does; the same address is no change.
    tools.eval(&format!(
        "new Promise((done) => {{ const before = location.href; \
         addEventListener('hashchange', () => done(), {{once: true}}); location.hash = {link:?}; \
         if (location.href === before) done(); }})"
    ));
    settle(tools);
}

/// Waits until the page shows what was asked for, or an error.
fn settle(tools: &mut DevTools) {
    // A task of its own: the page hears of a change of the address later.
    tools.eval("new Promise((done) => setTimeout(done, 20))");
    tools.wait("document.getElementById('status').textContent !== 'running' && document.getElementById('status').textContent !== 'starting'");
}
