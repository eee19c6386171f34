//! Batched ray queries: closest hit and occlusion for rays the caller supplies.
//!
//! The answers are those of pictures: a backend searches with the code that it renders with.

use rayon::prelude::*;

use crate::rays::RAYS_PER_BLOCK;
pub use crate::rays::{HitList, HitSlice, RayList, RaySlice};
use crate::{Backend, Pool, Snapshot, Stats};

/// Rays handed to a thread in one go.
const SHARE: usize = 256 * RAYS_PER_BLOCK;

/// Finds the closest hit of each ray, on the threads of `pool`. The answers do not depend on their number.
pub fn find_nearest(
    backend: &dyn Backend,
    snapshot: &Snapshot,
    rays: &RayList,
    hits: &mut HitList,
    pool: &Pool,
) -> Stats {
    let rays = &*rays.in_place(snapshot);
    hits.resize(rays.len());
    let HitList { prim, facet, t, .. } = hits;
    let shares = prim.par_chunks_mut(SHARE).zip(facet.par_chunks_mut(SHARE)).zip(t.par_chunks_mut(SHARE));
    let answer = |(number, ((prim, facet), t))| {
        let mut hits = HitSlice { prim, facet, t };
        Stats::with_exact(|| backend.find_nearest(snapshot, share(rays, number), &mut hits))
    };
    pool.run(|| shares.enumerate().map(answer).reduce(Stats::default, sum))
}

/// Asks for each ray whether it meets anything, on the threads of `pool`.
pub fn find_occluded(
    backend: &dyn Backend,
    snapshot: &Snapshot,
    rays: &RayList,
    occluded: &mut Vec<bool>,
    pool: &Pool,
) -> Stats {
    let rays = &*rays.in_place(snapshot);
    occluded.resize(rays.len(), false);
    let answer = |(number, occluded): (usize, &mut [bool])| {
        Stats::with_exact(|| backend.find_occluded(snapshot, share(rays, number), occluded))
    };
    pool.run(|| occluded.par_chunks_mut(SHARE).enumerate().map(answer).reduce(Stats::default, sum))
}

fn share(rays: &RayList, number: usize) -> RaySlice<'_> {
    rays.part(number * SHARE, SHARE)
}

fn sum(mut a: Stats, b: Stats) -> Stats {
    a += b;
    a
}
