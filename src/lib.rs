//! A reference cloth simulator and the software rasteriser that shows it: exact where it can be,
//! bounded where it cannot, and the same bytes on every machine and for any number of threads.
//!
//! ```
//! use drape::{
//!     output::png,
//!     render::{Options, Renderer},
//!     scene::{Overrides, load_text},
//!     simulation::Simulation,
//!     texture_source::TextureSource,
//! };
//!
//! // A ball under nothing: every key has a default but those of the objects themselves.
//! let text = r#"{
//!     "sphere": { "origin": [0.5, 0.2, 0.5], "radius": 0.2, "friction": 0.3 },
//!     "render": { "size": [64, 50] }
//! }"#;
//! let scene = load_text("ball.json", text, &Overrides::default())?.scene;
//! let renderer = Renderer::new(&scene, &TextureSource::BuiltIn)?;
//! let mut simulation = Simulation::new(&scene)?;
//! simulation.advance_frame()?;
//! let picture = renderer.draw(simulation.positions(), &Options::default());
//! assert_eq!(picture.rgb.len(), 64 * 50 * 3);
//! assert_eq!(picture.rgb[0], 64, "the background is round(255 · 0.25)");
//! let file = png::encode(picture.width, picture.height, &picture.rgb, png::Effort::Small)?;
//! assert!(file.starts_with(b"\x89PNG"));
//! # Ok::<(), drape::error::Error>(())
//! ```
//!
//! For programs of one's own, [`raster::DrawCall`] has an example.
//!
//! # The way of the data
//! Modules are declared in the order in which data flows; each uses only those above it.
//!
//! | step | module |
//! |---|---|
//! | pieces of work that threads take one after the other | `share` |
//! | vector instructions and the numbers of the fragment stage | [`lanes`] |
//! | scene file → validated scene → plan of what it needs | [`scene`] |
//! | grid, springs, forces, stretch limit | [`cloth`] |
//! | collisions with objects, and of the cloth with itself | `collision` |
//! | how points move on under forces, and at which steps that is stable | [`integrator`] |
//! | energies, extremes, rest, stability | [`diagnostics`] |
//! | one step, one frame | [`simulation`] |
//! | pictures that materials read | [`texture`], [`cubemap`], [`texture_source`] |
//! | triangles with attributes | [`mesh`] |
//! | orbit camera | [`camera`] |
//! | the part of GLSL that programs use | [`glsl`] |
//! | vertex stage → clip → set-up, bins → tiles → fragment stage | [`raster`] |
//! | vertex and fragment programs, beside their GLSL | [`shader`] |
//! | scene and positions → picture | [`render`] |
//! | PNG, OBJ, raw numbers, comparison; whole files or none | [`output`] |
//!
//! # Determinism
//! Whatever reaches a result is made of + − × ÷ and square roots, which IEEE 754 rounds exactly,
//! of integers, and of [`math`], one pinned source for every other function. Nothing is fused or
//! reordered; work is divided into chunks of fixed size whose results do not depend on each other.

#![forbid(unsafe_code)]

pub mod version;
pub mod error;
pub mod fence;
pub mod bounded;
pub mod container;
pub mod exif;
pub mod math;
mod share;
pub mod lanes;
pub mod scene;
pub mod cloth;
mod collision;
pub mod integrator;
pub mod diagnostics;
pub mod simulation;
pub mod texture;
pub mod cubemap;
pub mod texture_source;
pub mod mesh;
pub mod camera;
pub mod glsl;
pub mod raster;
pub mod shader;
pub mod render;
pub mod output;

#[doc = include_str!("../docs/architecture.md")]
pub mod architecture {}
