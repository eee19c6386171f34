//! Whitted's integrator over packets of rays, one tile after another.
//!
//! A tile is traced in batches: its camera rays, then streams of reflected rays. Lanes whose surfaces reflect are
//! gathered in a queue, which is traced in full packets as the next stream, until no lane goes on. For each batch all
//! rays find what they meet; then it is known where the points lie, and so what can stand between them and a light;
//! then they gather their light. Every lane computes on its own, so a pixel's bits depend on neither the number of lanes
//! nor its neighbours.

use std::any::Any;
use std::cell::RefCell;

use fearless_simd::{Level, Simd};

use super::pieces::PieceRoom;
use super::streams::Bounce;
use crate::cull::{Candidates, Frustum, Planner, PointBounds, TilePlan, quarters};
use crate::kernel::mesh::Visits;
use crate::lanes::{Work, at_level, outlined};
use crate::sample::Sample;
use crate::search::{BundleRoom, HitColumns, Searcher, bundle_room};
use crate::shade::{Chunk, Gathers, LampRoom, Shader};
use crate::stream::{Batch, CameraPackets, CameraRays, LaneBounds, Part, Queue};
use crate::{Frame, Instructions, Region, Size, Stats, Tile};

/// Traces all pixels of a tile in lanes: by Whitted's rules, or by paths.
pub(in crate::integrator) fn trace_lanes(frame: &Frame<'_>, tile: &mut Tile, gathers: Gathers) -> Stats {
    let level = frame.view.instructions.map_or_else(Level::new, Instructions::level);
    ROOM.with_borrow_mut(|room| at_level(level, TraceTile { frame, tile, gathers, room }))
}

thread_local! {
    /// Room for what a tile needs, kept from tile to tile.
    static ROOM: RefCell<Room> = RefCell::default();
}

/// Columns and lists that are filled anew for every tile.
#[derive(Default)]
struct Room {
    next: Queue,
    bounce: Bounce,
    found: HitColumns,
    /// Every shape, those that may be seen through a tile, and those through parts of it.
    visible: [Candidates; LEVELS],
    plan: TilePlan,
    /// Where the points lie that a batch shows.
    points: Vec<PointBounds>,
    visits: Visits,
    rays: CameraRays,
    lamps: LampRoom,
    pieces: PieceRoom,
    /// [`Registers`] of the kind of instructions that were used last.
    registers: Option<Box<dyn Any>>,
}

/// What is kept in registers' own form.
struct Registers<S: Simd> {
    chunk: Chunk<S>,
    /// Bounds of the points that a batch shows.
    seen: LaneBounds<S, 1>,
    /// Bounds of the rays that surfaces send on: where they start, and their unit directions.
    sent: LaneBounds<S, 2>,
    bundle: BundleRoom<S>,
}

impl<S: Simd> Registers<S> {
    /// Those that were kept, or new ones.
    fn take(s: S, kept: Option<Box<dyn Any>>) -> Box<Self> {
        let new = || {
            Box::new(Self {
                chunk: Chunk::new(s),
                seen: LaneBounds::nothing(s),
                sent: LaneBounds::nothing(s),
                bundle: bundle_room(s),
            })
        };
        kept.and_then(|kept| kept.downcast().ok()).unwrap_or_else(new)
    }
}

/// How often what is looked at is narrowed down: all shapes, a tile's, a quarter's.
const LEVELS: usize = 3;

/// Tracing one tile.
struct TraceTile<'a> {
    frame: &'a Frame<'a>,
    tile: &'a mut Tile,
    gathers: Gathers,
    room: &'a mut Room,
}

impl Work for TraceTile<'_> {
    type Output = Stats;

    #[inline(always)]
    fn with<S: Simd>(self, s: S) -> Stats {
        trace_with(s, self.frame, self.tile, self.gathers, self.room)
    }
}

/// Traces one tile with the instructions that `s` stands for.
#[inline(always)]
fn trace_with<S: Simd>(s: S, frame: &Frame<'_>, tile: &mut Tile, gathers: Gathers, room: &mut Room) -> Stats {
    let (snapshot, view) = (frame.snapshot, frame.view);
    let Room { next, bounce, found, visible, plan, points, visits, rays, lamps, pieces, registers } = room;
    let mut own = Registers::take(s, registers.take());
    let Registers { chunk, seen, sent, bundle } = &mut *own;
    for queue in [&mut *next, &mut bounce.stream] {
        queue.start(snapshot.origin_in_frame(), f64::INFINITY);
    }
    plan.start(snapshot);
    let outside = frame.outside_solids;
    visits.one_by_one = !view.skip.planes;
    let search = Searcher::new(s, snapshot, visits, outside);
    let sample = Sample::new(view, 0);
    let shader =
        Shader { s, search, view, gathers, plan, chunk, lamp_room: lamps, sample, next, sent, bundle };
    let planner = Planner { snapshot, skip: view.skip, outside };
    let mut tracer = TileTracer { s, frame, planner, shader, found, seen, points };
    visible[0].all(snapshot.columns());
    for number in view.traced_samples() {
        let sample = Sample::new(view, number);
        tracer.shader.sample = sample;
        let mut camera = CameraPackets::new(s, frame, tile, &sample, rays);
        let region = Region::from(Size::new(tile.width, tile.height));
        if view.skip.hidden && frame.is_pinhole() {
            tracer.survey(&mut camera, region, visible, tile);
        } else {
            tracer.shader.plan.dark.clear();
            tracer.trace_camera(&mut camera, region, &visible[0], tile);
        }
        if tracer.shader.next.len() > 0 {
            tracer.follow(bounce, tile);
        }
        tile.take_sample(number, view);
    }
    if let Some(edges) = frame.edges {
        let [all, within, ..] = visible;
        tracer.show_pieces(edges, [all, within], (pieces, bounce), tile);
    }
    let stats = tracer.shader.search.stats;
    *registers = Some(own);
    stats
}

/// What tracing a tile keeps at hand.
pub(super) struct TileTracer<'a, S: Simd> {
    pub(super) s: S,
    pub(super) frame: &'a Frame<'a>,
    pub(super) planner: Planner<'a>,
    pub(super) shader: Shader<'a, S>,
    /// What the rays of the batch under way have met.
    found: &'a mut HitColumns,
    /// Bounds of the points of the batch under way.
    seen: &'a mut LaneBounds<S, 1>,
    points: &'a mut Vec<PointBounds>,
}

impl<S: Simd> TileTracer<'_, S> {
    /// Adds the light that arrives along the camera rays of a part of a tile, of which the first of `visible` may be seen.
    /// What is seen is narrowed down, part by part, until one shape fills a part.
    #[inline(always)]
    fn survey(
        &mut self,
        camera: &mut CameraPackets<'_, S>,
        region: Region,
        visible: &mut [Candidates],
        tile: &mut Tile,
    ) {
        let [candidates, rest @ ..] = visible else { return };
        let [mine, further @ ..] = rest else { return };
        let place = Region::new(tile.x + region.x, tile.y + region.y, region.size);
        let frustum = Frustum::new(self.frame, &place);
        let columns = self.frame.snapshot.columns();
        mine.visible_through(&frustum, columns, candidates, self.planner.outside);
        if mine.is_empty() && columns.general_unbounded.is_empty() {
            self.fill(&Part { camera, region }, tile);
        } else if mine.tree || further.is_empty() || mine.filled {
            if self.frame.snapshot.has_mirrors() && !self.shader.gathers.paths {
                self.shader.plan.plan_darkness(&self.planner, &[frustum.beam()], &mine.points);
            }
            self.trace_camera(camera, region, mine, tile);
        } else {
            for quarter in quarters(region) {
                self.survey(camera, quarter, rest, tile);
            }
        }
    }

    /// Fills a part of a tile that shows nothing with the background.
    #[inline(always)]
    fn fill(&mut self, part: &Part<'_, S>, tile: &mut Tile) {
        let skipped = &mut self.shader.search.stats.skipped;
        skipped.nothing_seen += part.live();
        let light = &self.shader.gathers.sky;
        let view = self.frame.view;
        let whole = part.region.size == Size::new(tile.width, tile.height) && view.samples <= 1;
        let narrow = [light.x.narrow, light.y.narrow, light.z.narrow];
        if whole && tile.goes_blank(narrow) && view.skip.blank {
            skipped.blank_before += part.live();
            return;
        }
        outlined(
            self.s,
            #[inline(always)]
            || part.fill(self.s, light, tile),
        );
    }

    /// Adds the light that arrives along the camera rays of a part of a tile.
    #[inline(always)]
    fn trace_camera(
        &mut self,
        camera: &mut CameraPackets<'_, S>,
        region: Region,
        candidates: &Candidates,
        tile: &mut Tile,
    ) {
        outlined(
            self.s,
            #[inline(always)]
            || camera.make_rays(self.s, &region),
        );
        let part = &Part { camera, region };
        let walks = self.frame.view.skip.walks && candidates.hold_meshes(self.frame.snapshot.columns());
        if candidates.points.is_empty() || walks {
            self.trace(part, candidates, tile, 0);
            return;
        }
        self.shader.search.stats.rays.primary += part.live();
        self.shader.plan.plan_lights(&self.planner, &candidates.points);
        if candidates.filled {
            self.shader.shade_filled(part, candidates, tile);
        } else {
            outlined(
                self.s,
                #[inline(always)]
                || self.shader.shade(part, &candidates, tile, 0),
            );
        }
    }

    /// Finds what the rays of a batch meet, then adds the light that arrives along them.
    #[inline(always)]
    pub(super) fn trace(
        &mut self,
        batch: &impl Batch<S>,
        candidates: &Candidates,
        tile: &mut Tile,
        depth: u32,
    ) {
        let rays = &mut self.shader.search.stats.rays;
        *if depth == 0 { &mut rays.primary } else { &mut rays.reflection } += batch.live();
        self.found.make_room(batch.stretch(batch.stretches() - 1).end);
        outlined(
            self.s,
            #[inline(always)]
            || self.find(batch, candidates),
        );
        outlined(
            self.s,
            #[inline(always)]
            || self.shader.shade(batch, &&*self.found, tile, depth),
        );
    }

    /// Finds what the rays of a batch meet, and what may stand between that and the lights.
    #[inline(always)]
    fn find(&mut self, batch: &impl Batch<S>, candidates: &Candidates) {
        self.seen.clear();
        let Shader { search, bundle, view, .. } = &mut self.shader;
        search.find_hits(
            batch,
            candidates,
            view.skip.walks.then_some(bundle),
            #[inline(always)]
            |packet, best| {
                best.store(self.found, packet.at);
                self.seen.add(best.hits() & packet.live, best.prim, &[packet.point(best.t)]);
            },
        );
        self.points.clear();
        for at in 0..self.seen.len() {
            let (prim, [bounds]) = self.seen.get(at);
            self.points.push(PointBounds::new(prim, bounds));
        }
        self.shader.plan.plan_lights(&self.planner, self.points);
    }
}
