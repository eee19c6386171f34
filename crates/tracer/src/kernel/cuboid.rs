//! Rays against a box: between which distances they run between each pair of faces, with error bounds.
//!
//! Slabs after Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986.

use catoptra_core::geometry::Cuboid;
use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, LaneMask};
use fearless_simd::Simd;

use super::contract::{off_planes, surface_on_planes};
use super::faces::planes_met;
use super::solid as inside;
use super::{Crossing, Facet, Kernel, NearHit, PlaneRow, Proposal, Rays, Tried, bound};
use crate::film::NOTHING;
use crate::lanes::{D3, F, F3, M, U, splat3};
use crate::numeric::{DIRECTION_ERROR, POINT_ERROR, WORLD_DRIFT, magnitude_of};

/// A box, placed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CuboidRow {
    /// The planes of its faces by facet, with normals on the outer side.
    pub(crate) faces: [PlaneRow; 6],
    slabs: [Slab; 3],
}

/// All points `p` with `low <= normal · p <= high`.
#[derive(Debug, Clone, Copy)]
struct Slab {
    normal: [f32; 3],
    low: f32,
    high: f32,
    reach: f32,
}

/// Where rays enter a slab and where they leave it: at least, and at most.
struct Stretch<S: Simd> {
    near: [F<S>; 2],
    far: [F<S>; 2],
    /// Rays that run towards the higher side.
    upwards: M<S>,
}

impl CuboidRow {
    /// A box relative to an origin; `in_frame` is the same in the frame that rays are carried into its own space from.
    pub(crate) fn new(cuboid: &Cuboid, in_frame: &Cuboid, prim: u32) -> Self {
        let (bounds, place) = (cuboid.object_bounds(), cuboid.placement());
        let faces: [PlaneRow; 6] = std::array::from_fn(|facet| {
            let axis = DVec3::AXES[facet / 2];
            let (corner, normal) = if facet % 2 == 0 { (bounds.min, -axis) } else { (bounds.max, axis) };
            PlaneRow::new(place.point(corner), place.direction(normal), prim)
        });
        let own = (magnitude_of(bounds.min) + magnitude_of(bounds.max)) * place.scale() as f32;
        let drift = (own + magnitude_of(in_frame.placement().point(DVec3::ZERO))) * WORLD_DRIFT;
        let slabs = [0, 1, 2].map(|axis| Slab::between(&faces[2 * axis], &faces[2 * axis + 1], drift));
        Self { faces, slabs }
    }

    /// The crossing nearest ahead, and on which facet it lies. `entered` is the facet of rays that run from the box's
    /// surface into it, and [`NOTHING`] for all others.
    #[inline(always)]
    pub(crate) fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, entered: U<S>) -> (Proposal<S>, U<S>) {
        let zero = F::splat(s, 0.0);
        let x = self.slabs[0].stretch(s, rays);
        let y = self.slabs[1].stretch(s, rays);
        let z = self.slabs[2].stretch(s, rays);
        let enter = [latest(&x, &y, &z, 0), latest(&x, &y, &z, 1)];
        let leave = [soonest(&x, &y, &z, 0), soonest(&x, &y, &z, 1)];
        let misses = leave[1].less(enter[0]) | leave[1].less(zero);
        if !(!misses).any() {
            let nowhere = zero.less(zero);
            let nothing = Proposal { t: zero, error: zero, hit: nowhere, undecided: nowhere };
            return (nothing, U::splat(s, 0));
        }
        let crosses = enter[1].less(leave[0]);
        let ahead = zero.less(enter[0]) & entered.is(NOTHING);
        let begun =
            x.has_begun(zero, entered, 0) & y.has_begun(zero, entered, 2) & z.has_begun(zero, entered, 4);
        let inside = begun & zero.less(leave[0]);
        let by_x = x.may_count(inside, enter[0], leave[1]);
        let by_y = y.may_count(inside, enter[0], leave[1]);
        let by_z = z.may_count(inside, enter[0], leave[1]);
        let several = (by_x & by_y) | (by_y & by_z) | (by_z & by_x);
        let facet = U::pick(by_y, y.facet(s, inside, 2), x.facet(s, inside, 0));
        let facet = U::pick(by_z, z.facet(s, inside, 4), facet);
        let least = F::pick(inside, leave[0], enter[0]);
        let most = F::pick(inside, leave[1], enter[1]);
        let half = F::splat(s, 0.5);
        let t = (least + most) * half;
        let hit = crosses & (ahead | inside) & !several;
        let proposal = Proposal {
            t,
            error: bound(s, t.abs().mul_add(F::splat(s, DIRECTION_ERROR), (most - least) * half)),
            hit,
            // Written so that NaN, from numbers beyond those of f32, stays in doubt.
            undecided: !misses & !hit,
        };
        (proposal, facet)
    }
}

impl CuboidRow {
    /// Where lines run inside it.
    #[inline(always)]
    pub(super) fn stretch<S: Simd>(&self, s: S, rays: &Rays<S>) -> inside::Stretch<S> {
        let x = self.slabs[0].stretch(s, rays);
        let y = self.slabs[1].stretch(s, rays);
        let z = self.slabs[2].stretch(s, rays);
        let enter = [latest(&x, &y, &z, 0), latest(&x, &y, &z, 1)];
        let leave = [soonest(&x, &y, &z, 0), soonest(&x, &y, &z, 1)];
        let slack = |t: F<S>| bound(s, t.abs() * F::splat(s, DIRECTION_ERROR));
        let end = |at: [F<S>; 2], out: M<S>| {
            let [by_x, by_y, by_z] = [&x, &y, &z].map(|slab| slab.may_count(out, at[0], at[1]));
            let several = (by_x & by_y) | (by_y & by_z) | (by_z & by_x);
            let facet = U::pick(by_y, y.facet(s, out, 2), x.facet(s, out, 0));
            let facet = U::pick(by_z, z.facet(s, out, 4), facet);
            inside::End { least: at[0] - slack(at[0]), most: at[1] + slack(at[1]), facet, known: !several }
        };
        inside::Stretch::between(s, rays, [end(enter, M::splat(s, false)), end(leave, M::splat(s, true))])
    }
}

impl Kernel for CuboidRow {
    type Face = PlaneRow;

    #[inline(always)]
    fn faces(&self) -> &[PlaneRow] {
        &self.faces
    }

    #[inline(always)]
    fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, tried: &Tried<S>, mut found: impl FnMut(Crossing<S>)) {
        let (proposal, facet) = self.propose(s, rays, tried.entered);
        found(Crossing { proposal, facet: Facet::ByLane(facet), lanes: tried.lanes });
    }

    #[inline(always)]
    fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>) {
        let (normal, distance) = planes_met(s, &self.faces, hit);
        surface_on_planes(normal, distance, hit)
    }

    #[inline(always)]
    fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
        let (normal, distance) = planes_met(s, &self.faces, hit);
        off_planes(normal, distance, hit)
    }

    #[inline(always)]
    fn normal<S: Simd>(&self, s: S, hit: &impl NearHit<S>, _point: D3<S>) -> D3<S> {
        planes_met(s, &self.faces, hit).0
    }

    fn all_normals(&self, _center: DVec3, _half: DVec3, test: impl Fn(DVec3, DVec3) -> bool) -> bool {
        self.faces.iter().all(|face| test(face.normal, DVec3::ZERO))
    }

    fn is_outside(&self, point: DVec3) -> bool {
        self.faces.iter().any(|face| face.is_before(point))
    }
}

impl Slab {
    /// Between two opposite faces, where rays are known within a `drift` more.
    fn between(low: &PlaneRow, high: &PlaneRow, drift: f32) -> Self {
        Self {
            normal: high.normal32,
            low: -low.distance as f32,
            high: high.distance as f32,
            reach: low.reach.max(high.reach) + drift,
        }
    }

    #[inline(always)]
    fn stretch<S: Simd>(&self, s: S, rays: &Rays<S>) -> Stretch<S> {
        let normal = splat3(s, self.normal);
        let slope = normal.dot(rays.direction);
        let place = normal.dot(rays.origin);
        let (low, high) = (F::splat(s, self.low) - place, F::splat(s, self.high) - place);
        let point_error = bound(s, (rays.reach + F::splat(s, self.reach)) * F::splat(s, POINT_ERROR));
        let inverse = F::splat(s, 1.0) / slope;
        let (a, b) = (low * inverse, high * inverse);
        // Of slopes above four times their error, at least three quarters are left.
        let share = inverse.abs() * F::splat(s, 4.0 / 3.0);
        let direction_error = bound(s, F::splat(s, DIRECTION_ERROR));
        let off = a.abs().max(b.abs()).mul_add(direction_error, point_error) * share;
        let (near, far) = (a.min(b), a.max(b));
        let steep = F::splat(s, 4.0 * DIRECTION_ERROR).less(slope.abs());
        let mut stretch = Stretch {
            near: [near - off, near + off],
            far: [far - off, far + off],
            upwards: F::splat(s, 0.0).less(slope),
        };
        if (!steep).any() {
            stretch.flatten(s, steep, (-low).min(high), point_error);
        }
        stretch
    }
}

impl<S: Simd> Stretch<S> {
    /// Rays that have entered this slab, with the lower one of these facets and the next, for certain.
    #[inline(always)]
    fn has_begun(&self, zero: F<S>, entered: U<S>, lower: u32) -> M<S> {
        self.near[1].less(zero) | entered.is(lower) | entered.is(lower + 1)
    }

    /// Rays that may enter the box through a side of this slab, or leave it there where they begin `inside`: neither is
    /// another's entry certain to be later, nor another's exit to be sooner.
    #[inline(always)]
    fn may_count(&self, inside: M<S>, enter: F<S>, leave: F<S>) -> M<S> {
        (!inside & !self.near[1].less(enter)) | (inside & !leave.less(self.far[0]))
    }

    /// The facet through which rays enter, or leave from `inside`, of the lower one and the next.
    #[inline(always)]
    fn facet(&self, s: S, inside: M<S>, lower: u32) -> U<S> {
        let upper = (self.upwards & inside) | (!self.upwards & !inside);
        U::pick(upper, U::splat(s, lower + 1), U::splat(s, lower))
    }

    /// Where rays are not steep: they run along the slab. Those that lie `within` it by more than an error stay so for
    /// as long as that takes to use up; those outside stay outside as long.
    #[inline(always)]
    fn flatten(&mut self, s: S, steep: M<S>, within: F<S>, error: F<S>) {
        let (none, ever) = (F::splat(s, 0.0), F::splat(s, f32::INFINITY));
        let long = (within.abs() - error) * F::splat(s, 1.0 / (6.0 * DIRECTION_ERROR));
        let (inside, outside) = (error.less(within), within.less(-error));
        let settled = inside | outside;
        let long = F::pick(settled, long, none);
        let near = [F::pick(outside, long, -ever), F::pick(inside, -long, ever)];
        let far = [F::pick(inside, long, -ever), ever];
        self.near = [F::pick(steep, self.near[0], near[0]), F::pick(steep, self.near[1], near[1])];
        self.far = [F::pick(steep, self.far[0], far[0]), F::pick(steep, self.far[1], far[1])];
    }
}

/// The latest entry, at least or at most.
#[inline(always)]
fn latest<S: Simd>(x: &Stretch<S>, y: &Stretch<S>, z: &Stretch<S>, most: usize) -> F<S> {
    x.near[most].max(y.near[most]).max(z.near[most])
}

/// The soonest exit, at least or at most.
#[inline(always)]
fn soonest<S: Simd>(x: &Stretch<S>, y: &Stretch<S>, z: &Stretch<S>, most: usize) -> F<S> {
    x.far[most].min(y.far[most]).min(z.far[most])
}
