//! What does a scene store of an entity, beside its id, its placement and the part that it is?

use super::EntityId;

/// What kind of entity something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// A visible [`Shape`](crate::Shape) with a material.
    Shape,
    /// Something that gives light: a [`Light`](crate::Light).
    Light,
    /// Something to look through: a [`Camera`](crate::Camera).
    Camera,
    /// Entities that move together.
    Group,
}

impl std::fmt::Display for Role {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Shape => "shape",
            Self::Light => "light",
            Self::Camera => "camera",
            Self::Group => "group",
        })
    }
}

/// Component of every entity: what a person has set aside for a while. All else of the entity stays as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub struct Flags {
    /// It takes no part in any picture, and nothing that lies in it does: no shape is seen, no light shines. In a solid it
    /// is as if it were not there.
    pub hidden: bool,
    /// It, and what lies in it, is not to be picked or moved by hand.
    pub locked: bool,
}

/// Component of every entity: its name, which no other entity of the scene has.
#[derive(Debug, Clone)]
pub(super) struct Name(pub(super) String);

/// Component of every entity: the revision of the last edit of what it is or of its placement in its group.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touched(pub(super) u64);

/// Component of every member of a group: which group. Entities at the top of the scene have none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parent(pub(super) EntityId);

/// Component of every group: its members, in order.
#[derive(Debug, Clone)]
pub(super) struct Members(pub(super) Vec<EntityId>);
