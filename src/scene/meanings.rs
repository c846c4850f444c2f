//! What every key of a scene file means, in words for those who write one: the descriptions of the
//! JSON schema and the tables of `docs/scene.md`.

/// An object's keys, each with its meaning.
type Keys = &'static [(&'static str, &'static str)];

/// Every object by its key (empty for the scene itself), in the order of the reader.
pub(super) const MEANINGS: &[(&str, Keys)] = &[
    ("", SCENE),
    ("cloth", CLOTH),
    ("sphere", SPHERE),
    ("plane", PLANE),
    ("sim", SIM),
    ("camera", CAMERA),
    ("light", LIGHT),
    ("material", MATERIAL),
    ("render", RENDER),
];

/// What the key `name` of the object at the dotted path `object` means.
pub(super) fn meaning(object: &str, name: &str) -> &'static str {
    // The material of an object has the keys of the scene's material.
    let kind = object.rsplit('.').next().unwrap_or(object);
    let keys = MEANINGS.iter().find(|(object, _)| *object == kind).map_or(SCENE, |(_, keys)| keys);
    keys.iter().find(|(key, _)| *key == name).map_or("", |(_, meaning)| meaning)
}

/// The objects that have a key called `name`.
pub(super) fn objects_with(name: &str) -> impl Iterator<Item = &'static str> {
    MEANINGS
        .iter()
        .filter(move |(_, keys)| keys.iter().any(|(key, _)| *key == name))
        .map(|(object, _)| *object)
}

const SCENE: Keys = &[
    ("cloth", "The cloth: a rectangle of point masses joined by springs. Without it there is none."),
    ("sphere", "A ball that the cloth falls on, or a list of balls."),
    (
        "plane",
        "A plane that the cloth falls on, or a list of planes. It has no end, but a square of 4 m of it is \
         drawn.",
    ),
    ("sim", "How the cloth is moved."),
    ("camera", "Where the picture is taken from."),
    ("light", "The one light, a point."),
    ("material", "What every object looks like, but for what its own `material` says."),
    ("render", "Size, background and moment of the picture."),
];

const CLOTH: Keys = &[
    ("width", "Length along the first direction of the grid, the scene's x axis."),
    (
        "height",
        "Length along the second direction of the grid: the z axis if the cloth lies, the y axis if it \
         stands.",
    ),
    ("num_width_points", "Points along `width`. Both counts multiplied are at most 4194304."),
    ("num_height_points", "Points along `height`."),
    (
        "thickness",
        "Half the distance that self-collision keeps between two points; 0 switches self-collision off.",
    ),
    (
        "orientation",
        "How the cloth starts: 0 lying, at the height y = 1 m; 1 standing, in the plane z = 0, with each \
         point moved by up to 1 mm out of it so that the cloth folds as it falls.",
    ),
    (
        "pinned",
        "Points that never move, as grid points `[x, y]` counted from 0: `[[0, 0], [49, 0]]` holds two \
         corners of 50 x 50 points.",
    ),
    (
        "damping",
        "Part of its motion that a point loses in each step (`sim.damping` can make it a rate per second).",
    ),
    ("density", "Mass per area. The course's viewer shows a tenth of it as g/cm²: 15 there is 150 here."),
    ("ks", "Stiffness of the structural and shearing springs; bending springs have a fifth of it."),
    ("enable_structural", "Springs from each point to the next along the grid: they resist stretching."),
    ("enable_shearing", "Springs from each point to its diagonal neighbours: they resist shearing."),
    ("enable_bending", "Springs from each point to the next but one along the grid: they resist bending."),
    ("material", "What the cloth looks like. A key that is left out is as in the scene's `material`."),
];

const SPHERE: Keys = &[
    ("origin", "The centre `[x, y, z]`."),
    (
        "radius",
        "The radius. The drawn ball has 0.92 of it, so that the cloth's flat triangles do not cut into it.",
    ),
    (
        "friction",
        "Part of the sliding that contact takes away: 0 is smooth, 1 holds a point where it was a step before.",
    ),
    ("resolution", "Latitude and longitude counts of the drawn ball; `-a` and `-o` on the command line."),
    ("material", "What the ball looks like. A key that is left out is as in the scene's `material`."),
];

const PLANE: Keys = &[
    ("point", "A point of the plane; the drawn square is around it."),
    ("normal", "The direction at right angles to the plane, of any length."),
    (
        "friction",
        "Part of the sliding that contact takes away: 0 is smooth, 1 holds a point where it was a step before.",
    ),
    ("material", "What the plane looks like. A key that is left out is as in the scene's `material`."),
];

const SIM: Keys = &[
    ("fps", "Frames per second of simulated time; results are looked at once a frame."),
    (
        "steps_per_frame",
        "Steps of the simulation in each frame: a step lasts 1 / (fps · steps_per_frame) seconds.",
    ),
    ("gravity", "The acceleration of every point, `[x, y, z]`."),
    (
        "integrator",
        "The scheme that moves the points; `verlet` is the course's. No implicit method was as accurate as `verlet` for the \
         same work at any stiffness that was tried, and fewer implicit steps can cost more (`docs/findings.md`).",
    ),
    ("iterations", "Passes over the springs in a step of `xpbd`; no other integrator reads it."),
    (
        "tolerance",
        "Part of the forces that `implicit_euler` and `bdf2` may leave unbalanced at the end of a step; no \
         other integrator reads it.",
    ),
    (
        "precision",
        "The arithmetic of the positions: 64 bits, or 32 (`verlet` only), which is there to compare.",
    ),
    (
        "start",
        "How `verlet` starts from rest. `report`: as the course does, with an error that grows as the step \
         does; `half_step`: second order, at no cost.",
    ),
    (
        "damping",
        "What `cloth.damping` is a part of. `per_step`: of a step's motion, as in the course, so that \
         twice the steps damp twice as much; `per_second`: a rate that does not depend on the steps, and \
         agrees with the other at 2700 steps a second.",
    ),
    (
        "stretch_limit",
        "The strain at which the stretch limit shortens a spring again: 0.1 is 10 %. `null` switches it \
         off.",
    ),
    (
        "stretch_passes",
        "Passes of the stretch limit in each step. One leaves some springs longer than the limit.",
    ),
    (
        "self_collision",
        "Which pairs of points are kept apart. `same_box`: those within one box of a coarse grid, as in \
         the course, which misses some; `neighbors`: all that are too close; `off`: none.",
    ),
    (
        "contact",
        "What is promised of points that touch a ball or a plane. `report`: nothing, as in the course, so \
         some end up a little inside; `outside`: none is inside after a step, but where objects overlap it may \
         be inside all but the last.",
    ),
];

const CAMERA: Keys = &[
    (
        "target",
        "The point that the camera looks at. `null`: the middle of the cloth at its start, at half its \
         height, which is `[0.5, 0.5, 0.5]` for a lying cloth of 1 m.",
    ),
    (
        "distance",
        "How far the camera is from its target. `null`: 1.8 times the longer side of the cloth, as in the \
         course's viewer.",
    ),
    (
        "polar",
        "How far the camera is tilted from straight above the target: 0 looks down, 90 looks from the \
         side, 180 looks up.",
    ),
    (
        "azimuth",
        "Where the camera is around the vertical through the target: 0 is towards +z, 90 towards +x, -90 \
         towards -x.",
    ),
    (
        "hfov",
        "Horizontal field of view. Whichever of `hfov` and `vfov` is too narrow for the picture's shape is \
         widened.",
    ),
    ("vfov", "Vertical field of view; see `hfov`."),
    ("near", "What is nearer to the camera than this is not drawn."),
    ("far", "What is farther from the camera than this is not drawn; it is above `near`."),
];

const LIGHT: Keys = &[
    ("position", "Where the light is."),
    (
        "intensity",
        "How strong the light is in red, green and blue, at a distance of 1 m; it falls with the square of \
         the distance.",
    ),
    (
        "color",
        "The tint, red, green and blue, that the `custom` shader gives its highlight and ambient light; no \
         other shader reads it. It is normalised: `[2, 2, 2]` equals `[1, 1, 1]`.",
    ),
];

const MATERIAL: Keys = &[
    (
        "shader",
        "The program that colours the object; the table below tells them apart. `--shader` on the command \
         line sets it for every object.",
    ),
    (
        "color",
        "The colour: of `wireframe`, and of the diffuse light of `diffuse`, `phong`, `bump` and `displacement`. \
         Planes are a light grey, 0.7, if it is left out.",
    ),
    ("ka", "Weight of the ambient light, which is everywhere the same."),
    ("kd", "Weight of the diffuse light, which is strongest where the surface faces the light."),
    ("ks", "Weight of the highlight. Not the stiffness, which is `cloth.ks`."),
    ("shininess", "Exponent of the highlight: the larger, the smaller and sharper it is."),
    ("km", "Weight of the mirror image in `custom`."),
    (
        "normal_scaling",
        "How much steeper than the height map says `bump`, `displacement` and `custom` shade a slope; it \
         is multiplied by `height_scaling`. The default is the course's and hardly shows in `bump`; the \
         report's figures have 100.",
    ),
    (
        "height_scaling",
        "How far a white pixel of the height map lifts the surface in `displacement` and `custom`, in metres \
         on the cloth and in drawn radii on a ball; a factor of the slopes in `bump` too. The default is the course's \
         and makes lumps of 10 cm; the report's figures have 0.02 or 0.03.",
    ),
    (
        "texture",
        "The colour picture of `texture` and `custom`, by its file name without ending. Built in are \
         `texture_1` (a sunset), `texture_2` (the heights of a stone wall), `texture_3` (a plaid) and \
         `texture_4` (a grid of coordinates); `--textures DIR` has your own.",
    ),
    (
        "height_map",
        "The height map of `bump`, `displacement` and `custom`, named as `texture` is; its red channel is \
         the height.",
    ),
    (
        "environment",
        "The six pictures around the scene that `mirror` and `custom` show: the name of a folder in \
         `--textures DIR` with `posx.png`, `negx.png` and so on; `cube` is built in.",
    ),
];

const RENDER: Keys = &[
    ("size", "Width and height of the picture in pixels; `--size` on the command line."),
    ("samples", "Samples in each pixel: more than 1 smooths edges. `--samples` on the command line."),
    ("background", "Colour where nothing is drawn: red, green and blue, 1 for all of it."),
    (
        "time",
        "The simulated time at which the picture is taken, rounded to a frame; `--time` on the command \
         line.",
    ),
    ("filter", "How textures are looked up: the `nearest` pixel, or four of them mixed."),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_found_where_it_is() {
        assert!(meaning("", "cloth").starts_with("The cloth"));
        assert_eq!(meaning("sphere.material", "kd"), meaning("material", "kd"));
        assert_eq!(meaning("sphere", "kd"), "");
        assert_eq!(objects_with("friction").collect::<Vec<_>>(), ["sphere", "plane"]);
        assert_eq!(objects_with("frction").count(), 0);
    }
}
