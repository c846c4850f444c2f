//! The project's GLSL files, compiled by the driver.

use std::fs;

use drape::scene::Shader;
use glow::HasContext;

/// Writes object and triangle instead of a colour, as `drape::raster::draw` keeps them.
const ID_FRAGMENT: &str = "#version 330\n\
    uniform uint u_object;\n\
    out uint out_id;\n\
    void main() { out_id = u_object << 24 | uint(gl_PrimitiveID + 1); }\n";

/// Where the varyings of a fragment are taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Varyings {
    /// The centre of the pixel, also where it is beyond the triangle.
    Centre,
    /// A place inside of the triangle.
    Centroid,
    /// The same place, with the division by 1/w in the fragment shader: each varying times 1/w and 1/w itself are
    /// interpolated there without perspective.
    CentroidDivided,
    /// The same with the 1/w of the pixel's centre.
    CentroidOverCentre,
}

/// A shader's own files, and its vertex stage with ids as colours.
pub(crate) struct Programs {
    pub(crate) color: glow::Program,
    pub(crate) id: glow::Program,
}

impl Programs {
    /// Compiles `src/shader/*` of a shader, changed to take its `varyings` from there. Any word of the driver about it is a
    /// failure.
    pub(crate) fn compile(gl: &glow::Context, shader: Shader, varyings: Varyings) -> Self {
        let name = shader.name();
        let vertex = match shader {
            Shader::Displacement | Shader::Custom => format!("{name}.vert"),
            _ => "default.vert".to_owned(),
        };
        let fragment = format!("{name}.frag");
        let [vertex_text, fragment_text] = [&vertex, &fragment].map(|name| varyings.put_into(&source(name)));
        let vertex = (vertex.as_str(), vertex_text);
        let color = link(gl, &vertex, &(&fragment, fragment_text));
        let id = link(gl, &vertex, &("ids", ID_FRAGMENT.to_owned()));
        Self { color, id }
    }
}

impl Varyings {
    /// The text of a shader that takes its varyings from there.
    fn put_into(self, text: &str) -> String {
        let varyings: Vec<&str> = text.lines().filter(|line| is_varying(line)).collect();
        let lines = text.lines().map(|line| match self {
            _ if !is_varying(line) => line.to_owned(),
            Self::Centre => line.to_owned(),
            Self::Centroid => format!("centroid {line}"),
            Self::CentroidDivided | Self::CentroidOverCentre => {
                line.trim_start_matches("in ").trim_start_matches("out ").to_owned()
            }
        });
        let text = lines.collect::<Vec<_>>().join("\n") + "\n";
        match self {
            Self::Centre | Self::Centroid => text,
            Self::CentroidDivided => divided(&text, &varyings, "centroid "),
            Self::CentroidOverCentre => divided(&text, &varyings, ""),
        }
    }
}

fn is_varying(line: &str) -> bool {
    line.contains(" v_") && (line.starts_with("in ") || line.starts_with("out "))
}

/// A shader whose `varyings` are plain variables now: the vertex stage hands on each times 1/w, which the fragment stage
/// divides by the 1/w of the place that the qualifier `of_w` names.
fn divided(text: &str, varyings: &[&str], of_w: &str) -> String {
    let is_vertex = text.contains("gl_Position");
    let way = if is_vertex { "out" } else { "in" };
    let mut declared = format!("noperspective {of_w}{way} float q_w;\n");
    let mut assigned = String::new();
    for varying in varyings {
        let kind = varying.split_whitespace().nth(1).unwrap();
        let name = varying.split_whitespace().nth(2).unwrap().trim_end_matches(';');
        declared += &format!("noperspective centroid {way} {kind} q_{name};\n");
        assigned += &match is_vertex {
            true => format!("q_{name} = {name} * q_w;\n"),
            false => format!("{name} = q_{name} / q_w;\n"),
        };
    }
    let (before, main) = text.split_once("void main() {").unwrap();
    match is_vertex {
        true => {
            let (body, _) = main.rsplit_once('}').unwrap();
            format!("{before}{declared}void main() {{{body}q_w = 1.0 / gl_Position.w;\n{assigned}}}\n")
        }
        false => format!("{before}{declared}void main() {{\n{assigned}{main}"),
    }
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
