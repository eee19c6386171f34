//! What the builder of a mesh's tree sorts: boxes of triangles, sets of them, and the bins that their centres fall into.

use catoptra_core::TriangleMesh;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4};

use super::Box32;

/// A triangle's box; the last number of the lower corner is the bits of the triangle's own.
#[derive(Clone, Copy)]
pub(super) struct Item {
    pub(super) low: [f32; 4],
    pub(super) high: [f32; 4],
}

impl Item {
    pub(super) fn new(mesh: &TriangleMesh, id: u32) -> Self {
        let [a, b, c] = mesh.triangles()[id as usize].map(|i| mesh.positions()[i as usize]);
        let (mut low, mut high) = ([f32::from_bits(id); 4], [0.0; 4]);
        for axis in 0..3 {
            low[axis] = a[axis].min(b[axis]).min(c[axis]);
            high[axis] = a[axis].max(b[axis]).max(c[axis]);
        }
        Self { low, high }
    }
}

/// A box in registers; the fourth numbers mean nothing.
#[derive(Clone, Copy)]
pub(super) struct Extent<S: Simd> {
    pub(super) low: f32x4<S>,
    pub(super) high: f32x4<S>,
}

impl<S: Simd> Extent<S> {
    #[inline(always)]
    pub(super) fn empty(s: S) -> Self {
        Self { low: f32x4::splat(s, f32::INFINITY), high: f32x4::splat(s, f32::NEG_INFINITY) }
    }

    #[inline(always)]
    pub(super) fn of(s: S, item: &Item) -> Self {
        Self { low: f32x4::load_array_ref(s, &item.low), high: f32x4::load_array_ref(s, &item.high) }
    }

    #[inline(always)]
    pub(super) fn union(self, o: Self) -> Self {
        Self { low: self.low.min(o.low), high: self.high.max(o.high) }
    }

    /// Twice the centre; the order of centres is all that counts.
    #[inline(always)]
    pub(super) fn centre2(self) -> f32x4<S> {
        self.low + self.high
    }

    /// The box of one point.
    #[inline(always)]
    pub(super) fn point(at: f32x4<S>) -> Self {
        Self { low: at, high: at }
    }

    /// Half the surface area; 0 when empty.
    #[inline(always)]
    pub(super) fn half_area(self) -> f32 {
        let [x, y, z, _] = (self.high - self.low).to_array();
        if x < 0.0 { 0.0 } else { x * y + y * z + z * x }
    }

    pub(super) fn bounds(self) -> Box32 {
        let corner = |[x, y, z, _]: [f32; 4]| [x, y, z];
        Box32 { min: corner(self.low.to_array()), max: corner(self.high.to_array()) }
    }
}

/// Triangles that stand side by side, with the boxes round them and round their centres.
#[derive(Clone, Copy)]
pub(super) struct Set<S: Simd> {
    pub(super) first: usize,
    pub(super) count: usize,
    pub(super) around: Extent<S>,
    pub(super) centres: Extent<S>,
    pub(super) leaf: bool,
}

impl<S: Simd> Set<S> {
    pub(super) fn empty(s: S, first: usize) -> Self {
        Self { first, count: 0, around: Extent::empty(s), centres: Extent::empty(s), leaf: false }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, extent: Extent<S>) {
        self.count += 1;
        self.around = self.around.union(extent);
        self.centres = self.centres.union(Extent::point(extent.centre2()));
    }
}

/// Where a set is split: before a bin along an axis.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub(super) axis: usize,
    pub(super) bin: i32,
    pub(super) cost: f32,
}

/// How centres fall into bins.
#[derive(Clone, Copy)]
pub(super) struct Scale<S: Simd> {
    pub(super) low: f32x4<S>,
    pub(super) scale: f32x4<S>,
    pub(super) bins: usize,
}

impl<S: Simd> Scale<S> {
    #[inline(always)]
    pub(super) fn new(s: S, centres: Extent<S>, bins: usize) -> Self {
        let extent = centres.high - centres.low;
        let most = f32x4::splat(s, bins as f32 * 0.999);
        let some = extent.simd_gt(f32x4::splat(s, f32::MIN_POSITIVE));
        let scale = some.select(most / extent, f32x4::splat(s, 0.0));
        Self { low: centres.low, scale, bins }
    }

    #[inline(always)]
    pub(super) fn bins_of(&self, extent: Extent<S>) -> [i32; 4] {
        let place = (extent.centre2() - self.low) * self.scale;
        place.to_int::<fearless_simd::i32x4<S>>().to_array()
    }
}

/// What falls into a bin.
#[derive(Clone, Copy)]
pub(super) struct Bin {
    pub(super) around: Item,
    pub(super) count: u32,
}

impl Default for Bin {
    #[inline(always)]
    fn default() -> Self {
        Self { around: Item { low: [f32::INFINITY; 4], high: [f32::NEG_INFINITY; 4] }, count: 0 }
    }
}
