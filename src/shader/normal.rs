//! `normal`: the normal as a colour, (n + 1)/2.

use super::default::Oriented;
use crate::glsl::normalize;

pub use super::default::normal as vertex;

crate::fragment_program! {
    /// `normal.frag`
    pub struct Fragment {}
    |Oriented { v_normal }| {
        let n = normalize(v_normal);
        (n + n.all(1.0)) * n.x.all(0.5)
    }
}
