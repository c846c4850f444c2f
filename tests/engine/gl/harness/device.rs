//! Draws scenes with the driver: programs and textures are kept from one scene to the next.

use drape::camera::{Camera, Columns};
use drape::glsl::Exponent;
use drape::scene::{Scene, Shader};
use drape::shader::Uniforms;
use drape::texture::Texture;
use drape::texture_source::TextureSource;
use glow::HasContext;

use super::context::Context;
use super::object::{Object, vec3};
use super::program::{Programs, Varyings};
use super::target::Target;

/// A picture as the driver makes it, top row first.
pub(crate) struct GlPicture {
    pub(crate) rgb: Vec<u8>,
    pub(crate) ids: Vec<u32>,
    pub(crate) depth: Vec<f32>,
}

/// The driver with what was given to it so far.
pub(crate) struct Device<'a> {
    pub(crate) gl: &'a glow::Context,
    varyings: Varyings,
    programs: Vec<(Shader, Programs)>,
    textures: Vec<(String, glow::Texture, [f32; 2])>,
}

/// An object's vertices and program in the driver.
pub(crate) struct Uploaded {
    program: glow::Program,
    vertex_array: glow::VertexArray,
    buffers: Vec<glow::Buffer>,
    mode: u32,
    count: i32,
}

impl<'a> Device<'a> {
    pub(crate) fn new(context: &'a Context) -> Self {
        Self::with_varyings(context, Varyings::Centre)
    }

    /// As [`Device::new`], with the varyings of a fragment from another place.
    pub(crate) fn with_varyings(context: &'a Context, varyings: Varyings) -> Self {
        let gl = &context.gl;
        unsafe {
            gl.enable(glow::DEPTH_TEST);
            gl.depth_func(glow::LESS);
            gl.pixel_store_i32(glow::PACK_ALIGNMENT, 1);
            gl.pixel_store_i32(glow::UNPACK_ALIGNMENT, 1);
            // All the rest is GL's initial state: no culling, blending, dithering of sRGB,
            // seamless cube maps or multisampling; lines one pixel wide.
            gl.disable(glow::DITHER);
        }
        Self { gl, varyings, programs: Vec::new(), textures: Vec::new() }
    }

    /// Objects of a scene in colours and in ids.
    pub(crate) fn draw(&mut self, scene: &Scene, objects: &[Object<'_>]) -> GlPicture {
        let target = Target::new(self.gl, scene.render.size);
        let seamless = if scene.render.seamless { glow::Context::enable } else { glow::Context::disable };
        unsafe { seamless(self.gl, glow::TEXTURE_CUBE_MAP_SEAMLESS) };
        let camera = Camera::of(scene).unwrap();
        for object in objects {
            self.prepare(object);
        }
        target.begin_colors(vec3(scene.render.background));
        for object in objects {
            self.draw_object(object, 0, scene, &camera);
        }
        let rgb = target.rgb();
        target.begin_ids();
        for (object, number) in objects.iter().zip(1..) {
            self.draw_object(object, number, scene, &camera);
        }
        let picture = GlPicture { rgb, ids: target.ids(), depth: target.depth() };
        assert_eq!(unsafe { self.gl.get_error() }, glow::NO_ERROR);
        picture
    }

    /// Compiles the programs and uploads the textures of an object, if that was not done before.
    pub(crate) fn prepare(&mut self, object: &Object<'_>) {
        let material = object.material;
        if !self.programs.iter().any(|(shader, _)| *shader == material.shader) {
            self.programs.push((material.shader, Programs::compile(self.gl, material.shader, self.varyings)));
        }
        for name in [&material.texture, &material.height_map] {
            if self.texture(name).is_none() {
                let texture = TextureSource::BuiltIn.texture(name).unwrap();
                self.textures.push(upload(self.gl, name, glow::TEXTURE_2D, glow::REPEAT, &[texture]));
            }
        }
        if self.texture(&material.environment).is_none() {
            let cubemap = TextureSource::BuiltIn.cubemap(&material.environment).unwrap();
            let (target, wrap) = (glow::TEXTURE_CUBE_MAP, glow::CLAMP_TO_EDGE);
            self.textures.push(upload(self.gl, &material.environment, target, wrap, cubemap.faces()));
        }
    }

    fn texture(&self, name: &str) -> Option<(glow::Texture, [f32; 2])> {
        self.textures.iter().find(|(known, ..)| known == name).map(|&(_, texture, size)| (texture, size))
    }

    /// Draws one object: `number` 0 in colours, else in ids.
    pub(crate) fn draw_object(&self, object: &Object<'_>, number: u32, scene: &Scene, camera: &Camera) {
        let uploaded = self.upload(object, number == 0);
        self.draw_uploaded(&uploaded, object, number, scene, camera);
        unsafe {
            self.gl.delete_vertex_array(uploaded.vertex_array);
            uploaded.buffers.into_iter().for_each(|buffer| self.gl.delete_buffer(buffer));
        }
    }

    /// Gives the driver an object's vertices, for its program of colours or that of ids.
    pub(crate) fn upload(&self, object: &Object<'_>, in_colors: bool) -> Uploaded {
        let (_, programs) = self.programs.iter().find(|(of, _)| *of == object.material.shader).unwrap();
        let program = if in_colors { programs.color } else { programs.id };
        let mesh = &object.mesh;
        let arrays = [
            ("in_position", 3, mesh.positions.as_flattened()),
            ("in_normal", 3, mesh.normals.as_flattened()),
            ("in_tangent", 3, mesh.tangents.as_flattened()),
            ("in_uv", 2, mesh.uvs.as_flattened()),
        ];
        let (mode, indices) = match &object.lines {
            Some(lines) => (glow::LINES, lines.as_flattened()),
            None => (glow::TRIANGLES, mesh.triangles.as_flattened()),
        };
        let gl = self.gl;
        unsafe {
            let vertex_array = gl.create_vertex_array().unwrap();
            gl.bind_vertex_array(Some(vertex_array));
            let mut buffers = Vec::new();
            for (name, components, values) in arrays {
                let Some(location) = gl.get_attrib_location(program, name) else { continue };
                assert!(!values.is_empty(), "the program reads {name}, but the mesh is made without it");
                buffers.push(self.buffer(glow::ARRAY_BUFFER, values.iter().flat_map(|v| v.to_ne_bytes())));
                gl.enable_vertex_attrib_array(location);
                gl.vertex_attrib_pointer_f32(location, components, glow::FLOAT, false, 0, 0);
            }
            let bytes = indices.iter().flat_map(|i| i.to_ne_bytes());
            buffers.push(self.buffer(glow::ELEMENT_ARRAY_BUFFER, bytes));
            let count = i32::try_from(indices.len()).unwrap();
            Uploaded { program, vertex_array, buffers, mode, count }
        }
    }

    /// Draws what was uploaded: `number` 0 in colours, else in ids.
    pub(crate) fn draw_uploaded(
        &self,
        uploaded: &Uploaded,
        object: &Object<'_>,
        number: u32,
        scene: &Scene,
        camera: &Camera,
    ) {
        let &Uploaded { program, vertex_array, mode, count, .. } = uploaded;
        unsafe { self.gl.use_program(Some(program)) };
        self.set_uniforms(program, object, number, scene, camera);
        unsafe {
            self.gl.bind_vertex_array(Some(vertex_array));
            self.gl.draw_elements(mode, count, glow::UNSIGNED_INT, 0);
        }
    }

    fn buffer(&self, target: u32, bytes: impl Iterator<Item = u8>) -> glow::Buffer {
        unsafe {
            let buffer = self.gl.create_buffer().unwrap();
            self.gl.bind_buffer(target, Some(buffer));
            self.gl.buffer_data_u8_slice(target, &Vec::from_iter(bytes), glow::STREAM_DRAW);
            buffer
        }
    }

    /// Gives a program every uniform that it reads. One that is not known here is a failure.
    fn set_uniforms(
        &self,
        program: glow::Program,
        object: &Object<'_>,
        number: u32,
        scene: &Scene,
        camera: &Camera,
    ) {
        let gl = self.gl;
        let values = object.uniforms(scene, camera);
        let count = unsafe { gl.get_program_parameter_i32(program, glow::ACTIVE_UNIFORMS) };
        for index in 0..u32::try_from(count).unwrap() {
            let name = unsafe { gl.get_active_uniform(program, index) }.unwrap().name;
            let at = unsafe { gl.get_uniform_location(program, &name) };
            let at = at.as_ref();
            let material = object.material;
            match name.as_str() {
                "u_object" => unsafe { gl.uniform_1_u32(at, number) },
                "u_texture_1" => self.bind_picture(at, 0, &material.texture, object),
                "u_texture_2" => self.bind_picture(at, 1, &material.height_map, object),
                "u_texture_cubemap" => self.bind(at, 2, glow::TEXTURE_CUBE_MAP, &material.environment),
                "u_texture_2_size" => {
                    let [width, height] = self.texture(&material.height_map).unwrap().1;
                    unsafe { gl.uniform_2_f32(at, width, height) };
                }
                _ => self.set_value(at, &name, &values),
            }
        }
    }

    fn set_value(&self, at: Option<&glow::UniformLocation>, name: &str, u: &Uniforms) {
        let mat4 = |m: &Columns| unsafe { self.gl.uniform_matrix_4_f32_slice(at, false, m.as_flattened()) };
        let vec3 = |v: &[f32; 3]| unsafe { self.gl.uniform_3_f32_slice(at, v) };
        let float = |x: f32| unsafe { self.gl.uniform_1_f32(at, x) };
        match name {
            "u_model" => mat4(&u.u_model),
            "u_view_projection" => mat4(&u.u_view_projection),
            "u_cam_pos" => vec3(&u.u_cam_pos),
            "u_color" => vec3(&u.u_color),
            "u_light_pos" => vec3(&u.u_light_pos),
            "u_light_intensity" => vec3(&u.u_light_intensity),
            "u_light_color" => vec3(&u.u_light_color),
            "u_ka" => float(u.u_ka),
            "u_kd" => float(u.u_kd),
            "u_ks" => float(u.u_ks),
            "u_shininess" => float(match u.u_shininess {
                Exponent::Whole(whole) => whole as f32,
                Exponent::Real(real) => real,
            }),
            "u_km" => float(u.u_km),
            "u_normal_scaling" => float(u.u_normal_scaling),
            "u_height_scaling" => float(u.u_height_scaling),
            "u_bitangent" => float(u.u_bitangent),
            "u_two_sided" => float(u.u_two_sided),
            _ => panic!("what is the uniform {name}?"),
        }
    }

    /// Binds a picture, which repeats, but on a ball only along u.
    fn bind_picture(&self, at: Option<&glow::UniformLocation>, unit: u32, name: &str, object: &Object<'_>) {
        self.bind(at, unit, glow::TEXTURE_2D, name);
        let wrap = if object.is_ball { glow::CLAMP_TO_EDGE } else { glow::REPEAT };
        unsafe { self.gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_WRAP_T, wrap as i32) };
    }

    fn bind(&self, at: Option<&glow::UniformLocation>, unit: u32, target: u32, name: &str) {
        let (texture, _) = self.texture(name).unwrap();
        unsafe {
            self.gl.active_texture(glow::TEXTURE0 + unit);
            self.gl.bind_texture(target, Some(texture));
            self.gl.uniform_1_i32(at, unit as i32);
        }
    }
}

/// Uploads one picture, or the six faces of a cube map, as floats: 8-bit textures would be
/// filtered with 8-bit weights. Returns the texture with its name and its size in texels.
fn upload(
    gl: &glow::Context,
    name: &str,
    target: u32,
    wrap: u32,
    pictures: &[Texture],
) -> (String, glow::Texture, [f32; 2]) {
    let parameters = [
        (glow::TEXTURE_MIN_FILTER, glow::LINEAR),
        (glow::TEXTURE_MAG_FILTER, glow::LINEAR),
        (glow::TEXTURE_WRAP_S, wrap),
        (glow::TEXTURE_WRAP_T, wrap),
    ];
    let first = if target == glow::TEXTURE_2D { target } else { glow::TEXTURE_CUBE_MAP_POSITIVE_X };
    let [width, height] = [pictures[0].width(), pictures[0].height()];
    unsafe {
        let texture = gl.create_texture().unwrap();
        gl.bind_texture(target, Some(texture));
        for (name, value) in parameters {
            gl.tex_parameter_i32(target, name, value as i32);
        }
        for (face, picture) in (first..).zip(pictures) {
            let texels = picture.texels().as_flattened();
            let bytes: Vec<u8> = texels.iter().flat_map(|c| c.to_ne_bytes()).collect();
            let (w, h) = (width as i32, height as i32);
            let data = glow::PixelUnpackData::Slice(Some(&bytes));
            gl.tex_image_2d(face, 0, glow::RGB32F as i32, w, h, 0, glow::RGBA, glow::FLOAT, data);
        }
        (name.to_owned(), texture, [width, height].map(|n| n as f32))
    }
}
