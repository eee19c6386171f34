//! Where does a node show its mesh, if many times at once? `EXT_mesh_gpu_instancing`.

use catoptra_core::glam::{DQuat, DVec3};

use super::frame::{Linear, Local, turn};
use crate::model::gltf::accessor::Which;
use crate::model::gltf::json::Instances;
use crate::model::gltf::refusal::{Refusal, Within};
use crate::model::gltf::source::Source;

/// Where each copy stands within the node.
///
/// # Errors
/// Accessors of other types or different counts.
pub(crate) fn locals(given: &Instances, source: &Source<'_>) -> Result<Vec<Local>, Refusal> {
    let translations = rows::<3>(given, "TRANSLATION", source)?;
    let rotations = rows::<4>(given, "ROTATION", source)?;
    let scales = rows::<3>(given, "SCALE", source)?;
    let counts = [
        translations.as_ref().map(Vec::len),
        rotations.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let mut counts = counts.into_iter().flatten();
    let Some(count) = counts.next() else { return Ok(Vec::new()) };
    if counts.any(|other| other != count) {
        return Err(Refusal::new("its attributes must have equal counts"));
    }
    let vector = |rows: &Option<Vec<[f32; 3]>>, i: usize, default: DVec3| {
        rows.as_ref().map_or(default, |rows| DVec3::from(rows[i].map(f64::from)))
    };
    let local = |i: usize| {
        let turned = rotations.as_ref().map_or(Ok(DQuat::IDENTITY), |rows| turn(rows[i].map(f64::from)));
        let turned = turned.within(|| format!("ROTATION[{i}]"))?;
        let linear = Linear::TurnAndScale(turned, vector(&scales, i, DVec3::ONE));
        Ok(Local { translation: vector(&translations, i, DVec3::ZERO), linear })
    };
    (0..count).map(local).collect()
}

fn rows<const N: usize>(
    given: &Instances,
    name: &str,
    source: &Source<'_>,
) -> Result<Option<Vec<[f32; N]>>, Refusal> {
    let Some(&index) = given.attributes.get(name) else { return Ok(None) };
    let read = || {
        let accessor = source.accessor(index)?;
        source.limits.take(accessor.count(), size_of::<Local>())?;
        accessor.floats(N, Which::All)
    };
    read().map(Some).within(|| format!("attributes.{name}"))
}
