//! Which rays that leave a solid with flat faces may meet it again: those that run into it.

use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;

use super::Searcher;
use super::occluded::ShadowRays;
use super::packet::Packet;
use crate::film::NOTHING;
use crate::kernel::{End, Leaving, PlaneRow, Rays};
use crate::lanes::{F, M, U, splat3};
use crate::numeric::{DIRECTION_ERROR, PLAN_MARGIN};

/// Rays that are tested against the faces of a solid.
pub(crate) struct SelfHits<S: Simd> {
    /// Those that leave it.
    own: M<S>,
    /// Those that leave another shape, or run into this one.
    pub(crate) possible: M<S>,
    /// Those that leave it so flatly that `f32` cannot decide whether they run into it.
    pub(crate) undecided: M<S>,
}

impl<S: Simd> SelfHits<S> {
    /// The facets through which rays run into the solid that they leave; [`NOTHING`] for all others.
    #[inline(always)]
    pub(crate) fn entered(&self, s: S, leaving: &Leaving<S>) -> U<S> {
        U::pick(self.own & self.possible, leaving.facet, U::splat(s, NOTHING))
    }
}

impl<S: Simd> Searcher<'_, S> {
    /// Which rays of a packet may meet a solid with these faces.
    #[inline(always)]
    pub(crate) fn self_hits<P>(
        &self,
        packet: &Packet<'_, S, P>,
        faces: &[impl AsRef<PlaneRow>],
    ) -> SelfHits<S> {
        self.self_hits_by(&packet.leaving, packet.live, faces, |face| self.sides_of_rays(&packet.rays, face))
    }

    /// Which segments may meet a solid with these faces. All that leave one face for a common end run to the side of it
    /// that the end is on.
    #[inline(always)]
    pub(crate) fn self_hits_of_segments(
        &self,
        rays: &ShadowRays<'_, S>,
        faces: &[impl AsRef<PlaneRow>],
    ) -> SelfHits<S> {
        let Some(end) = rays.target.end else {
            let sides = |face: &PlaneRow| self.sides_of_rays(&rays.rays, face);
            return self.self_hits_by(&rays.leaving, rays.live, faces, sides);
        };
        self.self_hits_by(&rays.leaving, rays.live, faces, |face| {
            let (off, size) = match end {
                End::AtInfinity(direction) => (face.normal.dot(direction), 1.0),
                End::At(point) => {
                    let size = face.distance.abs() + point.abs().element_sum();
                    (face.normal.dot(point) - face.distance, size)
                }
            };
            let side = |beyond: bool| M::splat(self.s, beyond);
            (side(off > size * PLAN_MARGIN), side(off < -size * PLAN_MARGIN))
        })
    }

    /// Which rays run to the outer side of a face for certain, and which to the inner.
    #[inline(always)]
    fn sides_of_rays(&self, rays: &Rays<S>, face: &PlaneRow) -> (M<S>, M<S>) {
        let least = F::splat(self.s, DIRECTION_ERROR);
        let slope = splat3(self.s, face.normal32).dot(rays.direction);
        (least.less(slope), slope.less(-least))
    }

    /// `side` gives the rays that run to the outer side of a face for certain, and those that run to the inner.
    #[inline(always)]
    fn self_hits_by(
        &self,
        leaving: &Leaving<S>,
        live: M<S>,
        faces: &[impl AsRef<PlaneRow>],
        side: impl Fn(&PlaneRow) -> (M<S>, M<S>),
    ) -> SelfHits<S> {
        let none = M::splat(self.s, false);
        let own = if leaving.any { live & leaving.prim.is(faces[0].as_ref().prim) } else { none };
        let mut hits = SelfHits { own, possible: live & !own, undecided: none };
        if self.outside || !own.any() {
            return hits;
        }
        for (facet, lanes) in leaving.facet.groups(own) {
            let (outwards, inwards) = side(faces[facet as usize].as_ref());
            hits.possible = hits.possible | (lanes & inwards);
            hits.undecided = hits.undecided | (lanes & !(outwards | inwards));
        }
        hits
    }
}
