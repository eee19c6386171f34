//! How far do the shapes that a mesh can turn into move its corners? By weights as they stand in the file.

use super::primitive::Corners;
use crate::model::gltf::json::{Attributes, Primitive};
use crate::model::gltf::refusal::{Refusal, Within};
use crate::model::gltf::source::Source;

/// The weights that count, or none where nothing moves.
pub(crate) fn weights<'d>(primitive: &Primitive, of_node: &'d [f64], of_mesh: &'d [f64]) -> &'d [f64] {
    let given = if of_node.is_empty() { of_mesh } else { of_node };
    let given = &given[..given.len().min(primitive.targets.len())];
    if given.iter().all(|&weight| weight == 0.0) { &[] } else { given }
}

/// Moves the corners.
pub(crate) fn apply(
    corners: &mut Corners,
    targets: &[Attributes],
    weights: &[f64],
    source: &Source<'_>,
) -> Result<(), Refusal> {
    for (i, (target, &weight)) in targets.iter().zip(weights).enumerate() {
        if weight != 0.0 {
            // What is bent has other tangents.
            corners.tangents = None;
            apply_one(corners, target, weight, source).within(|| format!("targets[{i}]"))?;
        }
    }
    Ok(())
}

fn apply_one(
    corners: &mut Corners,
    target: &Attributes,
    weight: f64,
    source: &Source<'_>,
) -> Result<(), Refusal> {
    let deltas = |corners: &Corners, name: &str| -> Result<Option<Vec<[f32; 3]>>, Refusal> {
        let Some(&index) = target.get(name) else { return Ok(None) };
        source.limits.take(corners.positions.len(), size_of::<[f32; 3]>())?;
        let read = || corners.rows_of::<3>(&source.accessor(index)?, 3);
        read().map(Some).within(|| name.to_owned())
    };
    if let Some(deltas) = deltas(corners, "POSITION")? {
        add(&mut corners.positions, &deltas, weight);
    }
    if corners.normals.is_some()
        && let Some(deltas) = deltas(corners, "NORMAL")?
        && let Some(normals) = &mut corners.normals
    {
        add(normals, &deltas, weight);
    }
    if target.keys().any(|name| name.starts_with("TEXCOORD") || name.starts_with("COLOR")) {
        source.warnings.add_of_file("texture coordinates and colours of morph targets are left out");
    }
    Ok(())
}

fn add(rows: &mut [[f32; 3]], deltas: &[[f32; 3]], weight: f64) {
    for (row, delta) in rows.iter_mut().zip(deltas) {
        for (v, d) in row.iter_mut().zip(delta) {
            *v = (f64::from(*v) + weight * f64::from(*d)) as f32;
        }
    }
}
