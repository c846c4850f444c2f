//! The objects of a scene, each with its mesh, its place in the world and its material.

use super::options::{Shading, round, to_f32};
use crate::{
    camera::Columns,
    cloth::Points,
    lanes::F64,
    mesh::{Attributes, Mesh, Placement, SpringKinds, spring_lines},
    raster::{DrawCall, FragmentProgram, Primitives, VertexProgram},
    scene::{Material, Needs, Scene, Shader},
};

/// A mesh in the world, and what it looks like.
pub(super) struct Object<'a> {
    mesh: Mesh,
    lines: Option<Vec<[u32; 2]>>,
    pub(super) model: Columns,
    pub(super) material: &'a Material,
}

impl<'a> Object<'a> {
    /// What is drawn, in order: the cloth, then the colliders.
    pub(super) fn all(scene: &'a Scene, points: &Points, springs: Option<SpringKinds>) -> Vec<Self> {
        let mut objects = Vec::new();
        if let Some(cloth) = &scene.cloth {
            let lines = (cloth.material.shader == Shader::Wireframe)
                .then(|| spring_lines(cloth, springs.unwrap_or_else(|| SpringKinds::of(cloth))));
            let mesh = Mesh::cloth(cloth, points, Needs::of(cloth.material.shader));
            objects.push(Self { mesh, lines, model: model(Placement::WORLD), material: &cloth.material });
        }
        for collider in &scene.colliders {
            let material = collider.material();
            let (mesh, placement) = Mesh::collider(collider, Needs::of(material.shader));
            objects.push(Self { mesh, lines: None, model: model(placement), material });
        }
        objects
    }

    /// The draw call with these programs.
    pub(super) fn call<'b, F: FragmentProgram<N> + 'b, const N: usize>(
        &'b self,
        shading: Shading,
        vertex: impl VertexProgram<Attributes, F::Varyings<f32>> + 'b,
        fragment: F,
    ) -> DrawCall<'b> {
        let primitives = match &self.lines {
            Some(lines) => Primitives::Lines(lines),
            None => Primitives::Triangles(&self.mesh.triangles),
        };
        let (count, attributes) = (self.mesh.positions.len(), |i| self.mesh.vertex(i));
        match shading {
            Shading::F32 => DrawCall::new(primitives, count, attributes, vertex, fragment),
            Shading::F64 => {
                DrawCall::one_by_one::<F64, _, _, N>(primitives, count, attributes, vertex, fragment)
            }
        }
    }
}

/// The placement as a matrix.
fn model(Placement { origin, scale }: Placement) -> Columns {
    let s = to_f32(scale);
    let [x, y, z] = round(origin);
    [[s, 0.0, 0.0, 0.0], [0.0, s, 0.0, 0.0], [0.0, 0.0, s, 0.0], [x, y, z, 1.0]]
}
