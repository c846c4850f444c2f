//! The cloth: its size, its springs and how it starts.

use super::Material;
use super::json::choice::{choices, numbered};
use super::json::keys::keys;
use super::json::list::{GridPoints, Vector};
use super::json::range::{ANY, NOT_NEGATIVE, POSITIVE, from_to};
use super::json::scalar::{Count, Flag};
use crate::math::Vec3;

/// Most points of a cloth: as many as 2048 x 2048, whose triangles can be numbered in 24 bits.
pub const MAX_POINTS: usize = 1 << 22;

/// Points along one side. The product of both sides is limited to [`MAX_POINTS`] when the whole scene is
/// checked.
const SIDE: Count<usize> = Count(2, MAX_POINTS / 2);

keys! {
    /// A rectangular cloth of point masses.
    pub struct Cloth {
        /// Length along the first direction of the grid, the x axis of the scene.
        width: f64 => [required] POSITIVE.unit("m"), local;
        /// Length along the second direction of the grid: the z axis if the cloth is horizontal, the y axis if it
        /// is vertical.
        height: f64 => [required] POSITIVE.unit("m"), local;
        /// Points along `width`. The product of both counts may be at most 4194304.
        ///
        /// `W` of the method.
        num_width_points: usize => [required] SIDE;
        /// Points along `height`.
        ///
        /// `H` of the method.
        num_height_points: usize => [required] SIDE;
        /// Half the distance that self-collision keeps between two points; 0 turns self-collision off.
        thickness: f64 => [required] NOT_NEGATIVE.unit("m");
        /// How the cloth starts.
        orientation: Orientation => [required] numbered::<Orientation>();
        /// Added to the place of every point at the start, pinned ones too.
        offset: Vec3 => [Vec3::zeros()] Vector(ANY.unit("m"));
        /// The velocity at the start of every point that is not pinned.
        velocity: Vec3 => [Vec3::zeros()] Vector(ANY.unit("m/s"));
        /// Points that never move, as grid points `[x, y]` counted from 0: `[[0, 0], [49, 0]]` holds two
        /// corners of 50 x 50 points.
        ///
        /// Each is given once and lies on the grid.
        pinned: Vec<[usize; 2]> => [Vec::new()] GridPoints;
        /// Share of its motion that a point loses in each step; `sim.damping` can make it a rate per second.
        damping: f64 => [required] from_to(0.0, 100.0).unit("%");
        /// Mass per area. The viewer of the course shows a tenth of it as g/cm²: 15 there is 150 here.
        density: f64 => [required] POSITIVE.unit("kg/m²");
        /// Stiffness of each structural and shearing spring; bending springs have a fifth of it. It is that of a spring,
        /// not of the material, which so depends on the number of points: a strip of 0.2 m x 1 m with 21 rows (density
        /// 150, ks 5000, structural springs alone), hung by its upper edge, sags by 0.196 m with 3 columns and by
        /// 0.035 m with 17.
        ks: f64 => [required] NOT_NEGATIVE.unit("N/m");
        /// Springs from each point to the next along the grid. They resist stretching.
        enable_structural: bool => [required] Flag;
        /// Springs from each point to its diagonal neighbours. They resist shearing.
        enable_shearing: bool => [required] Flag;
        /// Springs from each point to the next but one along the grid. They resist bending.
        enable_bending: bool => [required] Flag;
        /// What the cloth looks like. A key that is left out is as in the scene's `material`.
        material: Material => [inherited] Material::read;
    }
}

choices! {
    /// How the cloth lies at the start (`cloth.orientation`); a scene file gives the place in this list.
    pub enum Orientation {
        /// It lies at the height y = 1 m.
        Horizontal = "horizontal",
        /// It stands in the plane z = 0, with each point moved out of it by up to 1 mm, so that the cloth
        /// folds as it falls.
        Vertical = "vertical",
    }
}
