//! All triangles of a model as one mesh.

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Content, Node};
use catoptra_core::{Placement, Shape, TriangleMesh};

use super::{Fault, Model, Place};

/// Shapes where the model places them, as one mesh round the offset of the first. Normals, texture coordinates and colours
/// stay where all meshes have them.
pub(super) fn mesh_of(model: &Model) -> Result<TriangleMesh, Fault> {
    let mut meshes = Vec::new();
    for node in &model.nodes {
        gather(node, &Placement::IDENTITY, &mut meshes);
    }
    let none = || Fault::new(Place::File, "holds no triangles");
    let (first, _) = meshes.first().ok_or_else(none)?;
    if let [(mesh, placement)] = &meshes[..]
        && *placement == Placement::IDENTITY
    {
        return Ok((*mesh).clone());
    }
    let offset = first.offset();
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    let all = |has: fn(&TriangleMesh) -> bool| meshes.iter().all(|(mesh, _)| has(mesh));
    let mut normals = all(|mesh| mesh.normals().is_some()).then(Vec::new);
    let mut uvs = all(|mesh| mesh.uvs().is_some()).then(Vec::new);
    let mut colors = all(|mesh| mesh.colors().is_some()).then(Vec::new);
    for (mesh, placement) in &meshes {
        let start = positions.len() as u32;
        let narrow = |v: DVec3| v.as_vec3().to_array();
        let place = |&p: &[f32; 3]| placement.point(DVec3::from(p.map(f64::from)) + mesh.offset()) - offset;
        positions.extend(mesh.positions().iter().map(place).map(narrow));
        triangles.extend(mesh.triangles().iter().map(|triangle| triangle.map(|corner| corner + start)));
        let turn = |&n: &[f32; 3]| narrow(placement.direction(DVec3::from(n.map(f64::from))));
        normals.iter_mut().for_each(|all| all.extend(mesh.normals().unwrap_or_default().iter().map(turn)));
        uvs.iter_mut().for_each(|all| all.extend(mesh.uvs().unwrap_or_default()));
        colors.iter_mut().for_each(|all| all.extend(mesh.colors().unwrap_or_default()));
    }
    let mesh = TriangleMesh::new(positions, triangles, normals, uvs).map(|mesh| mesh.with_offset(offset));
    let mesh = mesh.and_then(|mesh| match colors {
        Some(colors) => mesh.with_colors(colors),
        None => Ok(mesh),
    });
    mesh.map_err(|e| Fault::new(Place::File, e.to_string()))
}

fn gather<'a>(node: &'a Node, outer: &Placement, meshes: &mut Vec<(&'a TriangleMesh, Placement)>) {
    let placement = node.placement.then(outer);
    match &node.content {
        Content::Shape(Shape::Mesh(mesh), _) => meshes.push((mesh.triangles(), placement)),
        Content::Group(members) => members.iter().for_each(|member| gather(member, &placement, meshes)),
        _ => {}
    }
}
