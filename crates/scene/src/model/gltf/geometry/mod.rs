//! Which meshes does a file have, each stored once however many nodes show it?

mod morph;
mod primitive;
mod skin;
mod topology;
mod warp;

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::TriangleMesh;
use catoptra_core::glam::{DAffine3, DVec3};

pub(super) use primitive::topology;
pub(super) use skin::{is_skinned, joints};

use super::json::{Mesh, Primitive};
use super::refusal::Refusal;
use super::source::Source;
use super::tree::Rest;
use primitive::{Accessors, Corners};
use topology::Topology;

/// What one node does to the corners of its mesh.
pub(super) struct Pose<'p> {
    /// Weights of morph targets, if the node has its own.
    pub(super) weights: &'p [f64],
    /// The skin's number, and where its joints carry things.
    pub(super) skin: Option<(u64, &'p [DAffine3])>,
    /// What is left of the node's matrix beside its placement.
    pub(super) rest: Rest,
}

/// Two meshes with the same key are the same.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Key {
    accessors: Accessors,
    moved: Option<Moved>,
    rest: Rest,
}

/// By which morph targets, weights and joints corners are moved.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Moved {
    mesh: usize,
    primitive: usize,
    weights: Vec<u64>,
    skin: Option<u64>,
}

/// The meshes that have been read; `None` for what has no triangles.
#[derive(Debug, Default)]
pub(super) struct Meshes {
    known: HashMap<Key, Option<Arc<TriangleMesh>>>,
}

/// A primitive, and where it stands.
#[derive(Clone, Copy)]
pub(super) struct Which<'d> {
    pub(super) mesh: (usize, &'d Mesh),
    pub(super) primitive: (usize, &'d Primitive),
    pub(super) topology: Topology,
    /// Its texture coordinates.
    pub(super) uv_set: u64,
}

impl Meshes {
    /// The mesh of a primitive as a node shows it; `None` where it has no triangles.
    pub(super) fn get(
        &mut self,
        which: Which<'_>,
        pose: &Pose<'_>,
        source: &Source<'_>,
    ) -> Result<Option<Arc<TriangleMesh>>, Refusal> {
        let Some(accessors) = Accessors::of(which.primitive.1, which.topology, which.uv_set, source)? else {
            return Ok(None);
        };
        let weights = morph::weights(which.primitive.1, pose.weights, &which.mesh.1.weights);
        let is_moved = !weights.is_empty() || pose.skin.is_some();
        let moved = is_moved.then(|| Moved {
            mesh: which.mesh.0,
            primitive: which.primitive.0,
            weights: weights.iter().map(|weight| weight.to_bits()).collect(),
            skin: pose.skin.map(|(number, _)| number),
        });
        let plain = Key { accessors, moved, rest: Rest::NONE };
        let unwarped = self.known_or(plain.clone(), || read(&accessors, which, weights, pose, source))?;
        if pose.rest == Rest::NONE {
            return Ok(unwarped);
        }
        let Some(unwarped) = unwarped else { return Ok(None) };
        self.known_or(Key { rest: pose.rest, ..plain }, || {
            source.limits.take(unwarped.positions().len() + unwarped.triangles().len(), ROW)?;
            warp::warped(&unwarped, pose.rest.matrix()).map(|mesh| Some(Arc::new(mesh)))
        })
    }

    fn known_or(
        &mut self,
        key: Key,
        make: impl FnOnce() -> Result<Option<Arc<TriangleMesh>>, Refusal>,
    ) -> Result<Option<Arc<TriangleMesh>>, Refusal> {
        if let Some(known) = self.known.get(&key) {
            return Ok(known.clone());
        }
        let made = make()?;
        self.known.insert(key, made.clone());
        Ok(made)
    }
}

/// Bytes of a corner or a triangle at most: position, normal, texture coordinates, colour, tangent.
const ROW: usize = size_of::<[f32; 15]>();

fn read(
    accessors: &Accessors,
    which: Which<'_>,
    weights: &[f64],
    pose: &Pose<'_>,
    source: &Source<'_>,
) -> Result<Option<Arc<TriangleMesh>>, Refusal> {
    let Some(mut corners) = Corners::read(accessors, source)? else { return Ok(None) };
    let primitive = which.primitive.1;
    morph::apply(&mut corners, &primitive.targets, weights, source)?;
    let mut offset = DVec3::ZERO;
    if let Some((_, joints)) = pose.skin {
        let carried = skin::apply(corners, &primitive.attributes, joints, source)?;
        (corners, offset) = (carried.corners, carried.offset);
    }
    let Corners { positions, triangles, normals, uvs, colors, tangents, .. } = corners;
    let mesh = TriangleMesh::new(positions, triangles, normals, uvs).map(|mesh| mesh.with_offset(offset));
    let mesh = mesh.and_then(|mesh| match colors {
        Some(colors) => mesh.with_colors(colors),
        None => Ok(mesh),
    });
    let mesh = mesh.and_then(|mesh| match tangents {
        Some(tangents) => mesh.with_tangents(tangents),
        None => Ok(mesh),
    });
    Ok(Some(Arc::new(mesh?)))
}
