//! How are many rays asked about at once?

use catoptra_core::{Crossing, Ray, Span};
use rayon::prelude::*;

use super::column::{Column, Coordinates};
use super::ray::{checked_line, checked_span};
use super::{Caster, InvalidRay, InvalidRays, WorldHit, WorldRay};
use crate::rays::{HitList, HitSlice, RAYS_PER_BLOCK, RayList};
use crate::snapshot::{Hit, RaySegment};
use crate::{Backend, Pool, Stats, SurfaceId, backends};

/// Rays that a thread prepares and asks about in one go: 256 KiB of them, few enough to stay in its second-level cache.
const SHARE: usize = 256 * RAYS_PER_BLOCK;

/// Rays of the world side by side, in columns that someone else holds.
///
/// ```
/// use catoptra_tracer::{Caster, Pool, RayColumns};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let caster = Caster::from_triangles(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]])?;
/// let (origins, down) = ([[0.2, 0.2, 5.0], [0.9, 0.9, 5.0]], [[0.0, 0.0, -1.0]; 2]);
/// let rays = RayColumns::new(&origins, &down)?;
/// let hits = caster.nearest_many(&rays, Pool::shared()?)?;
/// assert_eq!((hits.t(0), hits.t(1)), (Some(5.0), None));
/// assert_eq!(caster.any_many(&rays, Pool::shared()?)?, [true, false]);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Copy)]
pub struct RayColumns<'a> {
    origins: Column<'a>,
    directions: Column<'a>,
    ends: Option<&'a [[f64; 2]]>,
    leaving: Option<&'a [Option<SurfaceId>]>,
}

impl<'a> RayColumns<'a> {
    /// From points in metres along directions of any length; of each ray all that lies in front of its origin counts.
    ///
    /// # Errors
    /// Columns of different lengths.
    pub fn new(
        origins: &'a [impl Coordinates],
        directions: &'a [impl Coordinates],
    ) -> Result<Self, InvalidRays> {
        let (origins, of_directions) = (Coordinates::column(origins), Coordinates::column(directions));
        let rays = Self { origins, directions: of_directions, ends: None, leaving: None };
        rays.with_column("directions", directions.len(), rays)
    }

    /// The same rays, of which only `[min, max]` counts, in lengths of the direction; see [`WorldRay::within`].
    ///
    /// # Errors
    /// As many ends as there are rays is what it takes.
    pub fn within(self, ends: &'a [[f64; 2]]) -> Result<Self, InvalidRays> {
        self.with_column("stretches", ends.len(), Self { ends: Some(ends), ..self })
    }

    /// The same rays, each leaving a surface or none; see [`WorldRay::leaving`].
    ///
    /// # Errors
    /// As many surfaces as there are rays is what it takes.
    pub fn leaving(self, surfaces: &'a [Option<SurfaceId>]) -> Result<Self, InvalidRays> {
        self.with_column("surfaces to leave", surfaces.len(), Self { leaving: Some(surfaces), ..self })
    }

    fn with_column(&self, what: &'static str, others: usize, with: Self) -> Result<Self, InvalidRays> {
        let origins = self.origins.len();
        if others == origins { Ok(with) } else { Err(InvalidRays::Lengths { origins, what, others }) }
    }

    /// How many rays there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.origins.len()
    }

    /// Whether there is no ray.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One of the rays.
    ///
    /// # Errors
    /// What is no ray.
    ///
    /// # Panics
    /// A number that is not below [`len`](Self::len).
    pub fn get(&self, at: usize) -> Result<WorldRay, InvalidRay> {
        let (ray, span, leaving) = self.parts(at)?;
        Ok(WorldRay::of_parts(ray, span, leaving))
    }

    #[inline(always)]
    fn parts(&self, at: usize) -> Result<(Ray, Span, Option<SurfaceId>), InvalidRay> {
        let ray = checked_line(self.origins.get(at), self.directions.get(at))?;
        let span = match self.ends {
            Some(ends) => checked_span(ends[at])?,
            None => Span::AHEAD,
        };
        Ok((ray, span, self.leaving.and_then(|surfaces| surfaces[at])))
    }

    /// Puts the rays of a share into a list.
    fn fill(&self, list: &mut RayList, share: usize) -> Result<(), InvalidRay> {
        let first = share * SHARE;
        list.make_room(SHARE.min(self.len() - first), self.leaving.is_some());
        for at in 0..list.len() {
            let (ray, span, leaving) = self.parts(first + at)?;
            list.set(at, &ray, [span.min, span.max], leaving);
        }
        Ok(())
    }

    /// The first of them that is no ray, when it is known that there is one.
    fn first_wrong(&self, cause: InvalidRay) -> InvalidRays {
        let wrong = (0..self.len()).find_map(|at| Some((at, self.get(at).err()?)));
        let (at, cause) = wrong.unwrap_or((0, cause));
        InvalidRays::Ray { at, cause }
    }
}

/// What each of many rays meets first; points, normals and texture coordinates are worked out when they are asked for.
#[derive(Debug)]
pub struct RayHits<'a> {
    caster: &'a Caster,
    rays: RayColumns<'a>,
    hits: HitList,
}

impl RayHits<'_> {
    /// How many rays were asked about.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rays.len()
    }

    /// Whether there was none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rays.is_empty()
    }

    /// How far along a ray its first hit lies, in lengths of its direction; `None` where it meets nothing.
    ///
    /// # Panics
    /// A number that is not below [`len`](Self::len).
    #[must_use]
    pub fn t(&self, at: usize) -> Option<f64> {
        self.hits.get(at).map(|(_, t)| t)
    }

    /// Which surface a ray meets first; its facet is the triangle of a mesh. `None` where it meets nothing.
    ///
    /// # Panics
    /// A number that is not below [`len`](Self::len).
    #[must_use]
    pub fn surface(&self, at: usize) -> Option<SurfaceId> {
        self.hits.get(at).map(|(surface, _)| surface)
    }

    /// What a ray meets first; `None` where it meets nothing.
    ///
    /// # Panics
    /// A number that is not below [`len`](Self::len).
    #[must_use]
    pub fn get(&self, at: usize) -> Option<WorldHit> {
        let (surface, t) = self.hits.get(at)?;
        let ray = self.rays.get(at).ok()?;
        let on = |segment: &RaySegment<'_>| self.caster.snapshot.crossing_on(segment, surface, t);
        let crossing = Crossing { t, ..self.caster.follow(&ray, on)? };
        Some(self.caster.told(&ray, &Hit { surface, crossing }))
    }

    /// What each ray meets first, in their order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Option<WorldHit>> + '_ {
        (0..self.len()).map(|at| self.get(at))
    }
}

impl Caster {
    /// What each of many rays meets first, on the threads of `pool`, by vector instructions. The answers are those of
    /// [`nearest`](Self::nearest), but for the last bits of `t`; they do not depend on the number of threads.
    ///
    /// # Errors
    /// The first of them that is no ray.
    pub fn nearest_many<'a>(
        &'a self,
        rays: &RayColumns<'a>,
        pool: &Pool,
    ) -> Result<RayHits<'a>, InvalidRays> {
        let mut hits = HitList::default();
        hits.resize(rays.len());
        let HitList { prim, facet, t, .. } = &mut hits;
        let shares = prim.par_chunks_mut(SHARE).zip(facet.par_chunks_mut(SHARE)).zip(t.par_chunks_mut(SHARE));
        self.answer(rays, pool, shares, |backend, list, ((prim, facet), t)| {
            let mut hits = HitSlice { prim, facet, t };
            backend.find_nearest(&self.snapshot, list.as_slice(), &mut hits)
        })?;
        Ok(RayHits { caster: self, rays: *rays, hits })
    }

    /// Whether each of many rays meets anything, on the threads of `pool`, by vector instructions.
    ///
    /// # Errors
    /// The first of them that is no ray.
    pub fn any_many(&self, rays: &RayColumns<'_>, pool: &Pool) -> Result<Vec<bool>, InvalidRays> {
        let mut met = vec![false; rays.len()];
        self.answer(rays, pool, met.par_chunks_mut(SHARE), |backend, list, met| {
            backend.find_occluded(&self.snapshot, list.as_slice(), met)
        })?;
        Ok(met)
    }

    /// Asks about each share of the rays, by the fastest backend, and keeps the answers.
    fn answer<T: Send>(
        &self,
        rays: &RayColumns<'_>,
        pool: &Pool,
        shares: impl IndexedParallelIterator<Item = T>,
        ask: impl Fn(&dyn Backend, &RayList, T) -> Stats + Sync + Send,
    ) -> Result<(), InvalidRays> {
        let backend = backends()[0];
        let answer = |list: &mut RayList, (share, answers): (usize, T)| {
            rays.fill(list, share)?;
            ask(backend, &list.in_place(&self.snapshot), answers);
            Ok(())
        };
        let answered = pool.run(|| shares.enumerate().try_for_each_init(RayList::new, answer));
        answered.map_err(|cause| rays.first_wrong(cause))
    }
}
