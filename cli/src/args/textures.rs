//! `--textures`, where nothing reads a texture.

use std::path::Path;

use crate::session::ui::Ui;
use drape::scene::{Images, Scene};

/// That a folder of textures changes nothing, and why.
pub(crate) const UNREAD: &str = "--textures has no effect: no shader of the scene reads a picture";

/// Warns of a texture with transparent pixels.
pub(crate) fn caution_of_transparency(name: &str, ui: &Ui) {
    let message = format!("the texture {name} has transparent pixels, which are drawn opaque");
    ui.caution(&message, "transparency is not drawn: paint the picture on a background of its own");
}

/// Whether a shader of `scene` reads a picture.
pub(crate) fn are_read(scene: &Scene) -> bool {
    let Images { textures, environments } = Images::of(scene);
    !textures.is_empty() || !environments.is_empty()
}

/// Warns of a `folder` of textures that changes nothing.
pub(crate) fn caution(folder: Option<&Path>, scene: &Scene, ui: &Ui) {
    if folder.is_some() && !are_read(scene) {
        ui.caution(UNREAD, "");
    }
}
