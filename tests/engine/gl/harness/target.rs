//! A framebuffer of one size, and reading it back with the top row first.

use glow::HasContext;

/// Stored colours and ids, or depths: what the driver made of a scene.
pub(crate) struct Target<'a> {
    gl: &'a glow::Context,
    size: [i32; 2],
    framebuffer: glow::Framebuffer,
    buffers: [glow::Renderbuffer; 3],
}

impl<'a> Target<'a> {
    /// 8-bit colour, 32-bit ids and 32-bit depth.
    pub(crate) fn new(gl: &'a glow::Context, [width, height]: [u32; 2]) -> Self {
        let size = [width, height].map(|n| i32::try_from(n).unwrap());
        let formats = [
            (glow::RGBA8, glow::COLOR_ATTACHMENT0),
            (glow::R32UI, glow::COLOR_ATTACHMENT1),
            (glow::DEPTH_COMPONENT32F, glow::DEPTH_ATTACHMENT),
        ];
        unsafe {
            let framebuffer = gl.create_framebuffer().unwrap();
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            let buffers = formats.map(|(format, attachment)| {
                let buffer = gl.create_renderbuffer().unwrap();
                gl.bind_renderbuffer(glow::RENDERBUFFER, Some(buffer));
                gl.renderbuffer_storage(glow::RENDERBUFFER, format, size[0], size[1]);
                gl.framebuffer_renderbuffer(glow::FRAMEBUFFER, attachment, glow::RENDERBUFFER, Some(buffer));
                buffer
            });
            let status = gl.check_framebuffer_status(glow::FRAMEBUFFER);
            assert_eq!(status, glow::FRAMEBUFFER_COMPLETE);
            gl.viewport(0, 0, size[0], size[1]);
            Self { gl, size, framebuffer, buffers }
        }
    }

    /// Clears colour and depth, and lets fragments write colours.
    pub(crate) fn begin_colors(&self, background: [f32; 3]) {
        let [r, g, b] = background;
        unsafe {
            self.gl.draw_buffers(&[glow::COLOR_ATTACHMENT0]);
            self.gl.clear_buffer_f32_slice(glow::COLOR, 0, &[r, g, b, 1.0]);
            self.gl.clear_buffer_f32_slice(glow::DEPTH, 0, &[1.0]);
        }
    }

    /// Clears ids and depth, and lets fragments write ids.
    pub(crate) fn begin_ids(&self) {
        unsafe {
            self.gl.draw_buffers(&[glow::COLOR_ATTACHMENT1]);
            self.gl.clear_buffer_u32_slice(glow::COLOR, 0, &[0; 4]);
            self.gl.clear_buffer_f32_slice(glow::DEPTH, 0, &[1.0]);
        }
    }

    /// Stored colours, three bytes a pixel.
    pub(crate) fn rgb(&self) -> Vec<u8> {
        let pixels = self.read(glow::COLOR_ATTACHMENT0, glow::RGBA, glow::UNSIGNED_BYTE);
        pixels.into_iter().flat_map(|[r, g, b, _]| [r, g, b]).collect()
    }

    /// What `begin_ids` asked for.
    pub(crate) fn ids(&self) -> Vec<u32> {
        let pixels = self.read(glow::COLOR_ATTACHMENT1, glow::RED_INTEGER, glow::UNSIGNED_INT);
        pixels.into_iter().map(u32::from_ne_bytes).collect()
    }

    /// Window depths.
    pub(crate) fn depth(&self) -> Vec<f32> {
        let pixels = self.read(glow::COLOR_ATTACHMENT1, glow::DEPTH_COMPONENT, glow::FLOAT);
        pixels.into_iter().map(f32::from_ne_bytes).collect()
    }

    /// Four bytes a pixel. GL's first row is the lowest.
    fn read(&self, attachment: u32, format: u32, kind: u32) -> Vec<[u8; 4]> {
        let [width, height] = self.size.map(|n| n as usize);
        let mut bytes = vec![0; width * height * 4];
        unsafe {
            self.gl.read_buffer(attachment);
            let data = glow::PixelPackData::Slice(Some(&mut bytes));
            self.gl.read_pixels(0, 0, self.size[0], self.size[1], format, kind, data);
        }
        let rows = bytes.chunks_exact(width * 4).rev();
        rows.flat_map(|row| row.chunks_exact(4).map(|pixel| [pixel[0], pixel[1], pixel[2], pixel[3]]))
            .collect()
    }
}

impl Drop for Target<'_> {
    fn drop(&mut self) {
        unsafe {
            self.gl.delete_framebuffer(self.framebuffer);
            for buffer in self.buffers {
                self.gl.delete_renderbuffer(buffer);
            }
        }
    }
}
