//! Which textures does a scene have, what is painted with them, and how does a material finish?

use super::{Change, ChangeKind, Edit, MaterialId, Scene, SceneError, Subject, TextureId};
use crate::texture::{Texture, TextureSource};
use crate::{Finish, Material, Part, Values};

/// Textures, and the finish of materials.
impl Scene {
    /// Adds a texture, for materials to be painted with:
    ///
    /// ```
    /// use catoptra_core::texture::{BrickTexture, Level, NoiseTexture, Paint};
    /// use catoptra_core::{Part, Rgb, Scene, glam::DVec2, material::Plastic};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut scene = Scene::new();
    /// let bricks = BrickTexture::new(Rgb::new(0.45, 0.12, 0.07), Rgb::grey(0.6), DVec2::new(0.24, 0.065))?;
    /// let bricks = scene.add_texture("bricks", bricks)?;
    /// let damp = scene.add_texture("damp", NoiseTexture::new(Rgb::grey(0.6), Rgb::grey(0.1), 3.0)?)?;
    /// let wall = Plastic::new(Rgb::WHITE)?.with("color", Paint::from(bricks))?.with("roughness", Level::from(damp))?;
    /// let wall = scene.add_material("wall", wall)?;
    /// assert_eq!(scene.painted_with(bricks), [wall]);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// A name that is empty or that another texture has.
    pub fn add_texture(&mut self, name: &str, texture: impl Into<Texture>) -> Result<TextureId, SceneError> {
        let id = self.next_texture_id();
        self.apply(Edit::AddTexture { name: name.to_owned(), texture: texture.into(), id: None })?;
        Ok(id)
    }

    /// A texture, `None` once it has been removed.
    #[must_use]
    pub fn find_texture(&self, id: TextureId) -> Option<&Texture> {
        self.textures.get(id).map(|(_, texture)| texture)
    }

    /// The name of a texture, `None` once it has been removed.
    #[must_use]
    pub fn texture_name(&self, id: TextureId) -> Option<&str> {
        self.textures.get(id).map(|(name, _)| name)
    }

    /// The texture of that name.
    #[must_use]
    pub fn texture_named(&self, name: &str) -> Option<TextureId> {
        self.textures.named(name)
    }

    /// All textures with their names, oldest first.
    pub fn textures(&self) -> impl Iterator<Item = (TextureId, &str, &Texture)> {
        self.textures.iter()
    }

    /// The id that the next new texture gets. A batch uses it to name what it adds.
    #[must_use]
    pub fn next_texture_id(&self) -> TextureId {
        self.textures.ids.peek_texture()
    }

    /// The materials that a texture is used in, oldest first.
    #[must_use]
    pub fn painted_with(&self, id: TextureId) -> Vec<MaterialId> {
        let uses = |values: &Values| values.textures().any(|texture| texture == id);
        let painted = |(_, _, worn): &(MaterialId, &str, &Worn)| {
            uses(&worn.material.values()) || uses(&worn.finish.values())
        };
        self.materials.iter().filter(painted).map(|(id, ..)| id).collect()
    }

    /// The materials, also gone ones, that may look different after a change: the one that was changed, or all that are painted
    /// with the texture that was. Over all [changes since](Self::changes_since) a revision none is missed: of a material that was
    /// painted with a texture only then, the log has a change of its own.
    #[must_use]
    pub fn materials_touched_by(&self, change: &Change) -> Vec<MaterialId> {
        match change.subject {
            _ if change.what == ChangeKind::Name => Vec::new(),
            Subject::Material(id) => vec![id],
            Subject::Texture(id) => self.painted_with(id),
            Subject::Entity(_) | Subject::Settings => Vec::new(),
        }
    }

    /// What shapes of a material have beside its lobes; nothing special for a material that is not there.
    #[must_use]
    pub fn finish(&self, id: MaterialId) -> Finish {
        self.materials.get(id).map(|(_, worn)| worn.finish).unwrap_or_default()
    }

    /// Whether the scene has every texture that these values name.
    pub(super) fn check_textures(&self, values: &Values) -> Result<(), SceneError> {
        let unknown = values.textures().find(|&texture| self.find_texture(texture).is_none());
        unknown.map_or(Ok(()), |texture| Err(SceneError::UnknownTexture(texture)))
    }

    /// Whether no material is painted with a texture.
    fn check_unused(&self, id: TextureId) -> Result<(), SceneError> {
        let painted = self.painted_with(id);
        let Some(&first) = painted.first() else { return Ok(()) };
        Err(SceneError::TextureInUse {
            texture: self.texture_name(id).unwrap_or_default().to_owned(),
            material: self.material_name(first).to_owned(),
            others: painted.len() - 1,
        })
    }
}

/// The edits of textures and finishes, each answering with its inverse.
impl Scene {
    pub(super) fn set_finish(&mut self, id: MaterialId, finish: Finish) -> Result<Edit, SceneError> {
        self.check_textures(&finish.values())?;
        let old = std::mem::replace(&mut self.materials.get_mut(id)?.finish, finish);
        self.record(Subject::Material(id), ChangeKind::Finish);
        Ok(Edit::Finish(id, old))
    }

    pub(super) fn set_texture(&mut self, id: TextureId, texture: Texture) -> Result<Edit, SceneError> {
        let old = std::mem::replace(self.textures.get_mut(id)?, texture);
        self.record(Subject::Texture(id), ChangeKind::Value);
        Ok(Edit::Texture(id, old))
    }

    pub(super) fn put_texture(
        &mut self,
        name: String,
        texture: Texture,
        id: Option<TextureId>,
    ) -> Result<Edit, SceneError> {
        let id = self.textures.add(name, texture, id)?;
        self.record(Subject::Texture(id), ChangeKind::Added);
        Ok(Edit::RemoveTexture(id))
    }

    pub(super) fn remove_texture(&mut self, id: TextureId) -> Result<Edit, SceneError> {
        self.check_unused(id)?;
        let (name, texture) = self.textures.remove(id)?;
        self.record(Subject::Texture(id), ChangeKind::Removed);
        Ok(Edit::AddTexture { name, texture, id: Some(id) })
    }

    pub(super) fn rename_texture(&mut self, id: TextureId, name: String) -> Result<Edit, SceneError> {
        let old = self.textures.rename(id, name)?;
        self.record(Subject::Texture(id), ChangeKind::Name);
        Ok(Edit::RenameTexture(id, old))
    }
}

impl TextureSource for Scene {
    fn texture(&self, id: TextureId) -> Option<&Texture> {
        self.find_texture(id)
    }
}

/// What a shape wears.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Worn {
    pub(super) material: Material,
    pub(super) finish: Finish,
}

#[cfg(test)]
mod tests;
