//! What lies in a model under which name?

use std::sync::Arc;

use catoptra_core::scene::{Content, Node};
use catoptra_core::{Image, Shape, TriangleMesh, Value};

use crate::model::Model;
use crate::words;

/// All that lies in a model, groups before their members.
pub(super) fn walk(model: &Model) -> impl Iterator<Item = &Node> {
    let mut rest: Vec<&Node> = model.nodes.iter().rev().collect();
    std::iter::from_fn(move || {
        let node = rest.pop()?;
        rest.extend(node.members().iter().rev());
        Some(node)
    })
}

/// Names of all that lies in a model.
pub(crate) fn names(model: &Model) -> Vec<&str> {
    walk(model).map(|node| node.name.as_str()).collect()
}

/// The node of that name.
pub(crate) fn find<'m>(model: &'m Model, name: &str) -> Option<&'m Node> {
    walk(model).find(|node| node.name == name)
}

/// The node of that name among others and all that lies in them.
pub(crate) fn find_mut<'n>(nodes: &'n mut [Node], name: &str) -> Option<&'n mut Node> {
    nodes.iter_mut().find_map(|node| {
        if node.name == name {
            return Some(node);
        }
        match &mut node.content {
            Content::Group(members) | Content::Solid(_, members) => find_mut(members, name),
            _ => None,
        }
    })
}

/// The triangles of a shape, if it is made of them.
pub(super) fn mesh_of(node: &Node) -> Option<&Arc<TriangleMesh>> {
    match &node.content {
        Content::Shape(Shape::Mesh(mesh), _) => Some(&mesh.source().mesh),
        _ => None,
    }
}

/// The triangles of the shape of that name.
pub(crate) fn mesh_named(model: &Model, name: &str) -> Result<Arc<TriangleMesh>, String> {
    let mut meshes = walk(model).filter_map(|node| Some((node.name.as_str(), mesh_of(node)?)));
    match meshes.find(|(known, _)| *known == name) {
        Some((_, mesh)) => Ok(Arc::clone(mesh)),
        None => {
            let known: Vec<&str> =
                walk(model).filter(|n| mesh_of(n).is_some()).map(|n| n.name.as_str()).collect();
            Err(format!("holds no mesh \"{name}\": {}", words::hint(name, &known, "meshes")))
        }
    }
}

/// The picture of the texture of that name.
pub(crate) fn image_named(model: &Model, name: &str) -> Result<Arc<Image>, String> {
    let found = model.textures.iter().find(|(known, _)| known == name).and_then(|(_, texture)| {
        texture.values().iter().find_map(|(_, value)| match value {
            Value::Image(source) => Some(Arc::clone(&source.image)),
            _ => None,
        })
    });
    found.ok_or_else(|| {
        let known: Vec<&str> = model.textures.iter().map(|(name, _)| name.as_str()).collect();
        format!("holds no picture \"{name}\": {}", words::hint(name, &known, "pictures"))
    })
}
