//! Makes the live page one file: `drape-bundle ENGINE.wasm PAGE_FOLDER OUT.html`.
//!
//! The engine's WebAssembly gets the scripts that call it (wasm-bindgen, as a library, so that no tool has to be
//! installed), is compressed, and is put into the page with the page's own styles and scripts.

#![forbid(unsafe_code)]

use std::error::Error;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use wasm_bindgen_cli_support::Bindgen;

type Result<T, E = Box<dyn Error>> = std::result::Result<T, E>;

fn main() -> Result<()> {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [engine, folder, out] = arguments.as_slice() else {
        return Err("expected ENGINE.wasm PAGE_FOLDER OUT.html".into());
    };
    let page = page(engine, folder)?;
    if let Some(parent) = out.parent() {
        fs::create_dir_all(parent)?;
    }
    fs::write(out, &page)?;
    writeln!(std::io::stdout(), "{}: {} bytes", out.display(), page.len())?;
    Ok(())
}

/// The whole page.
fn page(engine: &Path, folder: &Path) -> Result<String> {
    let read = |name: &str| {
        let path = folder.join(name);
        fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let mut output = Bindgen::new()
        .input_path(engine)
        .no_modules(true)?
        .typescript(false)
        .omit_default_module_path(true)
        .remove_name_section(true)
        .remove_producers_section(true)
        .generate_output()?;
    let wasm = output.wasm_mut().emit_wasm();
    let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
    gzip.write_all(&wasm)?;
    let wasm = BASE64_STANDARD.encode(gzip.finish()?);
    let worker = format!("{}\n{}", output.js(), read("worker.js")?);
    // In the order in which they build on each other.
    let scripts =
        ["link.js", "view.js", "plots.js", "controls.js", "page.js", "show.js", "files.js", "input.js"]
            .map(read);
    let scripts = scripts.into_iter().collect::<std::result::Result<Vec<_>, _>>()?.concat();
    let mut page = read("index.html")?;
    for (mark, text) in [
        ("/*style*/", read("style.css")?),
        ("/*worker*/", worker),
        ("/*wasm*/", wasm),
        ("/*scripts*/", scripts),
    ] {
        if text.contains("</script") || page.matches(mark).count() != 1 {
            return Err(format!("{mark} has no place of its own in the page").into());
        }
        page = page.replace(mark, &text);
    }
    Ok(page)
}
