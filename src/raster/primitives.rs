//! What a draw call draws.

/// What a draw call draws: vertex indices per primitive.
#[derive(Clone, Copy, Debug)]
pub enum Primitives<'a> {
    /// Filled triangles, both sides.
    Triangles(&'a [[u32; 3]]),
    /// Lines one pixel wide, in one colour: their fragment program reads no varyings.
    Lines(&'a [[u32; 2]]),
}

impl Primitives<'_> {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Triangles(all) => all.len(),
            Self::Lines(all) => all.len(),
        }
    }
}
