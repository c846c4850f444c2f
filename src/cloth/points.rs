//! A vector for each point of a cloth, and what is computed with one.

use crate::error::{Error, Kind, Result};
use crate::scene::Vec3;

/// One vector per point of the cloth, as a structure of arrays of equal length.
/// Point (i, j) is entry `j * W + i` of each array.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points<T = f64> {
    /// First components.
    pub x: Vec<T>,
    /// Second components.
    pub y: Vec<T>,
    /// Third components.
    pub z: Vec<T>,
}

impl<T: Clone + Default> Points<T> {
    /// `len` zero vectors of numbers of any type.
    ///
    /// # Errors
    /// [`Kind::Scene`] when they do not fit in memory.
    pub(crate) fn filled(len: usize) -> Result<Self> {
        let [x, y, z] = [(); 3].map(|()| filled(len, T::default()));
        Ok(Self { x: x?, y: y?, z: z? })
    }

    /// The three components.
    pub(crate) fn components(&self) -> [&[T]; 3] {
        [&self.x, &self.y, &self.z]
    }

    /// The three components, to be changed.
    pub(crate) fn components_mut(&mut self) -> [&mut [T]; 3] {
        [&mut self.x, &mut self.y, &mut self.z]
    }
}

impl Points {
    /// `len` zero vectors.
    ///
    /// # Errors
    /// [`Kind::Scene`] when they do not fit in memory.
    pub fn zeros(len: usize) -> Result<Self> {
        Self::filled(len)
    }

    /// Takes the vectors of `other`, which has as many, without new memory.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.x.copy_from_slice(&other.x);
        self.y.copy_from_slice(&other.y);
        self.z.copy_from_slice(&other.z);
    }

    /// How many points there are.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// The vector of point `index` (below [`Points::len`]).
    pub fn get(&self, index: usize) -> Vec3 {
        Vec3::new(self.x[index], self.y[index], self.z[index])
    }

    /// Gives point `index` (below [`Points::len`]) another vector.
    pub fn set(&mut self, index: usize, value: Vec3) {
        self.x[index] = value.x;
        self.y[index] = value.y;
        self.z[index] = value.z;
    }
}

/// `len` copies of `value`, or an error where memory does not suffice.
pub(crate) fn filled<T: Clone>(len: usize, value: T) -> Result<Vec<T>> {
    let mut values = Vec::new();
    values.try_reserve_exact(len).map_err(|_| too_large())?;
    values.resize(len, value);
    Ok(values)
}

/// The error of a cloth with more points than memory holds.
pub(crate) fn too_large() -> Error {
    Error::new(Kind::Scene, "the cloth has more points than fit in memory")
        .with_help("lower cloth.num_width_points or cloth.num_height_points")
}
