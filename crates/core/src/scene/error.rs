//! Why is an edit of a scene refused?

use super::{EntityId, MaterialId, Role, Scene, TextureId};
use crate::InvalidPart;

/// Why a [`Scene`] refused an edit; the scene is then exactly as it was before.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// No such entity, or it has been removed.
    #[error("there is no {0} in this scene")]
    UnknownEntity(EntityId),
    /// No such material, or it has been removed.
    #[error("there is no {0} in this scene")]
    UnknownMaterial(MaterialId),
    /// No such texture, or it has been removed.
    #[error("there is no {0} in this scene")]
    UnknownTexture(TextureId),
    /// A name without any letter.
    #[error("a name must not be empty")]
    EmptyName,
    /// Shapes, lights, cameras and groups share one list of names.
    #[error("the name \"{0}\" is taken by another shape, light, camera or group")]
    NameTaken(String),
    /// Two materials may not have one name.
    #[error("the name \"{0}\" is taken by another material")]
    MaterialNameTaken(String),
    /// Two textures may not have one name.
    #[error("the name \"{0}\" is taken by another texture")]
    TextureNameTaken(String),
    /// An inserted entity names an id that is in use.
    #[error("{0} is in the scene already")]
    IdTaken(EntityId),
    /// An added material names an id that is in use.
    #[error("{0} is in the scene already")]
    MaterialIdTaken(MaterialId),
    /// An added texture names an id that is in use.
    #[error("{0} is in the scene already")]
    TextureIdTaken(TextureId),
    /// Every number that an id can have has been used.
    #[error("the scene has no numbers left for new parts")]
    IdsExhausted,
    /// The entity has no part of this kind to change.
    #[error("\"{name}\" is a {is}, not a {needs}")]
    WrongRole {
        /// The entity that was to be changed.
        name: String,
        /// What it is.
        is: Role,
        /// What it would have to be.
        needs: Role,
    },
    /// Only groups have members.
    #[error("\"{name}\" is a {is} and cannot have members; only a group can")]
    NotAGroup {
        /// The entity that was to become a parent.
        name: String,
        /// What it is.
        is: Role,
    },
    /// Solids are made of planes, of closed shapes, and of other solids.
    #[error(
        "\"{name}\" cannot be a part of the solid \"{solid}\": only planes, closed shapes and other solids can"
    )]
    NotSolid {
        /// What was to become a part, or to have another shape.
        name: String,
        /// The solid.
        solid: String,
    },
    /// A mesh with holes encloses nothing.
    #[error("\"{name}\" cannot be a part of the solid \"{solid}\": its mesh is not closed, {edge}")]
    OpenMesh {
        /// What was to become a part, or to have another shape.
        name: String,
        /// The solid.
        solid: String,
        /// Where its mesh is open.
        edge: String,
    },
    /// A group may not be a member of itself, nor of a group inside it.
    #[error("\"{group}\" cannot become a member of \"{into}\", which is {}", if group == into {"itself"} else {"inside it"})]
    Cycle {
        /// The group that was to be moved.
        group: String,
        /// Where to.
        into: String,
    },
    /// Groups inside groups inside groups, further than a scene allows.
    #[error("\"{0}\" would lie inside more than {max} groups", max = Scene::MAX_DEPTH)]
    TooDeep(String),
    /// A place that nothing can be put at.
    #[error(transparent)]
    Placement(#[from] InvalidPart),
    /// A material that shapes still wear cannot be removed.
    #[error("the material \"{material}\" is in use by \"{shape}\"{}", and_others(*.others, "shape"))]
    MaterialInUse {
        /// The material that was to be removed.
        material: String,
        /// The oldest shape that has it.
        shape: String,
        /// How many other shapes have it.
        others: usize,
    },
    /// A texture that materials are painted with cannot be removed.
    #[error("the texture \"{texture}\" is in use by \"{material}\"{}", and_others(*.others, "material"))]
    TextureInUse {
        /// The texture that was to be removed.
        texture: String,
        /// The oldest material that is painted with it.
        material: String,
        /// How many other materials are.
        others: usize,
    },
}

impl SceneError {
    /// What to do about it; `None` where that is plain.
    #[must_use]
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::NotSolid { .. } => Some(
                "take a shape that encloses something, as a box or a cylinder with caps, or put it beside the solid",
            ),
            Self::OpenMesh { .. } => Some(
                "where the mesh was made, fill its holes and turn all its faces outwards, or put it beside the solid",
            ),
            _ => None,
        }
    }
}

fn and_others(count: usize, what: &str) -> String {
    match count {
        0 => String::new(),
        1 => format!(" and 1 other {what}"),
        _ => format!(" and {count} other {what}s"),
    }
}
