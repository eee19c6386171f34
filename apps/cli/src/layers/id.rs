//! Which thing and which material does the middle of each pixel show? Numbers whose names stand in the file's manifest; 0 where there
//! is none.

use catoptra_core::{EntityId, MaterialId};
use catoptra_scene::image::Channel;

use super::seen::whole;
use super::{Layer, Need, Seen};

pub(super) const LAYER: Layer = Layer { name: "id", needs: &[Need::Surfaces], channels };

fn channels<'a>(seen: &'a Seen<'_>) -> Vec<Channel<'a>> {
    let entity = |x, y| seen.surfaces.as_ref().and_then(|surfaces| surfaces.entity(x, y));
    let material = move |x, y| seen.job.scene.material_of(entity(x, y)?);
    vec![
        whole("id.entity", move |x, y| entity(x, y).map_or(0, EntityId::index)),
        whole("id.material", move |x, y| material(x, y).map_or(0, MaterialId::index)),
    ]
}
