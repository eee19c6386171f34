//! What do shapes of a glTF file wear?

mod finish;
mod painter;
mod pictures;
mod principled;
mod specular_glossiness;

use std::collections::HashMap;

use catoptra_core::{Material as CoreMaterial, MaterialId, TextureUse};

use super::json::{Material, TextureInfo, Whole, entry};
use super::names::unique;
use super::refusal::{Refusal, Within};
use super::source::Source;
use crate::model::names::Names;
use crate::model::{Model, ModelMaterial};
use painter::Painter;

/// What a primitive wears.
#[derive(Debug, Clone, Copy)]
pub(super) struct Look {
    pub(super) material: MaterialId,
    /// The texture coordinates that its textures go by.
    pub(super) uv_set: u64,
}

/// The materials of a file, as far as shapes wear them.
pub(super) struct Looks<'a, 's> {
    source: &'s Source<'a>,
    painter: Painter<'a, 's>,
    model: Model,
    known: HashMap<(Option<Whole>, bool), Look>,
    names: Names,
}

impl<'a, 's> Looks<'a, 's> {
    pub(super) fn new(source: &'s Source<'a>) -> Self {
        Self {
            source,
            painter: Painter::new(source),
            model: Model::default(),
            known: HashMap::new(),
            names: Names::default(),
        }
    }

    /// A model of these materials and their textures.
    pub(super) fn into_model(self) -> Model {
        Model { textures: self.painter.into_textures(), ..self.model }
    }

    /// What a primitive of that material wears. `has_colors`: its corners have colours of their own.
    pub(super) fn of(&mut self, index: Option<Whole>, has_colors: bool) -> Result<Look, Refusal> {
        if let Some(&known) = self.known.get(&(index, has_colors)) {
            return Ok(known);
        }
        let look = match index {
            Some(index) => {
                let given = entry(&self.source.document.materials, index, "materials")?;
                self.add(given, has_colors).within(|| format!("materials[{index}]"))?
            }
            None => {
                let ModelMaterial { name, material, finish } = ModelMaterial::grey()?;
                let material = if has_colors { self.by_corners(&material, "color")? } else { material };
                let name = unique(&mut self.names, None, &name);
                Look {
                    material: self.model.add_material(ModelMaterial { name, material, finish }),
                    uv_set: 0,
                }
            }
        };
        self.known.insert((index, has_colors), look);
        Ok(look)
    }

    fn add(&mut self, given: &Material, has_colors: bool) -> Result<Look, Refusal> {
        let uv_set = self.uv_set(given);
        let material = principled::principled(given, &mut self.painter)?;
        let material = if has_colors { self.by_corners(&material, "base-color")? } else { material };
        let finish = finish::finish(given, &mut self.painter)?;
        let name = unique(&mut self.names, given.name.as_deref(), "material");
        Ok(Look { material: self.model.add_material(ModelMaterial { name, material, finish }), uv_set })
    }

    /// The same material in the colours of a mesh's corners, where no texture gives it another.
    fn by_corners(&mut self, material: &CoreMaterial, field: &'static str) -> Result<CoreMaterial, Refusal> {
        let Some(color) = material.values().get(field).cloned() else { return Ok(material.clone()) };
        if color.texture().is_some() {
            self.source
                .warnings
                .add_of_file("colours of corners are left out where a texture gives a colour too");
            return Ok(material.clone());
        }
        let texture = self.painter.corner_colors()?;
        Ok(material.with(field, color.textured(TextureUse::of(texture)))?)
    }

    /// The coordinates of the textures in use; where they differ, those of the first.
    fn uv_set(&self, given: &Material) -> u64 {
        let set = |by: &TextureInfo| {
            let other = by.extensions.transform.as_ref().and_then(|transform| transform.tex_coord);
            other.unwrap_or(by.tex_coord).0
        };
        let mut sets = given.textures().into_iter().flatten().map(set);
        let Some(first) = sets.next() else { return 0 };
        if sets.any(|other| other != first) {
            self.source.warnings.add_of_file(format!(
                "a material has textures of several sets of coordinates: all are laid by TEXCOORD_{first}"
            ));
        }
        first
    }
}

impl Material {
    /// The textures that are shown, that of the colour first.
    fn textures(&self) -> Vec<Option<&TextureInfo>> {
        let extensions = self.extensions.as_deref();
        let archived = extensions.and_then(|found| found.specular_glossiness.as_ref());
        let mut textures = match (archived, self.pbr_metallic_roughness.as_deref()) {
            (Some(found), _) => {
                vec![found.diffuse_texture.as_ref(), found.specular_glossiness_texture.as_ref()]
            }
            (None, Some(found)) => {
                vec![found.base_color_texture.as_ref(), found.metallic_roughness_texture.as_ref()]
            }
            (None, None) => Vec::new(),
        };
        textures.extend([self.normal_texture.as_deref(), self.emissive_texture.as_deref()]);
        let Some(found) = extensions else { return textures };
        textures.push(found.transmission.as_ref().and_then(|t| t.transmission_texture.as_ref()));
        if let Some(coat) = &found.clearcoat {
            textures.extend([coat.clearcoat_texture.as_ref(), coat.clearcoat_roughness_texture.as_ref()]);
        }
        if let Some(sheen) = &found.sheen {
            textures.extend([sheen.sheen_color_texture.as_ref(), sheen.sheen_roughness_texture.as_ref()]);
        }
        if let Some(specular) = &found.specular {
            textures.extend([specular.specular_texture.as_ref(), specular.specular_color_texture.as_ref()]);
        }
        textures.push(found.anisotropy.as_ref().and_then(|a| a.anisotropy_texture.as_ref()));
        textures
    }
}
