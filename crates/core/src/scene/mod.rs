//! Where do the parts of a scene live, how are they found, and how are they changed?
//!
//! A [`Scene`] is a [`hecs::World`] behind stable ids. An entity is a [`Shape`], a [`Light`] or a [`Camera`] with
//! a [`Placement`], or a group whose members move with it. Materials are shared by [`MaterialId`], textures by [`TextureId`]. Every change is an
//! [`Edit`] that goes through [`Scene::apply`], which checks it, answers with its inverse, and writes into the edit log
//! what was changed; [`History`] makes undo and redo of it.

mod add;
mod apply;
mod check;
mod component;
mod copy;
mod edit;
mod error;
#[cfg(test)]
mod fixture;
mod history;
mod ids;
mod integrator;
mod library;
mod moving;
mod node;
mod painting;
mod query;
mod settings;
mod solids;
mod tree;

use std::collections::{BTreeMap, HashMap};
use std::sync::atomic::{AtomicU64, Ordering};

pub use component::{Flags, Role};
pub use edit::{Change, ChangeKind, Edit, Subject};
pub use error::SceneError;
pub use history::History;
pub use ids::{EntityId, MaterialId, TextureId};
pub use integrator::Integrator;
pub use node::{Content, Node, Subtree};
pub use query::Placed;
pub use settings::Settings;
pub use solids::PlacedSolid;

use crate::{Camera, Light, Material, Operation, Placement, Shape, Texture};
use component::Name;
use ids::Counter;
use library::Library;
use painting::Worn;

/// Shapes, lights, cameras, groups, materials, textures and settings, and a log of how they were changed.
///
/// ```
/// use catoptra_core::{Edit, Rgb, Scene, geometry::Sphere, glam::DVec3, light::PointLight, material::Matte};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut scene = Scene::new();
/// let clay = scene.add_material("clay", Matte::new(Rgb::new(0.8, 0.5, 0.3))?)?;
/// let ball = scene.add_shape("ball", Sphere::new(DVec3::ZERO, 1.0)?, clay, None)?;
/// scene.add_light("lamp", PointLight::new(DVec3::Y * 3.0, Rgb::grey(50.0))?, None)?;
/// assert_eq!(scene.entity_named("ball"), Some(ball));
///
/// // Every change is an edit, and answers with the edit that takes it back.
/// let back = scene.apply(Edit::Remove(ball))?;
/// assert!(!scene.contains(ball));
/// scene.apply(back)?;
/// assert!(scene.contains(ball));
/// # Ok(())
/// # }
/// ```
pub struct Scene {
    world: hecs::World,
    entities: BTreeMap<EntityId, hecs::Entity>,
    by_name: HashMap<String, EntityId>,
    /// What lies in no group, in order.
    roots: Vec<EntityId>,
    ids: Counter,
    textures: Library<TextureId, Texture>,
    materials: Library<MaterialId, Worn>,
    settings: Settings,
    log: Vec<Change>,
    revision: u64,
}

impl Scene {
    /// How many groups an entity can lie inside of, one in the other.
    pub const MAX_DEPTH: usize = 64;

    /// An empty scene with the default settings.
    #[must_use]
    pub fn new() -> Self {
        Self {
            world: hecs::World::new(),
            entities: BTreeMap::new(),
            by_name: HashMap::new(),
            roots: Vec::new(),
            ids: Counter::START,
            textures: Library::new(),
            materials: Library::new(),
            settings: Settings::default(),
            log: Vec::new(),
            revision: 0,
        }
    }

    /// Under what handle the store keeps an entity. It changes when a removal is undone.
    fn entity(&self, id: EntityId) -> Option<hecs::Entity> {
        self.entities.get(&id).copied()
    }

    /// Whether there is such an entity.
    #[must_use]
    pub fn contains(&self, id: EntityId) -> bool {
        self.entities.contains_key(&id)
    }

    /// All entities, oldest first.
    pub fn entities(&self) -> impl ExactSizeIterator<Item = EntityId> + '_ {
        self.entities.keys().copied()
    }

    /// The entities of one role, oldest first.
    pub fn entities_of(&self, role: Role) -> impl Iterator<Item = EntityId> + '_ {
        self.entities().filter(move |&id| self.role(id) == Some(role))
    }

    /// What an entity is.
    #[must_use]
    pub fn role(&self, id: EntityId) -> Option<Role> {
        let entity = self.world.entity(self.entity(id)?).ok()?;
        Some(match () {
            () if entity.has::<Shape>() => Role::Shape,
            () if entity.has::<Light>() => Role::Light,
            () if entity.has::<Camera>() => Role::Camera,
            () => Role::Group,
        })
    }

    /// The name of an entity.
    #[must_use]
    pub fn name(&self, id: EntityId) -> Option<String> {
        self.component::<Name>(id).map(|name| name.0)
    }

    /// The entity of that name.
    #[must_use]
    pub fn entity_named(&self, name: &str) -> Option<EntityId> {
        self.by_name.get(name).copied()
    }

    /// The shape of a shape entity, in its own space.
    #[must_use]
    pub fn shape(&self, id: EntityId) -> Option<Shape> {
        self.component(id)
    }

    /// The material of a shape entity.
    #[must_use]
    pub fn material_of(&self, id: EntityId) -> Option<MaterialId> {
        self.component(id)
    }

    /// How the members of a solid are combined; `None` for every other entity.
    #[must_use]
    pub fn operation(&self, id: EntityId) -> Option<Operation> {
        self.component(id)
    }

    /// The light of a light entity, in its own space.
    #[must_use]
    pub fn light(&self, id: EntityId) -> Option<Light> {
        self.component(id)
    }

    /// The camera of a camera entity, in its own space.
    #[must_use]
    pub fn camera(&self, id: EntityId) -> Option<Camera> {
        self.component(id)
    }

    /// The placement of an entity relative to its group or, outside any group, to the world.
    #[must_use]
    pub fn placement(&self, id: EntityId) -> Option<Placement> {
        self.component(id)
    }

    /// What has been set aside about an entity itself; see [`Self::is_hidden`] for the groups round it.
    #[must_use]
    pub fn flags(&self, id: EntityId) -> Flags {
        self.component(id).unwrap_or_default()
    }

    /// Whether an entity, or a group that it lies in, is hidden.
    #[must_use]
    pub fn is_hidden(&self, id: EntityId) -> bool {
        std::iter::once(id).chain(self.ancestors(id)).any(|id| self.flags(id).hidden)
    }

    /// Whether an entity, or a group that it lies in, is locked.
    #[must_use]
    pub fn is_locked(&self, id: EntityId) -> bool {
        std::iter::once(id).chain(self.ancestors(id)).any(|id| self.flags(id).locked)
    }

    /// A copy of one component, `None` without the entity or the component.
    fn component<T: hecs::Component + Clone>(&self, id: EntityId) -> Option<T> {
        self.world.get::<&T>(self.entity(id)?).ok().map(|component| T::clone(&component))
    }

    /// A material.
    ///
    /// # Panics
    /// If it has been removed, or is of another scene; what [`Self::material_of`] gives never is. See
    /// [`Self::find_material`] for ids that were kept.
    #[must_use]
    pub fn material(&self, id: MaterialId) -> &Material {
        self.find_material(id).unwrap_or_else(|| panic!("there is no {id} in this scene"))
    }

    /// A material, `None` once it has been removed.
    #[must_use]
    pub fn find_material(&self, id: MaterialId) -> Option<&Material> {
        self.materials.get(id).map(|(_, worn)| &worn.material)
    }

    /// The name of a material.
    ///
    /// # Panics
    /// As for [`Self::material`].
    #[must_use]
    pub fn material_name(&self, id: MaterialId) -> &str {
        self.materials.get(id).unwrap_or_else(|| panic!("there is no {id} in this scene")).0
    }

    /// The material of that name.
    #[must_use]
    pub fn material_named(&self, name: &str) -> Option<MaterialId> {
        self.materials.named(name)
    }

    /// All materials with their names, oldest first.
    pub fn materials(&self) -> impl Iterator<Item = (MaterialId, &str, &Material)> {
        self.materials.iter().map(|(id, name, worn)| (id, name, &worn.material))
    }

    /// The shapes that wear a material, oldest first.
    #[must_use]
    pub fn wearers(&self, id: MaterialId) -> Vec<EntityId> {
        let mut query = self.world.query::<(&EntityId, &MaterialId)>();
        let mut wearers: Vec<EntityId> =
            query.iter().filter(|(_, material)| **material == id).map(|(&entity, _)| entity).collect();
        wearers.sort_unstable();
        wearers
    }

    /// What holds for the scene as a whole.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The number of the scene's last edit; 0 before the first. Later edits have larger numbers, and no two edits of
    /// a process have the same, so that scenes of equal revision are equal: one scene at two times, a scene and its
    /// clone, or two that are empty.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// What was changed after the scene had that revision, in order; an undone edit counts as two.
    /// Searches by halves, and copies nothing.
    #[must_use]
    pub fn changes_since(&self, revision: u64) -> &[Change] {
        &self.log[self.log.partition_point(|change| change.revision <= revision)..]
    }

    /// Forgets the log up to and with that revision, which no caller will ask about again: a log grows by one
    /// line of 24 bytes with each changed part.
    pub fn forget_changes(&mut self, revision: u64) {
        self.log.drain(..self.log.partition_point(|change| change.revision <= revision));
    }

    /// The id that the next new entity gets. A batch uses it to name what it inserts.
    #[must_use]
    pub fn next_entity_id(&self) -> EntityId {
        self.ids.peek_entity()
    }

    /// The id that the next new material gets. A batch uses it to name what it adds.
    #[must_use]
    pub fn next_material_id(&self) -> MaterialId {
        self.materials.ids.peek_material()
    }
}

/// A revision that no scene of this process has had yet.
fn new_revision() -> u64 {
    static LAST: AtomicU64 = AtomicU64::new(0);
    LAST.fetch_add(1, Ordering::Relaxed) + 1
}

impl Default for Scene {
    fn default() -> Self {
        Self::new()
    }
}
