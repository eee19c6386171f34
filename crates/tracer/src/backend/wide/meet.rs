//! What the lanes of a packet show: their surfaces' own look, and where they send their rays on.

use catoptra_core::{Lane, LaneMask, ShadingPoint};
use fearless_simd::Simd;

use super::packet::Packet;
use super::queue::Leaving;
use super::search::Best;
use super::settle::{Groups, Settled, lanes_of, shading_of};
use super::{Tracer, dark};
use crate::kernel::rounded;
use crate::lanes::{D3, F, F3, M, narrow3, pick3, splat3};

/// The lanes that have met something.
pub(super) struct Meeting<S: Simd> {
    /// Which lanes.
    pub(super) hits: M<S>,
    pub(super) settled: Settled<S>,
    /// Geometric unit normal on the viewer's side.
    pub(super) normal: F3<S>,
    /// Points relative to the snapshot's origin, rounded.
    pub(super) point: F3<S>,
    pub(super) shading: ShadingPoint<F<S>>,
    pub(super) groups: Groups<S>,
}

impl<S: Simd> Tracer<'_, S> {
    /// The weighted light of every lane; rays that go on are queued.
    #[inline(always)]
    pub(super) fn gather(&mut self, packet: &Packet<S>, best: &Best<S>, depth: u32) -> F3<S> {
        let hits = best.hits() & packet.live;
        let background = splat3(self.s, self.frame.snapshot.background().to_array().map(|c| c as f32));
        let sky = background.times(packet.weight);
        if !hits.any() {
            return F3::select(packet.live, sky, dark(self.s));
        }
        let meeting = self.meet(packet, best, hits);
        let local = self.local(packet, best, &meeting);
        self.send_on(packet, best, &meeting, depth);
        let shown = local.times(packet.weight);
        F3::select(hits, shown, F3::select(packet.live, sky, dark(self.s)))
    }

    /// Settles all lanes, shape by shape.
    #[inline(always)]
    fn meet(&mut self, packet: &Packet<S>, best: &Best<S>, hits: M<S>) -> Meeting<S> {
        let snapshot = self.frame.snapshot;
        let mut groups = Groups::new(self.s);
        let mut left = hits.bits();
        let mut settled: Option<Settled<S>> = None;
        while left != 0 {
            let prim = best.prim.lane(left.trailing_zeros() as usize);
            let mask = lanes_of(best.prim, hits, prim);
            groups.add(mask, snapshot.prims()[prim as usize].material);
            let here = self.settle(packet, best, mask, prim);
            settled = Some(match settled {
                None => here,
                Some(before) => here.over(mask, before),
            });
            left &= !mask.bits();
        }
        let settled = settled.unwrap_or_else(|| Settled::nothing(packet));
        let rays = &packet.rays;
        let normal = narrow3(settled.normal);
        let away = F::splat(self.s, 0.0).less(normal.dot(rays.direction));
        let towards_viewer = |n: F3<S>| F3::select(away, F3::new(-n.x, -n.y, -n.z), n);
        let point = narrow3(settled.point);
        let d = rays.direction;
        let shading = ShadingPoint {
            position: point + splat3(self.s, rounded(snapshot.origin())),
            normal: towards_viewer(shading_of(&settled)),
            to_viewer: F3::new(-d.x, -d.y, -d.z),
            distance: best.t,
        };
        Meeting { hits, settled, normal: towards_viewer(normal), point, shading, groups }
    }

    /// Queues the rays of lanes whose surfaces reflect.
    #[inline(always)]
    fn send_on(&mut self, packet: &Packet<S>, best: &Best<S>, meeting: &Meeting<S>, depth: u32) {
        let materials = self.frame.snapshot.materials();
        let view = self.frame.view;
        for (mask, material) in meeting.groups.iter() {
            let material = &materials[material];
            let reflectiveness = material.reflectiveness();
            let color = material.reflection_color();
            let tint = splat3(self.s, [color.x, color.y, color.z].map(|c| c.narrow * reflectiveness.narrow));
            let weight = packet.weight.times(tint);
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
                self.reflect(packet, best, meeting, on, weight);
            }
        }
    }

    #[inline(always)]
    fn reflect(&mut self, packet: &Packet<S>, best: &Best<S>, meeting: &Meeting<S>, on: M<S>, weight: F3<S>) {
        let d = packet.direction;
        let about = |n: D3<S>| {
            let along = d.dot(n);
            n.scale_add(-(along + along), d)
        };
        let geometric = about(meeting.settled.normal);
        let direction = match meeting.settled.shading {
            None => geometric,
            Some(shading) => {
                let smooth = about(shading);
                let above = F::splat(self.s, 0.0).less(narrow3(smooth).dot(meeting.normal));
                pick3(above, smooth, geometric)
            }
        };
        let leaving = Leaving {
            origin: meeting.settled.point,
            direction,
            weight,
            pixel: packet.pixel,
            prim: best.prim,
            facet: best.facet,
        };
        self.next.push(on, &leaving);
    }
}
