//! Streams of reflected rays: what the rays of one may meet, which lights reach that, and what they send on.

use fearless_simd::Simd;

use super::tiles::TileTracer;
use crate::Tile;
use crate::cull::{Beam, Candidates};
use crate::lanes::outlined;
use crate::stream::Queue;

/// The stream of reflected rays that is being traced.
#[derive(Default)]
pub(super) struct Bounce {
    pub(super) stream: Queue,
    beams: Vec<Beam>,
    /// Shapes that its rays may meet.
    reachable: Candidates,
}

impl<S: Simd> TileTracer<'_, S> {
    /// Adds the light that arrives along reflected rays, and along those that are reflected again.
    pub(super) fn follow(&mut self, bounce: &mut Bounce, tile: &mut Tile) {
        for depth in 1.. {
            std::mem::swap(&mut bounce.stream, self.shader.next);
            self.shader.next.clear();
            if bounce.stream.len() == 0 {
                break;
            }
            self.trace_stream(bounce, tile, depth);
        }
    }

    /// Adds the light that arrives along the rays of a stream.
    #[inline(always)]
    fn trace_stream(&mut self, bounce: &mut Bounce, tile: &mut Tile, depth: u32) {
        let Bounce { stream, beams, reachable } = bounce;
        let sent = &mut *self.shader.sent;
        outlined(
            self.s,
            #[inline(always)]
            || {
                beams.clear();
                for at in 0..sent.len() {
                    let (prim, [start, unit]) = sent.get(at);
                    beams.push(Beam::new(prim, start, unit));
                }
                sent.clear();
            },
        );
        let (planner, snapshot) = (self.planner, self.planner.snapshot);
        let paths = self.shader.gathers.paths;
        // Rays that go every way may meet everything.
        if planner.skip.beams && !paths {
            reachable.reachable(snapshot.columns(), beams, planner.outside);
        } else {
            reachable.all(snapshot.columns());
        }
        let nothing = reachable.is_empty() && snapshot.columns().general_unbounded.is_empty();
        let stats = &mut self.shader.search.stats;
        if nothing && self.shader.gathers.is_dark() {
            stats.skipped.nothing_ahead += stream.len() as u64;
        } else if !paths && self.plan_ahead(beams, reachable) {
            self.shader.plan.plan_darkness(&planner, beams, &reachable.points);
            self.shader.search.stats.rays.reflection += stream.len() as u64;
            outlined(
                self.s,
                #[inline(always)]
                || self.shader.shade(&*stream, &&*reachable, tile, depth),
            );
        } else {
            self.shader.plan.dark.clear();
            self.trace(&*stream, reachable, tile, depth);
        }
    }

    /// Finds out what may stand between lights and all that the rays of some beams may meet, if that is bounded.
    fn plan_ahead(&mut self, beams: &[Beam], reachable: &mut Candidates) -> bool {
        let snapshot = self.planner.snapshot;
        let known = reachable.find_points_of(snapshot.columns(), beams);
        if known {
            self.shader.plan.plan_lights(&self.planner, &reachable.points);
        }
        known || (snapshot.light_rows().is_empty() && snapshot.lamps().asked().is_empty())
    }
}
