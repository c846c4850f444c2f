//! Where a cube map jumps: on the seams between its faces, which are not filtered across. There the
//! last bit of a direction picks the face.

use drape::camera::Camera;
use drape::cubemap::Cubemap;
use drape::mesh::Attributes;
use drape::raster::{self, DrawCall, FragmentProgram, Framebuffer, Primitives, VertexProgram};
use drape::scene::{Scene, Shader};
use drape::shader::sampler::{Sampler2d, SamplerCube};
use drape::shader::{custom, mirror, wireframe};
use drape::texture::Texture;

use super::object::Object;

/// Pixels that show one face of the cube map next to a pixel that shows another.
pub(crate) fn seams(scene: &Scene, objects: &[Object<'_>]) -> Vec<bool> {
    let faces = faces(scene, objects);
    let [width, height] = scene.render.size.map(|n| n as usize);
    let differs = |i: usize, j: usize| faces[i] != [0; 3] && faces[j] != [0; 3] && faces[i] != faces[j];
    let near = |x: usize, y: usize| {
        let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
        let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
        rows.flat_map(|row| columns.clone().map(move |column| row * width + column))
            .any(|j| differs(y * width + x, j))
    };
    (0..width * height).map(|i| near(i % width, i / width)).collect()
}

/// A colour per face of the cube map that is seen; black where none is.
fn faces(scene: &Scene, objects: &[Object<'_>]) -> Vec<[u8; 3]> {
    let shades = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(|face| [face / 6.0; 3]);
    let flat = shades.map(|shade| Texture::from_rgb(1, 1, &[shade]).unwrap());
    let cubemap = Cubemap::new("faces", flat).unwrap();
    let cube = SamplerCube { cubemap: &cubemap, filter: scene.render.filter, seamless: false };
    let camera = Camera::of(scene).unwrap();
    let height_maps: Vec<_> = objects.iter().map(Object::height_map).collect();
    let calls = objects.iter().zip(&height_maps).map(|(object, height_map)| {
        let mut u = object.uniforms(scene, &camera);
        // Nothing but the mirror.
        [u.u_ka, u.u_kd, u.u_ks, u.u_km] = [0.0, 0.0, 0.0, 1.0];
        u.u_color = [0.0; 3];
        let height_map = height_map.as_ref().map(|texture| Sampler2d {
            texture,
            filter: scene.render.filter,
            wrap_v: object.wrap_v(),
        });
        match (object.material.shader, height_map) {
            (Shader::Mirror, _) => {
                call(object, mirror::vertex(&u), mirror::Fragment { u, u_texture_cubemap: cube })
            }
            (Shader::Custom, Some(texture)) => {
                let fragment = custom::Fragment {
                    u,
                    u_texture_1: texture,
                    u_texture_2: texture,
                    u_texture_cubemap: cube,
                };
                call(object, custom::vertex(&u, texture), fragment)
            }
            _ => call(object, wireframe::vertex(&u), wireframe::Fragment { u }),
        }
    });
    let [width, height] = scene.render.size;
    let mut framebuffer = Framebuffer::new(width, height, 1);
    raster::draw(&mut framebuffer, [0.0; 3], &calls.collect::<Vec<_>>(), false);
    framebuffer.rgb().chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect()
}

/// The triangles of an object.
fn call<'a, F: FragmentProgram<N> + 'a, const N: usize>(
    object: &'a Object<'_>,
    vertex: impl VertexProgram<Attributes, F::Varyings<f32>> + 'a,
    fragment: F,
) -> DrawCall<'a> {
    let mesh = &object.mesh;
    let triangles = Primitives::Triangles(&mesh.triangles);
    DrawCall::new(triangles, mesh.positions.len(), |i| mesh.vertex(i), vertex, fragment)
}
