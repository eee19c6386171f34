//! How do the textures and materials of a model come into a scene?

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::scene::{Edit, Scene, TextureId};
use catoptra_core::{Finish, ImageSource, Texture, TextureUse, Value, Values};

use super::{Instance, ModelSource, full_name};
use crate::build::Id;

impl Instance {
    /// Adds the textures of a model, under the ids that `known` has for their names; where one of that name is there, it takes
    /// the place of the model's.
    ///
    /// # Errors
    /// What the scene refuses, for people.
    pub(crate) fn add_textures(
        scene: &mut Scene,
        name: &str,
        source: &ModelSource,
        known: &HashMap<String, TextureId>,
    ) -> Result<Self, String> {
        let mut instance = Self { name: name.to_owned(), path: source.path.clone(), ..Self::default() };
        for (texture_name, texture) in &source.model.textures {
            let id = known.get(&full_name(name, texture_name)).copied();
            instance.add_texture(scene, source, (texture_name, texture), id)?;
        }
        Ok(instance)
    }

    /// Adds the materials of the model, its textures being there; where one of that name is there, it takes the place of the
    /// model's.
    ///
    /// # Errors
    /// What the scene refuses, for people.
    pub(crate) fn add_materials(&mut self, scene: &mut Scene, source: &ModelSource) -> Result<(), String> {
        (0..source.model.materials.len()).try_for_each(|i| self.add_material(scene, source, i))
    }

    fn add_texture(
        &mut self,
        scene: &mut Scene,
        source: &ModelSource,
        (own, texture): (&str, &Texture),
        id: Option<TextureId>,
    ) -> Result<(), String> {
        let name = full_name(&self.name, own);
        if let Some(id) = scene.texture_named(&name) {
            self.textures.push(id);
            return Ok(());
        }
        let path = format!("{}#{own}", source.path);
        let values = texture.values();
        let values = values.iter().fold(Values::new(), |all, (field, value)| {
            let value = match value {
                Value::Image(image) => {
                    Value::Image(ImageSource { path: path.clone(), image: Arc::clone(&image.image) })
                }
                other => other.clone(),
            };
            all.with(field, value)
        });
        let texture = (texture.kind().make)(&values).map_err(|e| e.to_string())?;
        let id = id.unwrap_or_else(|| scene.next_texture_id());
        let add = Edit::AddTexture { name, texture, id: Some(id) };
        scene.apply(add).map_err(|e| e.to_string())?;
        self.textures.push(id);
        self.own_looks.push(Id::Texture(id));
        Ok(())
    }

    fn add_material(&mut self, scene: &mut Scene, source: &ModelSource, i: usize) -> Result<(), String> {
        let given = &source.model.materials[i];
        let name = full_name(&self.name, &given.name);
        if let Some(id) = scene.material_named(&name) {
            self.materials.push(id);
            return Ok(());
        }
        let material = (given.material.kind().make)(&self.mapped(&given.material.values()))
            .map_err(|e| e.to_string())?;
        let id = scene.add_material(&name, material).map_err(|e| e.to_string())?;
        if !given.finish.is_plain() {
            let finish = (Finish::KIND.make)(&self.mapped(&catoptra_core::Part::values(&given.finish)))
                .map_err(|e| e.to_string())?;
            scene.apply(Edit::Finish(id, finish)).map_err(|e| e.to_string())?;
        }
        self.materials.push(id);
        self.own_looks.push(Id::Material(id));
        Ok(())
    }

    /// Values of the model with the textures of the scene.
    fn mapped(&self, values: &Values) -> Values {
        repainted(values, |id| self.textures.get(id.index() as usize - 1).copied().unwrap_or(id))
    }
}

/// Values with other textures in the place of theirs.
pub(crate) fn repainted(values: &Values, texture: impl Fn(TextureId) -> TextureId) -> Values {
    values.iter().fold(Values::new(), |all, (field, value)| {
        let value = match value {
            Value::Texture(id) => Value::Texture(texture(*id)),
            Value::Textured(textured) => {
                let by = TextureUse { texture: texture(textured.by.texture), ..textured.by };
                textured.base.clone().textured(by)
            }
            other => other.clone(),
        };
        all.with(field, value)
    })
}
