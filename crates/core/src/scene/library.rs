//! Which materials and textures does a scene have, and under what names?

use std::collections::{BTreeMap, HashMap};

use super::ids::Counter;
use super::{MaterialId, SceneError, TextureId};

/// Names one part of a library.
pub(super) trait LibraryId: Copy + Ord {
    /// A new id.
    fn take(ids: &mut Counter) -> Self;
    /// Its number.
    fn number(self) -> u32;
    /// There is no such part.
    fn unknown(self) -> SceneError;
    /// An added part names an id that is in use.
    fn taken(self) -> SceneError;
    /// Another part of the library has that name.
    fn name_taken(name: String) -> SceneError;
}

macro_rules! library_id {
    ($id:ident, $take:ident, $unknown:ident, $taken:ident, $name_taken:ident) => {
        impl LibraryId for $id {
            fn take(ids: &mut Counter) -> Self {
                ids.$take()
            }
            fn number(self) -> u32 {
                self.index()
            }
            fn unknown(self) -> SceneError {
                SceneError::$unknown(self)
            }
            fn taken(self) -> SceneError {
                SceneError::$taken(self)
            }
            fn name_taken(name: String) -> SceneError {
                SceneError::$name_taken(name)
            }
        }
    };
}

library_id!(MaterialId, take_material, UnknownMaterial, MaterialIdTaken, MaterialNameTaken);
library_id!(TextureId, take_texture, UnknownTexture, TextureIdTaken, TextureNameTaken);

/// Parts of one scene that others name, by id and by name.
#[derive(Debug, Clone)]
pub(super) struct Library<Id, T> {
    entries: BTreeMap<Id, (String, T)>,
    by_name: HashMap<String, Id>,
    pub(super) ids: Counter,
}

impl<Id: LibraryId, T> Library<Id, T> {
    pub(super) fn new() -> Self {
        Self { entries: BTreeMap::new(), by_name: HashMap::new(), ids: Counter::START }
    }

    pub(super) fn get(&self, id: Id) -> Option<(&str, &T)> {
        self.entries.get(&id).map(|(name, part)| (name.as_str(), part))
    }

    pub(super) fn get_mut(&mut self, id: Id) -> Result<&mut T, SceneError> {
        self.entries.get_mut(&id).map(|(_, part)| part).ok_or(id.unknown())
    }

    pub(super) fn named(&self, name: &str) -> Option<Id> {
        self.by_name.get(name).copied()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (Id, &str, &T)> {
        self.entries.iter().map(|(&id, (name, part))| (id, name.as_str(), part))
    }

    /// Adds a part under `id`, or under a new id.
    pub(super) fn add(&mut self, name: String, part: T, id: Option<Id>) -> Result<Id, SceneError> {
        self.check_name(&name)?;
        let id = match id {
            Some(id) if self.entries.contains_key(&id) => return Err(id.taken()),
            Some(id) => id,
            None if !self.ids.has(1) => return Err(SceneError::IdsExhausted),
            None => Id::take(&mut self.ids),
        };
        self.ids.skip_past(id.number());
        self.by_name.insert(name.clone(), id);
        self.entries.insert(id, (name, part));
        Ok(id)
    }

    pub(super) fn remove(&mut self, id: Id) -> Result<(String, T), SceneError> {
        let entry = self.entries.remove(&id).ok_or(id.unknown())?;
        self.by_name.remove(&entry.0);
        Ok(entry)
    }

    /// Changes a name and gives back what it was.
    pub(super) fn rename(&mut self, id: Id, name: String) -> Result<String, SceneError> {
        let old = self.get(id).ok_or(id.unknown())?.0.to_owned();
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
            return Err(Id::name_taken(name.to_owned()));
        }
        Ok(())
    }
}
