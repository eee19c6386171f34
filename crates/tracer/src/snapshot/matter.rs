//! What do surfaces of a scene need that lanes do not know: lobes of many kinds, textures, finishes, media, light from all around?

use std::collections::BTreeMap;

use catoptra_core::glam::DVec3;
use catoptra_core::texture::{Texture, TextureSource};
use catoptra_core::{Environment, Finish, Material, Medium, Rgb, Shape, Sides, TextureId};

use super::Prim;
use super::extraction::OwnShape;

/// What is particular about a material.
#[derive(Debug, Clone)]
pub(crate) struct MatterRow {
    pub(crate) finish: Finish,
    pub(crate) is_textured: bool,
    /// Whether it matters which way texture coordinates run.
    pub(crate) is_directed: bool,
    /// What fills a solid of it.
    pub(crate) medium: Option<Medium>,
    /// The same without an inside, for surfaces that enclose nothing.
    pub(crate) thin: Option<Material>,
}

impl MatterRow {
    fn new(material: &Material, finish: Finish) -> Self {
        let medium = material.medium();
        let thin = || material.with("thin", catoptra_core::Value::Flag(true)).ok();
        Self {
            finish,
            is_textured: material.is_textured(),
            is_directed: finish.normal_map().is_some() || material.is_anisotropic(),
            medium,
            thin: medium.and_then(|_| thin()),
        }
    }

    /// Whether any light goes straight through.
    pub(crate) fn is_see_through(&self) -> bool {
        self.medium.is_some() || self.finish.is_see_through() || self.finish.sides() == Sides::Single
    }

    /// Whether lanes know all of it.
    fn is_plain(&self) -> bool {
        self.finish.is_plain() && !self.is_textured && self.medium.is_none()
    }
}

/// What a snapshot holds beside what lanes know.
#[derive(Debug, Default)]
pub(crate) struct Matter {
    /// By the index of the material.
    pub(crate) rows: Vec<MatterRow>,
    textures: BTreeMap<TextureId, Texture>,
    /// Shapes before they were placed, by their numbers, where materials ask where on them a point lies.
    own: BTreeMap<u32, OwnShape>,
    /// Light from all around; without any the background.
    pub(crate) surroundings: Vec<Environment>,
    /// The shapes that light goes through.
    pub(crate) clear: Vec<u32>,
    /// Whether there are any.
    pub(crate) is_see_through: bool,
    /// Whether lanes know all of every material.
    pub(crate) is_plain: bool,
    /// Whether lanes alone cannot shade the scene by Whitted's rules.
    pub(crate) is_needed: bool,
}

impl Matter {
    pub(super) fn new<'a>(
        prims: &[Prim],
        materials: impl Iterator<Item = (&'a Material, Finish)>,
        textures: BTreeMap<TextureId, Texture>,
        own: BTreeMap<u32, OwnShape>,
        surroundings: Vec<Environment>,
    ) -> Self {
        let (mut rows, mut is_plain) = (Vec::new(), true);
        for (material, finish) in materials {
            let row = MatterRow::new(material, finish);
            is_plain &= !material.needs_bsdf() && row.is_plain();
            rows.push(row);
        }
        let is_clear = |prim: &Prim| rows[prim.material as usize].is_see_through();
        let clear: Vec<u32> =
            prims.iter().zip(0..).filter(|(prim, _)| is_clear(prim)).map(|(_, at)| at).collect();
        let is_see_through = !clear.is_empty();
        let is_needed = !is_plain || !surroundings.is_empty();
        Self { rows, textures, own, surroundings, clear, is_see_through, is_plain, is_needed }
    }

    /// Of a shape.
    pub(crate) fn row(&self, prim: &Prim) -> &MatterRow {
        &self.rows[prim.material as usize]
    }

    /// What light from all around is wherever it comes from, before a background; `None` where it is not the same.
    pub(crate) fn sky(&self, background: Rgb) -> Option<Rgb> {
        let all = &self.surroundings;
        let sum = || all.iter().fold(Rgb::BLACK, |sum, light| sum + light.radiance(DVec3::Y));
        match all.iter().all(Environment::is_even) {
            true if all.is_empty() => Some(background),
            even => even.then(sum),
        }
    }

    /// A shape before it was placed, where its material asks for that.
    pub(crate) fn own_shape(&self, prim: u32) -> Option<&OwnShape> {
        self.own.get(&prim)
    }

    /// What fills a shape; nothing fills one that encloses nothing.
    pub(crate) fn medium_in(&self, prim: &Prim) -> Option<Medium> {
        self.row(prim).medium.filter(|_| !is_a_sheet(&prim.shape))
    }
}

impl TextureSource for Matter {
    fn texture(&self, id: TextureId) -> Option<&Texture> {
        self.textures.get(&id)
    }
}

/// Whether a shape is a piece of a surface that has no inside. Planes bound half of space, and meshes are taken for solids.
pub(crate) fn is_a_sheet(shape: &Shape) -> bool {
    matches!(shape, Shape::Rectangle(_) | Shape::Disk(_) | Shape::Triangle(_))
}
