//! Binary glTF 2.0 (`.glb`): meshes with materials, and the motion of the cloth as morph targets.
//!
//! glTF counts v from the first row of a picture, as the scene does, and has metres and y up.

use serde_json::{Value, json};

use super::part::Part;
use super::provenance::Provenance;
use crate::error::{Error, Kind, Result};
use crate::scene::{Material, Needs};

/// The motion of the first mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// When each frame is shown, in seconds, rising from 0.
    pub times: Vec<f32>,
    /// Positions and normals of the vertices in each frame.
    pub frames: Vec<Shape>,
}

/// Positions and normals of the vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shape {
    /// Where the vertices are.
    pub positions: Vec<[f64; 3]>,
    /// Unit normals.
    pub normals: Vec<[f32; 3]>,
}

/// Component types and targets of the specification.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// So many times their size from the origin vertices are counted from their middle, where the nodes then are: in numbers
/// of 32 bits their places would be off by 1e-5 of their size and more.
const TOO_FAR: f64 = 256.0;

/// glTF bytes of meshes. `texture` gives the PNG of a texture's name. With `motion`, which has a shape for each of its
/// times and as many vertices as the first mesh, an animation goes from frame to frame in straight lines. With the hash
/// of a state and `provenance`, the file says so of itself in `asset.extras.drape`; the content is its binary chunk.
///
/// # Errors
/// [`Kind::Internal`] when arrays do not fit together; [`Kind::Usage`] beyond 4 GiB; those of `texture`.
pub fn encode(
    parts: &[Part<'_>],
    motion: Option<&Motion>,
    provenance: Option<(u64, &Provenance)>,
    texture: impl Fn(&str) -> Result<Vec<u8>>,
) -> Result<Vec<u8>> {
    let mut file = File { middle: middle(parts), ..File::default() };
    for (i, part) in parts.iter().enumerate() {
        part.check()?;
        let material = file.material(part, &texture)?;
        file.mesh(part, material, motion.filter(|_| i == 0))?;
    }
    file.finish(parts.len(), provenance)
}

/// The lists of a file, and its bytes.
#[derive(Default)]
struct File {
    /// Where vertices are counted from.
    middle: [f64; 3],
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    materials: Vec<Value>,
    images: Vec<(String, Value)>,
    animation: Option<Value>,
}

impl File {
    /// Adds bytes, and returns the number of their view.
    fn view(&mut self, bytes: impl IntoIterator<Item = u8>, target: Option<u32>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        // Every view starts at a multiple of four.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(view);
        self.views.len() - 1
    }

    /// Adds numbers of `kind`, and returns the number of their accessor.
    fn floats<const N: usize>(&mut self, kind: &str, values: &[[f32; N]], target: Option<u32>) -> usize {
        let view = self.view(values.as_flattened().iter().flat_map(|c| c.to_le_bytes()), target);
        let least = |a: f32, b: f32| a.min(b);
        let bound = |of: fn(f32, f32) -> f32, start: f32| -> Vec<f32> {
            (0..N).map(|i| values.iter().map(|value| value[i]).fold(start, of)).collect()
        };
        self.accessors.push(json!({
            "bufferView": view, "componentType": FLOAT, "count": values.len(), "type": kind,
            "min": bound(least, f32::INFINITY), "max": bound(f32::max, f32::NEG_INFINITY),
        }));
        self.accessors.len() - 1
    }

    /// Adds the material of a part, and returns its number.
    fn material(&mut self, part: &Part<'_>, texture: &impl Fn(&str) -> Result<Vec<u8>>) -> Result<usize> {
        let Material { color, kd, ks, shininess, .. } = part.material;
        let needs = Needs::of(part.material.shader);
        // The exponent of the highlight as a roughness (Karis 2013), matt without one.
        let roughness = if *ks > 0.0 { (2.0 / (shininess + 2.0)).sqrt().sqrt() } else { 1.0 };
        let mut surface = json!({ "metallicFactor": 0.0, "roughnessFactor": roughness });
        if needs.texture {
            let index = self.image(&part.material.texture, texture)?;
            surface["baseColorTexture"] = json!({ "index": index });
        } else {
            let [r, g, b] = [0, 1, 2].map(|i| (color[i] * kd).clamp(0.0, 1.0));
            surface["baseColorFactor"] = json!([r, g, b, 1.0]);
        }
        self.materials
            .push(json!({ "name": part.name, "pbrMetallicRoughness": surface, "doubleSided": true }));
        Ok(self.materials.len() - 1)
    }

    /// Adds a texture once, and returns its number.
    fn image(&mut self, name: &str, texture: &impl Fn(&str) -> Result<Vec<u8>>) -> Result<usize> {
        if let Some(known) = self.images.iter().position(|(known, _)| known == name) {
            return Ok(known);
        }
        let view = self.view(texture(name)?, None);
        self.images
            .push((name.to_owned(), json!({ "name": name, "mimeType": "image/png", "bufferView": view })));
        Ok(self.images.len() - 1)
    }

    /// Adds a mesh with its node, and its motion.
    fn mesh(&mut self, part: &Part<'_>, material: usize, motion: Option<&Motion>) -> Result<()> {
        let positions = self.rounded(&part.positions);
        let mut primitive = json!({
            "attributes": {
                "POSITION": self.floats("VEC3", &positions, Some(ARRAY_BUFFER)),
                "NORMAL": self.floats("VEC3", &part.normals, Some(ARRAY_BUFFER)),
                "TEXCOORD_0": self.floats("VEC2", &part.uvs, Some(ARRAY_BUFFER)),
            },
            "material": material,
        });
        let indices = part.triangles.as_flattened();
        let view = self.view(indices.iter().flat_map(|i| i.to_le_bytes()), Some(ELEMENT_ARRAY_BUFFER));
        self.accessors.push(json!({
            "bufferView": view, "componentType": UNSIGNED_INT, "count": indices.len(), "type": "SCALAR",
        }));
        primitive["indices"] = json!(self.accessors.len() - 1);
        let mut mesh = json!({ "name": part.name });
        if let Some(motion) = motion.filter(|motion| motion.frames.len() > 1) {
            primitive["targets"] = Value::Array(self.targets(part, &positions, motion)?);
            mesh["weights"] = json!(vec![0.0; motion.frames.len() - 1]);
            self.animation = Some(self.animation(motion, self.nodes.len()));
        }
        mesh["primitives"] = json!([primitive]);
        let mut node = json!({ "name": part.name, "mesh": self.meshes.len() });
        if self.middle != [0.0; 3] {
            node["translation"] = json!(self.middle);
        }
        self.nodes.push(node);
        self.meshes.push(mesh);
        Ok(())
    }

    #[expect(clippy::cast_possible_truncation, reason = "glTF has numbers of 32 bits")]
    fn rounded(&self, positions: &[[f64; 3]]) -> Vec<[f32; 3]> {
        let place = |position: &[f64; 3]| [0, 1, 2].map(|axis| (position[axis] - self.middle[axis]) as f32);
        positions.iter().map(place).collect()
    }

    /// A morph target for each frame but the first: how far its vertices and normals are from those of the mesh.
    fn targets(&mut self, part: &Part<'_>, base: &[[f32; 3]], motion: &Motion) -> Result<Vec<Value>> {
        let fits = |shape: &Shape| shape.positions.len() == base.len() && shape.normals.len() == base.len();
        if motion.times.len() != motion.frames.len() || !motion.frames.iter().all(fits) {
            return Err(Error::new(Kind::Internal, "the motion does not fit the mesh"));
        }
        let mut targets = Vec::new();
        for shape in &motion.frames[1..] {
            let moved = differences(&self.rounded(&shape.positions), base);
            let turned = differences(&shape.normals, &part.normals);
            targets.push(json!({
                "POSITION": self.floats("VEC3", &moved, Some(ARRAY_BUFFER)),
                "NORMAL": self.floats("VEC3", &turned, Some(ARRAY_BUFFER)),
            }));
        }
        Ok(targets)
    }

    /// In frame k the weight of target k - 1 is 1, and all others are 0.
    fn animation(&mut self, motion: &Motion, node: usize) -> Value {
        let count = motion.frames.len();
        let times: Vec<[f32; 1]> = motion.times.iter().map(|&time| [time]).collect();
        let weight = |frame: usize, target: usize| [f32::from(u8::from(frame == target + 1))];
        let weights: Vec<[f32; 1]> =
            (0..count).flat_map(|frame| (0..count - 1).map(move |target| weight(frame, target))).collect();
        let (input, output) = (self.floats("SCALAR", &times, None), self.floats("SCALAR", &weights, None));
        json!({
            "name": "motion",
            "channels": [{ "sampler": 0, "target": { "node": node, "path": "weights" } }],
            "samplers": [{ "input": input, "output": output, "interpolation": "LINEAR" }],
        })
    }

    /// The file: a header, the JSON and the bytes, each filled up to a multiple of four.
    fn finish(self, nodes: usize, provenance: Option<(u64, &Provenance)>) -> Result<Vec<u8>> {
        let mut document = json!({
            "asset": { "version": "2.0", "generator": concat!("drape ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{ "nodes": (0..nodes).collect::<Vec<_>>() }],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.bytes.len() }],
        });
        if let Some((state, provenance)) = provenance {
            let said = provenance.of_content(state, &self.bytes).to_json();
            document["asset"]["extras"] = json!({ "drape": said });
        }
        if !self.images.is_empty() {
            let textures = (0..self.images.len()).map(|source| json!({ "sampler": 0, "source": source }));
            document["textures"] = Value::Array(textures.collect());
            // LINEAR, REPEAT.
            document["samplers"] =
                json!([{ "magFilter": 9729, "minFilter": 9729, "wrapS": 10497, "wrapT": 10497 }]);
            document["images"] = Value::Array(self.images.into_iter().map(|(_, image)| image).collect());
        }
        if let Some(animation) = self.animation {
            document["animations"] = json!([animation]);
        }
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let size = |bytes: usize| {
            u32::try_from(bytes)
                .map_err(|_| Error::new(Kind::Usage, "a .glb file holds at most 4 GiB: export fewer frames"))
        };
        let mut file = b"glTF".to_vec();
        let total = 12 + 8 + text.len() + 8 + self.bytes.len();
        for number in [2, size(total)?, size(text.len())?] {
            file.extend(u32::to_le_bytes(number));
        }
        file.extend(b"JSON");
        file.extend(text);
        file.extend(size(self.bytes.len())?.to_le_bytes());
        file.extend(b"BIN\0");
        file.extend(self.bytes);
        Ok(file)
    }
}

/// The middle of all vertices, as numbers of 32 bits, if that is far away; else the origin.
fn middle(parts: &[Part<'_>]) -> [f64; 3] {
    let positions = parts.iter().flat_map(|part| &part.positions);
    let bounds = [0, 1, 2].map(|axis| {
        positions.clone().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], position| {
            [least.min(position[axis]), most.max(position[axis])]
        })
    });
    let size = bounds.iter().fold(0.0, |size: f64, [least, most]| size.max(most - least));
    #[expect(clippy::cast_possible_truncation, reason = "readers have numbers of 32 bits")]
    let middle = bounds.map(|[least, most]| f64::from((least + 0.5 * (most - least)) as f32));
    let is_far = middle.iter().any(|c| c.abs() > TOO_FAR * size);
    if is_far { middle } else { [0.0; 3] }
}

fn differences(a: &[[f32; 3]], b: &[[f32; 3]]) -> Vec<[f32; 3]> {
    a.iter().zip(b).map(|(a, b)| [0, 1, 2].map(|axis| a[axis] - b[axis])).collect()
}

#[cfg(test)]
mod tests;
