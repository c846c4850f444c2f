//! What stands in a file is what its lists say.

#![expect(clippy::cast_possible_truncation, reason = "numbers are small")]

use super::super::part::tests::part;
use super::*;
use crate::scene::Shader;

fn document(bytes: &[u8]) -> Value {
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).unwrap()
}

/// The bytes that a view of the binary chunk holds, which starts at a multiple of four.
fn view<'a>(bytes: &'a [u8], document: &Value, view: &Value) -> &'a [u8] {
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let view = &document["bufferViews"][number(view)];
    let start = number(&view["byteOffset"]);
    assert_eq!(start % 4, 0, "{view}");
    &bytes[28 + length + start..][..number(&view["byteLength"])]
}

/// The numbers of an accessor.
fn floats(bytes: &[u8], document: &Value, accessor: &Value) -> Vec<f32> {
    let accessor = &document["accessors"][number(accessor)];
    let bytes = view(bytes, document, &accessor["bufferView"]);
    bytes.as_chunks().0.iter().map(|&c| f32::from_le_bytes(c)).collect()
}

fn number(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}

#[test]
fn a_file_has_its_header_and_its_length() {
    let material = Material::default();
    let bytes = encode(&[part(3, &[[0, 1, 2]], &material)], None, None, |_| Ok(Vec::new())).unwrap();
    assert_eq!(&bytes[..8], b"glTF\x02\0\0\0");
    assert_eq!(bytes[8..12], u32::try_from(bytes.len()).unwrap().to_le_bytes());
    let document = document(&bytes);
    assert_eq!(document["accessors"][0]["count"], 3);
    assert!(document.get("animations").is_none() && document.get("images").is_none());
}

#[test]
fn a_file_says_of_what_it_is() {
    let (material, said) = (Material::default(), Provenance::default());
    let parts = [part(3, &[[0, 1, 2]], &material)];
    let bytes = encode(&parts, None, Some((7, &said)), |_| Ok(Vec::new())).unwrap();
    let binary = bytes.windows(4).rposition(|window| window == b"BIN\0").unwrap() + 4;
    let expected = said.of_content(7, &bytes[binary..]).to_json();
    assert_eq!(document(&bytes)["asset"]["extras"]["drape"], expected);
}

#[test]
fn a_mesh_far_from_the_origin_keeps_its_shape() {
    let material = Material::default();
    let near = skew(&material);
    for (far, is_moved) in [([0.0; 3], false), ([1e3, 0.0, 0.0], false), ([1e7, -4e6, 3e9], true)] {
        let shift = |positions: &[[f64; 3]]| -> Vec<[f64; 3]> {
            positions.iter().map(|p| [0, 1, 2].map(|axis| p[axis] + far[axis])).collect()
        };
        let part = Part { positions: shift(&near.positions), ..skew(&material) };
        let second = Shape {
            positions: part.positions.iter().map(|p| [p[0] + 0.125, p[1], p[2]]).collect(),
            normals: part.normals.clone(),
        };
        let first = Shape { positions: part.positions.clone(), normals: part.normals.clone() };
        let motion = Motion { times: vec![0.0, 1.0], frames: vec![first, second] };
        let bytes = encode(std::slice::from_ref(&part), Some(&motion), None, |_| Ok(Vec::new())).unwrap();
        let document = document(&bytes);
        let translation = &document["nodes"][0]["translation"];
        assert_eq!(translation.is_array(), is_moved, "{far:?}");
        let primitive = &document["meshes"][0]["primitives"][0];
        let places = floats(&bytes, &document, &primitive["attributes"]["POSITION"]);
        for (i, expected) in part.positions.as_flattened().iter().enumerate() {
            let place = f64::from(places[i]) + translation[i % 3].as_f64().unwrap_or(0.0);
            assert!((place - expected).abs() < 1e-4, "{far:?}: {place} instead of {expected}");
        }
        let moved = floats(&bytes, &document, &primitive["targets"][0]["POSITION"]);
        assert_eq!(moved, [0.125, 0.0, 0.0].repeat(3), "{far:?}");
    }
}

/// A triangle whose numbers all differ.
fn skew(material: &Material) -> Part<'_> {
    Part {
        positions: vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.5]],
        normals: vec![[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
        uvs: vec![[0.0, 0.25], [0.5, 0.75], [1.0, 0.125]],
        ..part(3, &[[0, 2, 1]], material)
    }
}

/// v is counted from the first row of a picture, as glTF does.
#[test]
fn numbers_stand_where_the_accessors_say() {
    let material = Material { shader: Shader::Texture, ..Material::default() };
    let mesh = skew(&material);
    // A texture of an odd length moves what follows.
    let bytes = encode(std::slice::from_ref(&mesh), None, None, |_| Ok(b"five!".to_vec())).unwrap();
    let found = document(&bytes);
    let primitive = &found["meshes"][0]["primitives"][0];
    let read = |name: &str| floats(&bytes, &found, &primitive["attributes"][name]);
    assert_eq!(read("POSITION"), mesh.positions.as_flattened().iter().map(|&c| c as f32).collect::<Vec<_>>());
    assert_eq!(read("NORMAL"), mesh.normals.as_flattened());
    assert_eq!(read("TEXCOORD_0"), mesh.uvs.as_flattened());
    let accessor = &found["accessors"][number(&primitive["attributes"]["POSITION"])];
    assert_eq!((&accessor["min"], &accessor["max"]), (&json!([1.0, 2.0, 3.0]), &json!([7.0, 8.0, 9.5])));
    let indices = &found["accessors"][number(&primitive["indices"])];
    assert_eq!(indices["count"], 3);
    let corners = view(&bytes, &found, &indices["bufferView"]);
    assert_eq!(corners, [0_u32, 2, 1].map(u32::to_le_bytes).concat());
    assert_eq!(view(&bytes, &found, &found["images"][0]["bufferView"]), b"five!");
}

#[test]
fn motion_is_a_target_for_each_frame_but_the_first() {
    let material = Material::default();
    let mesh = skew(&material);
    let normals = mesh.normals.clone();
    let shape = |by: f64| {
        let positions = mesh.positions.iter().map(|&[x, y, z]| [x + by, y, z]).collect();
        Shape { positions, normals: normals.iter().map(|&[x, y, z]| [x, y, z + by as f32]).collect() }
    };
    let motion = Motion { times: vec![0.0, 0.5, 2.0], frames: [0.0, 1.0, 3.0].map(shape).to_vec() };
    let bytes = encode(std::slice::from_ref(&mesh), Some(&motion), None, |_| Ok(Vec::new())).unwrap();
    let found = document(&bytes);
    let targets = found["meshes"][0]["primitives"][0]["targets"].as_array().unwrap();
    assert_eq!(targets.len(), 2);
    for (target, by) in targets.iter().zip([1.0, 3.0]) {
        assert_eq!(floats(&bytes, &found, &target["POSITION"]), [[by, 0.0, 0.0]; 3].as_flattened());
        assert_eq!(floats(&bytes, &found, &target["NORMAL"]), [[0.0, 0.0, by]; 3].as_flattened());
    }
    let sampler = &found["animations"][0]["samplers"][0];
    assert_eq!(floats(&bytes, &found, &sampler["input"]), motion.times);
    // A row a frame: the first is the mesh itself, each other one its target.
    assert_eq!(floats(&bytes, &found, &sampler["output"]), [0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    let short = Motion { times: vec![0.0], ..motion };
    assert!(encode(&[mesh], Some(&short), None, |_| Ok(Vec::new())).is_err());
}
