//! What a scene holds now for a node of the text.

use catoptra_core::Placement;
use catoptra_core::scene::{EntityId, Flags, Scene};

use crate::build::Id;
use crate::outline::Part;

/// Name, part, material, placement and flags of one node as the scene has them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct State {
    pub(crate) part: Part,
    /// Empty for settings, which have none.
    pub(crate) name: String,
    /// Name of the material that a shape wears.
    pub(crate) material: Option<String>,
    pub(crate) placement: Placement,
    pub(crate) flags: Flags,
}

impl State {
    /// What the scene holds; `None` if it is gone.
    pub(crate) fn of(scene: &Scene, id: Id) -> Option<Self> {
        match id {
            Id::Settings => Some(Self::unplaced(Part::Settings(*scene.settings()), String::new())),
            Id::Texture(id) => {
                let texture = scene.find_texture(id)?.clone();
                Some(Self::unplaced(Part::Texture(texture), scene.texture_name(id)?.to_owned()))
            }
            Id::Material(id) => {
                let material = scene.find_material(id)?.clone();
                Some(Self::unplaced(
                    Part::Material(Box::new(material), scene.finish(id)),
                    scene.material_name(id).to_owned(),
                ))
            }
            Id::Entity(id) => Self::of_entity(scene, id),
            Id::Part(..) | Id::Repeated(_) => None,
        }
    }

    fn unplaced(part: Part, name: String) -> Self {
        Self { part, name, material: None, placement: Placement::IDENTITY, flags: Flags::default() }
    }

    fn of_entity(scene: &Scene, id: EntityId) -> Option<Self> {
        let part = scene
            .shape(id)
            .map(Part::Shape)
            .or_else(|| scene.light(id).map(Part::Light))
            .or_else(|| scene.camera(id).map(Part::Camera))
            .or_else(|| scene.operation(id).map(Part::Solid))
            .unwrap_or(Part::Group);
        Some(Self {
            part,
            name: scene.name(id)?,
            material: scene.material_of(id).map(|material| scene.material_name(material).to_owned()),
            placement: scene.placement(id)?,
            flags: scene.flags(id),
        })
    }
}
