//! PLY (Stanford): one triangle mesh, binary, little-endian.

use super::part::{Part, from_below};
use crate::error::Result;

/// PLY bytes of meshes as one: positions as doubles, normals, and texture coordinates `s` and `t`, of which t grows
/// upwards as in OBJ.
///
/// # Errors
/// [`Kind::Internal`](crate::error::Kind::Internal) when the arrays of a mesh do not fit together.
pub fn encode(parts: &[Part<'_>]) -> Result<Vec<u8>> {
    let count = |of: fn(&Part<'_>) -> usize| parts.iter().map(of).sum::<usize>();
    let (vertices, faces) = (count(|part| part.positions.len()), count(|part| part.triangles.len()));
    let vectors = ["x", "y", "z"].map(|name| format!("property double {name}\n")).concat();
    let others = ["nx", "ny", "nz", "s", "t"].map(|name| format!("property float {name}\n")).concat();
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\ncomment metres, y up\nelement vertex {vertices}\n{vectors}{others}\
         element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    for part in parts {
        part.check()?;
        for ((position, normal), &uv) in part.positions.iter().zip(&part.normals).zip(&part.uvs) {
            bytes.extend(position.iter().flat_map(|c| c.to_le_bytes()));
            bytes.extend(normal.iter().chain(&from_below(uv)).flat_map(|c| c.to_le_bytes()));
        }
    }
    let mut first = 0;
    for part in parts {
        for face in &part.triangles {
            bytes.push(3);
            bytes.extend(face.iter().flat_map(|vertex| (first + vertex).to_le_bytes()));
        }
        #[expect(clippy::cast_possible_truncation, reason = "far fewer than 2^32 vertices are drawn")]
        let vertices = part.positions.len() as u32;
        first += vertices;
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::super::part::tests::part;
    use super::*;
    use crate::scene::Material;

    #[test]
    fn meshes_are_joined_and_have_the_size_that_the_header_says() {
        let material = Material::default();
        let bytes =
            encode(&[part(3, &[[0, 1, 2]], &material), part(4, &[[0, 1, 3], [1, 2, 3]], &material)]).unwrap();
        let header = bytes.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
        assert!(String::from_utf8_lossy(&bytes[..header]).contains("element vertex 7\n"));
        assert_eq!(bytes.len() - header, 7 * (3 * 8 + 5 * 4) + 3 * (1 + 3 * 4));
        let mut single = part(3, &[[0, 1, 2]], &material);
        single.uvs[0] = [0.25, 0.75];
        let vertex = encode(&[single]).unwrap();
        let start = vertex.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
        let uv = &vertex[start + 3 * 8 + 3 * 4..][..8];
        assert_eq!(uv, [0.25_f32, 0.25].map(f32::to_le_bytes).concat(), "t is counted from below");
        let last = &bytes[bytes.len() - 12..];
        assert_eq!(last, [4_u32, 5, 6].map(u32::to_le_bytes).concat(), "counted through all meshes");
    }
}
