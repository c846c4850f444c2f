//! The live page: the engine of drape as WebAssembly, for the worker of a web page.
//!
//! The page's scripts call [`Page`] and nothing else. Everything that it gives is computed by the engine: the same
//! bytes as those of the command line.

#![forbid(unsafe_code)]

mod message;
mod request;
mod command;
mod controls;
mod gauge;
mod live;

use drape::error::Error;
use wasm_bindgen::prelude::wasm_bindgen;

use live::Live;
use request::Request;

/// The files of the stock scenes and of the table.
const SCENES: [(&str, &str); 6] = [
    ("sphere", include_str!("../../scenes/sphere.json")),
    ("plane", include_str!("../../scenes/plane.json")),
    ("pinned2", include_str!("../../scenes/pinned2.json")),
    ("pinned4", include_str!("../../scenes/pinned4.json")),
    ("selfCollision", include_str!("../../scenes/selfCollision.json")),
    ("table", include_str!("../../scenes/table.json")),
];

/// What the page shows. Errors are texts as the command line prints them.
#[wasm_bindgen]
#[derive(Default)]
pub struct Page {
    live: Live,
    /// The last picture that was drawn: red, green, blue and 255 of each pixel.
    rgba: Vec<u8>,
}

#[wasm_bindgen]
impl Page {
    /// A page that shows nothing yet.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// What can be chosen, as JSON: the values of each key that is a choice, textures, parts of the ledger, stock scenes.
    pub fn choices() -> String {
        let mut choices = controls::choices();
        choices["ledger"] = Live::ledger_names().into();
        choices["scenes"] = SCENES.iter().map(|(name, text)| (*name, *text)).collect();
        choices.to_string()
    }

    /// Shows what a request (JSON) asks for; JSON with what the controls show.
    ///
    /// # Errors
    /// What is wrong with the scene; then all stays as it was.
    pub fn load(&mut self, request: &str) -> Result<String, String> {
        let answer = Request::parse(request).and_then(|request| self.live.load(request));
        answer.map(|answer| answer.to_string()).map_err(text)
    }

    /// Adds a texture of the user's own.
    ///
    /// # Errors
    /// Why it is not a picture.
    pub fn add_texture(&mut self, name: &str, bytes: Vec<u8>) -> Result<(), String> {
        self.live.add_texture(name, bytes).map_err(text)
    }

    /// Starts the cloth anew.
    ///
    /// # Errors
    /// As when the scene was loaded.
    pub fn reset(&mut self) -> Result<(), String> {
        self.live.reset().map_err(text)
    }

    /// Moves the cloth on by one frame.
    ///
    /// # Errors
    /// How the cloth blew up, or why it is certain to.
    pub fn advance(&mut self) -> Result<(), String> {
        self.live.advance().map_err(text)
    }

    /// Frame, time (s), kinetic, spring and gravitational energy (J), and the entries of the ledger if it is recorded.
    pub fn row(&self) -> Vec<f64> {
        self.live.row()
    }

    /// The frame.
    pub fn frame(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "a number of frames is far below 2^53")]
        let frame = self.live.frame() as f64;
        frame
    }

    /// Length over rest length of the spring that is stretched most.
    pub fn stretch(&self) -> f64 {
        self.live.stretch()
    }

    /// Draws the picture: red, green, blue and 255 for each pixel, top row first.
    pub fn draw(&mut self) -> Vec<u8> {
        self.rgba = self.live.draw();
        self.rgba.clone()
    }

    /// Width of the picture in pixels.
    pub fn width(&self) -> u32 {
        self.live.size()[0]
    }

    /// Height of the picture in pixels.
    pub fn height(&self) -> u32 {
        self.live.size()[1]
    }

    /// The hash of the picture that was drawn last, as `drape render --hash` prints it.
    pub fn picture_hash(&self) -> String {
        format!("{:016x}", live::hash(&self.rgba))
    }

    /// The hash of the state, as `drape simulate --hash` prints it.
    pub fn state_hash(&self) -> String {
        format!("{:016x}", self.live.state_hash())
    }

    /// The picture as the file that `drape render` writes.
    ///
    /// # Errors
    /// If it cannot be encoded.
    pub fn png(&mut self) -> Result<Vec<u8>, String> {
        self.live.png().map_err(text)
    }

    /// The positions as `drape simulate --positions` writes them.
    pub fn positions(&self) -> Vec<u8> {
        self.live.positions()
    }

    /// The whole state as the file that `drape simulate --save-state` writes.
    pub fn state(&self) -> Vec<u8> {
        self.live.state()
    }

    /// The command for the picture.
    pub fn command(&self) -> String {
        self.live.command()
    }
}

#[expect(clippy::needless_pass_by_value, reason = "the shape that map_err asks for")]
fn text(error: Error) -> String {
    message::text(&error)
}
