//! What does each light add to the light on surfaces? The scene is copied once for each, with all others dark.

use std::sync::{Arc, OnceLock};

use catoptra_core::Light;
use catoptra_core::scene::{Edit, EntityId, Scene, SceneError};
use catoptra_tracer::{Extraction, Pool, Snapshot};

use crate::lighting::{self, Lighting};

/// So many lights are told apart at once; of more only those that are selected. Each copy is asked for the light on every pixel.
const MOST: usize = 12;

/// The scene with one light alone.
pub(crate) struct LightPart {
    pub(crate) id: EntityId,
    /// The light's name.
    pub(crate) name: String,
    extraction: Extraction,
    snapshot: OnceLock<Snapshot>,
}

impl LightPart {
    /// Frozen when it is first asked for, with what it shares with the whole scene.
    pub(crate) fn snapshot(&self, whole: &Snapshot, pool: &Pool) -> &Snapshot {
        self.snapshot.get_or_init(|| self.extraction.after(whole, pool).0)
    }
}

/// The lights of a scene one by one.
#[derive(Default)]
pub(crate) struct LightParts {
    pub(crate) parts: Vec<LightPart>,
    /// Whether these are all lights that shine: then what they give adds up to the whole.
    pub(crate) are_all: bool,
    /// The lights that are looked at alone; none for all.
    pub(crate) alone: Vec<EntityId>,
}

impl LightParts {
    /// Of all lights that shine in the window; of the selected ones where there are too many. Where `alone` says so, the
    /// selected ones are looked at alone.
    pub(crate) fn of(scene: &Scene, lighting: &Lighting, selected: &[EntityId], alone: bool) -> Arc<Self> {
        let shines =
            |id: &EntityId| lighting::shines(scene, *id) && !scene.is_hidden(*id) && !lighting.is_dark(*id);
        let all: Vec<EntityId> = scene.entities().filter(shines).collect();
        let are_all = all.len() <= MOST;
        let told: Vec<EntityId> =
            all.into_iter().filter(|id| are_all || selected.contains(id)).take(MOST).collect();
        let part = |id: EntityId| {
            let lit = with_one_light(scene, id).ok()?;
            let name = scene.name(id).unwrap_or_default();
            Some(LightPart { id, name, extraction: Extraction::of(&lit), snapshot: OnceLock::new() })
        };
        let parts: Vec<LightPart> = told.iter().filter_map(|id| part(*id)).collect();
        let are_all = are_all && parts.len() == told.len();
        let is_part = |id: &EntityId| alone && parts.iter().any(|part| part.id == *id);
        let alone = selected.iter().copied().filter(is_part).collect();
        Arc::new(Self { parts, are_all, alone })
    }
}

/// The scene with one of its lights alone.
fn with_one_light(scene: &Scene, light: EntityId) -> Result<Scene, SceneError> {
    let mut lit = lighting::darkened(scene, |id| id != light)?;
    for id in scene.entities().filter(|id| *id != light) {
        // A light that is no body and is not seen can as well be gone: then nobody asks about it.
        let is_nowhere =
            |part: Light| part.lamp().is_none() && (part.position().is_some() || part.direction().is_some());
        if lit.light(id).is_some_and(is_nowhere) {
            lit.apply(Edit::Remove(id))?;
        }
    }
    Ok(lit)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lamps(count: usize) -> Scene {
        let lamp = |i: usize| format!("point-light \"lamp {i}\" {{ position 0 {} 0; intensity 1 }}\n", i + 1);
        catoptra_scene::parse(&(0..count).map(lamp).collect::<String>(), "text", None).unwrap().0
    }

    fn names(parts: &LightParts) -> Vec<&str> {
        parts.parts.iter().map(|part| part.name.as_str()).collect()
    }

    #[test]
    fn of_few_lights_all_are_told_apart_and_of_many_the_selected_ones() {
        let lighting = Lighting::default();
        let few = lamps(3);
        let second = few.entity_named("lamp 1").unwrap();
        let parts = LightParts::of(&few, &lighting, &[second], true);
        assert_eq!(names(&parts), ["lamp 0", "lamp 1", "lamp 2"]);
        assert_eq!((parts.are_all, parts.alone.as_slice()), (true, &[second][..]));
        assert!(LightParts::of(&few, &lighting, &[second], false).alone.is_empty());
        let many = lamps(MOST + 1);
        let fifth = many.entity_named("lamp 4").unwrap();
        let parts = LightParts::of(&many, &lighting, &[fifth], false);
        assert_eq!((names(&parts), parts.are_all), (vec!["lamp 4"], false));
    }

    #[test]
    fn what_is_dark_or_hidden_is_no_part() {
        let mut scene = lamps(3);
        let [first, second] = ["lamp 0", "lamp 1"].map(|name| scene.entity_named(name).unwrap());
        let mut lighting = Lighting::default();
        lighting.toggle_mute(&[first]);
        let hidden = catoptra_core::Flags { hidden: true, locked: false };
        scene.apply(catoptra_core::Edit::Flags(second, hidden)).unwrap();
        let parts = LightParts::of(&scene, &lighting, &[], false);
        assert_eq!((names(&parts), parts.are_all), (vec!["lamp 2"], true));
    }
}
