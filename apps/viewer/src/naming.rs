//! Whose name is being typed, and what edit gives it to them?

use catoptra_core::scene::{Edit, EntityId, Scene, TextureId};

/// What has a name that can be typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Named {
    /// Something in the tree.
    Entity(EntityId),
    /// A texture.
    Texture(TextureId),
}

impl Named {
    /// Its name now, `None` once it is gone.
    pub(crate) fn name(self, scene: &Scene) -> Option<String> {
        match self {
            Self::Entity(id) => scene.name(id),
            Self::Texture(id) => scene.texture_name(id).map(str::to_owned),
        }
    }

    /// The edit that gives it another name; `None` where there is nothing to change.
    pub(crate) fn renamed(self, scene: &Scene, name: String) -> Option<Edit> {
        let is_other = self.name(scene).is_some_and(|now| now != name);
        is_other.then(|| match self {
            Self::Entity(id) => Edit::Name(id, name),
            Self::Texture(id) => Edit::RenameTexture(id, name),
        })
    }
}
