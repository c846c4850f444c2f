//! The project's GLSL files, compiled by the driver.

use std::fs;

use drape::scene::Shader;
use glow::HasContext;

/// Writes object and triangle instead of a colour, as `drape::raster::draw` keeps them.
const ID_FRAGMENT: &str = "#version 330\n\
    uniform uint u_object;\n\
    out uint out_id;\n\
    void main() { out_id = u_object << 24 | uint(gl_PrimitiveID + 1); }\n";

/// A shader's own files, and its vertex stage with ids as colours.
pub(crate) struct Programs {
    pub(crate) color: glow::Program,
    pub(crate) id: glow::Program,
}

impl Programs {
    /// Compiles `src/shader/*` of a shader, with a qualifier before each varying such as `centroid`. Any word of the driver about it is a failure.
    pub(crate) fn compile(gl: &glow::Context, shader: Shader, qualifier: &str) -> Self {
        let name = shader.name();
        let vertex = match shader {
            Shader::Displacement | Shader::Custom => format!("{name}.vert"),
            _ => "default.vert".to_owned(),
        };
        let fragment = format!("{name}.frag");
        let [vertex_text, fragment_text] =
            [&vertex, &fragment].map(|name| qualified(&source(name), qualifier));
        let vertex = (vertex.as_str(), vertex_text);
        let color = link(gl, &vertex, &(&fragment, fragment_text));
        let id = link(gl, &vertex, &("ids", ID_FRAGMENT.to_owned()));
        Self { color, id }
    }
}

/// A text with a qualifier before each varying.
fn qualified(text: &str, qualifier: &str) -> String {
    let line = |line: &str| {
        let varying = line.contains(" v_") && (line.starts_with("in ") || line.starts_with("out "));
        if varying { format!("{qualifier} {line}\n") } else { format!("{line}\n") }
    };
    text.lines().map(line).collect()
}

fn source(name: &str) -> String {
    let path = crate::repository::path("src/shader").join(name);
    fs::read_to_string(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}

fn link(gl: &glow::Context, vertex: &(&str, String), fragment: &(&str, String)) -> glow::Program {
    unsafe {
        let program = gl.create_program().unwrap();
        for (stage, (name, text)) in [(glow::VERTEX_SHADER, vertex), (glow::FRAGMENT_SHADER, fragment)] {
            let shader = gl.create_shader(stage).unwrap();
            gl.shader_source(shader, text);
            gl.compile_shader(shader);
            let log = gl.get_shader_info_log(shader);
            assert!(gl.get_shader_compile_status(shader) && log.is_empty(), "{name}:\n{log}");
            gl.attach_shader(program, shader);
        }
        gl.link_program(program);
        let log = gl.get_program_info_log(program);
        let names = (vertex.0, fragment.0);
        assert!(gl.get_program_link_status(program) && log.is_empty(), "{names:?}:\n{log}");
        program
    }
}
