//! How do the nodes of a model become those of a scene?

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::scene::{Content, Node};
use catoptra_core::{InvalidPart, MeshSource, Shape, TriangleMesh, Value};

use super::find::{mesh_of, walk};
use super::{Instance, ModelSource, Overrides, full_name};

/// What is needed to make the nodes of a model those of a scene.
pub(super) struct Making<'a> {
    instance: &'a Instance,
    source: &'a ModelSource,
    parts: &'a Overrides,
    /// The name of the first shape of every mesh: its others share the path.
    first: HashMap<*const TriangleMesh, &'a str>,
}

impl<'a> Making<'a> {
    pub(super) fn new(instance: &'a Instance, source: &'a ModelSource, parts: &'a Overrides) -> Self {
        let mut first = HashMap::new();
        for node in walk(&source.model) {
            if let Some(mesh) = mesh_of(node) {
                first.entry(Arc::as_ptr(mesh)).or_insert(node.name.as_str());
            }
        }
        Self { instance, source, parts, first }
    }

    pub(super) fn nodes(&self, nodes: &[Node]) -> Result<Vec<Node>, InvalidPart> {
        let kept = |node: &&Node| !self.parts.get(&node.name).is_some_and(|part| part.removed);
        nodes.iter().filter(kept).map(|node| self.node(node)).collect()
    }

    fn node(&self, node: &Node) -> Result<Node, InvalidPart> {
        let part = self.parts.get(&node.name);
        let content = match &node.content {
            Content::Shape(shape, worn) => {
                let own = self.instance.material(*worn);
                Content::Shape(self.shape(node, shape)?, part.and_then(|p| p.material).unwrap_or(own))
            }
            Content::Group(members) => Content::Group(self.nodes(members)?),
            Content::Solid(operation, members) => Content::Solid(*operation, self.nodes(members)?),
            other => other.clone(),
        };
        let placement = part.and_then(|part| part.placement).unwrap_or(node.placement);
        let flags = part.map(|part| part.flags).unwrap_or_default();
        Ok(Node::new(full_name(&self.instance.name, &node.name), content).placed(placement).flagged(flags))
    }

    /// The shape with the path by which scene text names its mesh.
    fn shape(&self, node: &Node, shape: &Shape) -> Result<Shape, InvalidPart> {
        let Some(mesh) = mesh_of(node) else { return Ok(shape.clone()) };
        let name = self.first.get(&Arc::as_ptr(mesh)).copied().unwrap_or(&node.name);
        let path = format!("{}#{name}", self.source.path);
        shape.with("file", Value::Mesh(MeshSource { path, mesh: Arc::clone(mesh) }))
    }
}
