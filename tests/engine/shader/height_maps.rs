//! Height maps: a flat one changes nothing, and a displaced ball has the outline that its height
//! map says, the better the finer the ball.

#![expect(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]
#![expect(clippy::cast_possible_truncation, reason = "colours and texels are small")]

use crate::scenes;
use crate::support::{
    Canvas, Picture,
    shaders::{plain, smooth, uniforms},
};
use drape::{
    mesh::{Attributes, Mesh},
    raster::{DrawCall, FragmentProgram, NoVaryings, Primitives, VertexProgram},
    scene::{Needs, Shader, Sphere},
    shader::{Uniforms, bump, displacement, phong, wireframe},
    texture::Texture,
};

/// The unit ball with all attributes.
fn ball(resolution: u32) -> Mesh {
    let sphere = Sphere { resolution: [resolution; 2], ..scenes::ball() };
    Mesh::sphere(&sphere, Needs::of(Shader::Custom))
}

/// Looks along -z; the picture is 3 units wide, and depth falls towards the viewer.
fn from_the_front() -> Uniforms {
    let s = 2.0 / 3.0;
    let u_view_projection =
        [[s, 0.0, 0.0, 0.0], [0.0, s, 0.0, 0.0], [0.0, 0.0, -0.25, 0.0], [0.0, 0.0, 0.0, 1.0]];
    Uniforms { u_view_projection, ..uniforms() }
}

fn draw<F: FragmentProgram<N>, const N: usize>(
    canvas: Canvas,
    mesh: &Mesh,
    vertex: impl VertexProgram<Attributes, F::Varyings<f32>>,
    fragment: F,
) -> Picture {
    let triangles = Primitives::Triangles(&mesh.triangles);
    canvas.draw(&[DrawCall::new(triangles, mesh.positions.len(), |i| mesh.vertex(i), vertex, fragment)])
}

#[test]
fn bump_with_a_flat_height_map_is_phong() {
    let (u, mesh, canvas) = (from_the_front(), ball(40), Canvas::new(256, 256));
    let lit = draw(canvas, &mesh, phong::vertex(&u), phong::Fragment { u });
    for height in [0.0, 0.5, 1.0] {
        let flat = plain(8, [height; 3]);
        let bumped = draw(canvas, &mesh, bump::vertex(&u), bump::Fragment { u, u_texture_2: smooth(&flat) });
        assert_eq!(lit, bumped, "height {height}");
    }
    let ground = plain(8, [0.0; 3]);
    let displaced = draw(
        canvas,
        &mesh,
        displacement::vertex(&u, smooth(&ground)),
        displacement::Fragment { u, u_texture_2: smooth(&ground) },
    );
    assert_eq!(lit, displaced, "no height, no displacement");
}

/// Texels along the meridian of the height map.
const ROWS: usize = 256;

/// The height where the ball's polar angle is πv: two waves from pole to pole.
fn height(v: f64) -> f64 {
    0.5 - 0.5 * drape::math::cos(4.0 * std::f64::consts::PI * v)
}

/// The part of pixels where the picture of a displaced ball differs from its true outline: the
/// curve of radius 1 + kh·height, as the heights depend on the polar angle alone.
fn outline_error(resolution: u32) -> f64 {
    let u = from_the_front();
    let row = |j: usize| [height((j as f64 + 0.5) / ROWS as f64) as f32; 3];
    let waves = Texture::from_rgb(1, ROWS, &(0..ROWS).map(row).collect::<Vec<_>>()).unwrap();
    let canvas = Canvas::new(256, 256);
    let vertex = displacement::vertex(&u, smooth(&waves));
    let picture = draw(
        canvas,
        &ball(resolution),
        |a: &Attributes| (vertex(a).0, NoVaryings::default()),
        wireframe::Fragment { u },
    );
    let differs = |([x, y], &id): ([u32; 2], &u32)| {
        let [x, y] = [f64::from(x) - 127.5, 127.5 - f64::from(y)].map(|c| c * 3.0 / 256.0);
        let v = drape::math::atan2(x.abs(), y) / std::f64::consts::PI;
        let inside = (x * x + y * y).sqrt() < 1.0 + 0.1 * height(v);
        inside != (id != 0)
    };
    let wrong = canvas.pixels().zip(&picture.ids).filter(|&pixel| differs(pixel)).count();
    wrong as f64 / 65_536.0
}

#[test]
fn the_outline_of_a_displaced_ball_approaches_its_height_map() {
    let errors = [16, 32, 64, 128].map(outline_error);
    println!("{errors:?}");
    for pair in errors.windows(2) {
        assert!(pair[1] < 0.6 * pair[0], "{errors:?}");
    }
    assert!(errors[3] < 2e-3, "{errors:?}");
}
