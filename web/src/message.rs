//! Errors as the command line prints them.

use drape::error::{Diagnostic, Error};

/// The text of an error: every place with its line and caret, then the error itself and what to do.
pub(crate) fn text(error: &Error) -> String {
    let mut blocks: Vec<_> = error.diagnostics.iter().map(|found| found.rendered.clone()).collect();
    // The number of errors is added only where there are several.
    if blocks.len() != 1 {
        blocks.push(format!("error: {}", error.message));
    }
    let help = match error.help.as_str() {
        "" => String::new(),
        help => format!("\n  = help: {}", help.replace('\n', "\n          ")),
    };
    blocks.join("\n\n") + &help
}

/// The texts of warnings.
pub(crate) fn texts(warnings: &[Diagnostic]) -> Vec<String> {
    warnings.iter().map(|warning| warning.rendered.clone()).collect()
}
