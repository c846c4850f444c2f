//! What fuzzing found stays found: the bodies of the fuzz targets run over the inputs in `fuzz/corpus/`.

use crate::corpus::run_all;

#[path = "../../fuzz/bodies/positions.rs"]
mod positions;
#[path = "../../fuzz/bodies/sweep_spec.rs"]
mod sweep_spec;

#[test]
fn positions_are_read_or_refused() {
    run_all("positions", positions::run);
}

#[test]
fn sweeps_are_read_or_explained() {
    run_all("sweep_spec", sweep_spec::run);
}
