//! The GLSL files and the Rust beside them declare and use the same uniforms and varyings, in the same order.

#![expect(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

use std::fs;

use drape::scene::Shader;

/// The name of every program, and the file that has the Rust of its fragment stage: its own, or that of a program
/// whose stage it takes over.
fn programs() -> Vec<(&'static str, String)> {
    let file = |&(stem, _): &(&'static str, Shader)| {
        let rust = read(&format!("{stem}.rs"));
        let taken = rust.split_once("pub use super::").and_then(|(_, rest)| rest.split_once("::Fragment;"));
        (stem, taken.map_or(stem, |(file, _)| file).to_owned())
    };
    Shader::NAMES.iter().map(file).collect()
}

/// A file of the shaders without its comments.
fn read(name: &str) -> String {
    let text = fs::read_to_string(crate::repository::path("src/shader").join(name)).unwrap();
    text.lines().map(|line| line.split("//").next().unwrap_or_default().to_owned() + "\n").collect()
}

/// What stands between the first brace after `start` and the one that closes it.
fn block<'a>(text: &'a str, start: &str) -> &'a str {
    let from = text.find(start).unwrap_or_else(|| panic!("no `{start}`")) + start.len();
    let open = from + text[from..].find('{').unwrap();
    let mut depth = 0;
    for (i, c) in text[open..].char_indices() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if depth == 0 {
            return &text[open + 1..open + i];
        }
    }
    panic!("`{start}` does not end")
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// The uniforms, varyings and attributes that a text names, in order, what follows itself once.
fn names(text: &str) -> Vec<&str> {
    let mut names: Vec<_> =
        words(text).filter(|w| ["u_", "v_", "in_"].iter().any(|start| w.starts_with(start))).collect();
    names.dedup();
    names
}

/// Type and name of everything that a GLSL file declares as `kind`.
fn declared<'a>(glsl: &'a str, kind: &str) -> Vec<(&'a str, &'a str)> {
    let declarations =
        glsl.lines().filter_map(|line| line.strip_prefix(kind)?.strip_suffix(';')?.trim().split_once(' '));
    declarations.filter(|&(_, name)| name != "out_color").collect()
}

/// The fields of a struct of varyings, or of a program, as (type, name).
fn fields(text: &str) -> Vec<(&str, &str)> {
    text.split(',')
        .filter_map(|field| field.split_once(':'))
        .map(|(name, kind)| (kind.trim(), name.trim()))
        .collect()
}

/// The Rust of a fragment program: its fields, the name of its varyings, those that it names, and its body.
fn fragment(rust: &str) -> (Vec<(&str, &str)>, &str, Vec<&str>, &str) {
    let program = block(rust, "fragment_program!");
    let (head, rest) = program.split_once('|').unwrap();
    let (pattern, body) = rest.split_once('|').unwrap();
    let (varyings, named) = pattern.split_once('{').unwrap();
    (fields(block(head, "struct")), varyings.trim(), names(named), body)
}

/// What differs between a fragment program in GLSL and its Rust, if anything does.
fn fragment_differs(glsl: &str, rust: &str, default: &str, uniforms: &str) -> Option<String> {
    let (program, varyings, named, body) = fragment(rust);
    let read = declared(glsl, "in");
    let of_struct = if varyings == "NoVaryings" {
        Vec::new()
    } else {
        fields(block(default, &format!("struct {varyings}")))
    };
    if read != of_struct || names(glsl_varyings(&read).as_str()) != named {
        return Some(format!("varyings {read:?} for {of_struct:?} as {named:?}"));
    }
    for (kind, name) in declared(glsl, "uniform").into_iter().filter(|(_, name)| !name.ends_with("_size")) {
        let expected: &[&str] = match kind {
            "sampler2D" => &["Sampler2d<'a>"],
            "samplerCube" => &["SamplerCube<'a>"],
            "vec3" => &["V"],
            _ => &["F", "f32", "Exponent"],
        };
        let shared = fields(block(uniforms, "pub struct Uniforms<F = f32, V = [f32; 3]>"));
        let found = program.iter().chain(&shared).find(|(_, field)| field.trim_start_matches("pub ") == name);
        if !found.is_some_and(|(kind, _)| expected.contains(kind)) {
            return Some(format!("uniform {kind} {name} is {found:?}"));
        }
    }
    // Every function by itself; calls of the program's own functions are passed over.
    let own = |body: &str| body.replace(call(body, "bumped_normal("), "");
    if names(&own(body)) != names(block(glsl, "void main()")) {
        return Some(format!("main: {:?} for {:?}", names(&own(body)), names(block(glsl, "void main()"))));
    }
    None
}

fn glsl_varyings(read: &[(&str, &str)]) -> String {
    read.iter().map(|(_, name)| format!("{name} ")).collect()
}

/// The text of a call, or nothing.
fn call<'a>(text: &'a str, start: &str) -> &'a str {
    let Some(from) = text.find(start) else { return "\0" };
    &text[from..from + text[from..].find(')').unwrap()]
}

/// What differs between a function in GLSL and in Rust. How a texture is read is the sampler's matter.
fn function_differs(name: &str, glsl: &str, rust: &str) -> Option<String> {
    let of = |text: &str| {
        names(text)
            .into_iter()
            .filter(|name| !name.starts_with("u_texture"))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let (mut g, mut r) =
        (of(block(glsl, &format!("vec3 {name}("))), of(block(rust, &format!("fn {name}<L: Lane>("))));
    g.dedup();
    r.dedup();
    (g != r).then(|| format!("{name}: {r:?} for {g:?}"))
}

/// What differs between a vertex program in GLSL and the statements of its Rust.
fn vertex_differs(glsl: &str, rust: &str, default: &str) -> Option<String> {
    let put_out = declared(glsl, "out");
    let of_struct = fields(block(default, "struct Relief"));
    if put_out != of_struct {
        return Some(format!("varyings {put_out:?} for {of_struct:?}"));
    }
    // From what each varying is made.
    for (_, varying) in put_out {
        let of_glsl = statement(block(glsl, "void main()"), &format!("{varying} ="));
        let of_rust = statement(block(default, "fn all_at("), &format!("{varying} ="));
        let g: Vec<_> = names(of_glsl).into_iter().filter(|name| !name.starts_with("u_")).collect();
        let r: Vec<_> = names(of_rust);
        // The position is handed to `all_at`, which `default` and `displacement` call with their own.
        let moved =
            varying == "v_position" && r == ["v_position"] && words(of_rust).any(|word| word == "position");
        if g != r
            && !(moved
                && (g == ["v_position", "in_position"] || words(of_glsl).any(|word| word == "displaced")))
        {
            return Some(format!("{varying}: {r:?} for {g:?}"));
        }
    }
    if glsl.contains("displaced") {
        let [mut g, mut r] = [block(glsl, "void main()"), block(rust, "move |a|")].map(|text| {
            let until = text.find("v_position").or_else(|| text.find("default::all_at")).unwrap();
            names(&text[..until])
        });
        g.sort_unstable();
        r.sort_unstable();
        if g != r {
            return Some(format!("displacement: {r:?} for {g:?}"));
        }
    }
    None
}

/// A statement from its left side on.
fn statement<'a>(text: &'a str, left: &str) -> &'a str {
    let from = text.find(left).unwrap_or_else(|| panic!("no `{left}`"));
    &text[from..from + text[from..].find(';').unwrap()]
}

#[test]
fn every_fragment_program_is_its_glsl() {
    let (default, uniforms) = (read("default.rs"), read("uniforms.rs"));
    for (stem, file) in programs() {
        let (glsl, rust) = (read(&format!("{stem}.frag")), read(&format!("{file}.rs")));
        assert_eq!(fragment_differs(&glsl, &rust, &default, &uniforms), None, "{stem}");
    }
    let (phong, bump) = (read("phong.rs"), read("bump.rs"));
    assert_eq!(function_differs("blinn_phong", &read("phong.frag"), &phong), None);
    assert_eq!(function_differs("bumped_normal", &read("bump.frag"), &bump), None);
    for stem in ["diffuse", "phong", "bump", "displacement", "custom"] {
        assert_eq!(function_differs("facing", &read(&format!("{stem}.frag")), &phong), None, "{stem}");
    }
}

#[test]
fn every_vertex_program_is_its_glsl() {
    let default = read("default.rs");
    for stem in ["default", "displacement"] {
        let (glsl, rust) = (read(&format!("{stem}.vert")), read(&format!("{stem}.rs")));
        assert_eq!(vertex_differs(&glsl, &rust, &default), None, "{stem}");
        let attributes: Vec<_> = declared(&glsl, "in");
        assert_eq!(
            attributes,
            [("vec3", "in_position"), ("vec3", "in_normal"), ("vec3", "in_tangent"), ("vec2", "in_uv")]
        );
    }
    // Which matrix each of the three steps multiplies by.
    for (function, matrix) in [
        ("fn world_position(", "u_model"),
        ("fn world_direction(", "u_model"),
        ("fn gl_position(", "u_view_projection"),
    ] {
        assert_eq!(names(block(&default, function))[..1], [matrix], "{function}");
    }
    // The smaller sets of varyings are made like all of them.
    for function in ["pub fn uv(", "pub fn normal(", "pub fn position_normal("] {
        let body = block(&default, function);
        for line in body.lines().filter(|line| line.trim_start().starts_with("let v_")) {
            let varying = names(line)[0];
            let of_all = statement(block(&default, "fn all_at("), &format!("{varying} ="));
            let same = |text: &str| text.replace("a.in_position", "position").replace("&u", "u");
            assert!(same(line).contains(&same(of_all)), "{function}: {line}");
        }
    }
}

/// No name can be swapped for another, in the GLSL or in the Rust, without being noticed.
#[test]
fn a_swapped_name_is_noticed() {
    let (default, uniforms) = (read("default.rs"), read("uniforms.rs"));
    let swapped = |text: &str, a: &str, b: &str| text.replace(a, "\0").replace(b, a).replace('\0', b);
    let mut swaps = 0;
    for (stem, file) in programs() {
        let (glsl, rust) = (read(&format!("{stem}.frag")), read(&format!("{file}.rs")));
        let (.., body) = fragment(&rust);
        let own = body.replace(call(body, "bumped_normal("), "");
        let mut used = names(&own);
        used.sort_unstable();
        used.dedup();
        for pair in used.windows(2) {
            let wrong = rust.replace(body, &swapped(body, pair[0], pair[1]));
            assert!(fragment_differs(&glsl, &wrong, &default, &uniforms).is_some(), "{stem}: {pair:?}");
            swaps += 1;
        }
    }
    for (name, file) in [("blinn_phong", "phong"), ("bumped_normal", "bump")] {
        let (glsl, rust) = (read(&format!("{file}.frag")), read(&format!("{file}.rs")));
        let body = block(&rust, &format!("fn {name}<L: Lane>("));
        let mut used: Vec<_> =
            names(body).into_iter().filter(|name| !name.starts_with("u_texture")).collect();
        used.sort_unstable();
        used.dedup();
        for pair in used.windows(2) {
            let wrong = rust.replace(body, &swapped(body, pair[0], pair[1]));
            assert!(function_differs(name, &glsl, &wrong).is_some(), "{name}: {pair:?}");
            swaps += 1;
        }
    }
    for pair in [["v_normal", "v_tangent"], ["in_normal", "in_tangent"], ["v_position", "v_normal"]] {
        let body = block(&default, "fn all_at(");
        let wrong = default.replace(body, &swapped(body, pair[0], pair[1]));
        assert!(vertex_differs(&read("default.vert"), "", &wrong).is_some(), "{pair:?}");
        swaps += 1;
    }
    assert!(swaps > 30, "only {swaps} swaps");
}

/// What a file says twice it says alike: `displacement.frag` is `bump.frag`, and so on.
#[test]
fn copies_are_copies() {
    assert_eq!(read("displacement.frag"), read("bump.frag"));
    assert_eq!(read("custom.vert"), read("displacement.vert"));
    let function = |file: &str, name: &str| block(&read(file), name).to_owned();
    assert_eq!(function("bump.frag", "vec3 blinn_phong"), function("phong.frag", "vec3 blinn_phong"));
    assert_eq!(function("custom.frag", "vec3 bumped_normal"), function("bump.frag", "vec3 bumped_normal"));
    assert_eq!(names(&function("bump.frag", "float h(")), ["u_texture_2"]);
}
