//! Lists of rays that a caller supplies and of their hits, in blocks of columns.

use std::borrow::Cow;

use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Span};

use crate::film::NOTHING;
use crate::lanes::prefetch;
use crate::snapshot::RaySegment;
use crate::{Hit, Snapshot, Stats, SurfaceId};

/// Rays of a block, and the whole groups that columns of answers hold: a packet of any width is one stretch of them.
pub(crate) const RAYS_PER_BLOCK: usize = 16;

/// Rays side by side, number by number. All that a packet reads lies together: memory is read in one stream.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(crate) struct RayBlock {
    pub(crate) origin: [[f64; RAYS_PER_BLOCK]; 3],
    pub(crate) direction: [[f64; RAYS_PER_BLOCK]; 3],
    pub(crate) min: [f64; RAYS_PER_BLOCK],
    pub(crate) max: [f64; RAYS_PER_BLOCK],
}

impl RayBlock {
    const EMPTY: Self = Self {
        origin: [[0.0; RAYS_PER_BLOCK]; 3],
        direction: [[0.0; RAYS_PER_BLOCK]; 3],
        min: [0.0; RAYS_PER_BLOCK],
        max: [0.0; RAYS_PER_BLOCK],
    };
}

/// Rays of the world in `f64`, each with a closed span `min <= t <= max` that is searched; `t` counts in lengths of the
/// ray's direction.
///
/// What lies behind the origin is never met, so a negative `min` counts as 0. A ray that is not
/// [valid](Ray::is_valid), and a stretch whose ends are not in order, meet nothing.
#[derive(Debug, Clone, Default)]
pub struct RayList {
    length: usize,
    blocks: Vec<RayBlock>,
    /// The surfaces that rays leave; empty where no ray leaves a surface.
    pub(crate) prim: Vec<u32>,
    pub(crate) facet: Vec<u32>,
}

impl RayList {
    /// No rays.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// How many rays there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.length
    }

    /// Whether there is no ray.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Takes all rays out and keeps the room.
    pub(crate) fn clear(&mut self) {
        self.length = 0;
        self.blocks.clear();
        self.prim.clear();
        self.facet.clear();
    }

    /// Appends a ray of the world to be searched on `min <= t <= max`. It may leave a surface, which it does not meet
    /// again at its origin.
    pub fn push(&mut self, ray: &Ray, [min, max]: [f64; 2], leaving: Option<SurfaceId>) {
        let (block, lane) = (self.length / RAYS_PER_BLOCK, self.length % RAYS_PER_BLOCK);
        if lane == 0 {
            self.blocks.push(RayBlock::EMPTY);
            if !self.prim.is_empty() {
                self.make_room_for_surfaces();
            }
        }
        let rays = &mut self.blocks[block];
        for axis in 0..3 {
            rays.origin[axis][lane] = ray.origin[axis];
            rays.direction[axis][lane] = ray.direction[axis];
        }
        (rays.min[lane], rays.max[lane]) = (min, max);
        if let Some(surface) = leaving {
            self.make_room_for_surfaces();
            (self.prim[self.length], self.facet[self.length]) = (surface.prim, surface.facet);
        }
        self.length += 1;
    }

    /// The same rays, of which each leaves the surface that is met where it leaves one.
    pub(crate) fn from_places(&self, snapshot: &Snapshot) -> Cow<'_, Self> {
        if self.prim.is_empty() || !snapshot.has_doubles() {
            return Cow::Borrowed(self);
        }
        let mut rays = self.clone();
        for (prim, facet) in rays.prim.iter_mut().zip(&mut rays.facet).filter(|(prim, _)| **prim != NOTHING) {
            let there = snapshot.surface_in_place(SurfaceId { prim: *prim, facet: *facet });
            (*prim, *facet) = (there.prim, there.facet);
        }
        Cow::Owned(rays)
    }

    fn make_room_for_surfaces(&mut self) {
        let room = self.blocks.len() * RAYS_PER_BLOCK;
        self.prim.resize(room, NOTHING);
        self.facet.resize(room, 0);
    }

    /// At most `length` rays from ray `first` on, which begins a block.
    pub(crate) fn part(&self, first: usize, length: usize) -> RaySlice<'_> {
        RaySlice { rays: self, first, length: length.min(self.length - first) }
    }

    /// All of them.
    #[must_use]
    pub fn as_slice(&self) -> RaySlice<'_> {
        RaySlice { rays: self, first: 0, length: self.length }
    }
}

/// Some rays of a list, from the start of a block on.
#[derive(Debug, Clone, Copy)]
pub struct RaySlice<'a> {
    pub(crate) rays: &'a RayList,
    pub(crate) first: usize,
    length: usize,
}

impl RaySlice<'_> {
    /// How many rays there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.length
    }

    /// Whether there is no ray.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// A ray of the world.
    ///
    /// # Panics
    /// A number that is not below [`len`](Self::len).
    #[must_use]
    #[inline]
    pub fn ray(&self, at: usize) -> Ray {
        assert!(at < self.length, "ray {at} of {}", self.length);
        let (rays, lane) = self.block(at);
        let vector = |[x, y, z]: &[[f64; RAYS_PER_BLOCK]; 3]| DVec3::new(x[lane], y[lane], z[lane]);
        Ray::new(vector(&rays.origin), vector(&rays.direction))
    }

    /// The span that a ray is searched on; `None` where it is empty.
    ///
    /// # Panics
    /// A number that is not below [`len`](Self::len).
    #[must_use]
    #[inline]
    pub fn span(&self, at: usize) -> Option<Span> {
        assert!(at < self.length, "ray {at} of {}", self.length);
        let (rays, lane) = self.block(at);
        let (min, max) = (rays.min[lane], rays.max[lane]);
        (min <= max && max >= 0.0).then(|| Span { min: min.max(0.0), max })
    }

    /// The surface that a ray leaves.
    ///
    /// # Panics
    /// A number that is not below [`len`](Self::len).
    #[must_use]
    #[inline]
    pub fn leaving(&self, at: usize) -> Option<SurfaceId> {
        assert!(at < self.length, "ray {at} of {}", self.length);
        let prim = *self.rays.prim.get(self.first + at)?;
        (prim != NOTHING).then(|| SurfaceId { prim, facet: self.rays.facet[self.first + at] })
    }

    /// The block that holds a ray, and its index there.
    #[inline(always)]
    pub(crate) fn block(&self, at: usize) -> (&RayBlock, usize) {
        let at = self.first + at;
        (&self.rays.blocks[at / RAYS_PER_BLOCK], at % RAYS_PER_BLOCK)
    }

    /// Prefetches the block that holds a ray.
    #[inline(always)]
    pub(crate) fn prefetch(&self, at: usize) {
        if let Some(first) = self.rays.blocks.first() {
            prefetch::<RayBlock, f64>(&first.origin[0], (self.first + at) / RAYS_PER_BLOCK);
        }
    }

    /// Asks about a ray, unless it can meet nothing: in the snapshot's frame, or where that rounds it, in the world.
    pub(crate) fn follow<T>(
        &self,
        snapshot: &Snapshot,
        at: usize,
        search: impl Fn(&RaySegment<'_>) -> Option<T>,
    ) -> Option<T> {
        let ray = self.ray(at);
        let (span, leaving) = (self.span(at)?, self.leaving(at));
        if ray.is_valid() { snapshot.follow(&ray, span, leaving, search) } else { None }
    }

    /// Answers ray by ray whether anything is met.
    pub(crate) fn ask(
        &self,
        snapshot: &Snapshot,
        answers: &mut [bool],
        search: impl Fn(&RaySegment<'_>) -> bool,
    ) -> Stats {
        for (at, answer) in answers.iter_mut().enumerate().take(self.length) {
            *answer = self.follow(snapshot, at, |segment| search(segment).then_some(())).is_some();
        }
        Stats::default()
    }
}

/// What each ray of a list meets first.
#[derive(Debug, Clone, Default)]
pub struct HitList {
    length: usize,
    pub(crate) prim: Vec<u32>,
    pub(crate) facet: Vec<u32>,
    pub(crate) t: Vec<f64>,
}

impl HitList {
    /// How many rays were searched.
    #[must_use]
    pub fn len(&self) -> usize {
        self.length
    }

    /// Whether there was none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// What a ray meets first: where, and at which `t` in lengths of its direction. `None` where it meets nothing.
    ///
    /// The surface is the right one. `t` is computed in `f64`: the parameter of the plane or sphere it belongs to.
    ///
    /// # Panics
    /// A number that is not below [`len`](Self::len).
    #[must_use]
    pub fn get(&self, at: usize) -> Option<(SurfaceId, f64)> {
        assert!(at < self.length, "ray {at} of {}", self.length);
        let prim = self.prim[at];
        (prim != NOTHING).then(|| (SurfaceId { prim, facet: self.facet[at] }, self.t[at]))
    }

    /// Makes room for the hits of `length` rays.
    pub(crate) fn resize(&mut self, length: usize) {
        let room = length.next_multiple_of(RAYS_PER_BLOCK);
        self.length = length;
        self.prim.resize(room, NOTHING);
        self.facet.resize(room, 0);
        self.t.resize(room, 0.0);
    }
}

/// Columns for the hits of some rays, in whole blocks.
#[derive(Debug)]
pub struct HitSlice<'a> {
    pub(crate) prim: &'a mut [u32],
    pub(crate) facet: &'a mut [u32],
    pub(crate) t: &'a mut [f64],
}

impl HitSlice<'_> {
    /// Answers about one ray.
    ///
    /// # Panics
    /// A number past the room.
    pub fn set(&mut self, at: usize, hit: Option<(SurfaceId, f64)>) {
        let (surface, t) = hit.unwrap_or((SurfaceId { prim: NOTHING, facet: 0 }, 0.0));
        (self.prim[at], self.facet[at], self.t[at]) = (surface.prim, surface.facet, t);
    }

    /// Answers ray by ray what is met first.
    pub(crate) fn fill(
        &mut self,
        snapshot: &Snapshot,
        rays: RaySlice<'_>,
        search: impl Fn(&RaySegment<'_>) -> Option<Hit>,
    ) -> Stats {
        for at in 0..rays.len() {
            let hit = rays.follow(snapshot, at, &search);
            self.set(at, hit.map(|hit| (hit.surface, hit.crossing.t)));
        }
        Stats::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_gives_back_what_was_put_in() {
        let mut rays = RayList::new();
        let surface = SurfaceId { prim: 3, facet: 4 };
        for i in 0..200 {
            let ray = Ray::new(DVec3::splat(f64::from(i)), DVec3::X);
            rays.push(&ray, [0.5, 2.0], (i == 100).then_some(surface));
        }
        assert_eq!(rays.as_slice().ray(199).origin, DVec3::splat(199.0));
        assert_eq!(rays.as_slice().leaving(100), Some(surface));
        assert_eq!(rays.as_slice().leaving(101), None);
        assert!(rays.as_slice().span(7).unwrap().contains(0.5));
    }

    #[test]
    fn ends_out_of_order_are_no_stretch() {
        let mut rays = RayList::new();
        for ends in [[1.0, 0.5], [f64::NAN, 1.0], [0.0, f64::NAN], [-2.0, -1.0]] {
            rays.push(&Ray::new(DVec3::ZERO, DVec3::X), ends, None);
        }
        assert!((0..4).all(|at| rays.as_slice().span(at).is_none()));
    }
}
