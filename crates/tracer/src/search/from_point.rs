//! Rays from one point to several others: shadow rays to the points of a lamp.

use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Span};
use fearless_simd::Simd;

use super::{OwnSegments, Packet, PreciseRays, Searcher, ShadowRays, drift, kernel_rays};
use crate::SurfaceId;
use crate::cull::Candidates;
use crate::film::NOTHING;
use crate::kernel::{Leaving, Target};
use crate::lanes::{Column, D, D3, F, M, MOST_LANES, U, load_wide3, narrow3, splat_wide, store_wide3};
use crate::numeric::{END_ERROR, POINT_ERROR};

/// Segments from a point, column by column, with room for a packet more than there are.
#[derive(Default)]
pub(crate) struct FromPoint {
    /// In the snapshot's frame.
    origin: DVec3,
    /// Where in that frame coordinates are zero.
    zero: DVec3,
    leaving: Option<SurfaceId>,
    length: usize,
    to: [Column<f64>; 3],
    end: Column<f64>,
}

impl FromPoint {
    /// Begins anew from a point in the snapshot's frame, which may lie on a surface; `zero` is where the snapshot's columns have
    /// their zero.
    pub(crate) fn start(&mut self, origin: DVec3, zero: DVec3, leaving: Option<SurfaceId>) {
        (self.origin, self.zero, self.leaving, self.length) = (origin, zero, leaving, 0);
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.length
    }

    /// The way of a segment.
    pub(crate) fn to(&self, at: usize) -> DVec3 {
        let [x, y, z] = &self.to;
        DVec3::new(x[at], y[at], z[at])
    }

    /// Adds the way to another point, of which things block the share `end`.
    pub(crate) fn push(&mut self, to: DVec3, end: f64) {
        self.make_room();
        for (column, way) in self.to.iter_mut().zip(to.to_array()) {
            column[self.length] = way;
        }
        self.end[self.length] = end;
        self.length += 1;
    }

    /// Adds the ways of the first lanes.
    #[inline(always)]
    pub(crate) fn push_lanes<S: Simd>(&mut self, to: D3<S>, end: f64, lanes: usize) {
        self.make_room();
        store_wide3(to, &mut self.to, self.length);
        self.end[self.length..self.length + lanes].fill(end);
        self.length += lanes;
    }

    /// Room for a packet beyond the one that may be added next.
    fn make_room(&mut self) {
        let needed = self.length + 2 * MOST_LANES;
        if self.end.len() < needed {
            let room = needed.next_power_of_two();
            self.to.iter_mut().for_each(|column| column.resize(room, 0.0));
            self.end.resize(room, 0.0);
        }
    }

    #[inline(always)]
    fn packet_at<S: Simd>(&self, s: S, at: usize) -> Packet<'_, S, Self> {
        let (origin, direction) = self.precise(s, at);
        let (rays, inverse_length) = kernel_rays(s, narrow3(origin), narrow3(direction));
        let (lanes, left) = (F::<S>::LANES, self.length - at);
        let of = |number: Option<u32>| U::splat(s, number.unwrap_or(NOTHING));
        Packet {
            precise: self,
            at,
            rays: rays.drifting(F::splat(s, drift(self.zero))),
            inverse_length,
            leaving: Leaving {
                prim: of(self.leaving.map(|surface| surface.prim)),
                facet: of(self.leaving.map(|surface| surface.facet)),
                any: self.leaving.is_some(),
            },
            live: M::from_bits(s, if left >= lanes { u64::MAX >> (64 - lanes) } else { (1 << left) - 1 }),
        }
    }
}

impl<S: Simd> PreciseRays<S> for FromPoint {
    const UNIT: bool = false;
    const FROM_ORIGIN: bool = true;

    fn ray(&self, at: usize) -> Ray {
        Ray::new(self.origin, self.to(at))
    }

    fn span(&self, at: usize) -> Span {
        Span::until(self.end[at])
    }

    #[inline(always)]
    fn precise(&self, s: S, at: usize) -> (D3<S>, D3<S>) {
        (splat_wide(s, self.origin - self.zero), load_wide3(s, &self.to, at))
    }

    #[inline(always)]
    fn ends(&self, s: S, at: usize) -> [D3<S>; 2] {
        let (origin, direction) = self.precise(s, at);
        [origin, direction.scale_add(D::load(s, &self.end[at..]), origin)]
    }
}

impl<S: Simd> Searcher<'_, S> {
    /// Finds out which segments from a point are blocked.
    #[inline(always)]
    pub(crate) fn blocked_from(&mut self, rays: &FromPoint, among: &Candidates, blocked: &mut Vec<bool>) {
        let s = self.s;
        blocked.clear();
        for at in (0..rays.len()).step_by(F::<S>::LANES) {
            let packet = rays.packet_at(s, at);
            let distance = D::load(s, &rays.end[at..]).narrow() / packet.inverse_length;
            // Lengths are off by a share of themselves.
            let off = distance * F::splat(s, END_ERROR / POINT_ERROR);
            let segments = ShadowRays {
                rays: packet.rays.drifting(off),
                leaving: packet.leaving,
                live: packet.live,
                target: Target { distance, end: None },
                behind: &[],
            };
            let bits = self.occluded(&OwnSegments(&packet), &segments, among).bits();
            let lanes = (rays.len() - at).min(F::<S>::LANES);
            blocked.extend((0..lanes).map(|lane| bits >> lane & 1 == 1));
        }
    }
}
