//! Ambient occlusion with packets of rays: a tile's camera rays find surfaces, whose directions are queued and then followed
//! in full packets until anything is in the way.

use std::cell::RefCell;

use catoptra_core::lobe::Diffuse;
use catoptra_core::{Lane, LaneMask};
use fearless_simd::{Level, Simd};

use crate::cull::{Candidates, Frustum};
use crate::kernel::mesh::Visits;
use crate::lanes::{F, F3, M, U, Work, at_level, narrow3, outlined, share_of_one, splat3, widen3};
use crate::sample::Sample;
use crate::sampler::pairs;
use crate::search::{Hits, OwnSegments, Packet, Searcher};
use crate::stream::{Batch, CameraPackets, CameraRays, Part, Queue, QueuedRays};
use crate::{Frame, Instructions, Region, Size, Stats, Tile};

/// Traces all pixels of a tile.
pub(super) fn trace_tile(frame: &Frame<'_>, tile: &mut Tile) -> Stats {
    let level = frame.view.instructions.map_or_else(Level::new, Instructions::level);
    ROOM.with_borrow_mut(|room| at_level(level, TraceTile { frame, tile, room }))
}

thread_local! {
    /// Room for what a tile needs, kept from tile to tile.
    static ROOM: RefCell<Room> = RefCell::default();
}

#[derive(Default)]
struct Room {
    rays: CameraRays,
    queue: Queue,
    visits: Visits,
    /// Every shape.
    all: Candidates,
    /// Those that the tile may show.
    visible: Candidates,
}

/// Tracing one tile.
struct TraceTile<'a> {
    frame: &'a Frame<'a>,
    tile: &'a mut Tile,
    room: &'a mut Room,
}

impl Work for TraceTile<'_> {
    type Output = Stats;

    #[inline(always)]
    fn with<S: Simd>(self, s: S) -> Stats {
        let Self { frame, tile, room: Room { rays, queue, visits, all, visible } } = self;
        let (snapshot, view) = (frame.snapshot, frame.view);
        let outside = frame.outside_solids;
        visits.one_by_one = !view.skip.planes;
        let mut tracer = OcclusionTracer { s, search: Searcher::new(s, snapshot, visits, outside), queue };
        let region = Region::from(Size::new(tile.width, tile.height));
        all.all(snapshot.columns());
        let seen = if view.skip.hidden && frame.is_pinhole() {
            let frustum = Frustum::new(frame, &Region::new(tile.x, tile.y, region.size));
            visible.visible_through(&frustum, snapshot.columns(), all, outside);
            &*visible
        } else {
            &*all
        };
        tracer.queue.start(snapshot.origin_in_frame(), view.occlusion_distance);
        for number in view.traced_samples() {
            let sample = &Sample::new(view, number);
            let mut camera = CameraPackets::new(s, frame, tile, sample, rays);
            outlined(
                s,
                #[inline(always)]
                || camera.make_rays(s, &region),
            );
            let part = Part { camera: &camera, region };
            outlined(
                s,
                #[inline(always)]
                || tracer.find_surfaces(&part, seen, sample, tile),
            );
            outlined(
                s,
                #[inline(always)]
                || tracer.look_for_the_sky(all, tile),
            );
            tile.take_sample(number, view);
        }
        tracer.search.stats
    }
}

/// What tracing a tile keeps at hand.
struct OcclusionTracer<'a, S: Simd> {
    s: S,
    search: Searcher<'a, S>,
    /// Rays from surfaces to the sky.
    queue: &'a mut Queue,
}

impl<S: Simd> OcclusionTracer<'_, S> {
    /// Finds what camera rays meet, and queues a ray from each surface. Where nothing is met, nothing hides the sky.
    #[inline(always)]
    fn find_surfaces(&mut self, part: &Part<'_, S>, seen: &Candidates, sample: &Sample, tile: &mut Tile) {
        self.queue.clear();
        self.search.stats.rays.primary += part.live();
        for stretch in 0..part.stretches() {
            for at in part.stretch(stretch).step_by(F::<S>::LANES) {
                if part.is_idle(at) {
                    continue;
                }
                let packet = part.packet(self.s, at);
                let best = self.search.closest(&packet, seen);
                let sky = F::pick(packet.live & !best.hits(), F::splat(self.s, 1.0), F::splat(self.s, 0.0));
                part.add(self.s, at, &best, F3::splat(sky), tile);
                if (best.hits() & packet.live).any() {
                    self.queue_directions(part.camera, &packet, &best, sample);
                }
            }
        }
    }

    /// Queues a ray in a random direction from what each ray of a packet meets.
    #[inline(always)]
    fn queue_directions(
        &mut self,
        camera: &CameraPackets<'_, S>,
        packet: &Packet<'_, S, CameraPackets<'_, S>>,
        best: &Hits<S>,
        sample: &Sample,
    ) {
        let s = self.s;
        let lanes = best.hits() & packet.live;
        let refined = self.search.refine_every(packet, best, lanes);
        let geometric = narrow3(refined.normal);
        let away = F::splat(s, 0.0).less(geometric.dot(packet.rays.direction));
        let facing = |v: F3<S>| F3::select(away, F3::new(-v.x, -v.y, -v.z), v);
        let [x, y] = camera.pixels_of_picture(s, packet.at);
        let numbers = sample.sampler(x, y).pair(U::splat(s, sample.index), pairs::DIRECTION);
        let normal = facing(narrow3(refined.shading));
        let (direction, _) = Diffuse::direction(normal, numbers.map(share_of_one));
        let above = lanes & F::splat(s, 0.0).less(direction.dot(facing(geometric)));
        self.search.stats.skipped.below_surface += lanes.count() - above.count();
        self.queue.push(
            above,
            &QueuedRays {
                origin: refined.point,
                direction: widen3(direction),
                weight: splat3(s, [1.0; 3]),
                pixel: U::counted(s, packet.at as u32),
                prim: best.prim,
                facet: best.facet,
            },
        );
    }

    /// Adds light to the pixels of queued rays that nothing is in the way of.
    #[inline(always)]
    fn look_for_the_sky(&mut self, all: &Candidates, tile: &mut Tile) {
        self.search.stats.rays.occlusion += self.queue.len() as u64;
        for at in (0..self.queue.len()).step_by(F::<S>::LANES) {
            let packet = self.queue.packet_at(self.s, at);
            let rays = self.queue.shadow_rays(self.s, &packet);
            let blocked = self.search.occluded(&OwnSegments(&packet), &rays, all);
            let open: M<S> = packet.live & !blocked;
            let light = F::pick(open, F::splat(self.s, 1.0), F::splat(self.s, 0.0));
            self.queue.add(self.s, at, &Hits::nothing(self.s), F3::splat(light), tile);
        }
    }
}
