//! Where the picture is taken from.

use super::json::keys::keys;
use super::json::list::{OrNull, Vector};
use super::json::object::defaults;
use super::json::range::{ANY, POSITIVE, Range, from_to};
use super::json::scalar::Flag;
use crate::math::Vec3;

/// Fields of view whose tangent is neither 0 nor infinite in binary32.
const FIELD_OF_VIEW: Range = from_to(0.001, 179.999).unit("degrees");

keys! {
    /// The camera, which looks at its target from a point on a sphere around it, as in the viewer of the course.
    pub struct Camera {
        /// The point that the camera looks at. `null`: the middle of the cloth at its start, at half its
        /// height, which is `[0.5, 0.5, 0.5]` for a horizontal cloth of 1 m.
        target: Option<Vec3> => [None] OrNull(Vector(ANY.unit("m"))), local;
        /// How far the camera is from its target. `null`: 1.8 times the longer side of the cloth, as in the
        /// viewer of the course.
        distance: Option<f64> => [None] OrNull(POSITIVE.unit("m")), local;
        /// Angle of the camera from straight above the target: 0 looks down, 90 looks from the
        /// side, 180 looks up.
        polar: f64 => [90.0] from_to(0.0, 180.0).unit("degrees");
        /// Angle of the camera around the vertical through the target: 0 is towards +z, 90 towards +x, -90
        /// towards -x.
        azimuth: f64 => [0.0] ANY.unit("degrees");
        /// Horizontal field of view. Whichever of `hfov` and `vfov` is too narrow for the shape of the picture is
        /// widened.
        hfov: f64 => [50.0] FIELD_OF_VIEW;
        /// Vertical field of view; see `hfov`.
        vfov: f64 => [35.0] FIELD_OF_VIEW;
        /// Whether the camera frames what there is: target and distance are chosen so that the cloth as it is in the
        /// picture, the balls and the boxes just fit into it, from the side that `polar` and `azimuth` say. In an
        /// animation it follows the cloth.
        fit: bool => [false] Flag;
        /// Distance of the near plane: what is nearer to the camera is not drawn.
        near: f64 => [0.01] POSITIVE.unit("m"), local;
        /// Distance of the far plane: what is farther from the camera is not drawn. It must be above `near`.
        far: f64 => [10_000.0] POSITIVE.unit("m"), local;
    }
}

impl Default for Camera {
    /// The camera of a scene file that says nothing about it.
    fn default() -> Self {
        defaults(Self::read)
    }
}
