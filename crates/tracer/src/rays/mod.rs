//! Lists of rays that a caller supplies and of their hits, in blocks of columns.

mod hits;

use std::borrow::Cow;

use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Span};

use crate::film::NOTHING;
use crate::lanes::prefetch;
use crate::snapshot::RaySegment;
use crate::{Snapshot, Stats, SurfaceId};

pub use hits::{HitList, HitSlice};

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

    /// Whether the first `count` are rays: finite, along some direction.
    pub(crate) fn are_rays(&self, count: usize) -> bool {
        // Zero times what is not finite is no number, which no sum gets rid of.
        let mut no_number = [0.0; RAYS_PER_BLOCK];
        let mut is_zero = [true; RAYS_PER_BLOCK];
        for axis in 0..3 {
            for lane in 0..RAYS_PER_BLOCK {
                no_number[lane] += 0.0 * self.origin[axis][lane] + 0.0 * self.direction[axis][lane];
                is_zero[lane] &= self.direction[axis][lane] == 0.0;
            }
        }
        (0..count).all(|lane| no_number[lane] == 0.0 && !is_zero[lane])
    }
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

    /// Holds so many rays from now on, which are to be written into its [blocks](Self::blocks_mut); keeps the memory that it has.
    pub(crate) fn make_room(&mut self, length: usize, leaving: bool) {
        self.length = length;
        self.blocks.resize(length.div_ceil(RAYS_PER_BLOCK), RayBlock::EMPTY);
        self.prim.clear();
        self.facet.clear();
        if leaving {
            self.make_room_for_surfaces();
        }
    }

    /// The blocks, the last of them with room to spare.
    pub(crate) fn blocks_mut(&mut self) -> &mut [RayBlock] {
        &mut self.blocks
    }

    /// Names the surfaces that rays leave, from the first on, where there is [room](Self::make_room) for them.
    pub(crate) fn leave(&mut self, surfaces: &[Option<SurfaceId>]) {
        for (at, surface) in surfaces.iter().enumerate() {
            if let Some(surface) = surface {
                (self.prim[at], self.facet[at]) = (surface.prim, surface.facet);
            }
        }
    }

    /// Names a ray that there is room for.
    fn set(&mut self, at: usize, ray: &Ray, [min, max]: [f64; 2], leaving: Option<SurfaceId>) {
        let lane = at % RAYS_PER_BLOCK;
        let rays = &mut self.blocks[at / RAYS_PER_BLOCK];
        for axis in 0..3 {
            rays.origin[axis][lane] = ray.origin[axis];
            rays.direction[axis][lane] = ray.direction[axis];
        }
        (rays.min[lane], rays.max[lane]) = (min, max);
        if let Some(surface) = leaving {
            (self.prim[at], self.facet[at]) = (surface.prim, surface.facet);
        }
    }

    /// Appends a ray of the world to be searched on `min <= t <= max`. It may leave a surface, which it does not meet
    /// again at its origin.
    pub fn push(&mut self, ray: &Ray, [min, max]: [f64; 2], leaving: Option<SurfaceId>) {
        if self.length.is_multiple_of(RAYS_PER_BLOCK) {
            self.blocks.push(RayBlock::EMPTY);
        }
        if leaving.is_some() || !self.prim.is_empty() {
            self.make_room_for_surfaces();
        }
        self.set(self.length, ray, [min, max], leaving);
        self.length += 1;
    }

    /// The same rays, of which each leaves the surface that is met where it leaves one.
    pub(crate) fn in_place(&self, snapshot: &Snapshot) -> Cow<'_, Self> {
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
