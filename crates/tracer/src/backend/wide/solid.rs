//! Which rays that leave a solid with flat faces may meet it again: those that run into it.

use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;

use super::Tracer;
use super::packet::{Left, Packet};
use super::shadow::Ways;
use crate::film::NOTHING;
use crate::kernel::PlaneRow;
use crate::lanes::{F, M, U, splat3};
use crate::numeric::{DIRECTION_ERROR, PLAN_MARGIN};

/// Rays that are tested against the faces of a solid.
pub(super) struct Again<S: Simd> {
    /// Those that have left it.
    pub(super) own: M<S>,
    /// Those that have left another shape, or run into this one.
    pub(super) may: M<S>,
    /// Those that leave it so flatly that `f32` cannot tell whether they run into it.
    pub(super) undecided: M<S>,
}

impl<S: Simd> Again<S> {
    /// The facets through which rays run into the solid that they leave; [`NOTHING`] for all others.
    #[inline(always)]
    pub(super) fn entered(&self, s: S, left: &Left<S>) -> U<S> {
        U::pick(self.own & self.may, left.facet, U::splat(s, NOTHING))
    }
}

impl<S: Simd> Tracer<'_, S> {
    /// Which rays of a packet may meet a solid with these faces.
    #[inline(always)]
    pub(super) fn again(&self, packet: &Packet<'_, S>, faces: &[impl AsRef<PlaneRow>]) -> Again<S> {
        let least = F::splat(self.s, DIRECTION_ERROR);
        self.again_by(&packet.left, packet.live, faces, |face| {
            let slope = splat3(self.s, face.normal32).dot(packet.rays.direction);
            (least.less(slope), slope.less(-least))
        })
    }

    /// Which ways to a light may meet a solid with these faces. All that leave one face run to the side of it that the
    /// light is on.
    #[inline(always)]
    pub(super) fn again_to_light(&self, ways: &Ways<S>, faces: &[impl AsRef<PlaneRow>]) -> Again<S> {
        let target = &ways.target;
        self.again_by(&ways.left, ways.live, faces, |face| {
            let (off, size) = if target.at_infinity {
                (face.normal.dot(target.place), 1.0)
            } else {
                let size = face.distance.abs() + target.place.abs().element_sum();
                (face.normal.dot(target.place) - face.distance, size)
            };
            let side = |beyond: bool| M::splat(self.s, beyond);
            (side(off > size * PLAN_MARGIN), side(off < -size * PLAN_MARGIN))
        })
    }

    /// `side` says for certain which rays run to the outer side of a face, and which to the inner.
    #[inline(always)]
    fn again_by(
        &self,
        left: &Left<S>,
        live: M<S>,
        faces: &[impl AsRef<PlaneRow>],
        side: impl Fn(&PlaneRow) -> (M<S>, M<S>),
    ) -> Again<S> {
        let none = M::splat(self.s, false);
        let own = if left.any { live & left.prim.is(faces[0].as_ref().prim) } else { none };
        let mut again = Again { own, may: live & !own, undecided: none };
        if self.outside || !own.any() {
            return again;
        }
        for (facet, lanes) in left.facet.groups(own) {
            let (outwards, inwards) = side(faces[facet as usize].as_ref());
            again.may = again.may | (lanes & inwards);
            again.undecided = again.undecided | (lanes & !(outwards | inwards));
        }
        again
    }
}
