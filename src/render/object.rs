//! The objects of a scene, each with its mesh, its place in the world and its material.

use super::options::{Shading, round, to_f32};
use crate::{
    camera::Columns,
    cloth::Points,
    glsl::{transform, xyz},
    lanes::F64,
    mesh::{Attributes, Mesh, Placement, SpringKinds, spring_lines},
    raster::{DrawCall, FragmentProgram, Primitives, VertexProgram},
    scene::{Collider, Material, Needs, Scene, Shader, Vec3},
    shader::sampler::Wrap,
};

/// A mesh in the world, and what it looks like.
pub(super) struct Object<'a> {
    pub(super) mesh: Mesh,
    lines: Option<Vec<[u32; 2]>>,
    pub(super) model: Columns,
    pub(super) material: &'a Material,
    /// What lies above the first row of its textures: the poles of a ball are not neighbours.
    pub(super) wrap_v: Wrap,
    pub(super) is_plane: bool,
}

impl<'a> Object<'a> {
    /// What is drawn, in order: the cloth, then the colliders. The cloth's mesh takes the `memory` of another.
    pub(super) fn all(
        scene: &'a Scene,
        points: &Points,
        springs: Option<SpringKinds>,
        memory: Mesh,
    ) -> Vec<Self> {
        let mut objects = Vec::new();
        if let Some(cloth) = &scene.cloth {
            let lines = (cloth.material.shader == Shader::Wireframe)
                .then(|| spring_lines(cloth, springs.unwrap_or_else(|| SpringKinds::of(cloth))));
            let mut mesh = memory;
            mesh.set_cloth(cloth, points, Needs::of(cloth.material.shader));
            let (model, material) = (model(Placement::WORLD), &cloth.material);
            objects.push(Self { mesh, lines, model, material, wrap_v: Wrap::Repeat, is_plane: false });
        }
        for collider in &scene.colliders {
            let material = collider.material();
            let (mesh, placement) = Mesh::collider(collider, Needs::of(material.shader));
            let wrap_v = if matches!(collider, Collider::Sphere(_)) { Wrap::Clamp } else { Wrap::Repeat };
            let is_plane = matches!(collider, Collider::Plane(_));
            objects.push(Self { mesh, lines: None, model: model(placement), material, wrap_v, is_plane });
        }
        objects
    }

    /// Where its vertices are, in metres.
    pub(super) fn places(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.mesh.positions.iter().map(|&position| {
            let [x, y, z] = xyz(transform(&self.model, position, 1.0)).map(f64::from);
            Vec3::new(x, y, z)
        })
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
