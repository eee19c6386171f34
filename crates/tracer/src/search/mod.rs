//! Searches a snapshot with packets of rays: closest hits, occlusion, and the exact points and normals at hits.

mod closest;
mod exact_resolver;
mod hits;
mod mesh;
mod mesh_occluded;
mod occluded;
mod own_segments;
mod packet;
pub(crate) mod query;
mod refine;
mod self_hit;
mod surface;
mod to_light;
mod to_points;
mod together;
mod view_cones;
mod walk;

use fearless_simd::Simd;

use crate::kernel::mesh::Visits;
use crate::{Snapshot, Stats};

pub(crate) use hits::{HitColumns, Hits};
pub(crate) use occluded::{ShadowRays, Shadows};
pub(crate) use own_segments::OwnSegments;
pub(crate) use packet::{Packet, PreciseRays, drift, kernel_rays, nearly_unit_rays};
pub(crate) use refine::Refined;
pub(crate) use surface::{PrecisePoints, Surface};
pub(crate) use to_light::ToLight;
pub(crate) use to_points::ToPoints;
pub(crate) use together::{BundleRoom, Later, bundle_room};
pub(crate) use view_cones::ViewCones;

/// Searches a snapshot with packets of rays.
pub(crate) struct Searcher<'a, S: Simd> {
    pub(crate) s: S,
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) stats: Stats,
    /// Stacks for walks through trees of meshes.
    pub(crate) visits: &'a mut Visits,
    /// Meshes that packets are to walk together.
    pub(crate) later: Later,
    /// Where the rays of a packet meet meshes.
    pub(crate) on_meshes: PrecisePoints<S>,
    /// Whether every ray stays outside all convex solids.
    pub(crate) outside: bool,
}

impl<'a, S: Simd> Searcher<'a, S> {
    /// That has searched nothing yet; `outside` where every ray stays outside all convex solids.
    pub(crate) fn new(s: S, snapshot: &'a Snapshot, visits: &'a mut Visits, outside: bool) -> Self {
        let on_meshes = PrecisePoints::none(s);
        Self { s, snapshot, stats: Stats::default(), visits, later: Later::default(), on_meshes, outside }
    }
}
