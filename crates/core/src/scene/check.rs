//! Which edits would leave a scene that does not hold together?

use std::collections::HashSet;

use super::{Content, EntityId, MaterialId, Node, Role, Scene, SceneError, Subtree};
use crate::Shape;

impl Scene {
    /// Whether all of a subtree can be inserted where it is to go.
    pub(super) fn check_insertion(&self, subtree: &Subtree) -> Result<(), SceneError> {
        if let Some(group) = subtree.parent {
            self.check_group(group)?;
            if self.operation(group).is_some() {
                check_solid(&subtree.node, || self.name_or_id(group))?;
            }
        }
        let above = self.depth_under(subtree.parent);
        let (mut names, mut ids) = (HashSet::new(), HashSet::new());
        let (mut fresh, mut counter) = (0, self.ids);
        for (node, depth) in subtree.node.walk() {
            self.check_node(node)?;
            if above + depth > Self::MAX_DEPTH {
                return Err(SceneError::TooDeep(node.name.clone()));
            }
            if !names.insert(node.name.as_str()) {
                return Err(SceneError::NameTaken(node.name.clone()));
            }
            match node.id {
                Some(id) if !ids.insert(id) => return Err(SceneError::IdTaken(id)),
                Some(id) => counter.skip_past(id.index()),
                None => fresh += 1,
            }
        }
        if counter.has(fresh) { Ok(()) } else { Err(SceneError::IdsExhausted) }
    }

    /// Whether one node fits what is in the scene already, its members and place aside.
    fn check_node(&self, node: &Node) -> Result<(), SceneError> {
        self.check_name(&node.name)?;
        if let Some(id) = node.id
            && self.contains(id)
        {
            return Err(SceneError::IdTaken(id));
        }
        match node.content {
            Content::Shape(_, material) => self.check_material(material),
            Content::Solid(_, ref members) => {
                members.iter().try_for_each(|member| check_solid(member, || node.name.clone()))
            }
            Content::Light(_) | Content::Camera(_) | Content::Group(_) => Ok(()),
        }
    }

    /// Whether an entity of the scene can become a member of `parent`.
    pub(super) fn check_membership(&self, id: EntityId, parent: Option<EntityId>) -> Result<(), SceneError> {
        let Some(group) = parent else { return Ok(()) };
        self.check_group(group)?;
        if self.operation(group).is_some()
            && let Some(node) = self.node(id)
        {
            check_solid(&node, || self.name_or_id(group))?;
        }
        if self.lies_in(group, id) {
            return Err(SceneError::Cycle { group: self.name_or_id(id), into: self.name_or_id(group) });
        }
        if self.depth_under(parent) + self.height(id) > Self::MAX_DEPTH {
            return Err(SceneError::TooDeep(self.name_or_id(id)));
        }
        Ok(())
    }

    /// Whether a name is one, and free.
    pub(super) fn check_name(&self, name: &str) -> Result<(), SceneError> {
        if name.trim().is_empty() {
            return Err(SceneError::EmptyName);
        }
        if self.by_name.contains_key(name) {
            return Err(SceneError::NameTaken(name.to_owned()));
        }
        Ok(())
    }

    /// Whether the scene has that material.
    pub(super) fn check_material(&self, id: MaterialId) -> Result<(), SceneError> {
        self.find_material(id).map(|_| ()).ok_or(SceneError::UnknownMaterial(id))
    }

    /// Whether an entity may have another shape: one that encloses nothing is no part of a solid.
    pub(super) fn check_part_of_solid(&self, id: EntityId, shape: &Shape) -> Result<(), SceneError> {
        match self.parent(id).filter(|&parent| self.operation(parent).is_some()) {
            Some(solid) => check_encloses(shape, || self.name_or_id(id), || self.name_or_id(solid)),
            None => Ok(()),
        }
    }

    fn check_group(&self, id: EntityId) -> Result<(), SceneError> {
        match self.role(id) {
            None => Err(SceneError::UnknownEntity(id)),
            Some(Role::Group) => Ok(()),
            Some(is) => Err(SceneError::NotAGroup { name: self.name_or_id(id), is }),
        }
    }

    /// What a message calls an entity.
    pub(super) fn name_or_id(&self, id: EntityId) -> String {
        self.name(id).unwrap_or_else(|| id.to_string())
    }
}

/// Whether a node can be a part of a solid.
fn check_solid(node: &Node, solid: impl Fn() -> String) -> Result<(), SceneError> {
    match &node.content {
        Content::Shape(shape, _) => check_encloses(shape, || node.name.clone(), solid),
        Content::Solid(..) => Ok(()),
        _ => Err(SceneError::NotSolid { name: node.name.clone(), solid: solid() }),
    }
}

/// Whether a shape encloses something, so that a solid can be made of it.
fn check_encloses(
    shape: &Shape,
    name: impl FnOnce() -> String,
    solid: impl FnOnce() -> String,
) -> Result<(), SceneError> {
    if shape.is_solid() {
        return Ok(());
    }
    let open = if let Shape::Mesh(mesh) = shape { mesh.triangles().open_edge() } else { None };
    Err(match open {
        Some(edge) => SceneError::OpenMesh { name: name(), solid: solid(), edge: edge.to_string() },
        None => SceneError::NotSolid { name: name(), solid: solid() },
    })
}
