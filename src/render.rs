//! A scene and the cloth's positions in, a picture out.

use nalgebra::Vector3;

use crate::{
    camera::{Camera, Columns},
    cloth::Points,
    cubemap::Cubemap,
    error::Result,
    lanes::{Lane, Wide},
    mesh::{Mesh, Reads, SpringKinds, spring_lines},
    raster::{self, DrawCall, Framebuffer, Primitives, Stages, Stats},
    scene::{Material, Scene, Shader, Vec3},
    shader::{
        Uniforms, bump, custom, diffuse, displacement,
        glsl::{Exponent, FragmentProgram, VertexProgram},
        mirror, normal, phong,
        sampler::{Sampler2d, SamplerCube},
        texture, wireframe,
    },
    texture::Texture,
    texture_source::TextureSource,
};

/// Part of its radius at which a ball is drawn, so that the cloth's flat triangles do not cut it.
const DRAWN_RADIUS: f64 = 0.92;

/// What is asked of a picture besides the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Spring kinds that a wireframe shows; absent: those that the cloth has.
    pub springs: Option<SpringKinds>,
    /// Keep object and triangle ids.
    pub ids: bool,
}

/// A finished picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Stored colours, three bytes a pixel, top row first.
    pub rgb: Vec<u8>,
    /// Window depth per pixel, 1 where nothing was drawn.
    pub depth: Vec<f32>,
    /// `object << 24 | (triangle + 1)` per pixel, 0 for the background; empty if not asked for.
    pub ids: Vec<u32>,
    /// What drawing it took.
    pub stats: Stats,
}

/// A scene with its textures, ready to be drawn at any positions of its cloth.
#[derive(Clone, Debug)]
pub struct Renderer {
    scene: Scene,
    camera: Camera,
    textures: Vec<(String, Texture)>,
    cubemaps: Vec<(String, Cubemap)>,
}

/// A mesh in the world, and what it looks like.
struct Object<'a> {
    mesh: Mesh,
    lines: Option<Vec<[u32; 2]>>,
    model: Columns,
    material: &'a Material,
}

impl Renderer {
    /// Reads the textures that the scene's materials need, each once, and no others.
    ///
    /// # Errors
    /// A texture that is missing or cannot be decoded.
    pub fn new(scene: &Scene, source: &TextureSource) -> Result<Self> {
        let mut renderer = Self {
            scene: scene.clone(),
            camera: Camera::of(scene),
            textures: Vec::new(),
            cubemaps: Vec::new(),
        };
        for material in materials(scene) {
            let needs = needs(material.shader);
            for name in [(needs.texture, &material.texture), (needs.height_map, &material.height_map)]
                .iter()
                .filter_map(|&(needed, name)| needed.then_some(name))
            {
                if find(&renderer.textures, name).is_none() {
                    renderer.textures.push((name.clone(), source.texture(name)?));
                }
            }
            if needs.environment && find(&renderer.cubemaps, &material.environment).is_none() {
                let cubemap = source.cubemap(&material.environment)?;
                renderer.cubemaps.push((material.environment.clone(), cubemap));
            }
        }
        Ok(renderer)
    }

    /// A framebuffer of the scene's size and samples.
    pub fn framebuffer(&self) -> Framebuffer {
        let [width, height] = self.scene.render.size;
        Framebuffer::new(width, height, self.scene.render.samples)
    }

    /// The picture with the cloth at `points`.
    pub fn draw(&self, points: &Points, options: &Options) -> Picture {
        let mut framebuffer = self.framebuffer();
        let (stats, _) = self.draw_into(&mut framebuffer, points, options);
        let [width, height] = self.scene.render.size;
        let (rgb, depth, ids) = (framebuffer.rgb(), framebuffer.depth(), framebuffer.ids());
        Picture { width, height, rgb, depth, ids, stats }
    }

    /// Draws into a framebuffer made by [`Renderer::framebuffer`], which is cleared first.
    pub fn draw_into(&self, framebuffer: &mut Framebuffer, points: &Points, options: &Options) -> (Stats, Stages) {
        let objects = self.objects(points, options);
        let calls: Vec<_> = objects.iter().map(|object| self.draw_call::<Wide<f32>>(object)).collect();
        raster::draw(framebuffer, round(self.scene.render.background), &calls, options.ids)
    }

    /// What is drawn, in order: the cloth, then the planes, then the spheres.
    fn objects(&self, points: &Points, options: &Options) -> Vec<Object<'_>> {
        let mut objects = Vec::new();
        if let Some(cloth) = &self.scene.cloth {
            let lines = (cloth.material.shader == Shader::Wireframe)
                .then(|| spring_lines(cloth, options.springs.unwrap_or_else(|| SpringKinds::of(cloth))));
            let mesh = Mesh::cloth(cloth, points, needs(cloth.material.shader).attributes);
            objects.push(Object { mesh, lines, model: model(&Vec3::zeros(), 1.0), material: &cloth.material });
        }
        for plane in &self.scene.planes {
            let mesh = Mesh::plane(plane, needs(plane.material.shader).attributes);
            let model = model(&Vec3::zeros(), 1.0);
            objects.push(Object { mesh, lines: None, model, material: &plane.material });
        }
        for sphere in &self.scene.spheres {
            let mesh = Mesh::sphere(sphere, needs(sphere.material.shader).attributes);
            let model = model(&sphere.origin, sphere.radius * DRAWN_RADIUS);
            objects.push(Object { mesh, lines: None, model, material: &sphere.material });
        }
        objects
    }

    /// The draw call of an object: its mesh with the programs of its material.
    fn draw_call<'a, L: Lane + 'a>(&'a self, object: &'a Object<'a>) -> DrawCall<'a> {
        let u = &self.uniforms(object);
        let material = object.material;
        let texture_1 = || self.sampler(&material.texture);
        let texture_2 = || self.sampler(&material.height_map);
        let environment = || self.sampler_cube(&material.environment);
        match material.shader {
            Shader::Wireframe => object.call(wireframe::vertex(u), wireframe::fragment::<L>(u)),
            Shader::Normal => object.call(normal::vertex(u), normal::fragment::<L>(u)),
            Shader::Diffuse => object.call(diffuse::vertex(u), diffuse::fragment::<L>(u)),
            Shader::Phong => object.call(phong::vertex(u), phong::fragment::<L>(u)),
            Shader::Texture => object.call(texture::vertex(u), texture::fragment::<L>(u, texture_1())),
            Shader::Mirror => object.call(mirror::vertex(u), mirror::fragment::<L>(u, environment())),
            Shader::Bump => object.call(bump::vertex(u), bump::fragment::<L>(u, texture_2())),
            Shader::Displacement => {
                object.call(displacement::vertex(u, texture_2()), displacement::fragment::<L>(u, texture_2()))
            }
            Shader::Custom => object.call(
                custom::vertex(u, texture_2()),
                custom::fragment::<L>(u, texture_1(), texture_2(), environment()),
            ),
        }
    }

    fn uniforms(&self, object: &Object<'_>) -> Uniforms {
        let (material, light) = (object.material, &self.scene.light);
        Uniforms {
            u_model: object.model,
            u_view_projection: self.camera.view_projection,
            u_cam_pos: self.camera.position,
            u_color: round(material.color),
            u_light_pos: round(light.position),
            u_light_intensity: round(light.intensity),
            u_light_color: round(light.color),
            u_ka: to_f32(material.ka),
            u_kd: to_f32(material.kd),
            u_ks: to_f32(material.ks),
            u_shininess: Exponent::of(to_f32(material.shininess)),
            u_km: to_f32(material.km),
            u_normal_scaling: to_f32(material.normal_scaling),
            u_height_scaling: to_f32(material.height_scaling),
        }
    }

    fn sampler(&self, name: &str) -> Sampler2d<'_> {
        Sampler2d { texture: find(&self.textures, name).expect(LOADED), filter: self.scene.render.filter }
    }

    fn sampler_cube(&self, name: &str) -> SamplerCube<'_> {
        SamplerCube { cubemap: find(&self.cubemaps, name).expect(LOADED), filter: self.scene.render.filter }
    }
}

/// `Renderer::new` reads exactly what `draw_call` asks for: both go by `needs`.
const LOADED: &str = "the renderer reads all textures of its materials";

impl Object<'_> {
    fn call<'a, L: Lane, const N: usize>(
        &'a self,
        vertex: impl VertexProgram<N> + 'a,
        fragment: impl FragmentProgram<L, N> + 'a,
    ) -> DrawCall<'a> {
        let primitives = match &self.lines {
            Some(lines) => Primitives::Lines(lines),
            None => Primitives::Triangles(&self.mesh.triangles),
        };
        DrawCall::new(primitives, self.mesh.positions.len(), |i| self.mesh.vertex(i), vertex, fragment)
    }
}

/// What a shader reads.
struct Needs {
    attributes: Reads,
    texture: bool,
    height_map: bool,
    environment: bool,
}

fn needs(shader: Shader) -> Needs {
    let bumped = matches!(shader, Shader::Bump | Shader::Displacement | Shader::Custom);
    Needs {
        attributes: Reads {
            normal: !matches!(shader, Shader::Wireframe | Shader::Texture),
            tangent: bumped,
            uv: bumped || shader == Shader::Texture,
        },
        texture: matches!(shader, Shader::Texture | Shader::Custom),
        height_map: bumped,
        environment: matches!(shader, Shader::Mirror | Shader::Custom),
    }
}

fn materials(scene: &Scene) -> impl Iterator<Item = &Material> {
    let planes = scene.planes.iter().map(|plane| &plane.material);
    let spheres = scene.spheres.iter().map(|sphere| &sphere.material);
    scene.cloth.iter().map(|cloth| &cloth.material).chain(planes).chain(spheres)
}

fn find<'a, T>(named: &'a [(String, T)], name: &str) -> Option<&'a T> {
    named.iter().find(|(other, _)| other == name).map(|(_, value)| value)
}

/// Scales by `scale`, then moves to `origin`.
fn model(origin: &Vec3, scale: f64) -> Columns {
    let s = to_f32(scale);
    let [x, y, z] = round(*origin);
    [[s, 0.0, 0.0, 0.0], [0.0, s, 0.0, 0.0], [0.0, 0.0, s, 0.0], [x, y, z, 1.0]]
}

fn round(v: Vector3<f64>) -> [f32; 3] {
    [v.x, v.y, v.z].map(to_f32)
}

#[expect(clippy::cast_possible_truncation, reason = "uniforms are f32")]
fn to_f32(value: f64) -> f32 {
    value as f32
}
