//! What a sweep can measure of a case.

use crate::run::table;

/// The hash of the state at the end.
pub(super) const HASH: &str = "hash";
/// When the cloth came to rest, in simulated seconds.
pub(super) const REST_TIME: &str = "rest_time";
/// How the case ended, in a word.
pub(super) const OUTCOME: &str = "outcome";
/// Running time, in milliseconds; it alone differs between runs.
pub(super) const WALL_MS: &str = "wall_ms";

/// The start of the names of what each phase added, for which a ledger is recorded.
const BY: &str = "by_";

/// The names of all measures: the columns of `simulate --csv`, whose last row counts, and others.
pub fn names() -> Vec<String> {
    let others = [HASH, REST_TIME, OUTCOME, WALL_MS].map(str::to_owned);
    table::columns().into_iter().chain(others).collect()
}

/// Whether a case needs a ledger for this measure.
pub(super) fn needs_ledger(name: &str) -> bool {
    name.starts_with(BY)
}

/// The unit of a measure; empty if it has none.
pub(super) fn unit(name: &str) -> &'static str {
    match name {
        "time" | REST_TIME => "s",
        "kinetic" | "spring" | "gravitational" | "total" => "J",
        "smallest_distance" => "m",
        "largest_speed" => "m/s",
        WALL_MS => "ms",
        name if needs_ledger(name) => "J",
        _ => "",
    }
}
