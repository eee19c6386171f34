//! Sets up single rays, a packet at a time: the values that boxes and triangles are tested with, a column each.

use catoptra_core::{Arithmetic, Lane};
use fearless_simd::Simd;

use super::single_ray::SingleRay;
use super::{ClosestHit, ExactResolver, Lines, TreeWalk};
use crate::lanes::{D, D3, F, M, MOST_LANES, U, narrow3};
use crate::numeric::{BOX_STRETCH, SINGLE_RAY_FLOOR, SINGLE_RAY_OFF, SINGLE_RAY_PAD, SINGLE_RAY_SHARE};

/// A number of every lane.
type Row = [f32; MOST_LANES];

/// Rays of a packet in a mesh's own space, each to be traced as a single ray.
pub(crate) struct RaySetup {
    /// Where slabs begin and how their `t` grow, axis by axis: at the ends of boxes that are met first, then at the
    /// others.
    starts: [[Row; 3]; 2],
    inverses: [[Row; 3]; 2],
    /// Which rays run backwards along each axis, bit by bit.
    backwards: [u64; 3],
    /// Those that run mostly along x, or else along y.
    mostly: [u64; 2],
    origin: [Row; 3],
    /// Directions over the largest of their coordinates, along the two axes that follow that one's.
    shear: [Row; 2],
    /// Lengths of the direction per length along the axis it mostly runs along.
    along: Row,
    /// Error of an edge value per unit of the sheared corners, and where there are none.
    slack: Row,
    floor: Row,
}

/// Rays to be traced, and the triangles that they leave.
#[derive(Clone, Copy)]
pub(crate) struct StartingRays<S: Simd> {
    pub(crate) lanes: M<S>,
    pub(crate) leaving: U<S>,
}

impl RaySetup {
    /// Sets up lines for a mesh whose corners' coordinates stay within `reach`. Their origins may be off by `off` along
    /// every axis, beyond the roundings of `f64`; the [`ExactResolver`](super::ExactResolver) has the exact rays.
    #[inline(always)]
    pub(crate) fn of<S: Simd>(s: S, lines: &Lines<S>, off: F<S>, reach: f32) -> Self {
        let (origin, direction) = (narrow3(lines.origin), narrow3(lines.direction));
        // An origin that is off counts like one of larger coordinates that is rounded.
        let largest = origin.x.abs().max(origin.y.abs()).max(origin.z.abs());
        let largest = off.mul_add(F::splat(s, SINGLE_RAY_OFF), largest);
        let pad = largest.mul_add(F::splat(s, SINGLE_RAY_PAD), F::splat(s, f32::MIN_POSITIVE));
        let reach = F::splat(s, reach) + largest;
        let floor = reach * F::splat(s, SINGLE_RAY_FLOOR);
        let floor = floor.mul_add(floor, F::splat(s, f32::MIN_POSITIVE));
        let mut rays = Self::nothing();
        rays.start(s, 0, origin.x, direction.x, pad);
        rays.start(s, 1, origin.y, direction.y, pad);
        rays.start(s, 2, origin.z, direction.z, pad);
        rays.lean(s, &lines.direction);
        (reach * F::splat(s, SINGLE_RAY_SHARE)).store(&mut rays.slack);
        floor.store(&mut rays.floor);
        rays
    }

    #[inline(always)]
    fn nothing() -> Self {
        let row = [0.0; MOST_LANES];
        Self {
            starts: [[row; 3]; 2],
            inverses: [[row; 3]; 2],
            backwards: [0; 3],
            mostly: [0; 2],
            origin: [row; 3],
            shear: [row; 2],
            along: row,
            slack: row,
            floor: row,
        }
    }

    /// Slabs along an axis.
    #[inline(always)]
    fn start<S: Simd>(&mut self, s: S, axis: usize, origin: F<S>, direction: F<S>, pad: F<S>) {
        let inverse = F::splat(s, 1.0) / direction;
        let backwards = inverse.less(F::splat(s, 0.0));
        // A lower end is padded downwards, an upper one upwards.
        let (lower, upper) = (origin + pad, origin - pad);
        self.backwards[axis] = backwards.bits();
        F::pick(backwards, upper, lower).store(&mut self.starts[0][axis]);
        F::pick(backwards, lower, upper).store(&mut self.starts[1][axis]);
        inverse.store(&mut self.inverses[0][axis]);
        (inverse * F::splat(s, BOX_STRETCH)).store(&mut self.inverses[1][axis]);
        origin.store(&mut self.origin[axis]);
    }

    /// The shear that makes every ray an axis.
    #[inline(always)]
    fn lean<S: Simd>(&mut self, s: S, direction: &D3<S>) {
        let (x, y, z) = (direction.x, direction.y, direction.z);
        let below = y.abs().max(z.abs());
        let not_x = x.abs().at_most(below);
        let not_y = y.abs().at_most(z.abs());
        let along = D::splat(s, 1.0) / either(not_x, not_y, [x, y, z]);
        (either(not_x, not_y, [y, z, x]) * along).narrow().store(&mut self.shear[0]);
        (either(not_x, not_y, [z, x, y]) * along).narrow().store(&mut self.shear[1]);
        along.narrow().store(&mut self.along);
        self.mostly = [(!not_x).bits(), (!not_y).bits()];
    }

    /// Finds the nearest triangle for rays, or any, one after another; `begun` gives what is known of a ray before.
    /// Returns slots of the tree's blocks; [`u32::MAX`] for none.
    #[inline(always)]
    pub(crate) fn search<S: Simd>(
        &self,
        s: S,
        walk: TreeWalk<'_>,
        rays: StartingRays<S>,
        begun: impl Fn(usize) -> ClosestHit,
        exact: &mut dyn ExactResolver,
    ) -> U<S> {
        let mut slots = [u32::MAX; MOST_LANES];
        let TreeWalk { tree, visits } = walk;
        let planes = visits.planes_of(tree);
        for lane in rays.lanes.lanes() {
            let mut found = begun(lane);
            let left = rays.leaving.lane(lane);
            let left = planes.map_or(left, |planes| planes.of_facet(left));
            self.lane(lane, left).search(s, tree, visits, &mut found, exact);
            slots[lane % MOST_LANES] = found.slot.unwrap_or(u32::MAX);
        }
        U::load(s, &slots)
    }

    /// The ray of a lane, which leaves from a triangle.
    #[inline(always)]
    pub(super) fn lane(&self, lane: usize, leaving: u32) -> SingleRay {
        let at = lane % MOST_LANES;
        let bit = |bits: u64| (bits >> at & 1) as usize;
        let three = |[x, y, z]: &[Row; 3]| [x[at], y[at], z[at]];
        let [x, y, z] = self.backwards;
        // In arithmetic: a branch would be unpredictable.
        let last = (2 - bit(self.mostly[1])) * (1 - bit(self.mostly[0]));
        SingleRay {
            lane,
            leaving,
            backwards: [bit(x), bit(y), bit(z)],
            starts: [three(&self.starts[0]), three(&self.starts[1])],
            inverses: [three(&self.inverses[0]), three(&self.inverses[1])],
            axes: [(last + 1) % 3, (last + 2) % 3, last],
            origin: three(&self.origin),
            shear: [self.shear[0][at], self.shear[1][at]],
            along: self.along[at],
            slack: self.slack[at],
            floor: self.floor[at],
        }
    }
}

/// The number that is for rays mostly along x, y or z.
#[inline(always)]
fn either<S: Simd>(not_x: M<S>, not_y: M<S>, [x, y, z]: [D<S>; 3]) -> D<S> {
    D::pick(not_x, D::pick(not_y, z, y), x)
}
