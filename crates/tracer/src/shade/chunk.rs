//! The packets that are shaded together: their hits, surfaces and light, column by column.
//!
//! Each step is taken for all of them before the next, so that the CPU has independent work while square roots and
//! quotients are computed, and what one step needs stays in registers.

use fearless_simd::Simd;

use super::groups::Groups;
use crate::film::NOTHING;
use crate::lanes::{F, F3, M, U};
use crate::search::{Hits, PrecisePoints};

/// Packets in a chunk.
pub(crate) const CHUNK: usize = 8;

/// The packets of a chunk, column by column.
pub(crate) struct Chunk<S: Simd> {
    /// Indices of their first rays in their batch.
    pub(crate) at: [usize; CHUNK],
    pub(crate) best: [Hits<S>; CHUNK],
    /// Points of their hits, relative to the snapshot's origin.
    pub(crate) point: [F3<S>; CHUNK],
    /// The same in `f64` of lanes that meet meshes.
    pub(crate) on_meshes: [PrecisePoints<S>; CHUNK],
    /// Geometric unit normals on the viewer's side.
    pub(crate) normal: [F3<S>; CHUNK],
    /// Lanes that are seen from the side that the shapes' own normals point to.
    pub(crate) front: [M<S>; CHUNK],
    /// Unit normals to shade with, on the viewer's side, where any shape has others.
    pub(crate) smooth: [F3<S>; CHUNK],
    /// Unit vectors to the viewer, where a material has glossy lobes.
    pub(crate) to_viewer: [F3<S>; CHUNK],
    /// Lanes with hits, by material.
    pub(crate) groups: [Groups; CHUNK],
    /// Lanes whose materials are lit.
    pub(crate) lit: [M<S>; CHUNK],
    /// Whether any material of a packet has glossy lobes.
    pub(crate) glossy: [bool; CHUNK],
    /// Light that arrives from all sides, weighed by the cosine: irradiance.
    pub(crate) irradiance: [F3<S>; CHUNK],
    /// Radiance shown by glossy lobes.
    pub(crate) specular: [F3<S>; CHUNK],
}

impl<S: Simd> Chunk<S> {
    #[inline(always)]
    pub(crate) fn new(s: S) -> Self {
        let zero = F::splat(s, 0.0);
        let dark = F3::splat(zero);
        let (nothing, none) = (U::splat(s, NOTHING), M::splat(s, false));
        Self {
            at: [0; CHUNK],
            best: [Hits { t: zero, error: zero, prim: nothing, facet: nothing }; CHUNK],
            point: [dark; CHUNK],
            on_meshes: [PrecisePoints::none(s); CHUNK],
            normal: [dark; CHUNK],
            front: [none; CHUNK],
            smooth: [dark; CHUNK],
            to_viewer: [dark; CHUNK],
            groups: [const { Groups::NONE }; CHUNK],
            lit: [none; CHUNK],
            glossy: [false; CHUNK],
            irradiance: [dark; CHUNK],
            specular: [dark; CHUNK],
        }
    }
}
