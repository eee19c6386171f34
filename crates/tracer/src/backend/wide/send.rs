//! Where the packets of a chunk send their rays on: mirrored, from their points in `f64`.

use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;

use super::Tracer;
use super::batch::Batch;
use super::queue::Leaving;
use crate::lanes::{D3, F, F3, M, narrow3, pick3};

impl<S: Simd> Tracer<'_, S> {
    /// Queues the mirrored rays of the first packets of the chunk. Compiled apart.
    #[inline(always)]
    pub(super) fn send_on(&mut self, batch: &impl Batch<S>, count: usize, depth: u32) {
        self.s.vectorize(
            #[inline(always)]
            || {
                for place in 0..count {
                    let (lanes, weight) = self.weigh_reflections(batch, place, depth);
                    if lanes.any() {
                        self.mirror(batch, place, lanes, weight);
                    }
                }
            },
        );
    }

    /// Finds which lanes of a packet send rays on, and how much of their light counts.
    #[inline(always)]
    fn weigh_reflections(&mut self, batch: &impl Batch<S>, place: usize, depth: u32) -> (M<S>, F3<S>) {
        let view = self.frame.view;
        let arriving = batch.weights(self.s, self.chunk.at[place]);
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
        (on, weights)
    }

    /// Queues the mirrored rays of some lanes of a packet.
    #[inline(always)]
    fn mirror(&mut self, batch: &impl Batch<S>, place: usize, lanes: M<S>, weight: F3<S>) {
        let packet = &self.packet_of(batch, place);
        let best = self.chunk.best[place];
        let settled = self.settle_every(packet, &best, lanes);
        let (_, d) = packet.precise_unit(self.s);
        let geometric = mirrored(d, settled.normal);
        let direction = if self.frame.snapshot.columns().smooth {
            let smooth = mirrored(d, settled.shading);
            let above = F::splat(self.s, 0.0).less(narrow3(smooth).dot(self.chunk.normal[place]));
            pick3(above, smooth, geometric)
        } else {
            geometric
        };
        self.spreads.sent.add(lanes, best.prim, &[narrow3(settled.point), narrow3(direction)]);
        let leaving = Leaving {
            origin: settled.point,
            direction,
            weight,
            pixel: batch.pixels(self.s, self.chunk.at[place]),
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
