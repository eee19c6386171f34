//! Packets of rays at the CPU's native width: `f32` kernels propose, `f64` settles.
//!
//! A tile is traced in batches: its camera rays, then streams of reflected rays. Lanes whose surfaces reflect are
//! gathered in a queue, which is traced in full packets as the next stream, until no lane goes on. For each batch all
//! rays find what they meet; then it is known where the points lie, and so what can stand between them and a light;
//! then they gather their light. Every lane computes on its own,
//! so a pixel's bits depend on neither the number of lanes nor its neighbours.

mod ask;
mod batch;
mod light;
mod meet;
mod mesh;
mod packet;
mod plan;
mod queue;
mod search;
mod settle;
mod shadow;
mod surface;
mod walk;

use std::cell::RefCell;

use catoptra_core::{Lane, LaneMask, Rgb};
use fearless_simd::{Level, Simd};

use super::{Backend, Frame};
use crate::film::NOTHING;
use crate::kernel::mesh::Visits;
use crate::lanes::{F, F3, U, splat3};
use crate::numeric::PLAN_MARGIN;
use crate::query::{HitSlice, RaySlice};
use crate::{Instructions, Snapshot, Stats, Tile, View};
use ask::Answers;
use batch::{Batch, Found};
use packet::Primary;
use plan::{Place, Seen, Shapes};
use queue::Queue;
use search::Best;

/// The default backend.
pub(super) struct Wide;

impl Backend for Wide {
    fn name(&self) -> &'static str {
        "wide"
    }

    fn doc(&self) -> &'static str {
        "packets of rays in f32 at the CPU's native width, settled in f64"
    }

    fn level(&self, view: &View) -> &'static str {
        view.instructions.unwrap_or_else(Instructions::best).name()
    }

    fn trace(&self, frame: &Frame<'_>, tile: &mut Tile) -> Stats {
        let level = frame.view.instructions.map_or_else(Level::new, Instructions::level);
        ROOM.with_borrow_mut(|room| trace_at(level, frame, tile, room))
    }

    fn find_nearest(&self, snapshot: &Snapshot, rays: RaySlice<'_>, hits: &mut HitSlice<'_>) -> Stats {
        ask::answer_natively(snapshot, rays, &mut Answers::Nearest(hits))
    }

    fn find_occluded(&self, snapshot: &Snapshot, rays: RaySlice<'_>, occluded: &mut [bool]) -> Stats {
        ask::answer_natively(snapshot, rays, &mut Answers::Occluded(occluded))
    }
}

thread_local! {
    /// Room for what a tile needs, kept from tile to tile.
    static ROOM: RefCell<Room> = RefCell::default();
}

/// Columns and lists that are filled anew for every tile.
#[derive(Default)]
struct Room {
    streams: [Queue; 2],
    found: Found,
    first: Shapes,
    between: Vec<Shapes>,
    visits: Visits,
}

/// Traces one tile with the instructions of a level.
fn trace_at(level: Level, frame: &Frame<'_>, tile: &mut Tile, room: &mut Room) -> Stats {
    #[cfg(target_arch = "x86_64")]
    if let Some(s) = level.as_avx512() {
        trace_with(s, frame, tile, room)
    } else if let Some(s) = level.as_avx2() {
        trace_with(s, frame, tile, room)
    } else if let Some(s) = level.as_sse2() {
        trace_with(s, frame, tile, room)
    } else {
        unreachable!("every x86-64 has SSE2")
    }
    #[cfg(not(target_arch = "x86_64"))]
    fearless_simd::dispatch!(level, s => trace_tile(s, frame, tile, room))
}

/// Lets the compiler use the instructions that `s` proves.
#[cfg(target_arch = "x86_64")]
fn trace_with<S: Simd>(s: S, frame: &Frame<'_>, tile: &mut Tile, room: &mut Room) -> Stats {
    s.vectorize(
        #[inline(always)]
        || trace_tile(s, frame, tile, room),
    )
}

/// Traces one tile with the instructions that `s` stands for.
#[inline(always)]
fn trace_tile<S: Simd>(s: S, frame: &Frame<'_>, tile: &mut Tile, room: &mut Room) -> Stats {
    let grid = frame.view.grid;
    let Room { streams: [current, next], found, first, between, visits } = room;
    [&mut *current, &mut *next]
        .into_iter()
        .for_each(|queue| queue.start_from(frame.snapshot.origin_in_frame()));
    between.resize_with(frame.snapshot.lights().len(), Shapes::default);
    let mut tracer =
        Tracer { s, frame, stats: Stats::default(), next, found, between, visits, outside: outside(frame) };
    for sample in 0..grid * grid {
        let (column, row) = (sample % grid, sample / grid);
        if frame.view.skip.hidden {
            first.seen_through(frame, tile);
        } else {
            first.all(frame.snapshot.columns());
        }
        tracer.trace_camera(&Primary::new(s, frame, tile, column, row), first, &mut tile.radiance);
        if (column, row) == (grid / 2, grid / 2) {
            batch::keep(s, tile, tracer.found);
        }
        first.all(frame.snapshot.columns());
        for depth in 1.. {
            std::mem::swap(current, tracer.next);
            tracer.next.clear();
            if current.len() == 0 {
                break;
            }
            tracer.trace(&*current, first, &mut tile.radiance, depth);
        }
    }
    tracer.finish(tile, grid);
    tracer.stats
}

/// Whether the eye, and so every ray, stays outside all spheres.
fn outside(frame: &Frame<'_>) -> bool {
    let spheres = &frame.snapshot.columns().spheres;
    spheres.iter().all(|row| row.center.distance(frame.eye) > row.radius * (1.0 + PLAN_MARGIN))
}

/// What tracing a tile keeps at hand.
struct Tracer<'a, S: Simd> {
    s: S,
    frame: &'a Frame<'a>,
    stats: Stats,
    /// Rays of the next stream.
    next: &'a mut Queue,
    /// What the rays of the batch under way have met.
    found: &'a mut Found,
    /// For every light, what may stand between it and what the batch under way shows.
    between: &'a mut [Shapes],
    /// Room for walks through trees of meshes.
    visits: &'a mut Visits,
    /// Whether every ray stays outside all spheres.
    outside: bool,
}

impl<S: Simd> Tracer<'_, S> {
    /// Adds the light that arrives along the camera rays of a tile.
    #[inline(always)]
    fn trace_camera(&mut self, camera: &Primary<S>, shapes: &Shapes, radiance: &mut [Vec<f32>; 3]) {
        match shapes.filled {
            None => self.trace(camera, shapes, radiance, 0),
            Some(place) => {
                self.stats.rays.primary += camera.live();
                self.found.make_room(camera.rays());
                self.plan_shadows(&[place]);
                // Compiled apart, as are the other loops: what is one function takes long to compile.
                self.s.vectorize(
                    #[inline(always)]
                    || self.find_and_shade(camera, shapes, radiance),
                );
            }
        }
    }

    /// Finds what the rays of a batch meet, then adds the light that arrives along them.
    #[inline(always)]
    fn trace(&mut self, batch: &impl Batch<S>, shapes: &Shapes, radiance: &mut [Vec<f32>; 3], depth: u32) {
        let rays = if depth == 0 { &mut self.stats.rays.primary } else { &mut self.stats.rays.reflection };
        *rays += batch.live();
        self.found.make_room(batch.rays());
        self.s.vectorize(
            #[inline(always)]
            || self.find(batch, shapes),
        );
        self.s.vectorize(
            #[inline(always)]
            || self.shade(batch, radiance, depth),
        );
    }

    /// Finds and shades at once: where the points lie is known beforehand.
    #[inline(always)]
    fn find_and_shade(&mut self, camera: &Primary<S>, shapes: &Shapes, radiance: &mut [Vec<f32>; 3]) {
        for at in (0..camera.rays()).step_by(F::<S>::LANES) {
            let packet = camera.packet(self.s, at, None);
            let best = self.nearest(&packet, shapes);
            best.store(self.found, at);
            let light = self.gather(&packet, &best, 0);
            camera.add(self.s, at, &packet, light, radiance);
        }
    }

    /// Adds the light that arrives along the rays of a batch from what they have met.
    #[inline(always)]
    fn shade(&mut self, batch: &impl Batch<S>, radiance: &mut [Vec<f32>; 3], depth: u32) {
        for at in (0..batch.rays()).step_by(F::<S>::LANES) {
            if depth > 0 && self.is_dark(at) {
                continue;
            }
            let known = F::load(self.s, &self.found.inverse_length[at..]);
            let packet = batch.packet(self.s, at, Some(known));
            let best = Best::found(self.s, self.found, at);
            let light = self.gather(&packet, &best, depth);
            batch.add(self.s, at, &packet, light, radiance);
        }
    }

    /// Whether the rays from `at` on meet nothing but darkness.
    #[inline(always)]
    fn is_dark(&self, at: usize) -> bool {
        let hits = !U::load(self.s, &self.found.prim[at..]).is(NOTHING);
        !hits.any() && self.frame.snapshot.background() == Rgb::BLACK
    }

    /// Finds what the rays of a batch meet, and what may stand between that and the lights.
    #[inline(always)]
    fn find(&mut self, batch: &impl Batch<S>, shapes: &Shapes) {
        let mut seen = Seen::nothing(self.s);
        for at in (0..batch.rays()).step_by(F::<S>::LANES) {
            let packet = batch.packet(self.s, at, None);
            let best = self.nearest(&packet, shapes);
            best.store(self.found, at);
            packet.inverse_length.store(&mut self.found.inverse_length[at..]);
            seen.add(&packet, &best);
        }
        let places: Vec<Place> = seen.places().collect();
        self.plan_shadows(&places);
    }

    /// Finds out for every light what may stand between it and the places that a batch shows.
    fn plan_shadows(&mut self, places: &[Place]) {
        let snapshot = self.frame.snapshot;
        for (shapes, light) in self.between.iter_mut().zip(snapshot.light_rows()) {
            if self.frame.view.skip.shafts {
                shapes.between(snapshot.columns(), places, light, self.outside);
            } else {
                shapes.all(snapshot.columns());
            }
        }
    }

    /// Divides sums over `grid` x `grid` samples; lights past every number become the largest, what is no number black.
    #[inline(always)]
    fn finish(&mut self, tile: &mut Tile, grid: u32) {
        let share = F::splat(self.s, 1.0 / (grid as f32 * grid as f32));
        let (zero, infinite) = (F::splat(self.s, 0.0), F::splat(self.s, f32::INFINITY));
        let most = F::splat(self.s, f32::MAX);
        for column in &mut tile.radiance {
            for at in (0..column.len()).step_by(F::<S>::LANES) {
                let light = F::load(self.s, &column[at..]);
                let finite = light.abs().less(infinite);
                self.stats.not_finite += (!finite).count();
                F::pick(finite, light * share, F::pick(zero.less(light), most, zero))
                    .store(&mut column[at..]);
            }
        }
    }
}

/// No light in any lane.
#[inline(always)]
fn dark<S: Simd>(s: S) -> F3<S> {
    splat3(s, [0.0; 3])
}
