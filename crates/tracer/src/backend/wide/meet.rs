//! What the lanes of a packet show: their surfaces' own look, and where they send their rays on.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, LaneMask, Material, ShadingPoint};
use fearless_simd::Simd;

use super::packet::Packet;
use super::queue::Leaving;
use super::search::Best;
use super::settle::{Groups, Settled};
use super::{Tracer, dark};
use crate::lanes::{D3, F, F3, M, narrow3, pick3};
use crate::numeric::POSITION_ERROR;

/// The lanes that have met something.
pub(super) struct Meeting<S: Simd> {
    /// Which lanes.
    pub(super) hits: M<S>,
    /// Geometric unit normal on the viewer's side.
    pub(super) normal: F3<S>,
    /// Points relative to the snapshot's origin.
    pub(super) point: F3<S>,
    pub(super) shading: ShadingPoint<F<S>>,
}

/// What is known of a packet once it has met something.
pub(super) struct Here<'a, S: Simd> {
    pub(super) packet: &'a Packet<'a, S>,
    pub(super) best: &'a Best<S>,
    pub(super) meeting: &'a Meeting<S>,
    pub(super) groups: &'a Groups,
}

impl<S: Simd> Tracer<'_, S> {
    /// The weighted light of every lane; rays that go on are queued.
    #[inline(always)]
    pub(super) fn gather(&mut self, packet: &Packet<'_, S>, best: &Best<S>, depth: u32) -> F3<S> {
        let hits = best.hits() & packet.live;
        let sky = F3::of(best.t, self.frame.snapshot.background_light()).times(packet.weight);
        if !hits.any() {
            return F3::select(packet.live, sky, dark(self.s));
        }
        // Apart from the meeting, so that the compiler may keep that in registers.
        let mut groups = Groups::new();
        let meeting = self.meet(packet, best, hits, &mut groups);
        let here = Here { packet, best, meeting: &meeting, groups: &groups };
        let local = self.local(&here);
        self.send_on(&here, depth);
        let shown = local.times(packet.weight);
        F3::select(hits, shown, F3::select(packet.live, sky, dark(self.s)))
    }

    /// The surfaces that the lanes have met, shape by shape.
    #[inline(always)]
    fn meet(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        hits: M<S>,
        groups: &mut Groups,
    ) -> Meeting<S> {
        let snapshot = self.frame.snapshot;
        let mut left = hits.bits();
        let prim = best.prim.lane(left.trailing_zeros() as usize);
        let mut mask = hits & best.prim.is(prim);
        groups.add(mask.bits(), snapshot.prims()[prim as usize].material);
        let mut surface = self.surface(packet, best, mask, prim);
        left &= !mask.bits();
        while left != 0 {
            let prim = best.prim.lane(left.trailing_zeros() as usize);
            mask = hits & best.prim.is(prim);
            groups.add(mask.bits(), snapshot.prims()[prim as usize].material);
            surface = self.surface_too(packet, best, mask, prim, surface);
            left &= !mask.bits();
        }
        let d = packet.rays.direction;
        let away = F::splat(self.s, 0.0).less(surface.normal.dot(d));
        let normal = turned(away, surface.normal);
        let mut shading = ShadingPoint {
            position: surface.point,
            normal: turned(away, surface.shading),
            to_viewer: F3::new(-d.x, -d.y, -d.z),
            distance: best.t,
        };
        if snapshot.has_patterns() {
            shading.position = self.place_in_patterns(packet, best, &shading, groups);
        }
        Meeting { hits, normal, point: surface.point, shading }
    }

    /// Positions for materials to judge by: where `f32` cannot tell on which side of a pattern's edge a point lies,
    /// one that `f64` has found to look the same.
    #[inline(always)]
    fn place_in_patterns(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        shading: &ShadingPoint<F<S>>,
        groups: &Groups,
    ) -> F3<S> {
        let mut position = shading.position;
        for group in 0..groups.len() {
            let (mask, material) = groups.get(self.s, group);
            let row = &self.frame.snapshot.material_rows()[material];
            if !row.is_pattern {
                continue;
            }
            let size = packet.rays.reach + best.t;
            let error = size.mul_add(F::splat(self.s, POSITION_ERROR), best.error);
            let lanes = mask & row.material.undecided(shading, error);
            if lanes.any() {
                position = self.settle_pattern(packet, best, lanes, &row.material, position);
            }
        }
        position
    }

    /// As [`place_in_patterns`](Self::place_in_patterns), of lanes that wear one material. Compiled apart, on copies.
    #[inline(always)]
    fn settle_pattern(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        lanes: M<S>,
        material: &Material,
        mut position: F3<S>,
    ) -> F3<S> {
        let (packet, best) = (*packet, *best);
        let point = self.s.vectorize(
            #[inline(always)]
            || self.settle_every(&packet, &best, lanes).point,
        );
        for lane in lanes.lanes() {
            self.stats.settled += 1;
            let near =
                material.reduced(DVec3::new(point.x.lane(lane), point.y.lane(lane), point.z.lane(lane)));
            position.x.set(lane, near.x as f32);
            position.y.set(lane, near.y as f32);
            position.z.set(lane, near.z as f32);
        }
        position
    }

    /// Queues the rays of lanes whose surfaces reflect.
    #[inline(always)]
    fn send_on(&mut self, here: &Here<'_, S>, depth: u32) {
        let Here { packet, best, groups, .. } = here;
        let materials = self.frame.snapshot.material_rows();
        let view = self.frame.view;
        for group in 0..groups.len() {
            let (mask, material) = groups.get(self.s, group);
            let row = &materials[material];
            if !row.reflects() {
                self.stats.skipped.not_reflective += mask.count();
                continue;
            }
            let weight = packet.weight.times(F3::of(best.t, &row.tint));
            let largest = weight.x.max(weight.y).max(weight.z);
            let positive = mask & F::splat(self.s, 0.0).less(largest);
            self.stats.skipped.not_reflective += (mask & !positive).count();
            if !positive.any() {
                continue;
            }
            if depth >= view.max_depth {
                self.stats.skipped.depth_limit += positive.count();
                continue;
            }
            let faint = positive & largest.less(F::splat(self.s, view.weight_cutoff));
            self.stats.skipped.weight_cutoff += faint.count();
            let on = positive & !faint;
            if on.any() {
                self.reflect(here, on, weight);
            }
        }
    }

    /// Queues the mirrored rays of the lanes of `on`, from their points in `f64`.
    #[inline(always)]
    fn reflect(&mut self, here: &Here<'_, S>, on: M<S>, weight: F3<S>) {
        let Here { packet, best, meeting, .. } = here;
        let settled = self.settle_every(packet, best, on);
        let (_, d) = packet.precise(self.s);
        let geometric = mirrored(d, settled.normal);
        let direction = if self.frame.snapshot.columns().smooth {
            let smooth = mirrored(d, settled.shading);
            let above = F::splat(self.s, 0.0).less(narrow3(smooth).dot(meeting.normal));
            pick3(above, smooth, geometric)
        } else {
            geometric
        };
        let leaving = Leaving {
            origin: settled.point,
            direction,
            weight,
            pixel: packet.pixel,
            prim: best.prim,
            facet: best.facet,
        };
        self.next.push(on, &leaving);
    }

    /// Settles lanes, shape by shape.
    #[inline(always)]
    fn settle_every(&mut self, packet: &Packet<'_, S>, best: &Best<S>, lanes: M<S>) -> Settled<S> {
        let mut left = lanes.bits();
        let prim = best.prim.lane(left.trailing_zeros() as usize);
        let mut mask = lanes & best.prim.is(prim);
        let mut settled = self.settle(packet, best, mask, prim);
        left &= !mask.bits();
        while left != 0 {
            let prim = best.prim.lane(left.trailing_zeros() as usize);
            mask = lanes & best.prim.is(prim);
            settled = self.settle_too(packet, best, mask, prim, settled);
            left &= !mask.bits();
        }
        settled
    }

    /// Settles the lanes on another shape. Compiled apart: most packets meet one shape.
    #[inline(always)]
    fn settle_too(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        mask: M<S>,
        prim: u32,
        before: Settled<S>,
    ) -> Settled<S> {
        let (packet, best) = (*packet, *best);
        self.s.vectorize(
            #[inline(always)]
            || self.settle(&packet, &best, mask, prim).over(mask, before),
        )
    }
}

/// The vector turned round where the mask holds.
#[inline(always)]
fn turned<S: Simd>(mask: M<S>, v: F3<S>) -> F3<S> {
    F3::select(mask, F3::new(-v.x, -v.y, -v.z), v)
}

/// A direction mirrored about a unit normal.
#[inline(always)]
fn mirrored<S: Simd>(d: D3<S>, n: D3<S>) -> D3<S> {
    let along = d.dot(n);
    n.scale_add(-(along + along), d)
}
