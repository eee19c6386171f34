//! Which materials does a scene have, and under what names?

use std::collections::{BTreeMap, HashMap};

use super::ids::Counter;
use super::{MaterialId, SceneError};
use crate::Material;

/// The materials of one scene, by id and by name.
#[derive(Debug, Clone)]
pub(super) struct Materials {
    entries: BTreeMap<MaterialId, (String, Material)>,
    by_name: HashMap<String, MaterialId>,
    pub(super) ids: Counter,
}

impl Materials {
    pub(super) fn new() -> Self {
        Self { entries: BTreeMap::new(), by_name: HashMap::new(), ids: Counter::START }
    }

    pub(super) fn get(&self, id: MaterialId) -> Option<(&str, &Material)> {
        self.entries.get(&id).map(|(name, material)| (name.as_str(), material))
    }

    pub(super) fn named(&self, name: &str) -> Option<MaterialId> {
        self.by_name.get(name).copied()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (MaterialId, &str, &Material)> {
        self.entries.iter().map(|(&id, (name, material))| (id, name.as_str(), material))
    }

    /// Adds a material under `id`, or under a new id.
    pub(super) fn add(
        &mut self,
        name: String,
        material: Material,
        id: Option<MaterialId>,
    ) -> Result<MaterialId, SceneError> {
        self.check_name(&name)?;
        let id = match id {
            Some(id) if self.entries.contains_key(&id) => return Err(SceneError::MaterialIdTaken(id)),
            Some(id) => id,
            None if !self.ids.has(1) => return Err(SceneError::IdsExhausted),
            None => self.ids.take_material(),
        };
        self.ids.skip_past(id.index());
        self.by_name.insert(name.clone(), id);
        self.entries.insert(id, (name, material));
        Ok(id)
    }

    pub(super) fn remove(&mut self, id: MaterialId) -> Result<(String, Material), SceneError> {
        let entry = self.entries.remove(&id).ok_or(SceneError::UnknownMaterial(id))?;
        self.by_name.remove(&entry.0);
        Ok(entry)
    }

    /// Changes a material and gives back what it was.
    pub(super) fn replace(&mut self, id: MaterialId, material: Material) -> Result<Material, SceneError> {
        let entry = self.entries.get_mut(&id).ok_or(SceneError::UnknownMaterial(id))?;
        Ok(std::mem::replace(&mut entry.1, material))
    }

    /// Changes a name and gives back what it was.
    pub(super) fn rename(&mut self, id: MaterialId, name: String) -> Result<String, SceneError> {
        let old = self.get(id).ok_or(SceneError::UnknownMaterial(id))?.0.to_owned();
        if old == name {
            return Ok(old);
        }
        self.check_name(&name)?;
        self.by_name.remove(&old);
        self.by_name.insert(name.clone(), id);
        if let Some(entry) = self.entries.get_mut(&id) {
            entry.0 = name;
        }
        Ok(old)
    }

    fn check_name(&self, name: &str) -> Result<(), SceneError> {
        if name.trim().is_empty() {
            return Err(SceneError::EmptyName);
        }
        if self.by_name.contains_key(name) {
            return Err(SceneError::MaterialNameTaken(name.to_owned()));
        }
        Ok(())
    }
}
