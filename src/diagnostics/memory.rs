//! How much memory a run takes at least.

use crate::cloth::springs;
use crate::error::{Error, Kind, Result};
use crate::scene::Scene;

/// The size of the largest arrays, in bytes: a lower bound of the memory of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Memory {
    /// Points and springs.
    pub cloth: u64,
    /// Colours and depths of a picture.
    pub picture: u64,
}

impl Memory {
    /// What `scene` takes.
    pub fn of(scene: &Scene) -> Self {
        // Three numbers each of the position, the last position and the force.
        const POINT: u64 = 3 * 3 * size_of::<f64>() as u64;
        const SPRING: u64 = size_of::<f64>() as u64;
        // Colour and depth of a sample.
        const SAMPLE: u64 = 4 * size_of::<f32>() as u64;
        let cloth = scene.cloth.as_ref().map_or(0, |cloth| {
            let springs: usize = springs::counts(cloth).iter().sum();
            (cloth.num_width_points * cloth.num_height_points) as u64 * POINT + springs as u64 * SPRING
        });
        let [width, height] = scene.render.size.map(u64::from);
        Self { cloth, picture: width * height * u64::from(scene.render.samples) * SAMPLE }
    }
}

/// Checks that `bytes` bytes of memory for `what` can be had, before any of them is used.
///
/// # Errors
/// [`Kind::Io`] with the number of bytes.
pub fn check_available(bytes: u64, what: &str) -> Result<()> {
    let had = usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok());
    if had {
        return Ok(());
    }
    Err(Error::new(Kind::Io, format!("the system does not give {bytes} bytes of memory for {what}"))
        .with_help("ask for less, or raise the limit of the system (ulimit -v)"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_that_cannot_be_had_is_an_error_with_its_size() {
        assert_eq!(check_available(1 << 20, "a test"), Ok(()));
        let error = check_available(u64::MAX, "a test").unwrap_err();
        assert_eq!(error.kind, Kind::Io);
        assert!(error.message.contains("18446744073709551615 bytes"), "{error}");
    }
}
