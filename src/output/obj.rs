//! Wavefront OBJ: a triangle mesh as text.

use std::fmt::Write;

use crate::error::{Error, Kind, Result};

/// OBJ text of a triangle mesh. Vertex i has `positions[i]`, `uv[i]` and `normals[i]`; a face
/// names three vertices, counted from 0. Each number is the shortest decimal that reads back as
/// the same bits.
///
/// # Errors
/// [`Kind::Internal`] when the slices differ in length or a face names no vertex.
pub fn encode(
    positions: &[[f64; 3]],
    uv: &[[f32; 2]],
    normals: &[[f32; 3]],
    faces: &[[u32; 3]],
) -> Result<String> {
    let count = positions.len();
    if uv.len() != count || normals.len() != count {
        return Err(Error::new(Kind::Internal, "positions, uv and normals differ in number"));
    }
    if faces.iter().flatten().any(|&vertex| vertex as usize >= count) {
        return Err(Error::new(Kind::Internal, "a face names a vertex that is not there"));
    }
    let mut text = String::new();
    text.extend(positions.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")));
    text.extend(uv.iter().map(|[u, v]| format!("vt {u} {v}\n")));
    text.extend(normals.iter().map(|[x, y, z]| format!("vn {x} {y} {z}\n")));
    text.extend(faces.iter().map(face_line));
    Ok(text)
}

/// A face line: OBJ counts from 1, and each corner names position, uv and normal.
fn face_line(face: &[u32; 3]) -> String {
    let mut line = String::from("f");
    for vertex in face {
        let number = u64::from(*vertex) + 1;
        // Writing to a string cannot fail.
        let _ = write!(line, " {number}/{number}/{number}");
    }
    line + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_triangle_reads_as_the_format_says() {
        let positions = [[0.0, 1.0, -0.5], [0.1, 2.0, 3.0], [1e-7, 0.0, 0.0]];
        let text =
            encode(&positions, &[[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]], &[[0.0, 1.0, 0.0]; 3], &[[0, 2, 1]]);
        let expected = "v 0 1 -0.5\nv 0.1 2 3\nv 0.0000001 0 0\nvt 0 0\nvt 1 0\nvt 0.5 1\n\
            vn 0 1 0\nvn 0 1 0\nvn 0 1 0\nf 1/1/1 3/3/3 2/2/2\n";
        assert_eq!(text.unwrap(), expected);
    }

    proptest! {
        #[test]
        fn numbers_read_back_bit_for_bit(wide in any::<[u64; 3]>(), narrow in any::<[u32; 3]>()) {
            let (point, normal) = (wide.map(f64::from_bits), narrow.map(f32::from_bits));
            prop_assume!(point.iter().all(|c| c.is_finite()) && normal.iter().all(|c| c.is_finite()));
            let text = encode(&[point], &[[normal[0], normal[1]]], &[normal], &[]).unwrap();
            let mut lines = text.lines().map(|line| line.split(' ').skip(1));
            let position: Vec<u64> = lines.next().unwrap().map(|n| n.parse::<f64>().unwrap().to_bits()).collect();
            let others: Vec<u32> = lines.flatten().map(|n| n.parse::<f32>().unwrap().to_bits()).collect();
            prop_assert_eq!(position, wide);
            prop_assert_eq!(others, [&narrow[..2], &narrow].concat());
        }
    }

    #[test]
    fn meshes_that_do_not_fit_together_are_refused() {
        let (p, t, n) = ([[0.0; 3]; 2], [[0.0; 2]; 2], [[0.0; 3]; 2]);
        assert!(encode(&p, &t, &n, &[[0, 1, 1]]).is_ok());
        assert!(encode(&p, &t, &n, &[[0, 1, 2]]).is_err());
        assert!(encode(&p, &t[..1], &n, &[]).is_err());
        assert!(encode(&p, &t, &n[..1], &[]).is_err());
    }
}
