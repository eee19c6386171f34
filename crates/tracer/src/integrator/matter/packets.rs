//! Paths through a tile, all of its pixels side by side: packets of rays find what is met, bounce by bounce, and what light does
//! there is worked out point by point in `f64`.
//!
//! Rays are kept in the order of those that they come from, so that sums of light do not depend on how many lanes there are.

use std::cell::RefCell;

use catoptra_core::{Ray, RayStart, Rgb, Span};
use fearless_simd::{Level, Simd};

use super::{Bounce, Media, Numbers, PathRay};
use crate::cull::{Candidates, Frustum};
use crate::film::{NOTHING, store_finite};
use crate::integrator::pixels::show_pieces;
use crate::integrator::walker::Walker;
use crate::integrator::{Integrate, Trees};
use crate::kernel::mesh::Visits;
use crate::lanes::{F, Work, at_level, outlined};
use crate::sample::Sample;
use crate::search::{HitColumns, PreciseRays, Searcher, bundle_room};
use crate::stream::{Batch, CameraPackets, CameraRays, Part, Queue};
use crate::{Frame, Hit, Instructions, Region, Size, Stats, SurfaceId, Tile};

/// Traces all pixels of a tile.
pub(in crate::integrator) fn trace_tile<I: Integrate + Bounce>(frame: &Frame<'_>, tile: &mut Tile) -> Stats {
    let level = frame.view.instructions.map_or_else(Level::new, Instructions::level);
    let mut walker = Walker::new(&Trees, frame);
    ROOM.with_borrow_mut(|room| {
        for number in frame.view.traced_samples() {
            let sample = Sample::new(frame.view, number);
            trace_sample::<I>(level, &mut walker, &sample, tile, room);
            tile.take_sample(number, frame.view);
        }
    });
    if let Some(edges) = frame.edges {
        show_pieces::<I, Trees>(&mut walker, edges, tile);
    }
    walker.stats
}

thread_local! {
    /// Room for what a tile needs, kept from tile to tile.
    static ROOM: RefCell<Room> = RefCell::default();
}

#[derive(Default)]
struct Room {
    camera: CameraRays,
    queue: Queue,
    found: HitColumns,
    visits: Visits,
    /// Every shape, and those that the tile may show.
    candidates: [Candidates; 2],
    /// The rays of a bounce and their hits, pixel by pixel.
    rays: Vec<TileRay>,
    next: Vec<TileRay>,
    hits: Vec<FoundHit>,
    /// The light of the sample under way, pixel by pixel.
    light: Vec<Rgb>,
}

/// A ray, and the place of its pixel in the tile's columns.
struct TileRay {
    path: PathRay,
    pixel: u32,
}

/// What a packet has found for a ray.
#[derive(Clone, Copy)]
struct FoundHit {
    ray: Ray,
    prim: u32,
    facet: u32,
    pixel: u32,
}

/// Traces a sample of all pixels.
fn trace_sample<B: Bounce>(
    level: Level,
    walker: &mut Walker<'_, Trees>,
    sample: &Sample,
    tile: &mut Tile,
    room: &mut Room,
) {
    let frame = walker.frame;
    room.light.clear();
    room.light.resize(tile.depth.len(), Rgb::BLACK);
    walker.stats += at_level(level, FindFirst { frame, sample, tile, room });
    let at_eye = Media::round_eye(frame);
    let is_parallel = matches!(frame.raster.start, RayStart::Window(_));
    let side = frame.view.side_of_sample();
    for at in 0..room.hits.len() {
        let found = room.hits[at];
        let at_start = is_parallel.then(|| Media::round_camera(frame, &found.ray));
        let path = PathRay::from_camera(frame, found.ray, side, at_start.as_ref().unwrap_or(&at_eye));
        let hit = found.hit(walker, &path);
        if sample.kept {
            let pixel = found.pixel as usize;
            let length = path.ray.direction.length();
            tile.depth[pixel] = hit.map_or(f32::INFINITY, |hit| (hit.crossing.t * length) as f32);
            tile.surface[pixel] = hit.map_or(NOTHING, |hit| hit.surface.prim);
        }
        meet::<B>(walker, sample, tile, (path, hit, found.pixel), (&mut room.light, &mut room.rays));
    }
    while !room.rays.is_empty() {
        walker.stats.rays.reflection += room.rays.len() as u64;
        walker.stats += at_level(level, FindNext { frame, room });
        let rays = std::mem::take(&mut room.rays);
        for (ray, at) in rays.into_iter().zip(0..) {
            let found = room.hits[at];
            let path = PathRay { ray: found.ray, ..ray.path };
            let hit = found.hit(walker, &path);
            meet::<B>(walker, sample, tile, (path, hit, ray.pixel), (&mut room.light, &mut room.next));
        }
        std::mem::swap(&mut room.rays, &mut room.next);
    }
    for (i, light) in room.light.iter().enumerate() {
        for (pixels, light) in tile.sums.iter_mut().zip(light.to_array()) {
            walker.stats.not_finite += store_finite(&mut pixels[i], light as f32);
        }
    }
}

/// Adds the light of a ray to its pixel, and lists the rays that go on.
fn meet<B: Bounce>(
    walker: &mut Walker<'_, Trees>,
    sample: &Sample,
    tile: &Tile,
    (path, hit, pixel): (PathRay, Option<Hit>, u32),
    (light, next): (&mut [Rgb], &mut Vec<TileRay>),
) {
    let [x, y] = tile.place_of(pixel as usize);
    let numbers = Numbers { sampler: sample.sampler(x, y), sample: sample.index };
    light[pixel as usize] += B::meet(walker, path, hit, &numbers);
    next.extend(walker.pending.drain(..).map(|path| TileRay { path, pixel }));
}

impl FoundHit {
    /// The hit in `f64`, where a packet has found one.
    fn hit(&self, walker: &Walker<'_, Trees>, path: &PathRay) -> Option<Hit> {
        if self.prim == NOTHING {
            return None;
        }
        let snapshot = walker.frame.snapshot;
        let surface = SurfaceId { prim: self.prim, facet: self.facet };
        snapshot
            .cross_part(surface.prim, Some(surface.facet), &path.ray, Span::AHEAD, path.leaving)
            .or_else(|| snapshot.nearest_in_frame(&path.ray, Span::AHEAD, path.leaving))
    }
}

/// Finds what the camera rays of a tile meet.
struct FindFirst<'a> {
    frame: &'a Frame<'a>,
    sample: &'a Sample,
    tile: &'a Tile,
    room: &'a mut Room,
}

impl Work for FindFirst<'_> {
    type Output = Stats;

    #[inline(always)]
    fn with<S: Simd>(self, s: S) -> Stats {
        let Self { frame, sample, tile, room } = self;
        let Room { camera: rays, visits, candidates: [all, visible], hits, .. } = room;
        let (snapshot, view) = (frame.snapshot, frame.view);
        visits.one_by_one = !view.skip.planes;
        let mut search = Searcher::new(s, snapshot, visits, false);
        let region = Region::from(Size::new(tile.width, tile.height));
        all.all(snapshot.columns());
        let seen = if view.skip.hidden && frame.is_pinhole() {
            let frustum = Frustum::new(frame, &Region::new(tile.x, tile.y, region.size));
            visible.visible_through(&frustum, snapshot.columns(), all, false);
            &*visible
        } else {
            &*all
        };
        let mut camera = CameraPackets::new(s, frame, tile, sample, rays);
        outlined(
            s,
            #[inline(always)]
            || camera.make_rays(s, &region),
        );
        let part = Part { camera: &camera, region };
        search.stats.rays.primary += part.live();
        hits.clear();
        let mut bundle = view.skip.walks.then(|| bundle_room(s));
        search.find_hits(
            &part,
            seen,
            bundle.as_mut(),
            #[inline(always)]
            |packet, best| {
                for lane in packet.live.lanes() {
                    let (ray, pixel) = (packet.ray(lane), (packet.at + lane) as u32);
                    hits.push(FoundHit {
                        ray,
                        prim: best.prim.lane(lane),
                        facet: best.facet.lane(lane),
                        pixel,
                    });
                }
            },
        );
        search.stats
    }
}

/// Finds what the rays of a bounce meet.
struct FindNext<'a> {
    frame: &'a Frame<'a>,
    room: &'a mut Room,
}

impl Work for FindNext<'_> {
    type Output = Stats;

    #[inline(always)]
    fn with<S: Simd>(self, s: S) -> Stats {
        let Self { frame, room } = self;
        let Room { queue, visits, candidates: [all, _], found, rays, hits, .. } = room;
        let snapshot = frame.snapshot;
        visits.one_by_one = !frame.view.skip.planes;
        let mut search = Searcher::new(s, snapshot, visits, false);
        queue.start(snapshot.origin_in_frame(), f64::INFINITY);
        for TileRay { path, pixel } in &*rays {
            queue.push_one::<S>(&path.ray, path.leaving, *pixel);
        }
        found.make_room(rays.len().next_multiple_of(F::<S>::LANES));
        outlined(
            s,
            #[inline(always)]
            || {
                for at in (0..queue.len()).step_by(F::<S>::LANES) {
                    let packet = queue.packet_at(s, at);
                    search.closest(&packet, all).store(found, at);
                }
            },
        );
        hits.clear();
        hits.extend((0..rays.len()).map(|at| FoundHit {
            ray: PreciseRays::<S>::ray(queue, at),
            prim: found.prim[at],
            facet: found.facet[at],
            pixel: rays[at].pixel,
        }));
        search.stats
    }
}
