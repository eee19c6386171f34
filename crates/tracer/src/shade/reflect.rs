//! Where the packets of a chunk send their rays on: mirrored, from their points in `f64`.

use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;

use super::Shader;
use crate::lanes::{D3, F, F3, M, U, narrow3, outlined, pick3};
use crate::stream::{Batch, QueuedRays};

impl<S: Simd> Shader<'_, S> {
    /// Queues the mirrored rays of the first packets of the chunk. See [`outlined`].
    #[inline(always)]
    pub(crate) fn continue_paths(&mut self, batch: &impl Batch<S>, count: usize, depth: u32) {
        outlined(
            self.s,
            #[inline(always)]
            || {
                for slot in 0..count {
                    let (lanes, weight) = self.reflections(batch, slot, depth);
                    if lanes.any() {
                        self.mirror(batch, slot, lanes, weight);
                    }
                }
            },
        );
    }

    /// Finds which lanes of a packet send rays on, and how much of their light counts.
    #[inline(always)]
    fn reflections(&mut self, batch: &impl Batch<S>, slot: usize, depth: u32) -> (M<S>, F3<S>) {
        let view = self.view;
        let arriving = batch.weights(self.s, self.chunk.at[slot]);
        let (mut on, mut weights) = (M::splat(self.s, false), arriving);
        for group in 0..self.chunk.groups[slot].len() {
            let (mask, material) = self.chunk.groups[slot].get(self.s, group);
            let row = &self.search.snapshot.material_rows()[material];
            if !row.reflects {
                continue;
            }
            let weight = arriving.times(F3::of(arriving.x, &row.tint));
            let largest = weight.x.max(weight.y).max(weight.z);
            let positive = mask & F::splat(self.s, 0.0).less(largest);
            self.search.stats.skipped.not_reflective += (mask & !positive).count();
            if depth >= view.max_depth {
                self.search.stats.skipped.depth_limit += positive.count();
                continue;
            }
            let faint = positive & largest.less(F::splat(self.s, view.weight_cutoff));
            self.search.stats.skipped.weight_cutoff += faint.count();
            on = on | self.lead_somewhere(positive & !faint, self.chunk.best[slot].prim);
            weights = F3::select(mask, weight, weights);
        }
        (on, weights)
    }

    /// Queues the mirrored rays of some lanes of a packet.
    #[inline(always)]
    fn mirror(&mut self, batch: &impl Batch<S>, slot: usize, lanes: M<S>, weight: F3<S>) {
        let packet = &self.packet_of(batch, slot);
        let best = self.chunk.best[slot];
        let refined = self.search.refine_every(packet, &best, lanes);
        let (_, d) = packet.precise_unit(self.s);
        let geometric = mirrored(d, refined.normal);
        let direction = if self.search.snapshot.columns().smooth {
            let smooth = mirrored(d, refined.shading);
            let above = F::splat(self.s, 0.0).less(narrow3(smooth).dot(self.chunk.normal[slot]));
            pick3(above, smooth, geometric)
        } else {
            geometric
        };
        self.sent.add(lanes, best.prim, &[narrow3(refined.point), narrow3(direction)]);
        let rays = QueuedRays {
            origin: refined.point,
            direction,
            weight,
            pixel: batch.pixels(self.s, self.chunk.at[slot]),
            prim: best.prim,
            facet: best.facet,
        };
        self.next.push(lanes, &rays);
    }

    /// The lanes whose reflected rays may meet anything; others are counted.
    #[inline(always)]
    fn lead_somewhere(&mut self, lanes: M<S>, prims: U<S>) -> M<S> {
        let mut on = lanes;
        for &prim in &self.plan.dark {
            on = on & !prims.is(prim);
        }
        self.search.stats.skipped.nothing_ahead += lanes.count() - on.count();
        on
    }
}

/// A direction mirrored about a unit normal.
#[inline(always)]
fn mirrored<S: Simd>(d: D3<S>, n: D3<S>) -> D3<S> {
    let along = d.dot(n);
    n.scale_add(-(along + along), d)
}
