//! One arena of memory where the system limits addresses (`ulimit -v`).
//!
//! The allocator of glibc sets 64 to 128 MiB of addresses aside for each thread that allocates, used or not. Under a
//! limit a run could end for want of memory of which it needs a tenth. The variable below gives all threads the arena
//! of the main thread. It is read when a program starts, so the program starts itself anew with it.

use std::os::unix::process::CommandExt;
use std::process::Command;
use std::{env, fs};

const VARIABLE: &str = "MALLOC_ARENA_MAX";

/// Starts the program anew where that is of use; before there are other threads.
pub(crate) fn ensure() {
    if env::var_os(VARIABLE).is_some() || !addresses_are_limited() {
        return;
    }
    let mut arguments = env::args_os();
    let mut anew = Command::new("/proc/self/exe");
    arguments.next().map(|name| anew.arg0(name));
    // It returns only where it fails. Then some runs end for want of memory, as told above.
    let _cause = anew.args(arguments).env(VARIABLE, "1").exec();
}

/// Whether the system has a number in `Max address space  SOFT  HARD  bytes`.
fn addresses_are_limited() -> bool {
    let limits = fs::read_to_string("/proc/self/limits").unwrap_or_default();
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"));
    line.and_then(|line| line.split_whitespace().next()).is_some_and(|soft| soft != "unlimited")
}
