//! Arguments that several commands share.

pub(crate) mod address;
pub(crate) mod flag;
pub(crate) mod frames;
pub(crate) mod limit;
pub(crate) mod output;
pub(crate) mod part;
pub(crate) mod provenance;
pub(crate) mod render;
pub(crate) mod scene;
pub(crate) mod state;
pub(crate) mod textures;
pub(crate) mod unread;
