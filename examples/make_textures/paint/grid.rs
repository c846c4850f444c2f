//! `texture_4`: a grid that shows which way texture coordinates run.

use super::color::hex;
use super::{Picture, paint as paint_each};

pub(super) fn paint() -> Picture {
    paint_each(|u, v| {
        let odd = ((u * 8.0).floor() + (v * 8.0).floor()) % 2.0 == 1.0;
        if odd { hex(0xd0d0d0) } else { [u, v, 0.5] }
    })
}
