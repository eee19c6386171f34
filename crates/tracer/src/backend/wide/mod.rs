//! Packets of rays at the CPU's native width: `f32` kernels propose, `f64` settles.
//!
//! A tile is traced in batches: its camera rays, then streams of reflected rays. Lanes whose surfaces reflect are
//! gathered in a queue, which is traced in full packets as the next stream, until no lane goes on. For each batch all
//! rays find what they meet; then it is known where the points lie, and so what can stand between them and a light;
//! then they gather their light. Every lane computes on its own,
//! so a pixel's bits depend on neither the number of lanes nor its neighbours.

mod ask;
mod batch;
mod beam;
mod chunk;
mod dark;
mod filled;
mod light;
mod meet;
mod mesh;
mod mesh_to_light;
mod packet;
mod plan;
mod queue;
mod search;
mod send;
mod settle;
mod shadow;
mod solid;
mod spread;
mod stream;
mod surface;
mod umpire;
mod walk;
mod window;

use std::any::Any;
use std::cell::RefCell;

use catoptra_core::Integrator;
use fearless_simd::{Level, Simd};

use super::{Backend, Frame};
use crate::integrator::{Trees, trace_pixels};
use crate::kernel::mesh::Visits;
use crate::lanes::{F, F3, splat3};
use crate::query::{HitSlice, RaySlice};
use crate::snapshot::LightRow;
use crate::{Instructions, Region, Size, Snapshot, Stats, Tile, View};
use ask::Answers;
use batch::{Batch, Found, Part};
use chunk::Chunk;
use meet::Before;
use packet::{CameraRays, Primary};
use plan::{Place, Shapes};
use queue::Queue;
use spread::Spreads;
use stream::Bounce;
use window::{Window, quarters};

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
        if frame.view.integrator != Integrator::Whitted {
            return trace_pixels(&Trees, frame, tile);
        }
        let level = frame.view.instructions.map_or_else(Level::new, Instructions::level);
        ROOM.with_borrow_mut(|room| at_level(level, TraceTile { frame, tile, room }))
    }

    fn find_nearest(&self, snapshot: &Snapshot, rays: RaySlice<'_>, hits: &mut HitSlice<'_>) -> Stats {
        ask::answer(snapshot, rays, Answers::Nearest(hits))
    }

    fn find_occluded(&self, snapshot: &Snapshot, rays: RaySlice<'_>, occluded: &mut [bool]) -> Stats {
        ask::answer(snapshot, rays, Answers::Occluded(occluded))
    }
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
    found: Found,
    /// Every shape, those that may be seen through a tile, and those through parts of it.
    seen: [Shapes; LEVELS],
    between: Vec<Shapes>,
    /// Lights that reach anything that the batch under way shows.
    reached: Vec<usize>,
    /// Shapes whose reflections of the batch under way go into darkness.
    dark: Vec<u32>,
    visits: Visits,
    rays: CameraRays,
    /// [`Registers`] of the kind of instructions that were used last.
    registers: Option<Box<dyn Any>>,
}

/// What is kept in registers' own form.
struct Registers<S: Simd> {
    chunk: Chunk<S>,
    spreads: Spreads<S>,
}

impl<S: Simd> Registers<S> {
    /// Those that were kept, or new ones.
    fn take(s: S, kept: Option<Box<dyn Any>>) -> Box<Self> {
        let new = || Box::new(Self { chunk: Chunk::new(s), spreads: Spreads::nothing(s) });
        kept.and_then(|kept| kept.downcast().ok()).unwrap_or_else(new)
    }
}

/// How often what is looked at is narrowed down: all shapes, a tile's, a quarter's.
const LEVELS: usize = 3;

/// Work that any vector instructions can do.
trait Work {
    type Output;

    /// Does it with the instructions that `s` stands for.
    fn with<S: Simd>(self, s: S) -> Self::Output;
}

/// Does work with the instructions of a level.
fn at_level<W: Work>(level: Level, work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    if let Some(s) = level.as_avx512() {
        vectorized(s, work)
    } else if let Some(s) = level.as_avx2() {
        vectorized(s, work)
    } else if let Some(s) = level.as_sse2() {
        vectorized(s, work)
    } else {
        unreachable!("every x86-64 has SSE2")
    }
    #[cfg(not(target_arch = "x86_64"))]
    fearless_simd::dispatch!(level, s => vectorized(s, work))
}

/// Lets the compiler use the instructions that `s` proves.
fn vectorized<S: Simd, W: Work>(s: S, work: W) -> W::Output {
    s.vectorize(
        #[inline(always)]
        || work.with(s),
    )
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
        trace_tile(s, self.frame, self.tile, self.room)
    }
}

/// Traces one tile with the instructions that `s` stands for.
#[inline(always)]
fn trace_tile<S: Simd>(s: S, frame: &Frame<'_>, tile: &mut Tile, room: &mut Room) -> Stats {
    let grid = frame.view.grid;
    let Room { next, bounce, found, seen, between, reached, dark, visits, rays, registers } = room;
    let mut own = Registers::take(s, registers.take());
    let Registers { chunk, spreads } = &mut *own;
    for queue in [&mut *next, &mut bounce.stream] {
        queue.start_from(frame.snapshot.origin_in_frame());
    }
    between.resize_with(frame.snapshot.lights().len(), Shapes::default);
    reached.clear();
    reached.extend(0..frame.snapshot.lights().len());
    let mut tracer = Tracer {
        s,
        frame,
        stats: Stats::default(),
        next,
        bounce: Some(bounce),
        found,
        between,
        reached,
        dark,
        visits,
        chunk,
        spreads,
        outside: frame.outside_solids,
    };
    seen[0].all(frame.snapshot.columns());
    for sample in 0..grid * grid {
        let mut camera = Primary::new(s, frame, tile, (sample % grid, sample / grid), rays);
        let region = Region::from(Size::new(tile.width, tile.height));
        if frame.view.skip.hidden {
            tracer.survey(&mut camera, region, seen, tile);
        } else {
            tracer.dark.clear();
            tracer.trace_camera(&mut camera, region, &seen[0], tile);
        }
        if tracer.next.len() > 0 {
            tracer.follow(tile);
        }
    }
    tracer.finish(tile, grid);
    let stats = tracer.stats;
    *registers = Some(own);
    stats
}

/// What tracing a tile keeps at hand.
struct Tracer<'a, S: Simd> {
    s: S,
    frame: &'a Frame<'a>,
    stats: Stats,
    /// Rays of the next stream.
    next: &'a mut Queue,
    /// The stream under way; taken while it is followed.
    bounce: Option<&'a mut Bounce>,
    /// What the rays of the batch under way have met.
    found: &'a mut Found,
    /// For every light, what may stand between it and what the batch under way shows.
    between: &'a mut [Shapes],
    /// Lights that reach anything that the batch under way shows.
    reached: &'a mut Vec<usize>,
    /// Shapes whose reflections of the batch under way go into darkness.
    dark: &'a mut Vec<u32>,
    /// Room for walks through trees of meshes.
    visits: &'a mut Visits,
    chunk: &'a mut Chunk<S>,
    spreads: &'a mut Spreads<S>,
    /// Whether every ray stays outside all convex solids.
    outside: bool,
}

impl<S: Simd> Tracer<'_, S> {
    /// Adds the light that arrives along the camera rays of a part of a tile, of which the first of `seen` may be seen.
    /// What is seen is narrowed down, part by part, until one shape fills a part.
    #[inline(always)]
    fn survey(&mut self, camera: &mut Primary<'_, S>, region: Region, seen: &mut [Shapes], tile: &mut Tile) {
        let [candidates, rest @ ..] = seen else { return };
        let [mine, further @ ..] = rest else { return };
        let window = Window::new(self.frame, &Region::new(tile.x + region.x, tile.y + region.y, region.size));
        let columns = self.frame.snapshot.columns();
        mine.seen_through(&window, columns, candidates, self.outside);
        if mine.is_empty() && columns.general_unbounded.is_empty() {
            let part = Part { camera, region };
            self.stats.skipped.nothing_seen += part.live();
            let light = self.frame.snapshot.background_light();
            let whole = part.region.size == Size::new(tile.width, tile.height) && self.frame.view.grid == 1;
            let narrow = [light.x.narrow, light.y.narrow, light.z.narrow];
            if whole && tile.goes_blank(narrow) && self.frame.view.skip.blank {
                self.stats.skipped.blank_before += part.live();
                return;
            }
            self.s.vectorize(
                #[inline(always)]
                || part.fill(self.s, light, tile),
            );
        } else if mine.tree || further.is_empty() || mine.filled {
            if self.frame.snapshot.has_mirrors() {
                self.plan_darkness(&[window.beam()], mine);
            }
            self.trace_camera(camera, region, mine, tile);
        } else {
            for quarter in quarters(region) {
                self.survey(camera, quarter, rest, tile);
            }
        }
    }

    /// Adds the light that arrives along the camera rays of a part of a tile.
    #[inline(always)]
    fn trace_camera(
        &mut self,
        camera: &mut Primary<'_, S>,
        region: Region,
        shapes: &Shapes,
        tile: &mut Tile,
    ) {
        self.s.vectorize(
            #[inline(always)]
            || camera.make_rays(self.s, &region),
        );
        let part = &Part { camera, region };
        if shapes.places.is_empty() {
            self.trace(part, shapes, tile, 0);
        } else {
            self.stats.rays.primary += part.live();
            self.plan_lights(&shapes.places);
            if shapes.filled {
                self.trace_filled(part, shapes, tile);
            } else {
                // Compiled apart, as are the other loops: what is one function takes long to compile.
                self.s.vectorize(
                    #[inline(always)]
                    || self.shade(part, &shapes, tile, 0),
                );
            }
        }
    }

    /// Finds what the rays of a batch meet, then adds the light that arrives along them.
    #[inline(always)]
    fn trace(&mut self, batch: &impl Batch<S>, shapes: &Shapes, tile: &mut Tile, depth: u32) {
        let rays = if depth == 0 { &mut self.stats.rays.primary } else { &mut self.stats.rays.reflection };
        *rays += batch.live();
        self.found.make_room(batch.stretch(batch.stretches() - 1).end);
        self.s.vectorize(
            #[inline(always)]
            || self.find(batch, shapes),
        );
        self.s.vectorize(
            #[inline(always)]
            || self.shade(batch, &Before, tile, depth),
        );
    }

    /// Finds what the rays of a batch meet, and what may stand between that and the lights.
    #[inline(always)]
    fn find(&mut self, batch: &impl Batch<S>, shapes: &Shapes) {
        self.spreads.seen.clear();
        for stretch in 0..batch.stretches() {
            for at in batch.stretch(stretch).step_by(F::<S>::LANES) {
                let packet = batch.packet(self.s, at);
                let best = self.nearest(&packet, shapes);
                best.store(self.found, at);
                self.spreads.seen.add(best.hits() & packet.live, best.prim, &[packet.point(best.t)]);
            }
        }
        let mut places = std::mem::take(&mut self.found.places);
        places.clear();
        for at in 0..self.spreads.seen.len() {
            let (prim, [bounds]) = self.spreads.seen.get(at);
            places.push(Place::new(prim, bounds));
        }
        self.plan_lights(&places);
        self.found.places = places;
    }

    /// Finds out for every light whether it reaches the places that a batch shows, and what may stand between.
    fn plan_lights(&mut self, places: &[Place]) {
        let (snapshot, skip) = (self.frame.snapshot, self.frame.view.skip);
        if skip.unreached && snapshot.has_cones() {
            let reaches = |light: &LightRow| places.iter().any(|place| place.is_reached_by(light));
            self.reached.clear();
            let lights = snapshot.light_rows().iter().enumerate();
            self.reached.extend(lights.filter(|(_, light)| reaches(light)).map(|(i, _)| i));
        }
        for (shapes, light) in self.between.iter_mut().zip(snapshot.light_rows()) {
            if skip.shafts {
                shapes.between(snapshot.columns(), places, light, self.outside);
            } else {
                shapes.all(snapshot.columns());
            }
        }
    }

    /// Divides sums over `grid` x `grid` samples.
    #[inline(always)]
    fn finish(&mut self, tile: &mut Tile, grid: u32) {
        if grid == 1 {
            return;
        }
        let share = F::splat(self.s, 1.0 / (grid as f32 * grid as f32));
        for column in &mut tile.radiance {
            for at in (0..column.len()).step_by(F::<S>::LANES) {
                (F::load(self.s, &column[at..]) * share).store(&mut column[at..]);
            }
        }
    }
}

/// No light in any lane.
#[inline(always)]
fn dark<S: Simd>(s: S) -> F3<S> {
    splat3(s, [0.0; 3])
}
