//! Streams of reflected rays: what the rays of one may meet, which lights reach that, and what they send on.

use catoptra_core::Rgb;
use fearless_simd::Simd;

use super::Tracer;
use super::beam::Beam;
use super::plan::Shapes;
use super::queue::Queue;
use crate::Tile;

/// A stream of reflected rays under way.
#[derive(Default)]
pub(super) struct Bounce {
    pub(super) stream: Queue,
    beams: Vec<Beam>,
    /// Shapes that its rays may meet.
    met: Shapes,
}

impl<S: Simd> Tracer<'_, S> {
    /// Adds the light that arrives along reflected rays, and along those that are reflected again.
    pub(super) fn follow(&mut self, tile: &mut Tile) {
        let Some(bounce) = self.bounce.take() else { return };
        for depth in 1.. {
            std::mem::swap(&mut bounce.stream, self.next);
            self.next.clear();
            if bounce.stream.len() == 0 {
                break;
            }
            self.trace_stream(bounce, tile, depth);
        }
        self.bounce = Some(bounce);
    }

    /// Adds the light that arrives along the rays of a stream.
    #[inline(always)]
    fn trace_stream(&mut self, bounce: &mut Bounce, tile: &mut Tile, depth: u32) {
        let Bounce { stream, beams, met } = bounce;
        self.s.vectorize(
            #[inline(always)]
            || {
                beams.clear();
                for at in 0..self.spreads.sent.len() {
                    let (prim, [start, unit]) = self.spreads.sent.get(at);
                    beams.push(Beam::new(prim, start, unit));
                }
                self.spreads.sent.clear();
            },
        );
        let snapshot = self.frame.snapshot;
        if self.frame.view.skip.beams {
            met.met_by(snapshot.columns(), beams, self.outside);
        } else {
            met.all(snapshot.columns());
        }
        let nothing = met.is_empty() && snapshot.columns().general_unbounded.is_empty();
        if nothing && snapshot.background() == Rgb::BLACK {
            self.stats.skipped.nothing_ahead += stream.len() as u64;
        } else if self.plan_ahead(beams, met) {
            self.plan_darkness(beams, met);
            self.stats.rays.reflection += stream.len() as u64;
            self.s.vectorize(
                #[inline(always)]
                || self.shade(&*stream, &&*met, tile, depth),
            );
        } else {
            self.dark.clear();
            self.trace(&*stream, met, tile, depth);
        }
    }

    /// Finds out what may stand between lights and all that the rays of some beams may meet, if that has an end.
    fn plan_ahead(&mut self, beams: &[Beam], met: &mut Shapes) -> bool {
        let snapshot = self.frame.snapshot;
        let known = met.find_places_of(snapshot.columns(), beams);
        if known {
            self.plan_lights(&met.places);
        }
        known || snapshot.light_rows().is_empty()
    }
}
