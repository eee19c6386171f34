//! What do the rays of a batch meet?

use fearless_simd::Simd;
use smallvec::SmallVec;

use super::Batch;
use crate::cull::Candidates;
use crate::kernel::mesh::GROUP;
use crate::lanes::F;
use crate::search::{BundleRoom, Hits, Packet, Searcher};

impl<S: Simd> Searcher<'_, S> {
    /// Finds the closest hits of a batch's packets among some shapes, and shows them packet by packet. Where the rays have a
    /// common origin and may meet meshes, packets side by side walk those together, unless there is no `room` for it.
    #[inline(always)]
    pub(crate) fn find_hits<B: Batch<S>>(
        &mut self,
        batch: &B,
        shapes: &Candidates,
        room: Option<&mut BundleRoom<S>>,
        mut show: impl FnMut(&Packet<'_, S, B::Precise>, &Hits<S>),
    ) {
        let stretches =
            (0..batch.stretches()).flat_map(|stretch| batch.stretch(stretch).step_by(F::<S>::LANES));
        let mut places = stretches.filter(|at| !batch.is_idle(*at));
        let together = batch.has_common_origin() && shapes.hold_meshes(self.snapshot.columns());
        let Some(room) = room.filter(|_| together) else {
            for at in places {
                let packet = batch.packet(self.s, at);
                let best = self.closest(&packet, shapes);
                show(&packet, &best);
            }
            return;
        };
        let mut best = [Hits::nothing(self.s); GROUP];
        loop {
            let mut packets: SmallVec<[Packet<'_, S, B::Precise>; GROUP]> = SmallVec::new();
            for at in places.by_ref().take(GROUP) {
                packets.push(batch.packet(self.s, at));
            }
            if packets.is_empty() {
                break;
            }
            self.closest_together(&packets, shapes, &mut best, room);
            for (packet, best) in packets.iter().zip(&best) {
                show(packet, best);
            }
        }
    }
}
