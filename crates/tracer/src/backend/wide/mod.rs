//! Packets of rays at the CPU's native width: `f32` kernels propose, `f64` settles.
//!
//! A tile is traced as streams. Its primary rays go packet by packet; lanes whose surfaces reflect are gathered in a
//! queue, which is traced in full packets as the next stream, until no lane goes on. Every lane computes on its own,
//! so a pixel's bits depend on neither the number of lanes nor its neighbours.

mod light;
mod meet;
mod packet;
mod queue;
mod search;
mod settle;
mod walk;

use fearless_simd::{Level, Simd, dispatch};

use super::{Backend, Frame};
use crate::film::{BLOCK, BLOCK_PIXELS};
use crate::integrator::finish;
use crate::lanes::{F, F3, splat3};
use crate::{Stats, Tile};
use packet::{Packet, Primary};
use queue::Queue;

/// The default backend.
pub(super) struct Wide;

impl Backend for Wide {
    fn name(&self) -> &'static str {
        "wide"
    }

    fn doc(&self) -> &'static str {
        "packets of rays in f32 at the CPU's native width, settled in f64"
    }

    fn level(&self) -> &'static str {
        // The detected level and its proof print as `Avx512(Avx512 { .. })`.
        let level = format!("{:?}", Level::new());
        let known = ["Avx512", "Avx2", "Sse4_2", "Sse2", "Neon", "WasmSimd128"];
        known.iter().find(|name| level.starts_with(**name)).unwrap_or(&"fallback")
    }

    fn trace(&self, frame: &Frame<'_>, tile: &mut Tile) -> Stats {
        dispatch!(Level::new(), s => trace_tile(s, frame, tile))
    }
}

/// Traces one tile with the instructions that `s` stands for.
#[inline(always)]
fn trace_tile<S: Simd>(s: S, frame: &Frame<'_>, tile: &mut Tile) -> Stats {
    for column in &mut tile.radiance {
        column.fill(0.0);
    }
    let grid = frame.view.grid;
    let mut tracer = Tracer { s, frame, stats: Stats::default(), next: Queue::default() };
    for sample in 0..grid * grid {
        tracer.trace_sample(tile, sample % grid, sample / grid);
    }
    tracer.stats.not_finite += finish(tile, grid);
    tracer.stats
}

/// What tracing a tile keeps at hand.
struct Tracer<'a, S: Simd> {
    s: S,
    frame: &'a Frame<'a>,
    stats: Stats,
    /// Rays of the next stream.
    next: Queue,
}

/// Where packets come from: the camera, or the stream gathered by the packets before.
enum Source {
    Camera(u32),
    Stream { stream: Queue, at: usize, depth: u32 },
}

impl<S: Simd> Tracer<'_, S> {
    /// Adds one sample of every pixel to the tile.
    #[inline(always)]
    fn trace_sample(&mut self, tile: &mut Tile, column: u32, row: u32) {
        let lanes = F::<S>::LANES;
        let packets = tile.depth.len() / lanes;
        let grid = self.frame.view.grid;
        let keeps = (column, row) == (grid / 2, grid / 2);
        let primary = Primary::new(self.s, self.frame, tile, column, row);
        let mut source = Source::Camera(0);
        loop {
            let (packet, depth, start) = match &mut source {
                Source::Camera(at) if (*at as usize) < packets => {
                    *at += 1;
                    (primary.packet(self.s, tile, *at - 1), 0, Some((*at - 1) as usize * lanes))
                }
                Source::Stream { stream, at, depth } if *at < stream.len() => {
                    *at += lanes;
                    (stream.packet(self.s, *at - lanes), *depth, None)
                }
                Source::Camera(_) => {
                    source = Source::Stream { stream: std::mem::take(&mut self.next), at: 0, depth: 1 };
                    continue;
                }
                Source::Stream { .. } if self.next.len() == 0 => break,
                Source::Stream { stream, at, depth } => {
                    stream.clear();
                    std::mem::swap(stream, &mut self.next);
                    (*at, *depth) = (0, *depth + 1);
                    continue;
                }
            };
            self.trace_packet(tile, packet, depth, start, keeps);
        }
    }

    /// Traces a packet and adds its light to the tile; `start` is where a camera packet lies in the tile's columns.
    #[inline(always)]
    fn trace_packet(
        &mut self,
        tile: &mut Tile,
        packet: Packet<S>,
        depth: u32,
        start: Option<usize>,
        keeps: bool,
    ) {
        let rays = if depth == 0 { &mut self.stats.rays.primary } else { &mut self.stats.rays.reflection };
        *rays += packet.live.count();
        let best = self.nearest(&packet);
        let light = self.gather(&packet, &best, depth);
        match start {
            Some(start) => {
                add_block(&mut tile.radiance, start, light, self.s);
                if keeps {
                    best.distance(self.s).store(&mut tile.depth[start..]);
                    best.prim.store(&mut tile.surface[start..]);
                }
            }
            None => add_lanes(&mut tile.radiance, &packet, light),
        }
    }
}

/// Adds a packet of neighbouring pixels.
#[inline(always)]
fn add_block<S: Simd>(radiance: &mut [Vec<f32>; 3], start: usize, light: F3<S>, s: S) {
    for (column, light) in radiance.iter_mut().zip([light.x, light.y, light.z]) {
        let pixels = &mut column[start..];
        (F::load(s, pixels) + light).store(pixels);
    }
}

/// Adds a packet whose lanes belong to any pixels, each to one of its own.
#[inline(always)]
fn add_lanes<S: Simd>(radiance: &mut [Vec<f32>; 3], packet: &Packet<S>, light: F3<S>) {
    for lane in packet.live.lanes() {
        let pixel = packet.pixel.lane(lane) as usize;
        for (column, light) in radiance.iter_mut().zip([light.x, light.y, light.z]) {
            column[pixel] += light.lane(lane);
        }
    }
}

/// No light in any lane.
#[inline(always)]
fn dark<S: Simd>(s: S) -> F3<S> {
    splat3(s, [0.0; 3])
}

const _: () =
    assert!(BLOCK as usize * BLOCK as usize == BLOCK_PIXELS, "a block is whole packets of 4, 8 or 16");
