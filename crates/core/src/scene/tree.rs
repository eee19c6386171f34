//! Who is a member of which group, in what order, and where does that put things in the world?

use super::{EntityId, Members, Parent, Role, Scene};
use crate::{Aabb, Light, Placement, Shape};

impl Scene {
    /// The members of a group, or what lies at the top of the scene, in order. Empty for what is no group.
    #[must_use]
    pub fn children(&self, group: Option<EntityId>) -> Vec<EntityId> {
        match group {
            None => self.roots.clone(),
            Some(id) => self.component::<Members>(id).map(|members| members.0).unwrap_or_default(),
        }
    }

    /// The group that an entity is a member of; `None` at the top of the scene, or without such an entity.
    #[must_use]
    pub fn parent(&self, id: EntityId) -> Option<EntityId> {
        self.component::<Parent>(id).map(Parent::id)
    }

    /// The groups round an entity, from the inner to the outer.
    pub fn ancestors(&self, id: EntityId) -> impl Iterator<Item = EntityId> + '_ {
        std::iter::successors(self.parent(id), |&group| self.parent(group))
    }

    /// All entities in the order of the tree: each before its members, siblings in order.
    #[must_use]
    pub fn walk(&self) -> Vec<EntityId> {
        let mut order = Vec::with_capacity(self.entities.len());
        let mut rest: Vec<EntityId> = self.roots.iter().rev().copied().collect();
        while let Some(id) = rest.pop() {
            order.push(id);
            rest.extend(self.children(Some(id)).into_iter().rev());
        }
        order
    }

    /// The first camera in the order of the tree.
    #[must_use]
    pub fn main_camera(&self) -> Option<EntityId> {
        self.walk().into_iter().find(|&id| self.role(id) == Some(Role::Camera))
    }

    /// Where an entity stands in the world: its own placement, then those of the groups round it.
    #[must_use]
    pub fn world_placement(&self, id: EntityId) -> Option<Placement> {
        let own = self.placement(id)?;
        Some(
            self.ancestors(id)
                .filter_map(|group| self.placement(group))
                .fold(own, |at, outer| at.then(&outer)),
        )
    }

    /// The shape of a shape entity, in world space.
    #[must_use]
    pub fn world_shape(&self, id: EntityId) -> Option<Shape> {
        Some(self.shape(id)?.placed(&self.world_placement(id)?))
    }

    /// The light of a light entity, in world space.
    #[must_use]
    pub fn world_light(&self, id: EntityId) -> Option<Light> {
        Some(self.light(id)?.placed(&self.world_placement(id)?))
    }

    /// The box, in world space, round a shape or round all bounded shapes in a group. `None` for what has no
    /// ends, such as a plane, and for what has no shape at all.
    #[must_use]
    pub fn world_bounds(&self, id: EntityId) -> Option<Aabb> {
        if let Some(shape) = self.world_shape(id) {
            return shape.bounds();
        }
        self.children(Some(id)).into_iter().filter_map(|member| self.world_bounds(member)).reduce(Aabb::union)
    }

    /// Whether `id` is `group` or lies inside it, however deep.
    #[must_use]
    pub fn lies_in(&self, id: EntityId, group: EntityId) -> bool {
        id == group || self.ancestors(id).any(|outer| outer == group)
    }

    /// How many groups an entity of this parent lies inside of.
    pub(super) fn depth_under(&self, parent: Option<EntityId>) -> usize {
        parent.map_or(0, |group| 1 + self.ancestors(group).count())
    }

    /// How many levels of members are below an entity; 0 for a shape or an empty group.
    pub(super) fn height(&self, id: EntityId) -> usize {
        self.children(Some(id)).into_iter().map(|member| 1 + self.height(member)).max().unwrap_or(0)
    }

    /// The place of an entity among its siblings.
    pub(super) fn index_of(&self, id: EntityId) -> usize {
        self.children(self.parent(id)).iter().position(|&sibling| sibling == id).unwrap_or(0)
    }

    /// Takes `id` out of the list of its parent's members and gives back its place there.
    pub(super) fn unlist(&mut self, id: EntityId) -> usize {
        let index = self.index_of(id);
        let parent = self.parent(id);
        self.change_members(parent, |members| members.retain(|&member| member != id));
        index
    }

    /// Puts `id` into the list of a parent's members.
    pub(super) fn list(&mut self, id: EntityId, parent: Option<EntityId>, index: Option<usize>) {
        self.change_members(parent, |members| {
            let end = members.len();
            members.insert(index.unwrap_or(end).min(end), id);
        });
    }

    fn change_members(&mut self, parent: Option<EntityId>, change: impl FnOnce(&mut Vec<EntityId>)) {
        match parent.and_then(|group| self.entity(group)) {
            None => change(&mut self.roots),
            Some(group) => {
                if let Ok(mut members) = self.world.get::<&mut Members>(group) {
                    change(&mut members.0);
                }
            }
        }
    }
}
