//! What the builder of a mesh's tree sorts: boxes of triangles, sets of them, and the bins that their centres fall into.

use catoptra_core::TriangleMesh;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4, f32x8, i32x4, mask32x8};

use super::{Box32, WIDTH};

/// A triangle's box: its lower corner, the bits of the triangle's number, and its upper corner with other signs, so that
/// boxes are united by one minimum.
#[derive(Clone, Copy)]
#[repr(align(32))]
pub(super) struct Item([f32; 8]);

/// Added to the bits of a triangle's number: subnormal numbers would slow down all sums they stand beside.
const PLAIN: u32 = 1 << 30;

impl Item {
    /// Takes up room.
    pub(super) const NONE: Self = Self([f32::INFINITY; 8]);

    pub(super) fn new(mesh: &TriangleMesh, id: u32) -> Self {
        let [a, b, c] = mesh.triangles()[id as usize].map(|i| mesh.positions()[i as usize]);
        let mut numbers = [0.0; 8];
        for axis in 0..3 {
            numbers[axis] = a[axis].min(b[axis]).min(c[axis]);
            numbers[axis + 4] = -a[axis].max(b[axis]).max(c[axis]);
        }
        numbers[3] = f32::from_bits(id.wrapping_add(PLAIN));
        Self(numbers)
    }

    /// The same triangle, of which only what lies in a box is meant.
    pub(super) fn within(self, bounds: &Box32) -> Self {
        let ([a, b, c], [u, v, w]) = (bounds.min, bounds.max);
        Self([a, b, c, self.0[3], -u, -v, -w, 0.0])
    }

    /// The box.
    pub(super) fn bounds(&self) -> Box32 {
        let [x, y, z, _, u, v, w, _] = self.0;
        Box32 { min: [x, y, z], max: [-u, -v, -w] }
    }

    /// Which triangle it is.
    pub(super) fn id(&self) -> u32 {
        self.0[3].to_bits().wrapping_sub(PLAIN)
    }
}

/// A box in registers, as in an [`Item`]; the fourth and the last number mean nothing.
#[derive(Clone, Copy)]
pub(super) struct Extent<S: Simd>(f32x8<S>);

impl<S: Simd> Extent<S> {
    #[inline(always)]
    pub(super) fn empty(s: S) -> Self {
        Self(f32x8::splat(s, f32::INFINITY))
    }

    #[inline(always)]
    pub(super) fn of(s: S, item: &Item) -> Self {
        Self(f32x8::load_array_ref(s, &item.0))
    }

    #[inline(always)]
    pub(super) fn store(self, item: &mut Item) {
        self.0.store_array(&mut item.0);
    }

    #[inline(always)]
    pub(super) fn union(self, o: Self) -> Self {
        Self(self.0.min(o.0))
    }

    /// Itself where that holds, else nothing.
    #[inline(always)]
    pub(super) fn only_if(self, s: S, holds: bool) -> Self {
        Self(mask32x8::splat(s, holds).select(self.0, f32x8::splat(s, f32::INFINITY)))
    }

    /// Twice the centre; the order of centres is all that counts.
    #[inline(always)]
    pub(super) fn centre2(self) -> f32x4<S> {
        let (low, minus_high) = self.0.split();
        low - minus_high
    }

    #[inline(always)]
    fn size(self) -> f32x4<S> {
        let (low, minus_high) = self.0.split();
        -(minus_high + low)
    }

    /// The box of one point.
    #[inline(always)]
    pub(super) fn point(at: f32x4<S>) -> Self {
        Self(at.combine(-at))
    }

    /// Half the surface area; 0 when empty.
    #[inline(always)]
    pub(super) fn half_area(self) -> f32 {
        let [x, y, z, _] = self.size().to_array();
        if x < 0.0 { 0.0 } else { x * y + y * z + z * x }
    }

    pub(super) fn bounds(self) -> Box32 {
        let [x, y, z, _, u, v, w, _] = self.0.to_array();
        Box32 { min: [x, y, z], max: [-u, -v, -w] }
    }
}

/// Triangles that stand side by side, with the boxes round them and round their centres.
#[derive(Clone, Copy)]
pub(super) struct Set<S: Simd> {
    pub(super) first: usize,
    pub(super) count: usize,
    /// Places behind them that are kept free for triangles that lie on both sides of a plane.
    pub(super) room: usize,
    pub(super) around: Extent<S>,
    pub(super) centres: Extent<S>,
    pub(super) leaf: bool,
    /// Whether they are in the buffer for sorting.
    pub(super) aside: bool,
}

impl<S: Simd> Set<S> {
    /// Of all these triangles, from the first slot on.
    pub(super) fn of(s: S, items: &[Item]) -> Self {
        let empty = Extent::empty(s);
        let (first, count, room) = (0, items.len(), 0);
        let mut set = Self { first, count, room, around: empty, centres: empty, leaf: false, aside: false };
        s.vectorize(
            #[inline(always)]
            || {
                for item in items {
                    let extent = Extent::of(s, item);
                    set.around = set.around.union(extent);
                    set.centres = set.centres.union(Extent::point(extent.centre2()));
                }
            },
        );
        set
    }

    /// Where two parts of it stand; free places are shared out as the triangles are.
    pub(super) fn parted(&self, counts: [usize; 2]) -> [Self; 2] {
        let room = self.room * counts[0] / (counts[0] + counts[1]);
        let second = self.first + counts[0] + room;
        let first = Self { count: counts[0], room, leaf: false, ..*self };
        [first, Self { first: second, count: counts[1], room: self.room - room, ..first }]
    }

    /// This set and the one right after it.
    pub(super) fn with(self, o: Self) -> Self {
        Self {
            count: self.count + o.count,
            around: self.around.union(o.around),
            centres: self.centres.union(o.centres),
            ..self
        }
    }
}

/// How centres fall into bins.
#[derive(Clone, Copy)]
pub(super) struct Scale<S: Simd> {
    low: f32x4<S>,
    scale: f32x4<S>,
    bins: usize,
}

impl<S: Simd> Scale<S> {
    #[inline(always)]
    pub(super) fn new(s: S, centres: Extent<S>, bins: usize) -> Self {
        let extent = centres.size();
        let most = f32x4::splat(s, bins as f32 * 0.999);
        let some = extent.simd_gt(f32x4::splat(s, f32::MIN_POSITIVE));
        let scale = some.select(most / extent, f32x4::splat(s, 0.0));
        Self { low: centres.0.split().0, scale, bins }
    }

    #[inline(always)]
    fn bins_of(&self, extent: Extent<S>) -> [i32; 4] {
        self.places_of(extent).to_array()
    }

    #[inline(always)]
    fn places_of(&self, extent: Extent<S>) -> i32x4<S> {
        ((extent.centre2() - self.low) * self.scale).to_int()
    }

    /// 1 for what lies before a plane, else 0.
    #[inline(always)]
    pub(super) fn lies_before(&self, extent: Extent<S>, plane: &Plane) -> usize {
        let before = self.places_of(extent).simd_lt(plane.bin).to_bitmask();
        (before >> plane.axis & 1) as usize
    }
}

/// Where a set is split: before a bin along an axis.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    axis: usize,
    bin: i32,
    /// Surface areas times triangles, of both parts.
    pub(super) cost: f32,
    /// How many triangles lie before it.
    pub(super) count: usize,
}

/// Most bins along an axis that any preset has.
pub(super) const MOST_BINS: usize = 32;

/// Cost of `count` triangles, in tests of one: whole blocks are tested, so sets that fill theirs are preferred.
#[inline(always)]
pub(super) fn weight(count: usize) -> f32 {
    count.next_multiple_of(WIDTH) as f32
}

/// What falls into each bin along each axis.
#[derive(Clone)]
pub(super) struct Bins {
    around: [[Item; MOST_BINS]; 3],
    count: [[u32; MOST_BINS]; 3],
}

impl Bins {
    /// Of some triangles.
    #[inline(always)]
    pub(super) fn of<S: Simd>(s: S, items: &[Item], scale: &Scale<S>) -> Self {
        let mut bins = Self { around: [[Item::NONE; MOST_BINS]; 3], count: [[0; MOST_BINS]; 3] };
        for item in items {
            let extent = Extent::of(s, item);
            let found = scale.bins_of(extent);
            bins.add(s, 0, found[0], extent);
            bins.add(s, 1, found[1], extent);
            bins.add(s, 2, found[2], extent);
        }
        bins
    }

    #[inline(always)]
    fn add<S: Simd>(&mut self, s: S, axis: usize, bin: i32, extent: Extent<S>) {
        let bin = bin as usize % MOST_BINS;
        let around = &mut self.around[axis][bin];
        Extent::of(s, around).union(extent).store(around);
        self.count[axis][bin] += 1;
    }

    /// Of these and other triangles.
    #[inline(always)]
    pub(super) fn with<S: Simd>(mut self, s: S, o: &Self) -> Self {
        for axis in 0..3 {
            for bin in 0..MOST_BINS {
                let around = &mut self.around[axis][bin];
                Extent::of(s, around).union(Extent::of(s, &o.around[axis][bin])).store(around);
                self.count[axis][bin] += o.count[axis][bin];
            }
        }
        self
    }

    /// The cheapest of the planes between bins, and the boxes round both parts.
    #[inline(always)]
    pub(super) fn best_plane<S: Simd>(&self, s: S, scale: &Scale<S>) -> Option<(Plane, [Extent<S>; 2])> {
        let mut best = Plane { axis: 0, bin: 0, cost: f32::INFINITY, count: 0 };
        for axis in 0..3 {
            self.sweep(s, axis, scale.bins.min(MOST_BINS), &mut best);
        }
        if best.count == 0 {
            return None;
        }
        Some((best, self.parts(s, scale.bins.min(MOST_BINS), &best)))
    }

    /// Sweeps the bins of an axis from both ends.
    #[inline(always)]
    fn sweep<S: Simd>(&self, s: S, axis: usize, bins: usize, best: &mut Plane) {
        let (boxes, counts) = (&self.around[axis], &self.count[axis]);
        let mut costs = [0.0; MOST_BINS];
        let (mut around, mut count) = (Extent::empty(s), 0);
        for at in (1..bins).rev() {
            around = around.union(Extent::of(s, &boxes[at]));
            count += counts[at];
            costs[at] = around.half_area() * weight(count as usize);
        }
        let all = count + counts[0];
        (around, count) = (Extent::empty(s), 0);
        for at in 1..bins {
            around = around.union(Extent::of(s, &boxes[at - 1]));
            count += counts[at - 1];
            let cost = around.half_area() * weight(count as usize) + costs[at];
            if count != 0 && count != all && cost < best.cost {
                *best = Plane { axis, bin: at as i32, cost, count: count as usize };
            }
        }
    }

    /// Boxes round what lies before a plane and what does not.
    #[inline(always)]
    fn parts<S: Simd>(&self, s: S, bins: usize, plane: &Plane) -> [Extent<S>; 2] {
        let (below, above) = self.around[plane.axis][..bins].split_at(plane.bin as usize);
        let mut parts = [Extent::empty(s); 2];
        for bin in below {
            parts[0] = parts[0].union(Extent::of(s, bin));
        }
        for bin in above {
            parts[1] = parts[1].union(Extent::of(s, bin));
        }
        parts
    }
}
