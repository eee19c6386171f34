//! Walks a mesh's tree with rays that have a common origin: all of them together against eight boxes at a time, and
//! against triangles whose edges span planes with the common origin.
//!
//! A ray is its slopes (u, v) over the axis that all rays run along, and its depth z is the parameter. An edge e that is
//! seen from the origin in the direction p spans the plane n = e × p, so a ray's edge value is n·(u, v, 1): two fused
//! products. The planes n, and whether all rays together pass an edge on the outside, are computed for eight triangles at
//! a time.

use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, LaneMask};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};

use super::accept::{PacketRays, TreeTriangle};
use super::edges::{Prepared, Slopes};
use super::packets::{Packets, SeenBox};
use super::ray_bundle::Aim;
use super::{ExactResolver, GROUP, LeafBlock, Visit, Visits, Waiting};
use crate::accel::{Node8, Planes, WIDTH, WideTree};
use crate::lanes::{Bits, F, M, U, outlined};
use crate::numeric::{BUNDLE_BOX, BUNDLE_PAD, BUNDLE_SLOPE};

/// What the rays of a bundle share: their common origin, main axis and bounds.
pub(crate) struct CommonOrigin {
    /// Axes of the slopes, then the one that all rays run along.
    pub(super) axes: [usize; 3],
    /// 1 or −1: their sign along that axis. All space is mirrored through the zero point for those that run backwards.
    pub(super) sign: f32,
    /// The common origin, mirrored as the rays are, axis by axis as in `axes`.
    pub(super) origin: [f32; 3],
    /// How far a ray may pass the common origin by.
    pub(super) slack: f32,
    /// The common origin in `f64`, and how far a ray may pass that by.
    pub(super) precise_origin: DVec3,
    pub(super) precise_slack: f32,
    /// How far slopes may be off beyond their own rounding.
    pub(super) slopes_off: f32,
    /// Box round the slopes of all rays, up to their error.
    pub(super) low: [f32; 2],
    pub(super) high: [f32; 2],
    /// How far boxes are widened.
    pad: f32,
    /// Whether any crossing will do (occlusion).
    pub(super) any: bool,
}

/// One packet of a bundle: the slopes of its rays, and their nearest hits.
#[derive(Clone, Copy)]
pub(crate) struct BundledRays<S: Simd> {
    pub(crate) u: F<S>,
    pub(crate) v: F<S>,
    /// Box round the slopes.
    pub(crate) slopes: [[f32; 2]; 2],
    /// Depths between which the stretch begins.
    pub(crate) begin: [F<S>; 2],
    /// Depths between which the nearest crossing so far lies, or the end of the stretch.
    pub(crate) end: [F<S>; 2],
    /// Slot of the nearest triangle in the tree's blocks; [`u32::MAX`] for none.
    pub(crate) slot: U<S>,
    /// Triangle that each ray leaves from.
    pub(crate) leaving: U<S>,
    /// Depth per `t`.
    pub(crate) scale: F<S>,
    pub(crate) live: M<S>,
    /// How often a triangle was decided on in `f64`.
    pub(crate) decided: u64,
}

impl<S: Simd> BundledRays<S> {
    /// Box round the slopes of the rays that are still followed, of which there are some.
    #[inline(always)]
    fn around_live(&self, s: S) -> [[f32; 2]; 2] {
        let (most, least) = (F::splat(s, f32::INFINITY), F::splat(s, f32::NEG_INFINITY));
        let low = |slopes| F::pick(self.live, slopes, most).0.reduce_min();
        let high = |slopes| F::pick(self.live, slopes, least).0.reduce_max();
        [[low(self.u), low(self.v)], [high(self.u), high(self.v)]]
    }
}

/// The packets of a walk.
struct Group<'a, S: Simd> {
    rays: &'a [BundledRays<S>],
    /// The boxes round their slopes.
    packets: &'a Packets,
    /// The depth up to which any of them still searches.
    far: f32,
}

/// A block of which rays may meet some triangles.
struct SeenBlock<'a> {
    leaf: LeafBlock<'a>,
    prepared: &'a Prepared,
    /// Triangles that rays may meet, bit by bit.
    seen: u64,
    planes: Option<&'a Planes>,
}

impl<'a> SeenBlock<'a> {
    #[inline(always)]
    fn triangle(&self, at: usize) -> TreeTriangle<'a> {
        let LeafBlock { tree, block, .. } = self.leaf;
        let facet = tree.blocks[block].facet[at];
        TreeTriangle { tree, slot: self.leaf.slot(at), facet, planes: self.planes }
    }
}

impl CommonOrigin {
    /// Rays within a box of slopes, each at most 2 in magnitude, that pass a point by at most `slack`; through a mesh
    /// whose corners' coordinates stay within `reach`.
    pub(crate) fn new(aim: &Aim, origin: DVec3, slack: f32, slopes: [[f32; 2]; 2], reach: f32) -> Self {
        let ([u, v, z], sign) = (aim.axes, f64::from(aim.sign));
        let own = DVec3::new(origin[u] * sign, origin[v] * sign, origin[z] * sign);
        let rounded = own.as_vec3();
        let off = (own - rounded.as_dvec3()).abs().max_element() as f32;
        let (precise_slack, slack) = (slack, (slack + off).next_up());
        let size = reach + rounded.abs().max_element();
        let [low, high] = slopes;
        Self {
            axes: aim.axes,
            sign: aim.sign,
            origin: rounded.to_array(),
            slack,
            precise_origin: own,
            precise_slack,
            slopes_off: 0.0,
            low,
            high,
            pad: BUNDLE_PAD * size + 4.0 * slack + f32::MIN_POSITIVE,
            any: false,
        }
    }

    /// Searches for any crossing (occlusion) rather than the nearest.
    pub(crate) fn for_any(self) -> Self {
        Self { any: true, ..self }
    }

    /// The same with slopes that may be off by `more` beside.
    pub(crate) fn with_slopes_off(self, more: f32) -> Self {
        Self { slopes_off: self.slopes_off + more, ..self }
    }

    /// A box round slopes below 2, widened by their error, and for the rounding of its own ends.
    #[inline(always)]
    pub(super) fn widened(&self, [low, high]: [[f32; 2]; 2]) -> [[f32; 2]; 2] {
        let wider = self.slopes_off + 3.0 * BUNDLE_SLOPE;
        [[low[0] - wider, low[1] - wider], [high[0] + wider, high[1] + wider]]
    }

    /// At most the size of any ray's slopes.
    #[inline(always)]
    pub(super) fn steepest(&self) -> [f32; 2] {
        let [low, high] = self.widened([self.low, self.high]);
        [low[0].abs().max(high[0].abs()), low[1].abs().max(high[1].abs())]
    }

    /// Finds the nearest triangle for every ray of up to [`GROUP`] packets, or any. The resolver counts lanes from the
    /// first packet's on. See [`outlined`].
    pub(crate) fn search<S: Simd>(
        &self,
        s: S,
        tree: &WideTree,
        visits: &mut Visits,
        rays: &mut [BundledRays<S>],
        exact: &mut dyn ExactResolver,
    ) {
        outlined(
            s,
            #[inline(always)]
            || self.walk(s, tree, visits, rays, exact),
        );
    }

    #[inline(always)]
    fn walk<S: Simd>(
        &self,
        s: S,
        tree: &WideTree,
        visits: &mut Visits,
        rays: &mut [BundledRays<S>],
        exact: &mut dyn ExactResolver,
    ) {
        let planes = visits.planes_of(tree);
        let Some(mut waiting) = visits.start() else { return };
        let mut packets = Packets::NONE;
        for (at, rays) in rays.iter_mut().enumerate().take(GROUP) {
            if let Some(planes) = planes {
                rays.leave_planes(s, planes);
            }
            rays.slopes = self.widened(rays.slopes);
            packets.set(at, rays.slopes, self.far(s, rays));
        }
        waiting.push(Visit { near: 0.0, link: 0, count: 0, packets: (1 << rays.len().min(GROUP)) - 1 });
        let mut farthest = packets.farthest(s);
        let ray_bounds = self.ray_bounds();
        while let Some(visit) = waiting.pop(farthest) {
            if visit.count == 0 {
                *waiting.nodes += 1;
                let group = Group { rays, packets: &packets, far: farthest };
                self.enter(s, tree, visit, &group, &mut waiting);
                continue;
            }
            for leaf in visit.blocks(tree) {
                *waiting.blocks += 1;
                let within = u64::from(visit.packets & packets.within(s, visit.near));
                let Some((prepared, seen)) = self.prepare(s, &leaf, &ray_bounds) else { continue };
                let block = SeenBlock { leaf, prepared: &prepared, seen, planes };
                let changed = self.pass(s, &block, within, rays, exact);
                for packet in Bits(changed) {
                    let rays = &mut rays[packet];
                    if self.any && rays.live.any() {
                        rays.slopes = self.widened(rays.around_live(s));
                    }
                    packets.set(packet % GROUP, rays.slopes, self.far(s, rays));
                }
                if changed != 0 {
                    farthest = packets.farthest(s);
                }
            }
        }
    }

    /// At least the depth up to which boxes are still searched.
    #[inline(always)]
    fn far<S: Simd>(&self, s: S, rays: &BundledRays<S>) -> f32 {
        let none = F::splat(s, f32::NEG_INFINITY);
        F::pick(rays.live, rays.end[1], none).0.reduce_max()
    }

    /// A row of a node as seen from the common origin; `side` 0 for the lower sides, 1 for the upper.
    #[inline(always)]
    fn row<S: Simd>(&self, s: S, node: &Node8, which: usize, side: usize) -> f32x8<S> {
        let upper = (self.sign > 0.0) == (side == 1);
        let row = &node.bounds[self.axes[which]][usize::from(upper)];
        let start = if side == 0 { self.origin[which] + self.pad } else { self.origin[which] - self.pad };
        f32x8::load_array_ref(s, row).mul_sub_precise(f32x8::splat(s, self.sign), f32x8::splat(s, start))
    }

    /// Adds the children of a node that some ray may enter up to a depth, the nearest last.
    #[inline(always)]
    fn enter<S: Simd>(
        &self,
        s: S,
        tree: &WideTree,
        visit: Visit,
        group: &Group<'_, S>,
        waiting: &mut Waiting<'_>,
    ) {
        let node = &tree.nodes[visit.link as usize];
        let (one, zero) = (f32x8::splat(s, 1.0), f32x8::splat(s, 0.0));
        let (near, away) = (self.row(s, node, 2, 0).max(zero), self.row(s, node, 2, 1));
        let mut met = near.simd_le(f32x8::splat(s, group.far)) & near.simd_le(away);
        let (of_near, of_away) = (one / near, one / away);
        let wider = f32x8::splat(s, BUNDLE_BOX + BUNDLE_SLOPE + self.slopes_off);
        let mut sides = [[0.0; WIDTH]; 4];
        for which in 0..2 {
            let (low, high) = (self.row(s, node, which, 0), self.row(s, node, which, 1));
            let low = low * low.simd_lt(zero).select(of_near, of_away) - wider;
            let high = high * high.simd_lt(zero).select(of_away, of_near) + wider;
            // Written so that NaN, of a box with the origin in a face, counts as met.
            let beside = low.simd_gt(f32x8::splat(s, self.high[which]))
                | high.simd_lt(f32x8::splat(s, self.low[which]));
            met &= !beside;
            (sides[2 * which], sides[2 * which + 1]) = (low.to_array(), high.to_array());
        }
        let (near, first) = (near.to_array(), waiting.depth);
        for child in Bits(met.to_bitmask() & ((1 << node.children) - 1)) {
            let child = child % WIDTH;
            let seen = SeenBox {
                low: [sides[0][child], sides[2][child]],
                high: [sides[1][child], sides[3][child]],
                near: near[child],
            };
            let maybe = visit.packets & group.packets.entering(s, &seen);
            let unsure = maybe & group.packets.larger_than_half(s, &seen);
            let packets = (maybe & !unsure) | entering(s, group.rays, unsure, &seen);
            if packets != 0 {
                waiting.insert(first, Visit { packets, ..Visit::ahead(tree, node, child, &near) });
            }
        }
    }

    /// Tests the rays of some packets against triangles of a block; which packets have changed.
    #[inline(always)]
    fn pass<S: Simd>(
        &self,
        s: S,
        block: &SeenBlock<'_>,
        packets: u64,
        rays: &mut [BundledRays<S>],
        exact: &mut dyn ExactResolver,
    ) -> u64 {
        let mut changed = 0;
        for packet in Bits(packets) {
            let Some(packet_rays) = rays.get_mut(packet) else { continue };
            let seen = if block.seen & (block.seen - 1) == 0 {
                block.seen
            } else {
                block.seen & block.prepared.seen_by(s, &Slopes::of(packet_rays.slopes))
            };
            for at in Bits(seen) {
                let at = at % WIDTH;
                let triangle = block.triangle(at);
                let packet_rays = PacketRays { rays: &mut *packet_rays, packet };
                let met = self.accept(s, &triangle, block.prepared, packet_rays, exact);
                changed |= u64::from(met) << packet;
            }
        }
        changed
    }
}

/// Which of some packets have a ray whose slopes lie within a box, and whose nearest hit lies beyond that depth.
#[inline(always)]
fn entering<S: Simd>(s: S, rays: &[BundledRays<S>], packets: u32, seen: &SeenBox) -> u32 {
    let mut entering = 0;
    for packet in Bits(u64::from(packets)) {
        let Some(rays) = rays.get(packet) else { continue };
        let beside = rays.u.less(F::splat(s, seen.low[0]))
            | F::splat(s, seen.high[0]).less(rays.u)
            | rays.v.less(F::splat(s, seen.low[1]))
            | F::splat(s, seen.high[1]).less(rays.v);
        let behind = rays.end[1].less(F::splat(s, seen.near));
        entering |= u32::from((rays.live & !(beside | behind)).any()) << packet;
    }
    entering
}
