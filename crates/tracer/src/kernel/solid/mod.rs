//! Rays against a convex shape, or against the surface that a solid made of others has on one: between which distances rays
//! run inside each, with error bounds.

mod condition;
mod convex;
mod half_spaces;
mod stretch;
#[cfg(test)]
mod tests;

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Arithmetic, Lane, LaneMask, Member, Shape};
use fearless_simd::Simd;
use smallvec::SmallVec;

use super::{Crossing, Facet, Kernel, NearHit, PlaneRow, Proposal, Rays, Tried, bound};
use crate::lanes::{D, D3, F, F3, M, U};
use crate::numeric::{DIRECTION_ERROR, PLAN_MARGIN};
use condition::Conditions;
use convex::Convex;
use stretch::Sides;
pub(crate) use stretch::{End, Stretch};

/// A convex shape, or the part of a solid that one is.
#[derive(Debug, Clone)]
pub(crate) struct SolidRow {
    own: Convex,
    /// The other shapes that decide where its surface is the solid's, by their numbers in the solid; but for those that are
    /// nowhere near.
    others: Vec<(u32, Convex)>,
    conditions: Conditions,
    /// What makes normals of the shape those of the solid: 1, or −1 of what is taken away.
    outwards: f64,
    /// Whether it is a part of a solid.
    is_member: bool,
}

/// What of the shape that rays leave is known.
struct Left<S: Simd> {
    /// Rays that leave this very shape.
    own: M<S>,
    /// And the facet that they leave.
    facet: U<S>,
}

impl SolidRow {
    /// A shape that is its own solid, relative to an origin; `in_frame` is the same in the frame that rays are carried into its
    /// own space from. `None` of shapes that are not convex, or have no inside.
    pub(crate) fn whole(shape: &Shape, in_frame: &Shape, prim: u32) -> Option<Self> {
        let own = Convex::new(shape, in_frame, prim)?;
        Some(Self {
            own,
            others: Vec::new(),
            conditions: Conditions::default(),
            outwards: 1.0,
            is_member: false,
        })
    }

    /// A part of a solid, whose shapes `place` gives relative to an origin. `None` where that gives none, or one that it depends
    /// on is not convex.
    pub(crate) fn member(
        member: &Member,
        place: impl Fn(&Shape) -> Option<Shape>,
        prim: u32,
    ) -> Option<Self> {
        let solid = member.solid();
        let convex = |shape: &Shape| Convex::new(&place(shape)?, shape, prim);
        let conditions = Conditions::of(solid.rule(), member.number())?;
        let outwards = if solid.rule().is_negative(member.number()) { -1.0 } else { 1.0 };
        let near = conditions.shapes().into_iter().filter_map(|number| {
            let shape = &solid.shapes()[number as usize];
            may_touch(member.bounds(), shape.bounds()).then(|| convex(shape).map(|other| (number, other)))
        });
        let others = near.collect::<Option<_>>()?;
        Some(Self { own: convex(member.shape())?, others, conditions, outwards, is_member: true })
    }

    /// Whether rays that leave it outwards never meet it again.
    pub(crate) fn is_convex(&self) -> bool {
        !self.is_member
    }

    /// The crossing nearest ahead, and on which facet it lies.
    #[inline(always)]
    fn nearest<S: Simd>(&self, s: S, rays: &Rays<S>, left: &Left<S>) -> (Proposal<S>, U<S>) {
        let (zero, none) = (F::splat(s, 0.0), M::splat(s, false));
        let own = self.own.stretch(s, rays);
        let mut proposal = Proposal { t: zero, error: zero, hit: none, undecided: none };
        let mut facet = own.ends[0].facet;
        if !(!own.misses).any() {
            return (proposal, facet);
        }
        let mut open = left.is_clear(s, &own);
        proposal.undecided = !own.misses & !open;
        let mut others: SmallVec<[Stretch<S>; 4]> = SmallVec::new();
        for end in &own.ends {
            let ahead = open & end.is_ahead(s);
            if !ahead.any() {
                continue;
            }
            if others.is_empty() {
                others.extend(self.others.iter().map(|(_, other)| other.stretch(s, rays)));
            }
            let [yes, no] = self.is_surface(s, &others, end);
            let hit = ahead & yes & end.known;
            let half = F::splat(s, 0.5);
            let (t, off) = ((end.least + end.most) * half, (end.most - end.least) * half);
            let error = bound(s, t.abs().mul_add(F::splat(s, DIRECTION_ERROR), off));
            proposal.t = F::pick(hit, t, proposal.t);
            proposal.error = F::pick(hit, error, proposal.error);
            facet = U::pick(hit, end.facet, facet);
            proposal.hit = proposal.hit | hit;
            let passes = ahead & no;
            proposal.undecided = proposal.undecided | (ahead & !hit & !passes);
            open = open & !(ahead & !passes);
        }
        (proposal, facet)
    }

    /// Where an end of the own stretch is on the solid's surface, and where it is not, for certain.
    #[inline(always)]
    fn is_surface<S: Simd>(&self, s: S, others: &[Stretch<S>], end: &End<S>) -> [M<S>; 2] {
        let sides = |number: u32| {
            let place = self.others.iter().position(|(other, _)| *other == number);
            place.map_or(Sides::ALL.not(), |place| others[place].sides(end))
        };
        let held = self.conditions.hold(&sides);
        [held.inside, held.outside].map(|bits| M::from_bits(s, bits))
    }
}

impl<S: Simd> Left<S> {
    /// Rays which certainly cross the shape at two places that are both known to be ahead or behind, but for one of a ray
    /// that leaves this shape: the end on the facet that it leaves is where it begins.
    #[inline(always)]
    fn is_clear(&self, s: S, stretch: &Stretch<S>) -> M<S> {
        let [first, last] = stretch.ends.map(|end| {
            let begins = !(end.is_ahead(s) | end.is_not_ahead(s));
            let left = self.own & begins & end.known & end.facet.equals(self.facet);
            [left, begins & !left]
        });
        let leaves = (first[0] & !last[0]) | (last[0] & !first[0]);
        stretch.crosses & !first[1] & !last[1] & (leaves | !self.own)
    }
}

impl Kernel for SolidRow {
    type Face = PlaneRow;

    #[inline(always)]
    fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, tried: &Tried<S>, mut found: impl FnMut(Crossing<S>)) {
        let mut lanes = tried.lanes;
        let mut left = Left { own: M::splat(s, false), facet: tried.leaving.facet };
        if tried.leaving.any {
            left.own = tried.leaving.prim.is(tried.prim);
            if tried.outside && self.is_convex() {
                lanes = lanes & !left.own;
            }
        }
        let (proposal, facet) = self.nearest(s, rays, &left);
        found(Crossing { proposal, facet: Facet::ByLane(facet), lanes });
    }

    #[inline(always)]
    fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>) {
        let (point, normal) = self.own.surface(s, hit);
        (point, normal.scale(F::splat(s, self.outwards as f32)))
    }

    #[inline(always)]
    fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
        self.own.off(s, hit)
    }

    #[inline(always)]
    fn normal<S: Simd>(&self, s: S, hit: &impl NearHit<S>, point: D3<S>) -> D3<S> {
        let normal = self.own.normal(s, hit, point);
        normal.scale(D::splat(s, self.outwards))
    }

    fn all_normals(&self, center: DVec3, half: DVec3, test: impl Fn(DVec3, DVec3) -> bool) -> bool {
        self.own.all_normals(center, half, |normal, half| test(normal * self.outwards, half))
    }

    /// Rays that leave a member may meet it again, wherever they begin.
    fn is_outside(&self, point: DVec3) -> bool {
        self.is_member || self.own.is_outside(point)
    }
}

/// Whether what lies within two boxes may have points in common, however their corners were rounded.
fn may_touch(one: Option<Aabb>, other: Option<Aabb>) -> bool {
    let (Some(one), Some(other)) = (one, other) else { return true };
    let reach = [one.min, one.max, other.min, other.max].map(|p| p.abs().max_element());
    let pad = DVec3::splat(reach.into_iter().fold(0.0, f64::max) * PLAN_MARGIN);
    !one.intersection(Aabb { min: other.min - pad, max: other.max + pad }).is_empty()
}
