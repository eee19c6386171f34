//! Where the packets of a chunk send their rays on: mirrored, from their points in `f64`.
//!
//! As everywhere in a chunk, each step is taken for all packets before the next.

use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;

use super::Tracer;
use super::batch::Batch;
use super::packet::kernel_rays;
use super::queue::Leaving;
use crate::lanes::{D3, F, F3, M, narrow3, pick3};

/// Reflected rays of a packet.
#[derive(Clone, Copy)]
pub(super) struct Sent<S: Simd> {
    /// Lanes that send one on.
    pub(super) lanes: M<S>,
    /// How much of the light along it counts.
    pub(super) weight: F3<S>,
    pub(super) origin: D3<S>,
    pub(super) direction: D3<S>,
}

impl<S: Simd> Tracer<'_, S> {
    /// Queues the mirrored rays of the first packets of the chunk. Compiled apart.
    #[inline(always)]
    pub(super) fn send_on(&mut self, batch: &impl Batch<S>, count: usize, depth: u32) {
        for place in 0..count {
            self.weigh_reflections(batch, place, depth);
        }
        self.s.vectorize(
            #[inline(always)]
            || {
                for place in 0..count {
                    if self.chunk.sent[place].lanes.any() {
                        self.mirror(batch, place);
                    }
                }
            },
        );
        self.s.vectorize(
            #[inline(always)]
            || {
                for place in 0..count {
                    if self.chunk.sent[place].lanes.any() {
                        self.queue(batch, place);
                    }
                }
            },
        );
    }

    /// Finds which lanes of a packet send rays on, and how much of their light counts.
    #[inline(always)]
    fn weigh_reflections(&mut self, batch: &impl Batch<S>, place: usize, depth: u32) {
        let view = self.frame.view;
        let arriving = self.packet_of(batch, place).weight;
        let (mut on, mut weights) = (M::splat(self.s, false), arriving);
        for group in 0..self.chunk.groups[place].len() {
            let (mask, material) = self.chunk.groups[place].get(self.s, group);
            let row = &self.frame.snapshot.material_rows()[material];
            if !row.reflects {
                continue;
            }
            let weight = arriving.times(F3::of(arriving.x, &row.tint));
            let largest = weight.x.max(weight.y).max(weight.z);
            let positive = mask & F::splat(self.s, 0.0).less(largest);
            self.stats.skipped.not_reflective += (mask & !positive).count();
            if depth >= view.max_depth {
                self.stats.skipped.depth_limit += positive.count();
                continue;
            }
            let faint = positive & largest.less(F::splat(self.s, view.weight_cutoff));
            self.stats.skipped.weight_cutoff += faint.count();
            on = on | self.lead_on(positive & !faint, self.chunk.best[place].prim);
            weights = F3::select(mask, weight, weights);
        }
        (self.chunk.sent[place].lanes, self.chunk.sent[place].weight) = (on, weights);
    }

    /// Mirrors the rays of a packet.
    #[inline(always)]
    fn mirror(&mut self, batch: &impl Batch<S>, place: usize) {
        let packet = self.packet_of(batch, place);
        let best = self.chunk.best[place];
        let settled = self.settle_every(&packet, &best, self.chunk.sent[place].lanes);
        let (_, d) = packet.precise(self.s);
        let geometric = mirrored(d, settled.normal);
        let sent = &mut self.chunk.sent[place];
        sent.origin = settled.point;
        sent.direction = if self.frame.snapshot.columns().smooth {
            let smooth = mirrored(d, settled.shading);
            let above = F::splat(self.s, 0.0).less(narrow3(smooth).dot(self.chunk.normal[place]));
            pick3(above, smooth, geometric)
        } else {
            geometric
        };
    }

    /// Queues the mirrored rays of a packet.
    #[inline(always)]
    fn queue(&mut self, batch: &impl Batch<S>, place: usize) {
        let best = self.chunk.best[place];
        let Sent { lanes, weight, origin, direction } = self.chunk.sent[place];
        let (rays, inverse_length) = kernel_rays(self.s, narrow3(origin), narrow3(direction));
        self.spreads.starts.add(lanes, best.prim, rays.origin);
        self.spreads.units.add(lanes, best.prim, rays.direction);
        let leaving = Leaving {
            origin,
            direction,
            start: rays.origin,
            unit: rays.direction,
            inverse_length,
            weight,
            pixel: self.packet_of(batch, place).pixel,
            prim: best.prim,
            facet: best.facet,
        };
        self.next.push(lanes, &leaving);
    }
}

/// A direction mirrored about a unit normal.
#[inline(always)]
fn mirrored<S: Simd>(d: D3<S>, n: D3<S>) -> D3<S> {
    let along = d.dot(n);
    n.scale_add(-(along + along), d)
}
