//! Where do the joints of a skin carry the corners of a mesh? In the pose that the nodes stand in (section 3.7.3.3 of the
//! specification).

use catoptra_core::glam::{DAffine3, DMat3, DVec3};

use super::primitive::Corners;
use super::warp::cofactors;
use crate::model::gltf::accessor::Which;
use crate::model::gltf::json::{Attributes, Skin, entry};
use crate::model::gltf::refusal::{Refusal, Within};
use crate::model::gltf::source::Source;

/// For each joint of a skin, where it carries what it holds: from the mesh's own space to the world.
pub(crate) fn joints(
    skin: &Skin,
    globals: &[DAffine3],
    source: &Source<'_>,
) -> Result<Vec<DAffine3>, Refusal> {
    let bind = match skin.inverse_bind_matrices {
        Some(index) => {
            let read = || {
                let accessor = source.accessor(index)?;
                source.limits.take(accessor.count(), size_of::<[f32; 16]>())?;
                accessor.floats::<16>(16, Which::All)
            };
            read().within(|| "inverseBindMatrices".to_owned())?
        }
        None => Vec::new(),
    };
    if skin.inverse_bind_matrices.is_some() && bind.len() < skin.joints.len() {
        let message = format!("has {} joints, but {} inverseBindMatrices", skin.joints.len(), bind.len());
        return Err(Refusal::new(message));
    }
    let joint = |(i, &node): (usize, _)| {
        let global = entry(globals, node, "nodes").within(|| format!("joints[{i}]"))?;
        Ok(bind.get(i).map_or(*global, |matrix| *global * affine(matrix)))
    };
    skin.joints.iter().enumerate().map(joint).collect()
}

/// The first three rows of a column-major matrix.
fn affine(m: &[f32; 16]) -> DAffine3 {
    let column = |i: usize| DVec3::new(f64::from(m[i]), f64::from(m[i + 1]), f64::from(m[i + 2]));
    DAffine3::from_cols(column(0), column(4), column(8), column(12))
}

/// Corners where joints have carried them, round an offset.
pub(crate) struct Carried {
    pub(crate) corners: Corners,
    pub(crate) offset: DVec3,
}

/// Whether a primitive says which joints carry it.
pub(crate) fn is_skinned(attributes: &Attributes) -> bool {
    attributes.contains_key("JOINTS_0") && attributes.contains_key("WEIGHTS_0")
}

/// Carries the corners.
pub(crate) fn apply(
    mut corners: Corners,
    attributes: &Attributes,
    joints: &[DAffine3],
    source: &Source<'_>,
) -> Result<Carried, Refusal> {
    let influences = Influences::read(&corners, attributes, joints.len(), source)?;
    let mut places = Vec::with_capacity(corners.positions.len());
    for (i, position) in corners.positions.iter().enumerate() {
        let carries = influences.blended(i, joints);
        places.push(carries.transform_point3(DVec3::from(position.map(f64::from))));
        if let Some(normals) = &mut corners.normals {
            let normal = cofactors(carries.matrix3) * DVec3::from(normals[i].map(f64::from));
            normals[i] = normal.normalize_or_zero().as_vec3().to_array();
        }
    }
    corners.tangents = None;
    let offset = offset_of(&places);
    for (position, place) in corners.positions.iter_mut().zip(&places) {
        *position = (place - offset).as_vec3().to_array();
    }
    // A mirrored skeleton turns all triangles.
    if joints.first().is_some_and(|joint| joint.matrix3.determinant() < 0.0) {
        corners.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    Ok(Carried { corners, offset })
}

/// Round which point corners keep their digits in `f32`: zero, unless they are far from it for their extent.
fn offset_of(places: &[DVec3]) -> DVec3 {
    const FAR: f64 = 8.0;
    let low = places.iter().fold(DVec3::INFINITY, |low, &p| low.min(p));
    let high = places.iter().fold(DVec3::NEG_INFINITY, |high, &p| high.max(p));
    let (middle, extent) = ((low + high) / 2.0, (high - low).max_element());
    if middle.is_finite() && middle.abs().max_element() > FAR * extent { middle } else { DVec3::ZERO }
}

/// Which joints carry each corner, and by how much.
struct Influences {
    /// Four joints a corner in each set.
    joints: Vec<Vec<[f32; 4]>>,
    weights: Vec<Vec<[f32; 4]>>,
}

impl Influences {
    fn read(
        corners: &Corners,
        attributes: &Attributes,
        count: usize,
        source: &Source<'_>,
    ) -> Result<Self, Refusal> {
        let mut found = Self { joints: Vec::new(), weights: Vec::new() };
        for set in 0.. {
            let named = |what: &str| attributes.get(&format!("{what}_{set}")).copied();
            let (Some(joints), Some(weights)) = (named("JOINTS"), named("WEIGHTS")) else { break };
            source.limits.take(2 * corners.positions.len(), size_of::<[f32; 4]>())?;
            let read = |index| corners.rows_of::<4>(&source.accessor(index)?, 4);
            let joints = read(joints).within(|| format!("attributes.JOINTS_{set}"))?;
            let past = |&&joint: &&f32| !(joint >= 0.0 && (joint as usize) < count);
            if let Some(joint) = joints.as_flattened().iter().find(past) {
                let message = format!("names joint {joint}, of which the skin has {count}");
                return Err(Refusal::new(message)).within(|| format!("attributes.JOINTS_{set}"));
            }
            found.joints.push(joints);
            found.weights.push(read(weights).within(|| format!("attributes.WEIGHTS_{set}"))?);
        }
        Ok(found)
    }

    /// The mean of what a corner's joints do, by their weights; all by the first where no weight is there.
    fn blended(&self, corner: usize, joints: &[DAffine3]) -> DAffine3 {
        let pairs = || {
            let sets = self.joints.iter().zip(&self.weights);
            let pairs =
                sets.flat_map(move |(joints, weights)| joints[corner].into_iter().zip(weights[corner]));
            pairs.map(|(joint, weight)| (joint as usize, f64::from(weight).max(0.0)))
        };
        let total: f64 = pairs().map(|(_, weight)| weight).sum();
        if !(total > 0.0 && total.is_finite()) {
            return pairs().next().map_or(DAffine3::IDENTITY, |(joint, _)| joints[joint]);
        }
        let (mut matrix, mut translation) = (DMat3::ZERO, DVec3::ZERO);
        for (joint, weight) in pairs().filter(|(_, weight)| *weight > 0.0) {
            let share = weight / total;
            matrix += joints[joint].matrix3 * share;
            translation += joints[joint].translation * share;
        }
        DAffine3 { matrix3: matrix, translation }
    }
}
