//! What is inserted into a scene, and what a removal gives back: an entity with all its members.

use super::{EntityId, Flags, MaterialId, Role};
use crate::{Camera, Light, Operation, Placement, Shape};

/// One entity with its members, outside any scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// The id to have in the scene; `None` for a new one. This is how an undone removal keeps its ids.
    pub id: Option<EntityId>,
    /// The name, unique among all entities of the scene.
    pub name: String,
    /// Its placement relative to its group or, outside any group, to the world.
    pub placement: Placement,
    /// Whether it is hidden or locked.
    pub flags: Flags,
    /// What it is.
    pub content: Content,
}

/// What an entity is.
#[derive(Debug, Clone, PartialEq)]
pub enum Content {
    /// A visible shape, with its material.
    Shape(Shape, MaterialId),
    /// Something that gives light.
    Light(Light),
    /// Something to look through.
    Camera(Camera),
    /// Other entities, in order, that move with it.
    Group(Vec<Node>),
    /// A solid made of members: shapes that [enclose something](Shape::is_solid) and other such solids. They move with it.
    Solid(Operation, Vec<Node>),
}

/// A [`Node`] and the place in the tree of groups where it goes.
#[derive(Debug, Clone, PartialEq)]
pub struct Subtree {
    /// The entity and its members.
    pub node: Node,
    /// The group it becomes a member of; `None` for the top of the scene.
    pub parent: Option<EntityId>,
    /// Its place among its siblings, from 0; `None`, or a number past the end, for the last.
    pub index: Option<usize>,
}

impl Node {
    /// An unmoved entity with a new id.
    #[must_use]
    pub fn new(name: impl Into<String>, content: Content) -> Self {
        Self { id: None, name: name.into(), placement: Placement::IDENTITY, flags: Flags::default(), content }
    }

    /// A shape of `material`.
    #[must_use]
    pub fn shape(name: impl Into<String>, shape: impl Into<Shape>, material: MaterialId) -> Self {
        Self::new(name, Content::Shape(shape.into(), material))
    }

    /// A light.
    #[must_use]
    pub fn light(name: impl Into<String>, light: impl Into<Light>) -> Self {
        Self::new(name, Content::Light(light.into()))
    }

    /// A camera.
    #[must_use]
    pub fn camera(name: impl Into<String>, camera: Camera) -> Self {
        Self::new(name, Content::Camera(camera))
    }

    /// A group of `members`.
    #[must_use]
    pub fn group(name: impl Into<String>, members: Vec<Self>) -> Self {
        Self::new(name, Content::Group(members))
    }

    /// A solid made of `members`.
    #[must_use]
    pub fn solid(name: impl Into<String>, operation: Operation, members: Vec<Self>) -> Self {
        Self::new(name, Content::Solid(operation, members))
    }

    /// The same at another place.
    #[must_use]
    pub fn placed(self, placement: Placement) -> Self {
        Self { placement, ..self }
    }

    /// The same, hidden or locked as said.
    #[must_use]
    pub fn flagged(self, flags: Flags) -> Self {
        Self { flags, ..self }
    }

    /// The same under an id of the caller's choice, which the scene must not be using.
    #[must_use]
    pub fn with_id(self, id: EntityId) -> Self {
        Self { id: Some(id), ..self }
    }

    /// What kind of entity this is.
    #[must_use]
    pub fn role(&self) -> Role {
        match self.content {
            Content::Shape(..) => Role::Shape,
            Content::Light(_) => Role::Light,
            Content::Camera(_) => Role::Camera,
            Content::Group(_) | Content::Solid(..) => Role::Group,
        }
    }

    /// The members of a group or a solid in order; empty for everything else.
    #[must_use]
    pub fn members(&self) -> &[Self] {
        match &self.content {
            Content::Group(members) | Content::Solid(_, members) => members,
            Content::Shape(..) | Content::Light(_) | Content::Camera(_) => &[],
        }
    }

    /// This node, then its members and theirs, each with the number of groups of this subtree that hold it.
    pub(super) fn walk(&self) -> impl Iterator<Item = (&Self, usize)> {
        let mut rest = vec![(self, 0)];
        std::iter::from_fn(move || {
            let (node, depth) = rest.pop()?;
            rest.extend(node.members().iter().rev().map(|member| (member, depth + 1)));
            Some((node, depth))
        })
    }

    /// Changes this node, then its members and theirs.
    pub fn each_mut(&mut self, change: &mut impl FnMut(&mut Self)) {
        change(self);
        if let Content::Group(members) | Content::Solid(_, members) = &mut self.content {
            for member in members {
                member.each_mut(change);
            }
        }
    }
}

impl Subtree {
    /// `node` as the last at the top of the scene.
    #[must_use]
    pub fn new(node: Node) -> Self {
        Self { node, parent: None, index: None }
    }

    /// The same as the last member of a group.
    #[must_use]
    pub fn under(self, group: EntityId) -> Self {
        Self { parent: Some(group), ..self }
    }

    /// The same at a place among its siblings, from 0.
    #[must_use]
    pub fn at(self, index: usize) -> Self {
        Self { index: Some(index), ..self }
    }
}

impl From<Node> for Subtree {
    fn from(node: Node) -> Self {
        Self::new(node)
    }
}
