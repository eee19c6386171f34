//! Packets that lie side by side meet much the same boxes and triangles of a mesh: they come to it one after another, and
//! walk its tree together.

use fearless_simd::Simd;

use super::Searcher;
use super::hits::Hits;
use super::occluded::{Segments, Shadows};
use super::packet::{Packet, PreciseRays};
use crate::cull::Candidates;
use crate::kernel::mesh::{BundledRays, GROUP};
use crate::lanes::{Bits, outlined};
use crate::snapshot::Instance;

/// Meshes that some packets have come to and are to walk together.
#[derive(Default)]
pub(crate) struct Later {
    /// The packet under way, as one bit; 0 where each packet walks by itself.
    packet: u32,
    /// Shapes in the order in which packets came to them.
    met: Vec<u32>,
    /// Which packets came to each shape, bit by bit.
    packets: Vec<u32>,
}

impl Later {
    /// Whether the packet under way is to walk a mesh later; that is then noted.
    #[inline(always)]
    pub(super) fn takes(&mut self, prim: u32) -> bool {
        if self.packet == 0 {
            return false;
        }
        let at = prim as usize;
        if self.packets.len() <= at {
            self.packets.resize(at + 1, 0);
        }
        if self.packets[at] == 0 {
            self.met.push(prim);
        }
        self.packets[at] |= self.packet;
        true
    }
}

/// Room for packets that walk a mesh together.
pub(crate) type BundleRoom<S> = [BundledRays<S>; GROUP];

/// Room that holds no rays.
pub(crate) fn bundle_room<S: Simd>(s: S) -> BundleRoom<S> {
    [BundledRays::nothing(s); GROUP]
}

impl<S: Simd> Searcher<'_, S> {
    /// The closest hits of up to [`GROUP`] packets among the given shapes.
    #[inline(always)]
    pub(crate) fn closest_together<P: PreciseRays<S>>(
        &mut self,
        packets: &[Packet<'_, S, P>],
        shapes: &Candidates,
        best: &mut [Hits<S>],
        room: &mut BundleRoom<S>,
    ) {
        for (number, (packet, best)) in packets.iter().zip(&mut *best).enumerate() {
            self.later.packet = 1 << number;
            *best = self.closest(packet, shapes);
        }
        self.walk_later(|search, instance, which| search.walk_together(packets, which, best, instance, room));
    }

    /// Which segments are blocked, of up to [`GROUP`] packets: those that are still open afterwards are not.
    #[inline(always)]
    pub(crate) fn occluded_together<G: Segments<S>>(
        &mut self,
        shadows: &mut [Shadows<'_, S, G>],
        occluders: &Candidates,
        room: &mut BundleRoom<S>,
    ) {
        for (number, shadows) in shadows.iter_mut().enumerate() {
            self.later.packet = 1 << number;
            shadows.open = shadows.open & !self.occluded(shadows.segments, &shadows.rays, occluders);
        }
        self.walk_later(|search, instance, which| search.occlude_together(shadows, which, instance, room));
    }

    /// Walks all meshes that have been noted, each with the packets that came to it.
    #[inline(always)]
    fn walk_later(&mut self, mut walk: impl FnMut(&mut Self, &Instance, u32)) {
        let columns = self.snapshot.columns();
        self.later.packet = 0;
        for at in 0..self.later.met.len() {
            let Later { met, packets, .. } = &mut self.later;
            let prim = met[at];
            let which = std::mem::take(&mut packets[prim as usize]);
            if let Some(instance) = columns.instance(prim) {
                walk(self, instance, which);
            }
        }
        self.later.met.clear();
    }

    /// Finds the nearest triangle of a mesh for some packets, of which there is one at least. See [`outlined`].
    fn walk_together<P: PreciseRays<S>>(
        &mut self,
        packets: &[Packet<'_, S, P>],
        which: u32,
        best: &mut [Hits<S>],
        instance: &Instance,
        room: &mut BundleRoom<S>,
    ) {
        outlined(
            self.s,
            #[inline(always)]
            || {
                let (first, end) = stretch(which);
                let (packets, best) = (&packets[first..end], &mut best[first..end]);
                let which = which >> first;
                if !self.walk_as_bundle(packets, which, best, instance, room) {
                    for packet in Bits(u64::from(which)) {
                        self.walk_mesh(&packets[packet], &mut best[packet], instance);
                    }
                }
            },
        );
    }

    /// Closes the segments of some packets that a mesh blocks. See [`outlined`].
    fn occlude_together<G: Segments<S>>(
        &mut self,
        shadows: &mut [Shadows<'_, S, G>],
        which: u32,
        instance: &Instance,
        room: &mut BundleRoom<S>,
    ) {
        outlined(
            self.s,
            #[inline(always)]
            || {
                let (first, end) = stretch(which);
                let (shadows, which) = (&mut shadows[first..end], which >> first);
                if !self.occlude_as_bundle(shadows, which, instance, room) {
                    for packet in Bits(u64::from(which)) {
                        let Shadows { segments, rays, open } = &mut shadows[packet];
                        *open = self.occlude_by_mesh(*segments, rays, *open, instance);
                    }
                }
            },
        );
    }
}

/// The stretch of packets, from the first to behind the last, of which a bit is set.
#[inline(always)]
fn stretch(which: u32) -> (usize, usize) {
    (which.trailing_zeros() as usize, (u32::BITS - which.leading_zeros()) as usize)
}
