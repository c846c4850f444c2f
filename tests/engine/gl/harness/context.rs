//! An OpenGL 3.3 core context without a window, on Mesa's software driver.

use khronos_egl as egl;

type Egl = egl::DynamicInstance<egl::EGL1_5>;

/// `EGL_PLATFORM_SURFACELESS_MESA` of the extension `EGL_MESA_platform_surfaceless`.
const SURFACELESS: egl::Enum = 0x31DD;

/// A current context and its functions. Everything is loaded at run time.
pub(crate) struct Context {
    pub(crate) gl: glow::Context,
    egl: Egl,
    display: egl::Display,
    context: egl::Context,
}

impl Context {
    /// Opens a context and makes it current; the error says what is missing.
    pub(crate) fn open() -> Result<Self, String> {
        // SAFETY: the caller is this binary's only test, and it has started no threads yet.
        unsafe {
            std::env::set_var("LIBGL_ALWAYS_SOFTWARE", "1");
            std::env::set_var("GALLIUM_DRIVER", "llvmpipe");
        }
        // SAFETY: the library is the system's EGL, as the loader finds it.
        let egl = unsafe { Egl::load_required() }.map_err(|why| format!("libEGL.so.1: {why}"))?;
        // SAFETY: the default display is valid for this platform, and so is an empty list.
        let display =
            unsafe { egl.get_platform_display(SURFACELESS, egl::DEFAULT_DISPLAY, &[egl::ATTRIB_NONE]) }
                .map_err(|why| format!("a display without a window: {why}"))?;
        egl.initialize(display).map_err(|why| format!("eglInitialize: {why}"))?;
        egl.bind_api(egl::OPENGL_API).map_err(|why| format!("desktop OpenGL: {why}"))?;
        let context = create(&egl, display)?;
        egl.make_current(display, None, None, Some(context))
            .map_err(|why| format!("eglMakeCurrent: {why}"))?;
        let address = |name: &str| egl.get_proc_address(name).map_or(std::ptr::null(), |f| f as *const _);
        // SAFETY: the addresses come from the context that was made current right above.
        let gl = unsafe { glow::Context::from_loader_function(address) };
        let opened = Self { gl, egl, display, context };
        let driver = opened.driver();
        // Another driver has other roundings, which the limits do not know.
        if driver.contains("llvmpipe") { Ok(opened) } else { Err(format!("the driver is {driver}")) }
    }

    /// The driver's name and version.
    pub(crate) fn driver(&self) -> String {
        use glow::HasContext;
        let text = |name| unsafe { self.gl.get_parameter_string(name) };
        format!("{}, {}", text(glow::RENDERER), text(glow::VERSION))
    }
}

fn create(egl: &Egl, display: egl::Display) -> Result<egl::Context, String> {
    let wanted = [egl::RENDERABLE_TYPE, egl::OPENGL_BIT, egl::SURFACE_TYPE, egl::PBUFFER_BIT, egl::NONE];
    let config = egl
        .choose_first_config(display, &wanted)
        .map_err(|why| format!("eglChooseConfig: {why}"))?
        .ok_or("no configuration for desktop OpenGL")?;
    let version = [
        egl::CONTEXT_MAJOR_VERSION,
        3,
        egl::CONTEXT_MINOR_VERSION,
        3,
        egl::CONTEXT_OPENGL_PROFILE_MASK,
        egl::CONTEXT_OPENGL_CORE_PROFILE_BIT,
        egl::NONE,
    ];
    egl.create_context(display, config, None, &version).map_err(|why| format!("OpenGL 3.3 core: {why}"))
}

impl Drop for Context {
    fn drop(&mut self) {
        // Failing to clean up does no harm: the process is about to end.
        let _ = self.egl.make_current(self.display, None, None, None);
        let _ = self.egl.destroy_context(self.display, self.context);
        let _ = self.egl.terminate(self.display);
    }
}
