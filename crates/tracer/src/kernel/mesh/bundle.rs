//! Walks a mesh's tree with a bundle of rays: all of them together against eight boxes at a time, and against triangles
//! whose edges are seen as lines.
//!
//! Rays of a bundle either pass through one point or run side by side; what differs between the two is told by [`Common`].
//! In both a ray is a place (u, v) in a plane across the axis that all rays run along, and its depth z is the parameter.
//! Seen along the rays an edge of a triangle is a line n·(u, v, 1) = 0 of that plane, so a ray's edge value is two fused
//! products. The lines n, and whether all rays together pass an edge on the outside, are computed for eight triangles at
//! a time.

use catoptra_core::{Lane, LaneMask};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};

use super::accept::{PacketRays, TreeTriangle};
use super::bundled_rays::BundledRays;
use super::common::{Common, Eight3, Sides};
use super::common_direction::CommonDirection;
use super::common_origin::CommonOrigin;
use super::edges::{Around, Prepared, minus};
use super::packets::{Packets, SeenBox};
use super::ray_bundle::Aim;
use super::{ExactResolver, GROUP, LeafBlock, Visit, Visits, Waiting};
use crate::accel::{Block8, Node8, Planes, WIDTH, WideTree};
use crate::lanes::{Bits, F, outlined};
use crate::numeric::BUNDLE_PAD;

/// A bundle of rays.
pub(crate) struct Bundle<C> {
    /// Axes of the places, then the one that all rays run along.
    pub(super) axes: [usize; 3],
    /// 1 or −1: their sign along that axis. All space is mirrored through the zero point for those that run backwards.
    pub(super) sign: f32,
    /// What depths are counted from, mirrored as the rays are, axis by axis as in `axes`.
    pub(super) origin: [f32; 3],
    /// Box round the places of all rays, up to their error.
    pub(super) low: [f32; 2],
    pub(super) high: [f32; 2],
    /// How far boxes are widened.
    pad: f32,
    /// Whether any crossing will do (occlusion).
    pub(super) any: bool,
    pub(super) common: C,
}

/// Rays that pass through one point, or run side by side.
pub(crate) enum AnyBundle {
    Through(Bundle<CommonOrigin>),
    Along(Bundle<CommonDirection>),
}

impl AnyBundle {
    /// As [`Bundle::search`].
    pub(crate) fn search<S: Simd>(
        &self,
        s: S,
        tree: &WideTree,
        visits: &mut Visits,
        rays: &mut [BundledRays<S>],
        exact: &mut dyn ExactResolver,
    ) {
        match self {
            Self::Through(bundle) => bundle.search(s, tree, visits, rays, exact),
            Self::Along(bundle) => bundle.search(s, tree, visits, rays, exact),
        }
    }
}

/// The packets of a walk.
struct Group<'a, S: Simd> {
    rays: &'a [BundledRays<S>],
    /// The boxes round their places.
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
    /// The numbers of planes, where known.
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

impl<C> Bundle<C> {
    /// Rays within a box of places that have something in common; through a mesh whose corners' coordinates stay within `reach`.
    /// Boxes are widened by `pad` beside what `f32` rounds.
    pub(super) fn new(
        aim: &Aim,
        origin: [f32; 3],
        [low, high]: [[f32; 2]; 2],
        [reach, pad]: [f32; 2],
        common: C,
    ) -> Self {
        let size = origin.iter().fold(0.0_f32, |most, at| most.max(at.abs())) + reach;
        Self {
            axes: aim.axes,
            sign: aim.sign,
            origin,
            low,
            high,
            pad: BUNDLE_PAD * size + pad + f32::MIN_POSITIVE,
            any: false,
            common,
        }
    }

    /// Searches for any crossing (occlusion) rather than the nearest.
    pub(crate) fn for_any(self) -> Self {
        Self { any: true, ..self }
    }

    /// The edges of a block's triangles, and their corners relative to what depths are counted from, mirrored as the rays are; axis
    /// by axis as in `axes`.
    #[inline(always)]
    pub(super) fn triangles<S: Simd>(&self, s: S, leaf: &LeafBlock<'_>) -> [[Eight3<S>; 3]; 2] {
        let block = &leaf.tree.blocks[leaf.block];
        let (a, b, c) = (self.corner(s, block, 0), self.corner(s, block, 1), self.corner(s, block, 2));
        [[minus(c, b), minus(a, c), minus(b, a)], [self.seen(s, a), self.seen(s, b), self.seen(s, c)]]
    }

    /// A corner of every triangle, axis by axis as in `axes`.
    #[inline(always)]
    fn corner<S: Simd>(&self, s: S, block: &Block8, corner: usize) -> Eight3<S> {
        let rows = &block.corners[corner];
        [
            f32x8::load_array_ref(s, &rows[self.axes[0]]),
            f32x8::load_array_ref(s, &rows[self.axes[1]]),
            f32x8::load_array_ref(s, &rows[self.axes[2]]),
        ]
    }

    /// Corners relative to what depths are counted from, mirrored as the rays are.
    #[inline(always)]
    fn seen<S: Simd>(&self, s: S, p: Eight3<S>) -> Eight3<S> {
        let sign = f32x8::splat(s, self.sign);
        [
            p[0].mul_sub_precise(sign, f32x8::splat(s, self.origin[0])),
            p[1].mul_sub_precise(sign, f32x8::splat(s, self.origin[1])),
            p[2].mul_sub_precise(sign, f32x8::splat(s, self.origin[2])),
        ]
    }

    /// A row of a node as seen from what depths are counted from; `side` 0 for the lower sides, 1 for the upper.
    #[inline(always)]
    fn row<S: Simd>(&self, s: S, node: &Node8, which: usize, side: usize) -> f32x8<S> {
        let upper = (self.sign > 0.0) == (side == 1);
        let row = &node.bounds[self.axes[which]][usize::from(upper)];
        let start = if side == 0 { self.origin[which] + self.pad } else { self.origin[which] - self.pad };
        f32x8::load_array_ref(s, row).mul_sub_precise(f32x8::splat(s, self.sign), f32x8::splat(s, start))
    }
}

impl<C: Common> Bundle<C> {
    /// A box round places, widened by their error.
    #[inline(always)]
    pub(super) fn widened(&self, [low, high]: [[f32; 2]; 2]) -> [[f32; 2]; 2] {
        let wider = self.common.error();
        [[low[0] - wider, low[1] - wider], [high[0] + wider, high[1] + wider]]
    }

    /// At most the size of any ray's place.
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
            rays.around = self.widened(rays.around);
            packets.set(at, rays.around, self.far(s, rays));
        }
        waiting.push(Visit { near: f32::MIN, link: 0, count: 0, packets: (1 << rays.len().min(GROUP)) - 1 });
        let mut farthest = packets.farthest(s);
        let ray_bounds = self.common.ray_bounds(self);
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
                let Some((prepared, seen)) = self.common.prepare(s, self, &leaf, &ray_bounds) else {
                    continue;
                };
                let block = SeenBlock { leaf, prepared: &prepared, seen, planes };
                let changed = self.pass(s, &block, within, rays, exact);
                for packet in Bits(changed) {
                    let rays = &mut rays[packet];
                    if self.any && rays.live.any() {
                        rays.around = self.widened(rays.around_live(s));
                    }
                    packets.set(packet % GROUP, rays.around, self.far(s, rays));
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
        let rows = [0, 1, 2].map(
            #[inline(always)]
            |which| [self.row(s, node, which, 0), self.row(s, node, which, 1)],
        );
        let Sides { low, high, near, away } = self.common.sides(s, self, &rows);
        let mut met = near.simd_le(f32x8::splat(s, group.far)) & near.simd_le(away);
        let mut sides = [[0.0; WIDTH]; 4];
        for which in 0..2 {
            // Written so that NaN, of a box with a common origin in a face, counts as met.
            let beside = low[which].simd_gt(f32x8::splat(s, self.high[which]))
                | high[which].simd_lt(f32x8::splat(s, self.low[which]));
            met &= !beside;
            (sides[2 * which], sides[2 * which + 1]) = (low[which].to_array(), high[which].to_array());
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
                block.seen & block.prepared.seen_by(s, &Around::of(packet_rays.around))
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

/// Which of some packets have a ray whose place lies within a box, and whose nearest hit lies beyond that depth.
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
