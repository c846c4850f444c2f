//! The place for a number in the name of a file: `%d`, or `%04d` for four digits.

use std::path::Path;

/// What stands before the place in the name of a file, the width in it, and what stands behind it. None if there is no
/// place, or `%` elsewhere in the name.
pub(crate) fn place(path: &Path) -> Option<[&str; 3]> {
    let (before, rest) = path.file_name()?.to_str()?.split_once('%')?;
    let (width, after) = rest.split_once('d')?;
    (width.bytes().all(|byte| byte.is_ascii_digit()) && !after.contains('%'))
        .then_some([before, width, after])
}
