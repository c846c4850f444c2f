//! What fuzzing found stays found: the bodies of the fuzz targets run over the inputs in `fuzz/corpus/`.

use crate::corpus::run_all;

#[path = "../../fuzz/bodies/raster.rs"]
mod raster;
#[path = "../../fuzz/bodies/scene.rs"]
pub(crate) mod scene;
#[path = "../../fuzz/bodies/state.rs"]
mod state;
#[path = "../../fuzz/bodies/texture.rs"]
mod texture;

#[test]
fn scenes_are_read_or_explained() {
    run_all("scene", scene::run);
}

#[test]
fn pictures_are_decoded_or_refused_within_their_memory() {
    run_all("texture", texture::run);
}

#[test]
fn any_bits_are_drawn_alike_by_threads_and_vectors() {
    run_all("raster", raster::run);
}

#[test]
fn states_are_refused_or_gone_on_from() {
    run_all("state", state::run);
}
