//! Pictures of four samples a pixel, as the driver makes them.

use drape::camera::Camera;
use drape::scene::Scene;
use glow::HasContext;

use super::device::Device;
use super::object::{Object, vec3};

/// Samples of a pixel: the driver has no other number.
const SAMPLES: i32 = 4;

/// A picture of `objects`, three bytes a pixel, top row first.
///
/// The driver numbers and places the samples with y up, ours lie with y down; so it draws the picture upside down.
pub(crate) fn sampled(device: &mut Device<'_>, scene: &Scene, objects: &[Object<'_>]) -> Vec<u8> {
    let mut camera = Camera::of(scene).unwrap();
    camera.view_projection.iter_mut().for_each(|column| column[1] = -column[1]);
    objects.iter().for_each(|object| device.prepare(object));
    let target = Sampled::new(device.gl, scene.render.size);
    target.begin(vec3(scene.render.background));
    objects.iter().for_each(|object| device.draw_object(object, 0, scene, &camera));
    target.resolve();
    target.rgb()
}

/// A framebuffer of several samples, and one for their means.
pub(crate) struct Sampled<'a> {
    gl: &'a glow::Context,
    size: [i32; 2],
    many: glow::Framebuffer,
    one: glow::Framebuffer,
}

impl<'a> Sampled<'a> {
    pub(crate) fn new(gl: &'a glow::Context, size: [u32; 2]) -> Self {
        let size = size.map(|n| i32::try_from(n).unwrap());
        let [many, one] = [SAMPLES, 0].map(|samples| unsafe { framebuffer(gl, size, samples) });
        Self { gl, size, many, one }
    }

    /// Clears colour and depth of the samples, which are drawn to.
    pub(crate) fn begin(&self, [r, g, b]: [f32; 3]) {
        let Self { gl, size, many, .. } = self;
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(*many));
            gl.enable(glow::MULTISAMPLE);
            gl.viewport(0, 0, size[0], size[1]);
            gl.clear_color(r, g, b, 1.0);
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
        }
    }

    /// Takes the means of the samples.
    pub(crate) fn resolve(&self) {
        let Self { gl, size: [w, h], many, one } = *self;
        unsafe {
            gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(many));
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(one));
            gl.blit_framebuffer(0, 0, w, h, 0, 0, w, h, glow::COLOR_BUFFER_BIT, glow::NEAREST);
        }
    }

    /// The means, three bytes a pixel.
    fn rgb(&self) -> Vec<u8> {
        let Self { gl, size: [w, h], one, .. } = *self;
        let mut pixels = vec![0; (4 * w * h) as usize];
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(one));
            let into = glow::PixelPackData::Slice(Some(&mut pixels));
            gl.read_pixels(0, 0, w, h, glow::RGBA, glow::UNSIGNED_BYTE, into);
            assert_eq!(gl.get_error(), glow::NO_ERROR);
        }
        pixels.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
    }
}

impl Drop for Sampled<'_> {
    fn drop(&mut self) {
        let both = [self.many, self.one];
        both.into_iter().for_each(|framebuffer| unsafe { self.gl.delete_framebuffer(framebuffer) });
    }
}

/// A framebuffer with colour and depth, which is bound.
unsafe fn framebuffer(gl: &glow::Context, [w, h]: [i32; 2], samples: i32) -> glow::Framebuffer {
    unsafe {
        let framebuffer = gl.create_framebuffer().unwrap();
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
        for (format, attachment) in
            [(glow::RGBA8, glow::COLOR_ATTACHMENT0), (glow::DEPTH_COMPONENT32F, glow::DEPTH_ATTACHMENT)]
        {
            let buffer = gl.create_renderbuffer().unwrap();
            gl.bind_renderbuffer(glow::RENDERBUFFER, Some(buffer));
            gl.renderbuffer_storage_multisample(glow::RENDERBUFFER, samples, format, w, h);
            gl.framebuffer_renderbuffer(glow::FRAMEBUFFER, attachment, glow::RENDERBUFFER, Some(buffer));
        }
        assert_eq!(gl.check_framebuffer_status(glow::FRAMEBUFFER), glow::FRAMEBUFFER_COMPLETE);
        framebuffer
    }
}

/// The largest difference of a channel of each pixel.
pub(crate) fn differences(a: &[u8], b: &[u8]) -> Vec<u8> {
    let pixels = a.chunks_exact(3).zip(b.chunks_exact(3));
    pixels.map(|(a, b)| (0..3).map(|c| a[c].abs_diff(b[c])).max().unwrap_or(0)).collect()
}
