//! Pictures join where they meet themselves or each other.

use drape::cubemap::{Cubemap, FACES};
use drape::texture::Texture;
use drape::texture_source::TextureSource;

/// Mean absolute difference of two rows of texels, in steps of 1/255.
fn contrast(a: &[[f32; 4]], b: &[[f32; 4]]) -> f32 {
    assert_eq!(a.len(), b.len());
    let differences = a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| (x - y).abs());
    differences.sum::<f32>() * 255.0 / (3 * a.len()) as f32
}

/// Row `y` (or column, if `upright`) of a texture.
fn line(texture: &Texture, upright: bool, y: usize) -> Vec<[f32; 4]> {
    (0..texture.width()).map(|x| if upright { texture.texel(y, x) } else { texture.texel(x, y) }).collect()
}

/// Whether opposite sides join: the step from one to the other is no larger than those of the four
/// texels beside it (a thread of the plaid is four wide).
fn joins(texture: &Texture, upright: bool) -> bool {
    let last = texture.width() - 1;
    let step = |a: usize, b: usize| contrast(&line(texture, upright, a), &line(texture, upright, b));
    let beside = (0..4).map(|k| step(k, k + 1).max(step(last - k - 1, last - k))).fold(0.0, f32::max);
    step(last, 0) <= 1.25 * beside + 0.5
}

#[test]
fn pictures_join_where_they_go_around() {
    for (name, upright) in [
        ("texture_1", true),
        ("texture_2", true),
        ("texture_2", false),
        ("texture_3", true),
        ("texture_3", false),
    ] {
        let texture = TextureSource::BuiltIn.texture(name).unwrap();
        assert!(joins(&texture, upright), "{name} has a seam (upright: {upright})");
    }
    assert!(
        !joins(&TextureSource::BuiltIn.texture("texture_1").unwrap(), false),
        "sky and ground do not join"
    );
}

/// Face, s and t of a direction: table 8.19 of the OpenGL 4.6 specification.
fn lookup([x, y, z]: [f64; 3]) -> (usize, f64, f64) {
    let (face, sc, tc, major) = if x.abs() >= y.abs() && x.abs() >= z.abs() {
        if x > 0.0 { (0, -z, -y, x) } else { (1, z, -y, x) }
    } else if y.abs() >= z.abs() {
        if y > 0.0 { (2, x, z, y) } else { (3, x, -z, y) }
    } else if z > 0.0 {
        (4, x, -y, z)
    } else {
        (5, -x, -y, z)
    };
    (face, (sc / major.abs() + 1.0) / 2.0, (tc / major.abs() + 1.0) / 2.0)
}

/// The texel of a cube map in a direction.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "s and t are in 0..=1")]
fn look(cube: &Cubemap, direction: [f64; 3]) -> (usize, [f32; 4]) {
    let (face, s, t) = lookup(direction);
    let texel = |place: f64| ((place * cube.size() as f64) as usize).min(cube.size() - 1);
    (face, cube.faces()[face].texel(texel(s), texel(t)))
}

/// Directions of the middles of a line of texels that runs along an edge between the faces on which
/// coordinates `a` and `b` have these signs, `outward` texels from the edge, on the face of `a`.
fn along_edge(a: (usize, f64), b: (usize, f64), outward: f64, size: usize) -> Vec<[f64; 3]> {
    let place = |i: usize| (i as f64 + 0.5) / size as f64 * 2.0 - 1.0;
    let mut direction = [0.0; 3];
    direction[a.0] = a.1;
    direction[b.0] = b.1 * (1.0 - 2.0 * (outward + 0.5) / size as f64);
    let free = 3 - a.0 - b.0;
    let at = |i| {
        let mut direction = direction;
        direction[free] = place(i);
        direction
    };
    (0..size).map(at).collect()
}

/// The step across one edge of the cube, and the larger of the steps beside it.
fn edge_steps(cube: &Cubemap, a: (usize, f64), b: (usize, f64)) -> (f32, f32) {
    let texels = |a, b, outward, face: &mut Vec<usize>| -> Vec<_> {
        let seen = along_edge(a, b, outward, cube.size()).into_iter().map(|d| look(cube, d));
        let (faces, texels): (Vec<_>, Vec<_>) = seen.unzip();
        assert!(faces.iter().all(|f| *f == faces[0]), "a line of texels lies on one face");
        face.push(faces[0]);
        texels
    };
    let mut faces = Vec::new();
    let [a1, a0] = [1.0, 0.0].map(|outward| texels(a, b, outward, &mut faces));
    let [b0, b1] = [0.0, 1.0].map(|outward| texels(b, a, outward, &mut faces));
    assert!(faces[0] == faces[1] && faces[2] == faces[3] && faces[0] != faces[2], "{faces:?}");
    (contrast(&a0, &b0), contrast(&a1, &a0).max(contrast(&b0, &b1)))
}

/// Edges of a cube map at which the picture breaks.
fn seams(cube: &Cubemap) -> Vec<String> {
    let mut found = Vec::new();
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        for (sa, sb) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let (across, beside) = edge_steps(cube, (a, sa), (b, sb));
            if across > 1.25 * beside + 0.5 {
                found.push(format!("axes {a}{sa:+} and {b}{sb:+}: {across} against {beside}"));
            }
        }
    }
    found
}

#[test]
fn the_cube_map_has_no_seams() {
    let cube = TextureSource::BuiltIn.cubemap("cube").unwrap();
    assert_eq!(seams(&cube), Vec::<String>::new());
}

/// The check above sees each face that is turned, mirrored or in the wrong place.
#[test]
fn a_wrong_face_is_a_seam() {
    let cube = TextureSource::BuiltIn.cubemap("cube").unwrap();
    let size = cube.size();
    for face in 0..6 {
        let texel = |x: usize, y: usize| cube.faces()[face].texel(x, y);
        let changes: [&dyn Fn(usize, usize) -> [f32; 4]; 3] =
            [&|x, y| texel(size - 1 - x, y), &|x, y| texel(x, size - 1 - y), &|x, y| texel(y, size - 1 - x)];
        for (number, change) in changes.iter().enumerate() {
            let rgb = (0..size * size).map(|i| change(i % size, i / size)).map(|[r, g, b, _]| [r, g, b]);
            let mut faces = cube.faces().clone();
            faces[face] = Texture::from_rgb(size, size, &rgb.collect::<Vec<_>>()).unwrap();
            let changed = Cubemap::new("changed", faces).unwrap();
            assert_ne!(seams(&changed), Vec::<String>::new(), "{}, change {number}", FACES[face]);
        }
        let mut faces = cube.faces().clone();
        faces.swap(face, (face + 1) % 6);
        assert_ne!(seams(&Cubemap::new("changed", faces).unwrap()), Vec::<String>::new(), "{}", FACES[face]);
    }
}
