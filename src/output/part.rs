//! The meshes of a scene for other programs.

use crate::cloth::Points;
use crate::error::{Error, Kind, Result};
use crate::mesh::Mesh;
use crate::scene::{Material, Needs, Scene};

/// One object of a scene as a triangle mesh, in metres, y up. Vertex i has `positions[i]`, `normals[i]` and `uvs[i]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Part<'a> {
    /// `cloth`, `sphere`, `plane` or the like; with a number, from 2 on, where there are several.
    pub name: String,
    /// Where the vertices are.
    pub positions: Vec<[f64; 3]>,
    /// Unit normals.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates; the first row of a texture is at v = 0.
    pub uvs: Vec<[f32; 2]>,
    /// Three vertices a triangle, counterclockwise from the side of the normal.
    pub triangles: Vec<[u32; 3]>,
    /// What it looks like.
    pub material: &'a Material,
}

/// What programs read of a mesh.
const ALL: Needs =
    Needs { normal: true, uv: true, tangent: false, texture: false, height_map: false, environment: false };

impl<'a> Part<'a> {
    /// The cloth of `scene` at `points`, if it has one.
    pub fn cloth(scene: &'a Scene, points: &Points) -> Option<Self> {
        let cloth = scene.cloth.as_ref()?;
        let Mesh { normals, uvs, triangles, .. } = Mesh::cloth(cloth, points, ALL);
        // In f64, as simulated: the mesh that is drawn has f32.
        let positions = (0..points.len()).map(|i| points.get(i).into()).collect();
        Some(Self { name: "cloth".to_owned(), positions, normals, uvs, triangles, material: &cloth.material })
    }

    /// What the cloth collides with, as it is drawn.
    pub fn colliders(scene: &'a Scene) -> Vec<Self> {
        let mut parts: Vec<Self> = Vec::new();
        for collider in &scene.colliders {
            let (Mesh { positions, normals, uvs, triangles, .. }, placement) = Mesh::collider(collider, ALL);
            let kind = collider.kind().key();
            let before = parts.iter().filter(|part| part.name.starts_with(kind)).count();
            let name = if before == 0 { kind.to_owned() } else { format!("{kind}_{}", before + 1) };
            let place = |position: &[f32; 3]| {
                [0, 1, 2].map(|axis| placement.origin[axis] + placement.scale * f64::from(position[axis]))
            };
            let positions = positions.iter().map(place).collect();
            parts.push(Self { name, positions, normals, uvs, triangles, material: collider.material() });
        }
        parts
    }

    /// Checks that the arrays fit together.
    ///
    /// # Errors
    /// [`Kind::Internal`] when they differ in length or a triangle names no vertex.
    pub(super) fn check(&self) -> Result<()> {
        let count = self.positions.len();
        if self.uvs.len() != count || self.normals.len() != count {
            return Err(Error::new(Kind::Internal, "positions, uv and normals differ in number"));
        }
        if self.triangles.iter().flatten().any(|&vertex| vertex as usize >= count) {
            return Err(Error::new(Kind::Internal, "a face names a vertex that is not there"));
        }
        Ok(())
    }
}

/// Texture coordinates with v counted from the last row of a picture, as OBJ and PLY have them.
pub(super) fn from_below([u, v]: [f32; 2]) -> [f32; 2] {
    [u, 1.0 - v]
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A part with this many vertices and these triangles.
    pub(in crate::output) fn part<'a>(
        count: usize,
        triangles: &[[u32; 3]],
        material: &'a Material,
    ) -> Part<'a> {
        Part {
            name: "part".to_owned(),
            positions: vec![[0.0; 3]; count],
            normals: vec![[0.0, 1.0, 0.0]; count],
            uvs: vec![[0.0; 2]; count],
            triangles: triangles.to_vec(),
            material,
        }
    }

    #[test]
    fn meshes_that_do_not_fit_together_are_refused() {
        let material = Material::default();
        assert!(part(2, &[[0, 1, 1]], &material).check().is_ok());
        assert!(part(2, &[[0, 1, 2]], &material).check().is_err());
        let mut few = part(2, &[], &material);
        few.uvs.pop();
        assert!(few.check().is_err());
        let mut few = part(2, &[], &material);
        few.normals.pop();
        assert!(few.check().is_err());
    }
}
