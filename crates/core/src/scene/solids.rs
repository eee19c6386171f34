//! Which solids does a scene have, and of which shapes are they made?

use super::component::Touched;
use super::{EntityId, Scene};
use crate::solid::Rule;
use crate::{Placement, Shape, Solid};

/// A solid of a scene where it stands in the world.
#[derive(Debug, Clone)]
pub struct PlacedSolid {
    /// In world space.
    pub solid: Solid,
    /// Which entities its shapes are, by their numbers.
    pub members: Vec<EntityId>,
    /// The revision of the last edit that may have changed it.
    pub touched: u64,
}

impl Scene {
    /// All solids that are no parts of others and not hidden, where they stand in the world.
    #[must_use]
    pub fn world_solids(&self) -> Vec<PlacedSolid> {
        let is_outer = |&id: &EntityId| {
            self.operation(id).is_some()
                && !self.is_hidden(id)
                && self.parent(id).is_none_or(|parent| self.operation(parent).is_none())
        };
        self.walk().into_iter().filter(is_outer).filter_map(|id| self.world_solid(id)).collect()
    }

    fn world_solid(&self, id: EntityId) -> Option<PlacedSolid> {
        let around: Vec<EntityId> = self.ancestors(id).collect();
        let outer = around.iter().filter_map(|&group| self.placement(group));
        let at = outer.fold(Placement::IDENTITY, |at, outer| at.then(&outer));
        let mut parts = Parts { scene: self, shapes: Vec::new(), members: Vec::new(), touched: 0 };
        let rule = parts.rule(id, &at)?;
        let touched = around.into_iter().filter_map(|id| self.component::<Touched>(id)).map(|t| t.0);
        let touched = touched.fold(parts.touched, u64::max);
        Some(PlacedSolid { solid: Solid::new(parts.shapes, rule)?, members: parts.members, touched })
    }
}

/// What has been found of a solid.
struct Parts<'a> {
    scene: &'a Scene,
    shapes: Vec<Shape>,
    members: Vec<EntityId>,
    touched: u64,
}

impl Parts<'_> {
    /// The rule of an entity and all that lies in it; `at` is where what holds it stands.
    fn rule(&mut self, id: EntityId, at: &Placement) -> Option<Rule> {
        let at = self.scene.placement(id)?.then(at);
        self.touched = self.touched.max(self.scene.component::<Touched>(id)?.0);
        if let Some(operation) = self.scene.operation(id) {
            let members = self.scene.children(Some(id));
            let mut rules = Vec::new();
            for member in members {
                if self.scene.flags(member).hidden {
                    self.touched = self.touched.max(self.scene.component::<Touched>(member)?.0);
                } else {
                    rules.push(self.rule(member, &at)?);
                }
            }
            return Some(Rule::Combined(operation, rules));
        }
        self.shapes.push(self.scene.shape(id)?.placed(&at));
        self.members.push(id);
        Some(Rule::Shape(self.shapes.len() as u32 - 1))
    }
}
