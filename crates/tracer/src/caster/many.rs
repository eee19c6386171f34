//! How are many rays asked about at once?

use catoptra_core::{EntityId, Ray, Span};
use rayon::prelude::*;

use super::column::{Column, Coordinates};
use super::ray::{Leaving, checked_line, checked_span};
use super::{Caster, InvalidRay, InvalidRays, WorldHit, WorldRay};
use crate::rays::{HitList, RAYS_PER_BLOCK, RayList};
use crate::snapshot::RaySegment;
use crate::{Backend, Pool, SurfaceId, backends};

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
    surfaces: Option<&'a [Option<SurfaceId>]>,
    entities: Option<&'a [Option<EntityId>]>,
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
        let rays = Self { origins, directions: of_directions, ends: None, surfaces: None, entities: None };
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
        self.with_column("surfaces to leave", surfaces.len(), Self { surfaces: Some(surfaces), ..self })
    }

    /// The same rays, each leaving an entity or none; see [`WorldRay::leaving_entity`]. A ray that would meet the entity it leaves
    /// is asked about by itself, which takes some times as long.
    ///
    /// # Errors
    /// As many entities as there are rays is what it takes.
    pub fn leaving_entities(self, entities: &'a [Option<EntityId>]) -> Result<Self, InvalidRays> {
        self.with_column("entities to leave", entities.len(), Self { entities: Some(entities), ..self })
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
        let (ray, span) = self.line(at)?;
        let surface = self.surfaces.and_then(|surfaces| surfaces[at]);
        Ok(WorldRay::of_parts(ray, span, Leaving { surface, entity: self.entity_left(at) }))
    }

    fn entity_left(&self, at: usize) -> Option<EntityId> {
        self.entities.and_then(|entities| entities[at])
    }

    /// Which of `count` rays from one on leave an entity, counted from that one.
    fn that_leave_entities(&self, first: usize, count: usize) -> impl Iterator<Item = usize> {
        let entities = self.entities.map_or(&[][..], |entities| &entities[first..first + count]);
        entities.iter().enumerate().filter_map(|(at, entity)| entity.map(|_| at))
    }

    fn line(&self, at: usize) -> Result<(Ray, Span), InvalidRay> {
        let ray = checked_line(self.origins.get(at), self.directions.get(at))?;
        let span = match self.ends {
            Some(ends) => checked_span(ends[at])?,
            None => Span::AHEAD,
        };
        Ok((ray, span))
    }

    /// Puts the rays of a share into a list, block by block.
    fn fill(&self, list: &mut RayList, share: usize) -> Result<(), InvalidRay> {
        let first = share * SHARE;
        let length = SHARE.min(self.len() - first);
        list.make_room(length, self.surfaces.is_some());
        for (number, block) in list.blocks_mut().iter_mut().enumerate() {
            let start = first + number * RAYS_PER_BLOCK;
            let rays = start..(start + RAYS_PER_BLOCK).min(first + length);
            self.origins.put(rays.clone(), &mut block.origin);
            self.directions.put(rays.clone(), &mut block.direction);
            if !block.are_rays(rays.len()) {
                rays.clone().try_for_each(|at| self.line(at).map(drop))?;
            }
            match self.ends {
                None => {
                    let Span { min, max } = Span::AHEAD;
                    (block.min, block.max) = ([min; RAYS_PER_BLOCK], [max; RAYS_PER_BLOCK]);
                }
                Some(ends) => {
                    for (lane, &ends) in ends[rays].iter().enumerate() {
                        let span = checked_span(ends)?;
                        (block.min[lane], block.max[lane]) = (span.min, span.max);
                    }
                }
            }
        }
        if let Some(surfaces) = self.surfaces {
            list.leave(&surfaces[first..first + length]);
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
    /// Those of each share of the rays.
    hits: Vec<HitList>,
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
        self.met(at).map(|(_, t)| t)
    }

    /// Which surface a ray meets first; its facet is the triangle of a mesh. `None` where it meets nothing.
    ///
    /// # Panics
    /// A number that is not below [`len`](Self::len).
    #[must_use]
    pub fn surface(&self, at: usize) -> Option<SurfaceId> {
        self.met(at).map(|(surface, _)| surface)
    }

    /// What a ray meets first; `None` where it meets nothing.
    ///
    /// # Panics
    /// A number that is not below [`len`](Self::len).
    #[must_use]
    pub fn get(&self, at: usize) -> Option<WorldHit> {
        let (surface, t) = self.met(at)?;
        self.caster.hit_on(&self.rays.get(at).ok()?, surface, t)
    }

    fn met(&self, at: usize) -> Option<(SurfaceId, f64)> {
        self.hits[at / SHARE].get(at % SHARE)
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
        let hits = self.answer(rays, pool, |backend, list, first| {
            let mut hits = HitList::default();
            hits.resize(list.len());
            backend.find_nearest(&self.snapshot, list.as_slice(), &mut hits.as_slice());
            for at in rays.that_leave_entities(first, list.len()) {
                let left = self.prim_left(rays.entity_left(first + at));
                if hits.get(at).is_some_and(|(surface, _)| Some(surface.prim) == left) {
                    let hit = self.alone(rays, first + at, |segment| self.snapshot.nearest_on(segment));
                    hits.as_slice().set(at, hit.flatten().map(|hit| (hit.surface, hit.crossing.t)));
                }
            }
            hits
        })?;
        Ok(RayHits { caster: self, rays: *rays, hits })
    }

    /// Whether each of many rays meets anything, on the threads of `pool`, by vector instructions.
    ///
    /// # Errors
    /// The first of them that is no ray.
    pub fn any_many(&self, rays: &RayColumns<'_>, pool: &Pool) -> Result<Vec<bool>, InvalidRays> {
        let met = self.answer(rays, pool, |backend, list, first| {
            let mut met = vec![false; list.len()];
            backend.find_occluded(&self.snapshot, list.as_slice(), &mut met);
            for at in rays.that_leave_entities(first, list.len()) {
                let others = |segment: &RaySegment<'_>| self.snapshot.is_occluded_on(segment);
                met[at] = met[at] && self.alone(rays, first + at, others) == Some(true);
            }
            met
        })?;
        Ok(met.concat())
    }

    /// Asks about one of them by itself.
    fn alone<T>(
        &self,
        rays: &RayColumns<'_>,
        at: usize,
        search: impl FnOnce(&RaySegment<'_>) -> T,
    ) -> Option<T> {
        Some(self.follow(&rays.get(at).ok()?, search))
    }

    /// Asks about each share of the rays, by the fastest backend, with the number of its first: the answers of each share.
    ///
    /// Shares have memory of their own, which one call leaves to the next; one stretch for all would be new each time.
    fn answer<T: Send>(
        &self,
        rays: &RayColumns<'_>,
        pool: &Pool,
        ask: impl Fn(&dyn Backend, &RayList, usize) -> T + Sync + Send,
    ) -> Result<Vec<T>, InvalidRays> {
        let backend = backends()[0];
        let answer = |list: &mut RayList, share: usize| {
            rays.fill(list, share)?;
            Ok(ask(backend, &list.in_place(&self.snapshot), share * SHARE))
        };
        let shares = (0..rays.len().div_ceil(SHARE)).into_par_iter();
        let answered: Result<Vec<T>, _> = pool.run(|| shares.map_init(RayList::new, answer).collect());
        answered.map_err(|cause| rays.first_wrong(cause))
    }
}
