//! Counts of what a snapshot holds: shapes, materials, lights, triangles.

use catoptra_core::{EntityId, Light, Material};
use serde::Serialize;

use super::Snapshot;

/// What there is in a snapshot.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Needs {
    /// Shapes by kind, most first.
    pub shapes: Vec<(&'static str, usize)>,
    /// Lights by kind, most first; ambient light is not among them.
    pub lights: Vec<(&'static str, usize)>,
    /// Materials by kind, most first.
    pub materials: Vec<(&'static str, usize)>,
    /// Unbounded shapes, which are not in the tree.
    pub unbounded: usize,
    /// Meshes, each counted once however many instances it has.
    pub meshes: usize,
    /// Triangles of those meshes.
    pub triangles: usize,
    /// Bytes of all trees.
    pub tree_bytes: usize,
    /// Shapes that have a SIMD kernel; the others are crossed one ray at a time.
    pub with_kernel: usize,
    /// Whether any shape reflects.
    pub reflects: bool,
    /// Lights that throw shadows.
    pub shadowing_lights: usize,
    /// Whether there is ambient light.
    pub ambient: bool,
    /// Surfaces that light others: flat and round ones each, of others every facet or triangle.
    pub lamps: usize,
    /// Whether these are so many that every point asks some of them, picked at random.
    pub lamps_are_picked: bool,
    /// Shapes that shine and light nothing, as they have no end.
    pub endless_lamps: usize,
}

impl Snapshot {
    /// Counts what is in it.
    #[must_use]
    pub fn needs(&self) -> Needs {
        Needs {
            shapes: count(self.prims.iter().map(|p| p.shape.kind_name())),
            lights: count(self.lights.iter().map(Light::kind_name)),
            materials: count(self.materials.iter().map(Material::kind_name)),
            unbounded: self.index.unbounded.len(),
            meshes: self.index.meshes.len(),
            triangles: self.index.meshes.iter().map(|m| m.mesh().triangles().len()).sum(),
            tree_bytes: self.index.meshes.iter().map(|m| m.bytes()).sum::<usize>()
                + size_of_val(&self.index.tree.nodes[..])
                + size_of_val(&self.index.tree.order[..]),
            with_kernel: self.prims.len() - self.index.columns.without_kernel(),
            reflects: self.has_mirrors,
            shadowing_lights: self.lights.iter().filter(|l| l.shadow()).count(),
            ambient: self.ambient.max_channel() > 0.0,
            lamps: self.lamps().rows.len(),
            lamps_are_picked: self.picked_lamps().is_some(),
            endless_lamps: self.endless_lamps().count(),
        }
    }

    /// How many surfaces light others, where these are so many that every point asks some of them, picked at random.
    #[must_use]
    pub fn picked_lamps(&self) -> Option<usize> {
        self.lamps().tree.as_ref().map(|_| self.lamps().rows.len())
    }

    /// Shapes that shine and light nothing, as they have no end.
    pub fn endless_lamps(&self) -> impl Iterator<Item = EntityId> {
        self.lamps().endless.iter().map(|&prim| self.entities()[prim as usize])
    }
}

fn count(names: impl Iterator<Item = &'static str>) -> Vec<(&'static str, usize)> {
    let mut counts: Vec<(&'static str, usize)> = Vec::new();
    for name in names {
        match counts.iter_mut().find(|(n, _)| *n == name) {
            Some(entry) => entry.1 += 1,
            None => counts.push((name, 1)),
        }
    }
    counts.sort_by_key(|&(name, n)| (std::cmp::Reverse(n), name));
    counts
}
