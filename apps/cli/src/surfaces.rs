//! What do rays of the world meet: which thing, where, and which way does its surface look?

use catoptra_core::glam::DVec3;
use catoptra_core::material::Matte;
use catoptra_core::{EntityId, Ray, Rgb, Scene, Shape};
use catoptra_tracer::query::{HitList, RayList, find_nearest};
use catoptra_tracer::{Backend, Caster, Pool, Region, Size, Snapshot, SurfaceId, View, WorldHit, WorldRay};
use miette::{IntoDiagnostic, Result};

/// 1 where a ray of that direction comes from the outer side of what it meets, else -1.
pub(crate) fn side(hit: &WorldHit, direction: DVec3) -> f64 {
    if hit.normal.dot(direction) > 0.0 { -1.0 } else { 1.0 }
}

/// A snapshot of one shape.
pub(crate) fn snapshot_of(shape: Shape, pool: &Pool) -> Result<Snapshot> {
    let mut scene = Scene::new();
    let grey = Matte::new(Rgb::grey(0.5)).into_diagnostic()?;
    let grey = scene.add_material("grey", grey).into_diagnostic()?;
    scene.add_shape("shape", shape, grey, None).into_diagnostic()?;
    Ok(Snapshot::extract(&scene, pool))
}

/// What the rays through the middles of a picture's pixels meet first.
pub(crate) struct Surfaces<'a> {
    snapshot: &'a Snapshot,
    view: &'a View,
    region: Region,
    surface: Vec<SurfaceId>,
    t: Vec<f64>,
}

/// Stands for nothing.
const NOTHING: SurfaceId = SurfaceId { prim: u32::MAX, facet: 0 };

/// Rays that are asked about in one go.
const AT_ONCE: usize = 1 << 18;

impl<'a> Surfaces<'a> {
    /// Asks about every pixel that a view shows.
    ///
    /// # Errors
    /// Memory that is not there.
    pub(crate) fn seen(
        backend: &dyn Backend,
        snapshot: &'a Snapshot,
        view: &'a View,
        pool: &Pool,
    ) -> Result<Self> {
        let region = view.region();
        let mut found = Self { snapshot, view, region, surface: Vec::new(), t: Vec::new() };
        found.surface.try_reserve_exact(region.size.pixels()).into_diagnostic()?;
        found.t.try_reserve_exact(region.size.pixels()).into_diagnostic()?;
        let rows = (AT_ONCE / (region.size.width.max(1) as usize)).max(1);
        for first in (0..region.size.height).step_by(rows) {
            let last = region.size.height.min(first.saturating_add(rows as u32));
            let (mut rays, mut hits) = (RayList::new(), HitList::default());
            for (x, y) in (first..last).flat_map(|y| (0..region.size.width).map(move |x| (x, y))) {
                rays.push(&found.ray(x, y), [0.0, f64::INFINITY], None);
            }
            find_nearest(backend, snapshot, &rays, &mut hits, pool);
            for (surface, t) in (0..rays.len()).map(|at| hits.get(at).unwrap_or((NOTHING, f64::INFINITY))) {
                found.surface.push(surface);
                found.t.push(t);
            }
        }
        Ok(found)
    }

    /// Bytes that it takes.
    pub(crate) fn bytes_of(size: Size) -> u64 {
        size.pixels() as u64 * (size_of::<SurfaceId>() + size_of::<f64>()) as u64
    }

    /// The ray through the middle of a pixel, counted from the corner of what is seen.
    pub(crate) fn ray(&self, x: u32, y: u32) -> Ray {
        let middle = |from: u32, at: u32| f64::from(from + at) + 0.5;
        let (x, y) = (middle(self.region.x, x), middle(self.region.y, y));
        self.view.camera.ray(x, y, self.view.size.width, self.view.size.height)
    }

    fn at(&self, x: u32, y: u32) -> usize {
        y as usize * self.region.size.width as usize + x as usize
    }

    /// What it meets, by a caster over the same snapshot.
    pub(crate) fn met(&self, caster: &Caster, x: u32, y: u32) -> Option<WorldHit> {
        let (at, Ray { origin, direction, .. }) = (self.at(x, y), self.ray(x, y));
        let surface = *self.surface.get(at).filter(|surface| **surface != NOTHING)?;
        caster.hit_on(&WorldRay::new(origin, direction).ok()?, surface, self.t[at])
    }

    /// Which thing that is.
    pub(crate) fn entity(&self, x: u32, y: u32) -> Option<EntityId> {
        self.snapshot.entities().get(self.surface.get(self.at(x, y))?.prim as usize).copied()
    }

    /// Metres from the ray's start to it; infinite where it meets nothing.
    pub(crate) fn distance(&self, x: u32, y: u32) -> f64 {
        self.t[self.at(x, y)] * self.ray(x, y).direction.length()
    }

    /// All rays that meet something, with what and where.
    pub(crate) fn sightings(&self) -> impl Iterator<Item = (Ray, SurfaceId, f64)> {
        let width = self.region.size.width.max(1) as usize;
        let met =
            self.surface.iter().zip(&self.t).enumerate().filter(|(_, (surface, _))| **surface != NOTHING);
        met.map(move |(at, (surface, t))| (self.ray((at % width) as u32, (at / width) as u32), *surface, *t))
    }

    /// All things that are met, each once, in the order of their ids.
    pub(crate) fn entities(&self) -> Vec<EntityId> {
        let mut prims: Vec<u32> = self.surface.iter().map(|surface| surface.prim).collect();
        prims.sort_unstable();
        prims.dedup();
        prims.iter().filter_map(|prim| self.snapshot.entities().get(*prim as usize).copied()).collect()
    }
}
