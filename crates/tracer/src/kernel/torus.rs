//! Rays against a torus: steps that certainly do not pass its surface, until a crossing is certain.
//!
//! With h the height of a point above the plane of the ring, ρ how far it is from the axis, and τ how far from the middle of
//! the tube, τ² = (ρ − R)² + h², the distance to the surface D = τ − r changes by no more than one metre a metre (Hart, "Sphere
//! Tracing", The Visual Computer 12, 1996). Where |D| is at most half the smaller of r and R − r, its second derivative along
//! a ray is at most the `bend`, twice the inverse of that smaller one: τ is at least r/2 and ρ at least (R − r)/2. So from
//! where D and its slope g are known the ray runs outside for as long as D + g w − bend w²/2 > 0, and where it falls that
//! steeply that it must cross before g can vanish, it crosses once.

use catoptra_core::geometry::Torus;
use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, LaneMask};
use fearless_simd::Simd;

use super::{Crossing, Facet, Kernel, NearHit, PlaneRow, Proposal, Rays, Tried, bound};
use crate::lanes::{D, D3, F, F3, M, narrow3, splat_wide, splat3, unit, widen3};
use crate::numeric::{DIRECTION_ERROR, POINT_ERROR, TORUS_ERROR, magnitude_of, rounded};

/// After as many steps a ray is left to `f64`.
const MOST_STEPS: u32 = 24;

/// By what the ball round it is larger, so that no ray comes into it on the surface.
const ROOM: f32 = 1.0 + 1.0 / 64.0;

/// A torus.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TorusRow {
    center: DVec3,
    axis: DVec3,
    radii: [f64; 2],
    center32: [f32; 3],
    axis32: [f32; 3],
    major: f32,
    minor: f32,
    ball: f32,
    reach: f32,
    /// The smaller of r and R − r.
    narrow: f32,
}

/// Rays as seen from the middle.
#[derive(Clone, Copy)]
struct Seen<S: Simd> {
    /// Metres to the point nearest to the middle.
    nearest: F<S>,
    /// That point.
    q: F3<S>,
    direction: F3<S>,
    /// How high it lies, and how much the rays climb a metre.
    height: F<S>,
    climb: F<S>,
    /// Bound on the error of a coordinate, as of a [`RoundRow`](super::RoundRow).
    point_error: F<S>,
    /// Bounds on the errors of distances and of slopes.
    error: F<S>,
    slope_error: F<S>,
}

/// The distance from the surface at a place, and how much that changes a metre.
#[derive(Clone, Copy)]
struct Off<S: Simd> {
    distance: F<S>,
    slope: F<S>,
}

/// How far rays have been followed.
struct March<S: Simd> {
    /// Metres from the nearest point.
    place: F<S>,
    /// Rays that are still followed.
    open: M<S>,
    /// Rays that cross soon after `place` for certain, and how steeply at least.
    crosses: M<S>,
    least_slope: F<S>,
    undecided: M<S>,
}

impl TorusRow {
    pub(crate) fn new(torus: &Torus) -> Self {
        let [major, minor] = torus.radii();
        let ball = ((major + minor) as f32) * ROOM;
        Self {
            center: torus.center(),
            axis: torus.axis(),
            radii: torus.radii(),
            center32: rounded(torus.center()),
            axis32: rounded(torus.axis()),
            major: major as f32,
            minor: minor as f32,
            ball,
            reach: magnitude_of(torus.center()) + ball,
            narrow: minor.min(major - minor) as f32,
        }
    }

    #[inline(always)]
    fn see<S: Simd>(&self, s: S, rays: &Rays<S>) -> Seen<S> {
        let (direction, axis, center) = (rays.direction, splat3(s, self.axis32), splat3(s, self.center32));
        let nearest = (center - rays.origin).dot(direction);
        let q = direction.scale_add(nearest, rays.origin - center);
        let point_error = (rays.reach + F::splat(s, self.reach)) * F::splat(s, POINT_ERROR);
        let error = point_error * F::splat(s, TORUS_ERROR);
        let slope_error = error.mul_add(F::splat(s, 8.0 / self.narrow), F::splat(s, 2.0 * DIRECTION_ERROR));
        Seen {
            nearest,
            q,
            direction,
            height: q.dot(axis),
            climb: direction.dot(axis),
            point_error: bound(s, point_error),
            error: bound(s, error),
            slope_error: bound(s, slope_error),
        }
    }

    #[inline(always)]
    fn off<S: Simd>(&self, s: S, seen: &Seen<S>, place: F<S>) -> Off<S> {
        let height = place.mul_add(seen.climb, seen.height);
        let point = seen.direction.scale_add(place, seen.q);
        let across = splat3(s, self.axis32).scale_add(-height, point);
        let from_axis = across.dot(across).sqrt();
        let beyond = from_axis - F::splat(s, self.major);
        let from_tube = beyond.mul_add(beyond, height * height).sqrt();
        let outwards = across.dot(seen.direction) / from_axis;
        let slope = beyond.mul_add(outwards, height * seen.climb) / from_tube;
        Off { distance: from_tube - F::splat(s, self.minor), slope }
    }

    /// Between which places rays run within the ball round it and between the planes above and below it.
    #[inline(always)]
    fn within<S: Simd>(&self, s: S, seen: &Seen<S>) -> [F<S>; 2] {
        let of = |v: f32| F::splat(s, v);
        let (ball, zero) = (of(self.ball) + seen.error, of(0.0));
        let half = ball.mul_add(ball, -seen.q.dot(seen.q));
        // Of rays that pass by, the stretch ends before it begins.
        let root = F::pick(half.less(zero), of(-1.0), half.max(zero).sqrt() + seen.error);
        let top = of(self.minor * ROOM) + seen.error;
        let inverse = of(1.0) / seen.climb;
        let [a, b] = [(-top - seen.height) * inverse, (top - seen.height) * inverse];
        let steep = of(4.0 * DIRECTION_ERROR).less(seen.climb.abs());
        let low = F::pick(steep, a.min(b), -root);
        let high = F::pick(steep, a.max(b), root);
        // Off by a rounding of the climb.
        let slack = of(8.0 * DIRECTION_ERROR) * inverse.abs();
        let [low, high] = [low - low.abs() * slack, high + high.abs() * slack];
        [F::pick(steep, low.max(-root), -root), F::pick(steep, high.min(root), root)]
    }

    /// The crossing nearest ahead. `leaving` are rays that leave this very torus.
    #[inline(always)]
    fn nearest<S: Simd>(&self, s: S, rays: &Rays<S>, leaving: M<S>) -> Proposal<S> {
        let zero = F::splat(s, 0.0);
        let seen = self.see(s, rays);
        let [enter, exit] = self.within(s, &seen);
        let begin = -seen.nearest;
        let place = F::pick(begin.less(enter) & !leaving, enter, begin);
        // Written so that NaN, from numbers beyond those of f32, stays in doubt.
        let held = rays.reach.less(F::splat(s, f32::INFINITY));
        let misses = held & exit.less(place) & !leaving;
        let mut march = March {
            place,
            open: !misses,
            crosses: zero.less(zero),
            least_slope: F::splat(s, -1.0),
            undecided: zero.less(zero),
        };
        if !march.open.any() {
            return Proposal { t: zero, error: zero, hit: misses & !misses, undecided: misses & !misses };
        }
        if leaving.any() {
            self.leave(s, &seen, &mut march, leaving);
        }
        for _ in 0..MOST_STEPS {
            if !march.open.any() {
                break;
            }
            self.step(s, &seen, &mut march, exit);
        }
        let mut place = march.place;
        for _ in 0..2 {
            let off = self.off(s, &seen, place);
            place = place - off.distance / off.slope;
        }
        let off = self.off(s, &seen, place).distance.abs();
        let error = (off + seen.error) * F::splat(s, -2.0) / march.least_slope;
        Proposal {
            t: seen.nearest + place,
            error: bound(s, error + seen.point_error + seen.point_error),
            hit: march.crosses & held,
            undecided: march.undecided | march.open | !held,
        }
    }

    /// Follows rays from the surface to where they are certainly outside: as long as they do not turn back that is where the
    /// second derivative has used up half the slope.
    #[inline(always)]
    fn leave<S: Simd>(&self, s: S, seen: &Seen<S>, march: &mut March<S>, leaving: M<S>) {
        let off = self.off(s, seen, march.place);
        let slope = off.slope - seen.slope_error;
        let outwards = F::splat(s, 0.0).less(slope);
        let way = slope * F::splat(s, self.narrow / 4.0);
        march.place = F::pick(leaving & outwards, march.place + way, march.place);
        let inwards = leaving & !outwards;
        march.undecided = march.undecided | inwards;
        march.open = march.open & !inwards;
    }

    /// Follows rays one step further.
    #[inline(always)]
    fn step<S: Simd>(&self, s: S, seen: &Seen<S>, march: &mut March<S>, exit: F<S>) {
        let of = |v: f32| F::splat(s, v);
        let (zero, room, bend) = (of(0.0), of(self.narrow / 2.0), of(2.0 / self.narrow));
        let off = self.off(s, seen, march.place);
        let [least, most] = [off.distance - seen.error, off.distance + seen.error];
        let outside = zero.less(least);
        // Down to where it has certainly crossed at half the slope.
        let slope = off.slope + seen.slope_error;
        let down = (most + seen.error) * of(-2.0) / slope;
        let certain = slope.less(zero) & (bend * down).less(slope * of(-0.5)) & (most + down).less(room);
        let crosses = march.open & outside & certain;
        march.crosses = march.crosses | crosses;
        march.least_slope = F::pick(crosses, slope, march.least_slope);
        let stuck = march.open & !outside;
        march.undecided = march.undecided | stuck;
        march.open = march.open & !crosses & !stuck;
        let slope = off.slope - seen.slope_error;
        let turn = slope.mul_add(slope, bend * (least + least)).max(zero).sqrt();
        let curved = ((least + least) / (turn - slope)).min(room - most);
        let way = F::pick(least.less(curved), curved, least) * of(1.0 - 4.0 * DIRECTION_ERROR);
        march.place = F::pick(march.open, march.place + way, march.place);
        march.open = march.open & !exit.less(march.place);
    }

    /// Points as seen from the middle of the tube beside them.
    #[inline(always)]
    fn seen_from_tube<S: Simd>(&self, s: S, point: D3<S>) -> D3<S> {
        let axis = splat_wide(s, self.axis);
        let from = point - splat_wide(s, self.center);
        let height = from.dot(axis);
        let across = axis.scale_add(-height, from);
        unit(s, across).scale_add(D::splat(s, -self.radii[0]), from)
    }
}

impl Kernel for TorusRow {
    type Face = PlaneRow;

    #[inline(always)]
    fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, tried: &Tried<S>, mut found: impl FnMut(Crossing<S>)) {
        let proposal = self.nearest(s, rays, tried.leaving.from(s, tried.prim, 0));
        found(Crossing { proposal, facet: Facet::Same(0), lanes: tried.lanes });
    }

    #[inline(always)]
    fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>) {
        let (off, slope) = Kernel::off(self, s, hit);
        let point = hit.near() + widen3(hit.direction().scale(-(off / slope)));
        (narrow3(point), narrow3(self.normal(s, hit, point)))
    }

    #[inline(always)]
    fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
        let from_tube = self.seen_from_tube(s, hit.near());
        let off = from_tube.dot(from_tube) - D::splat(s, self.radii[1] * self.radii[1]);
        let slope = narrow3(from_tube).dot(hit.direction());
        (off.narrow(), slope + slope)
    }

    #[inline(always)]
    fn normal<S: Simd>(&self, s: S, _hit: &impl NearHit<S>, point: D3<S>) -> D3<S> {
        self.seen_from_tube(s, point).scale(D::splat(s, 1.0 / self.radii[1]))
    }

    /// Of all that any torus may have.
    fn all_normals(&self, _center: DVec3, _half: DVec3, test: impl Fn(DVec3, DVec3) -> bool) -> bool {
        test(DVec3::ZERO, DVec3::ONE)
    }

    /// Rays that leave it may meet it again, wherever they begin.
    fn is_outside(&self, _point: DVec3) -> bool {
        true
    }
}
