//! All triangles of a model as one mesh.

use std::sync::Arc;

use catoptra_core::geometry::unit_normal;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Content, Node};
use catoptra_core::{InvalidPart, Placement, Shape, TriangleMesh};

use super::{Fault, Model, Place};

/// Shapes where the model places them, as one mesh round the offset of the first. Where some have normals, texture coordinates
/// or colours, the others have those of their faces, 0 0, and white.
pub(super) fn mesh_of(model: Model) -> Result<TriangleMesh, Fault> {
    let mut meshes = Vec::new();
    for node in &model.nodes {
        gather(node, &Placement::IDENTITY, &mut meshes);
    }
    drop(model);
    let none = || Fault::new(Place::File, "holds no triangles");
    let (first, placement) = meshes.first().ok_or_else(none)?;
    if meshes.len() == 1 && *placement == Placement::IDENTITY {
        return meshes.pop().map(|(mesh, _)| Arc::unwrap_or_clone(mesh)).ok_or_else(none);
    }
    let any = |has: fn(&TriangleMesh) -> bool| meshes.iter().any(|(mesh, _)| has(mesh));
    let mut merged = Merged {
        offset: first.offset(),
        positions: Vec::new(),
        triangles: Vec::new(),
        normals: any(|mesh| mesh.normals().is_some()).then(Vec::new),
        uvs: any(|mesh| mesh.uvs().is_some()).then(Vec::new),
        colors: any(|mesh| mesh.colors().is_some()).then(Vec::new),
    };
    for (mesh, placement) in &meshes {
        merged.add(mesh, placement);
    }
    merged.mesh().map_err(|e| Fault::new(Place::File, e))
}

fn gather(node: &Node, outer: &Placement, meshes: &mut Vec<(Arc<TriangleMesh>, Placement)>) {
    let placement = node.placement.then(outer);
    match &node.content {
        Content::Shape(Shape::Mesh(mesh), _) => meshes.push((Arc::clone(&mesh.source().mesh), placement)),
        Content::Group(members) => members.iter().for_each(|member| gather(member, &placement, meshes)),
        _ => {}
    }
}

/// A mesh that grows.
struct Merged {
    offset: DVec3,
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    normals: Option<Vec<[f32; 3]>>,
    uvs: Option<Vec<[f32; 2]>>,
    colors: Option<Vec<[f32; 3]>>,
}

impl Merged {
    fn add(&mut self, mesh: &TriangleMesh, placement: &Placement) {
        let start = self.positions.len() as u32;
        let count = mesh.positions().len();
        // Faces without normals among others with them stand apart from their neighbours.
        let apart = self.normals.is_some() && mesh.normals().is_none();
        let corners: Vec<u32> = if apart {
            mesh.triangles().iter().flatten().copied().collect()
        } else {
            (0..count as u32).collect()
        };
        let narrow = |v: DVec3| v.as_vec3().to_array();
        let wide = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        let place = |corner: &u32| {
            let own = wide(mesh.positions()[*corner as usize]) + mesh.offset();
            narrow(placement.point(own) - self.offset)
        };
        self.positions.extend(corners.iter().map(place));
        if apart {
            self.triangles
                .extend((start..).step_by(3).take(mesh.triangles().len()).map(|i| [i, i + 1, i + 2]));
        } else {
            self.triangles
                .extend(mesh.triangles().iter().map(|triangle| triangle.map(|corner| corner + start)));
        }
        let turned = |normal: DVec3| narrow(placement.direction(normal));
        if let Some(normals) = &mut self.normals {
            match mesh.normals() {
                Some(own) => normals.extend(own.iter().map(|&normal| turned(wide(normal)))),
                None => normals.extend((0..mesh.triangles().len() as u32).flat_map(|triangle| {
                    let normal = unit_normal(&mesh.corners(triangle)).unwrap_or(DVec3::ZERO);
                    [turned(normal); 3]
                })),
            }
        }
        extend(&mut self.uvs, &corners, mesh.uvs(), [0.0; 2]);
        extend(&mut self.colors, &corners, mesh.colors(), [1.0; 3]);
    }

    fn mesh(self) -> Result<TriangleMesh, InvalidPart> {
        let mesh = TriangleMesh::new(self.positions, self.triangles, self.normals, self.uvs)?;
        let mesh = mesh.with_offset(self.offset);
        match self.colors {
            Some(colors) => mesh.with_colors(colors),
            None => Ok(mesh),
        }
    }
}

/// Adds the rows of some corners, where there is a table to add to.
fn extend<T: Copy>(all: &mut Option<Vec<T>>, corners: &[u32], own: Option<&[T]>, none: T) {
    if let Some(all) = all {
        all.extend(corners.iter().map(|&corner| own.map_or(none, |own| own[corner as usize])));
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::MeshSource;
    use catoptra_core::geometry::Mesh;

    use super::*;
    use crate::model::ModelMaterial;

    const CORNERS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

    fn square(normals: Option<[f32; 3]>) -> TriangleMesh {
        let normals = normals.map(|normal| vec![normal; 4]);
        TriangleMesh::new(CORNERS.to_vec(), vec![[0, 1, 2], [0, 2, 3]], normals, None).unwrap()
    }

    fn model(meshes: Vec<(TriangleMesh, Placement)>) -> Model {
        let mut model = Model::default();
        let grey = model.add_material(ModelMaterial::grey().unwrap());
        for (i, (mesh, placement)) in meshes.into_iter().enumerate() {
            let shape = Mesh::new(MeshSource { path: String::new(), mesh: Arc::new(mesh) });
            model.nodes.push(Node::shape(format!("{i}"), shape, grey).placed(placement));
        }
        model
    }

    #[test]
    fn meshes_without_normals_stay_flat_beside_others() {
        let turned = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::X, std::f64::consts::FRAC_PI_2).unwrap();
        let tilted = square(Some([0.0, 0.6, 0.8]));
        let merged = mesh_of(model(vec![(tilted, Placement::IDENTITY), (square(None), turned)])).unwrap();
        assert_eq!(merged.positions().len(), 4 + 6);
        assert_eq!(merged.triangles()[2..], [[4, 5, 6], [7, 8, 9]]);
        let normals = merged.normals().unwrap();
        assert_eq!(normals[0], [0.0, 0.6, 0.8]);
        assert!(normals[4..].iter().all(|n| (n[1] + 1.0).abs() < 1e-6), "{normals:?}");
    }

    #[test]
    fn what_some_lack_is_filled_in() {
        let uvs =
            TriangleMesh::new(CORNERS.to_vec(), vec![[0, 1, 2]], None, Some(vec![[0.5; 2]; 4])).unwrap();
        let colors = square(None).with_colors(vec![[0.25; 3]; 4]).unwrap();
        let far = Placement::IDENTITY.moved(DVec3::X * 5.0).unwrap();
        let merged = mesh_of(model(vec![(uvs, Placement::IDENTITY), (colors, far)])).unwrap();
        assert_eq!(merged.uvs().map(|uvs| (uvs[3], uvs[4])), Some(([0.5; 2], [0.0; 2])));
        assert_eq!(merged.colors().map(|colors| (colors[3], colors[4])), Some(([1.0; 3], [0.25; 3])));
        assert_eq!((merged.normals(), merged.bounds().max.x), (None, 6.0));
    }
}
