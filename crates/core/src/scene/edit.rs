//! What can be changed in a scene, and how is a change written down?

use super::{EntityId, Flags, MaterialId, Settings, Subtree, TextureId};
use crate::{Camera, Finish, Light, Material, Operation, Placement, Shape, Texture};

/// One change to a [`Scene`](super::Scene). [`Scene::apply`](super::Scene::apply) does it and answers with the
/// edit that takes it back.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Edit {
    /// Puts an entity with its members into the scene. Its inverse is `Remove` with the new entity's id.
    Insert(Box<Subtree>),
    /// Takes an entity with its members out of the scene. Undone, they come back under their old ids.
    Remove(EntityId),
    /// Gives a shape entity another shape.
    Shape(EntityId, Shape),
    /// Combines the members of a solid in another way.
    Operation(EntityId, Operation),
    /// Gives a light entity another light.
    Light(EntityId, Light),
    /// Gives a camera entity another camera.
    Camera(EntityId, Camera),
    /// Places an entity anew, relative to its group.
    Placement(EntityId, Placement),
    /// Hides an entity or locks it, or takes that back.
    Flags(EntityId, Flags),
    /// Gives a shape entity another of the scene's materials.
    MaterialOf(EntityId, MaterialId),
    /// Makes an entity the last member of a group, or the last at the top of the scene. Its own placement stays,
    /// so that it moves in the world if the groups are placed differently.
    Parent(EntityId, Option<EntityId>),
    /// Moves an entity to a place among its siblings, from 0; a number past the end is the last place.
    Order(EntityId, usize),
    /// Renames an entity.
    Name(EntityId, String),
    /// Changes a material, on every shape that has it.
    Material(MaterialId, Material),
    /// Adds a material, with no special finish. Its inverse is `RemoveMaterial` with the new material's id.
    AddMaterial {
        /// The name, unique among the scene's materials.
        name: String,
        /// The material.
        material: Material,
        /// The id to have; `None` for a new one. This is how an undone removal keeps its id.
        id: Option<MaterialId>,
    },
    /// Removes a material that no shape has.
    RemoveMaterial(MaterialId),
    /// Renames a material.
    RenameMaterial(MaterialId, String),
    /// Changes what shapes of a material have beside its lobes.
    Finish(MaterialId, Finish),
    /// Changes a texture, in every material that is painted with it.
    Texture(TextureId, Texture),
    /// Adds a texture. Its inverse is `RemoveTexture` with the new texture's id.
    AddTexture {
        /// The name, unique among the scene's textures.
        name: String,
        /// The texture.
        texture: Texture,
        /// The id to have; `None` for a new one. This is how an undone removal keeps its id.
        id: Option<TextureId>,
    },
    /// Removes a texture that no material is painted with.
    RemoveTexture(TextureId),
    /// Renames a texture.
    RenameTexture(TextureId, String),
    /// Changes the settings.
    Settings(Settings),
    /// All of these, one after the other, as one edit: if one is refused, none is done.
    Batch(Vec<Edit>),
}

impl Edit {
    /// The edit that inserts `subtree`, or a [`Node`](super::Node) at the end of the scene's top.
    #[must_use]
    pub fn insert(subtree: impl Into<Subtree>) -> Self {
        Self::Insert(Box::new(subtree.into()))
    }
}

/// One line of the edit log: what was changed, and what about it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Change {
    /// The scene's revision after the edit that did it; all changes of one edit share it.
    pub revision: u64,
    /// What was changed.
    pub subject: Subject,
    /// What about it was changed.
    pub what: ChangeKind,
}

/// What a [`Change`] is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Subject {
    /// A shape, light, camera or group. When a group is placed anew only the group is named: its members keep
    /// their own placements, yet stand elsewhere in the world.
    Entity(EntityId),
    /// A material; the shapes that wear it are not named.
    Material(MaterialId),
    /// A texture; the materials that are painted with it are not named.
    Texture(TextureId),
    /// The settings of the scene.
    Settings,
}

/// What about something was changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum ChangeKind {
    /// It is new, or has come back. Members that came with their group have lines of their own.
    Added,
    /// It is gone. Members that went with their group have lines of their own.
    Removed,
    /// The shape of a shape entity.
    Shape,
    /// How the members of a solid are combined.
    Operation,
    /// The light of a light entity.
    Light,
    /// The camera of a camera entity.
    Camera,
    /// The placement of an entity within its group.
    Placement,
    /// Whether an entity is hidden or locked.
    Flags,
    /// Which material a shape has.
    Material,
    /// Which group an entity is a member of, and its place among its siblings.
    Parent,
    /// The place of an entity among its siblings.
    Order,
    /// The name of an entity, of a material or of a texture.
    Name,
    /// The values of a material, of a texture or of the settings.
    Value,
    /// The finish of a material.
    Finish,
}
