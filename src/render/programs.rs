//! The programs of the objects: what each material's shader is made of, with its uniforms and textures.

use super::object::Object;
use super::options::{Shading, round, to_f32};
use crate::{
    camera::{self, Camera},
    cubemap::Cubemap,
    error::Result,
    glsl::Exponent,
    math::StateHash,
    raster::DrawCall,
    scene::{Bitangent, Collider, Images, Scene, Shader, Vec3},
    shader::{
        Uniforms, bump, custom, diffuse, displacement, mirror, normal, phong,
        sampler::{Sampler2d, SamplerCube, Wrap},
        texture, wireframe,
    },
    texture::{Texture, check_all_texels},
    texture_source::TextureSource,
};

/// A scene with its camera and textures.
#[derive(Clone, Debug)]
pub(super) struct Programs {
    /// The scene, moved so that `origin` is at 0.
    pub(super) scene: Scene,
    /// The point of the world that is drawn as the origin.
    pub(super) origin: Vec3,
    camera: Camera,
    textures: Vec<(String, Texture)>,
    cubemaps: Vec<(String, Cubemap)>,
}

impl Programs {
    /// Reads the textures that the scene's materials need, each once, and no others.
    ///
    /// # Errors
    /// A texture that is missing or cannot be decoded.
    pub(super) fn new(scene: &Scene, source: &TextureSource) -> Result<Self> {
        let origin = camera::origin(scene)?;
        let scene = moved(scene, origin)?;
        let camera = Camera::of(&scene)?;
        let mut programs = Self { scene, origin, camera, textures: Vec::new(), cubemaps: Vec::new() };
        programs.read_missing(source)?;
        Ok(programs)
    }

    /// Checks the camera of a scene.
    pub(super) fn check(scene: &Scene) -> Result<()> {
        Camera::of(&moved(scene, camera::origin(scene)?)?).map(drop)
    }

    /// The same for another scene; what was read is kept and not read again.
    ///
    /// # Errors
    /// As [`Programs::new`]; then nothing but what was read has changed.
    pub(super) fn change_scene(&mut self, scene: &Scene, source: &TextureSource) -> Result<()> {
        let origin = camera::origin(scene)?;
        let scene = moved(scene, origin)?;
        let camera = Camera::of(&scene)?;
        let before = std::mem::replace(&mut self.scene, scene);
        if let Err(error) = self.read_missing(source) {
            self.scene = before;
            return Err(error);
        }
        (self.camera, self.origin) = (camera, origin);
        Ok(())
    }

    /// Reads the textures that the scene needs and that were not read yet.
    fn read_missing(&mut self, source: &TextureSource) -> Result<()> {
        let images = Images::of(&self.scene);
        for name in images.textures {
            if find(&self.textures, &name).is_none() {
                let texture = source.texture(&name)?;
                self.textures.push((name, texture));
                self.check_texels()?;
            }
        }
        for name in images.environments {
            if find(&self.cubemaps, &name).is_none() {
                let cubemap = source.cubemap(&name)?;
                self.cubemaps.push((name, cubemap));
                self.check_texels()?;
            }
        }
        Ok(())
    }

    /// Checks that the textures together have at most [`MAX_ALL_TEXELS`].
    fn check_texels(&self) -> Result<()> {
        let faces = self.cubemaps.iter().flat_map(|(_, cubemap)| cubemap.faces());
        let all = self.textures.iter().map(|(_, texture)| texture).chain(faces);
        check_all_texels(all.map(|texture| texture.texels().len() as u64).sum())
    }

    /// Takes the texels of all textures into `hash`.
    pub(super) fn hash_textures(&self, hash: &mut StateHash) {
        let faces = self.cubemaps.iter().flat_map(|(_, cubemap)| cubemap.faces());
        for texture in self.textures.iter().map(|(_, texture)| texture).chain(faces) {
            hash.write(&(texture.width() as u64).to_le_bytes());
            texture.texels().iter().flatten().for_each(|value| hash.write(&value.to_le_bytes()));
        }
    }

    /// The names of the textures that have transparent pixels.
    pub(super) fn transparent_textures(&self) -> Vec<&str> {
        let named = self.textures.iter().map(|(name, texture)| (name, texture.was_transparent()));
        let cubes = self
            .cubemaps
            .iter()
            .map(|(name, cube)| (name, cube.faces().iter().any(Texture::was_transparent)));
        named.chain(cubes).filter(|(_, transparent)| *transparent).map(|(name, _)| name.as_str()).collect()
    }

    /// The camera for a picture of `objects`.
    pub(super) fn camera(&self, objects: &[Object<'_>]) -> Camera {
        if !self.scene.camera.fit {
            return self.camera.clone();
        }
        // Planes have no end; they are framed only where there is nothing else.
        let bounded: Vec<_> = objects.iter().filter(|object| !object.is_plane).collect();
        let shown = if bounded.is_empty() { objects.iter().collect() } else { bounded };
        let points: Vec<Vec3> = shown.into_iter().flat_map(Object::places).collect();
        let fitting = if points.is_empty() { None } else { Camera::fitting(&self.scene, &points).ok() };
        fitting.unwrap_or_else(|| self.camera.clone())
    }

    /// The draw call of an object: its mesh with the programs of its material.
    pub(super) fn draw_call<'a>(
        &'a self,
        object: &'a Object<'a>,
        camera: &Camera,
        shading: Shading,
    ) -> DrawCall<'a> {
        let u = self.uniforms(object, camera);
        let material = object.material;
        let u_texture_1 = || self.sampler(&material.texture, object.wrap_v);
        let u_texture_2 = || self.sampler(&material.height_map, object.wrap_v);
        let u_texture_cubemap = || self.sampler_cube(&material.environment);
        match material.shader {
            Shader::Wireframe => object.call(shading, wireframe::vertex(&u), wireframe::Fragment { u }),
            Shader::Normal => object.call(shading, normal::vertex(&u), normal::Fragment {}),
            Shader::Diffuse => object.call(shading, diffuse::vertex(&u), diffuse::Fragment { u }),
            Shader::Phong => object.call(shading, phong::vertex(&u), phong::Fragment { u }),
            Shader::Texture => {
                let fragment = texture::Fragment { u_texture_1: u_texture_1() };
                object.call(shading, texture::vertex(&u), fragment)
            }
            Shader::Mirror => {
                let fragment = mirror::Fragment { u, u_texture_cubemap: u_texture_cubemap() };
                object.call(shading, mirror::vertex(&u), fragment)
            }
            Shader::Bump => {
                let fragment = bump::Fragment { u, u_texture_2: u_texture_2() };
                object.call(shading, bump::vertex(&u), fragment)
            }
            Shader::Displacement => {
                let fragment = displacement::Fragment { u, u_texture_2: u_texture_2() };
                object.call(shading, displacement::vertex(&u, u_texture_2()), fragment)
            }
            Shader::Custom => {
                let fragment = custom::Fragment {
                    u,
                    u_texture_1: u_texture_1(),
                    u_texture_2: u_texture_2(),
                    u_texture_cubemap: u_texture_cubemap(),
                };
                object.call(shading, custom::vertex(&u, u_texture_2()), fragment)
            }
        }
    }

    fn uniforms(&self, object: &Object<'_>, camera: &Camera) -> Uniforms {
        let (material, light) = (object.material, &self.scene.light);
        Uniforms {
            u_model: object.model,
            u_view_projection: camera.view_projection,
            u_cam_pos: camera.position,
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
            u_bitangent: match material.bitangent {
                Bitangent::NormalCrossTangent => 1.0,
                Bitangent::Uv => -1.0,
            },
            u_two_sided: f32::from(u8::from(material.two_sided)),
        }
    }

    fn sampler(&self, name: &str, wrap_v: Wrap) -> Sampler2d<'_> {
        let texture = find(&self.textures, name).expect(LOADED);
        Sampler2d { texture, filter: self.scene.render.filter, wrap_v }
    }

    fn sampler_cube(&self, name: &str) -> SamplerCube<'_> {
        let cubemap = find(&self.cubemaps, name).expect(LOADED);
        let crate::scene::Render { filter, seamless, .. } = self.scene.render;
        SamplerCube { cubemap, filter, seamless }
    }
}

/// The scene as it is seen from `origin`, but for the cloth, whose points are handed in.
fn moved(scene: &Scene, origin: Vec3) -> Result<Scene> {
    let mut moved = scene.clone();
    if origin == Vec3::zeros() {
        return Ok(moved);
    }
    moved.camera.target = Some(camera::target(scene)? - origin);
    moved.light.position -= origin;
    for collider in &mut moved.colliders {
        match collider {
            Collider::Plane(plane) => plane.point -= origin,
            Collider::Sphere(sphere) => sphere.origin -= origin,
            Collider::Cuboid(cuboid) => cuboid.origin -= origin,
        }
    }
    Ok(moved)
}

/// `Programs::new` reads exactly what `draw_call` asks for: both go by [`Needs::of`].
const LOADED: &str = "the renderer reads all textures of its materials";

fn find<'a, T>(named: &'a [(String, T)], name: &str) -> Option<&'a T> {
    named.iter().find(|(other, _)| other == name).map(|(_, value)| value)
}
