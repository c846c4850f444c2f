//! Wavefront OBJ: triangle meshes as text, and MTL: their materials.

use std::fmt::Write;

use super::part::{Part, from_below};
use crate::error::Result;
use crate::scene::{Material, Needs};

/// OBJ text of meshes. Each number is the shortest decimal that reads back as the same bits; v grows upwards, so
/// that the first row of a texture is at v = 1, as programs that read OBJ expect. With `library`, the name of a file
/// of [`materials`], every mesh names its material there. A single mesh without materials has no name.
///
/// # Errors
/// [`Kind::Internal`](crate::error::Kind::Internal) when the arrays of a mesh do not fit together.
pub fn encode(parts: &[Part<'_>], library: Option<&str>) -> Result<String> {
    let mut text = library.map_or(String::new(), |library| format!("mtllib {library}\n"));
    let mut first = 1;
    for part in parts {
        part.check()?;
        if parts.len() > 1 || library.is_some() {
            text += &format!("o {}\n", part.name);
        }
        text.extend(part.positions.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")));
        text.extend(part.uvs.iter().map(|&uv| from_below(uv)).map(|[u, v]| format!("vt {u} {v}\n")));
        text.extend(part.normals.iter().map(|[x, y, z]| format!("vn {x} {y} {z}\n")));
        if library.is_some() {
            text += &format!("usemtl {}\n", part.name);
        }
        text.extend(part.triangles.iter().map(|face| face_line(face, first)));
        first += part.positions.len() as u64;
    }
    Ok(text)
}

/// A face line: each corner names position, uv and normal, counted through all meshes from 1 on.
fn face_line(face: &[u32; 3], first: u64) -> String {
    let mut line = String::from("f");
    for vertex in face {
        let number = first + u64::from(*vertex);
        // Writing to a string cannot fail.
        let _ = write!(line, " {number}/{number}/{number}");
    }
    line + "\n"
}

/// MTL text of the materials of meshes, each with the name of its mesh. Textures are files `NAME.png` beside it.
pub fn materials(parts: &[Part<'_>]) -> String {
    parts.iter().map(|part| format!("newmtl {}\n{}", part.name, material(part.material))).collect()
}

fn material(material: &Material) -> String {
    let needs = Needs::of(material.shader);
    let [r, g, b] = if needs.texture { [1.0; 3] } else { [0, 1, 2].map(|i| material.color[i] * material.kd) };
    let Material { ka, ks, shininess, .. } = *material;
    let mut text = format!(
        "Ka {ka} {ka} {ka}\nKd {r} {g} {b}\nKs {ks} {ks} {ks}\nNs {}\nillum 2\n",
        shininess.min(1000.0)
    );
    if needs.texture {
        text += &format!("map_Kd {}.png\n", material.texture);
    }
    if needs.height_map {
        text += &format!("map_bump {}.png\n", material.height_map);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::part::tests::part;
    use super::*;
    use crate::scene::Shader;
    use proptest::prelude::*;

    #[test]
    fn a_triangle_reads_as_the_format_says() {
        let material = Material::default();
        let mut triangle = part(3, &[[0, 2, 1]], &material);
        triangle.positions = vec![[0.0, 1.0, -0.5], [0.1, 2.0, 3.0], [1e-7, 0.0, 0.0]];
        triangle.uvs = vec![[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]];
        let expected = "v 0 1 -0.5\nv 0.1 2 3\nv 0.0000001 0 0\nvt 0 1\nvt 1 1\nvt 0.5 0\n\
            vn 0 1 0\nvn 0 1 0\nvn 0 1 0\nf 1/1/1 3/3/3 2/2/2\n";
        assert_eq!(encode(&[triangle], None).unwrap(), expected);
    }

    #[test]
    fn several_meshes_count_their_vertices_through_and_name_their_materials() {
        let textured = Material { shader: Shader::Texture, texture: "plaid".into(), ..Material::default() };
        let mut parts = [part(3, &[[0, 1, 2]], &textured), part(3, &[[0, 1, 2]], &textured)];
        parts[1].name = "other".into();
        let text = encode(&parts, Some("x.mtl")).unwrap();
        assert!(text.starts_with("mtllib x.mtl\no part\nv ") && text.contains("\no other\n"));
        assert!(text.contains("usemtl part\nf 1/1/1 2/2/2 3/3/3\n"), "{text}");
        assert!(text.ends_with("usemtl other\nf 4/4/4 5/5/5 6/6/6\n"), "{text}");
        let library = materials(&parts);
        assert!(library.contains("newmtl other\nKa 0.1 0.1 0.1\nKd 1 1 1\n"), "{library}");
        assert_eq!(library.matches("map_Kd plaid.png\n").count(), 2);
    }

    proptest! {
        #[test]
        fn numbers_read_back_bit_for_bit(wide in any::<[u64; 3]>(), narrow in any::<[u32; 3]>()) {
            let (point, normal) = (wide.map(f64::from_bits), narrow.map(f32::from_bits));
            prop_assume!(point.iter().all(|c| c.is_finite()) && normal.iter().all(|c| c.is_finite()));
            let material = Material::default();
            let mut mesh = part(1, &[], &material);
            (mesh.positions, mesh.normals, mesh.uvs) = (vec![point], vec![normal], vec![[normal[0], normal[1]]]);
            let text = encode(&[mesh], None).unwrap();
            let mut lines = text.lines().map(|line| line.split(' ').skip(1));
            let position: Vec<u64> = lines.next().unwrap().map(|n| n.parse::<f64>().unwrap().to_bits()).collect();
            let others: Vec<u32> = lines.flatten().map(|n| n.parse::<f32>().unwrap().to_bits()).collect();
            prop_assert_eq!(position, wide);
            prop_assert_eq!(others, [&[narrow[0], (1.0 - normal[1]).to_bits()], &narrow[..]].concat());
        }
    }
}
