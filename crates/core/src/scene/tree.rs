//! Who is a member of which group, in what order, and where does that put things in the world?

use super::component::{Members, Parent};
use super::{EntityId, Scene};
use crate::{Aabb, Camera, Light, Placement, Shape};

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
        self.component::<Parent>(id).map(|parent| parent.0)
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
        self.cameras().into_iter().map(|(id, _)| id).min_by_key(|&id| self.position(id))
    }

    /// The places of an entity and of the groups round it among their siblings, from the outer to the inner: the
    /// order of the tree.
    fn position(&self, id: EntityId) -> Vec<usize> {
        let mut places: Vec<usize> =
            std::iter::once(id).chain(self.ancestors(id)).map(|id| self.index_of(id)).collect();
        places.reverse();
        places
    }

    /// The placement of an entity in the world: its own, then those of the groups round it.
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

    /// The camera of a camera entity, in world space. `None` also where its groups take it further away than
    /// numbers reach.
    #[must_use]
    pub fn world_camera(&self, id: EntityId) -> Option<Camera> {
        self.camera(id)?.placed(&self.world_placement(id)?).ok()
    }

    /// The box, in world space, round a shape, round a light's surface, or round all of these in a group. `None` for what
    /// has no ends, such as a plane, and for what has no surface at all.
    #[must_use]
    pub fn world_bounds(&self, id: EntityId) -> Option<Aabb> {
        if let Some(shape) = self.world_shape(id) {
            return shape.bounds();
        }
        if let Some(light) = self.world_light(id) {
            return light.lamp()?.shape.bounds();
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

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::fixture::{Room, camera, matte, moved, sphere};
    use super::super::{Edit, Node, Subtree};
    use crate::{Light, Placement, Rgb, Value, Values};

    #[test]
    fn a_walk_meets_groups_before_members_and_siblings_in_order() {
        let r = Room::new();
        assert_eq!(r.scene.walk(), [r.floor, r.things, r.ball, r.lamps, r.lamp, r.eye]);
    }

    #[test]
    fn own_placement_comes_before_those_of_the_groups() {
        let mut r = Room::new();
        let quarter = std::f64::consts::FRAC_PI_2;
        let turned = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::Y, quarter).unwrap();
        r.scene.apply(Edit::Placement(r.things, turned)).unwrap();
        r.scene.apply(Edit::Placement(r.ball, moved(1.0, 2.0, 0.0))).unwrap();
        let at = r.scene.world_placement(r.ball).unwrap().point(DVec3::ZERO);
        assert!(at.distance(DVec3::new(0.0, 2.0, -1.0)) < 1e-15, "{at}");
    }

    #[test]
    fn placements_of_nested_groups_add_up() {
        let mut r = Room::new();
        for id in [r.things, r.lamps, r.lamp] {
            r.scene.apply(Edit::Placement(id, moved(1.0, 0.0, 0.0))).unwrap();
        }
        let at = r.scene.world_placement(r.lamp).unwrap().translation();
        assert_eq!(at, DVec3::new(3.0, 0.0, 0.0));
        assert_eq!(r.scene.world_light(r.lamp).unwrap().position(), Some(at));
    }

    #[test]
    fn bounds_of_a_group_hold_its_bounded_members_where_they_stand() {
        let mut r = Room::new();
        r.scene.apply(Edit::Parent(r.floor, Some(r.things))).unwrap();
        r.scene.add_shape("pearl", sphere(0.5), r.white, Some(r.lamps)).unwrap();
        r.scene.apply(Edit::Placement(r.lamps, moved(10.0, 0.0, 0.0))).unwrap();
        let bounds = r.scene.world_bounds(r.things).unwrap();
        assert!((bounds.min - DVec3::NEG_ONE).abs().max_element() < 1e-12, "{bounds:?}");
        assert!((bounds.max - DVec3::new(10.5, 1.0, 1.0)).abs().max_element() < 1e-12, "{bounds:?}");
    }

    #[test]
    fn what_has_no_ends_or_no_shape_has_no_bounds() {
        let r = Room::new();
        for id in [r.floor, r.lamp, r.lamps, r.eye] {
            assert_eq!(r.scene.world_bounds(id), None, "{id}");
        }
    }

    #[test]
    fn a_light_that_is_a_surface_has_its_bounds() {
        let mut r = Room::new();
        let values = Values::new().with("radius", Value::Number(0.5));
        let values = values.with("radiance", Value::Color(Rgb::WHITE));
        let lamp = (Light::kind_named("sphere-light").unwrap().make)(&values).unwrap();
        r.scene.apply(Edit::Light(r.lamp, lamp)).unwrap();
        r.scene.apply(Edit::Placement(r.lamps, moved(10.0, 0.0, 0.0))).unwrap();
        for id in [r.lamp, r.lamps] {
            let bounds = r.scene.world_bounds(id).unwrap();
            assert_eq!((bounds.centre(), bounds.size()), (DVec3::X * 10.0, DVec3::ONE));
        }
    }

    #[test]
    fn the_main_camera_is_the_first_in_the_tree_and_not_the_oldest() {
        let mut r = Room::new();
        assert_eq!(r.scene.main_camera(), Some(r.eye));
        let side = Subtree::new(Node::camera("side", camera(0.5))).at(0);
        r.scene.apply(Edit::insert(side)).unwrap();
        assert_eq!(r.scene.main_camera(), r.scene.entity_named("side"));
    }

    #[test]
    fn an_unknown_entity_has_nothing() {
        let mut r = Room::new();
        r.scene.apply(Edit::Remove(r.things)).unwrap();
        assert!(r.scene.role(r.ball).is_none() && r.scene.name(r.ball).is_none());
        assert!(r.scene.world_placement(r.ball).is_none() && r.scene.world_bounds(r.ball).is_none());
        assert!(r.scene.parent(r.ball).is_none() && r.scene.children(Some(r.things)).is_empty());
    }

    #[test]
    fn wearers_are_listed_by_age() {
        let mut r = Room::new();
        assert_eq!(r.scene.wearers(r.white), [r.floor, r.ball]);
        let red = r.scene.add_material("red", matte(0.2)).unwrap();
        assert!(r.scene.wearers(red).is_empty());
    }
}
