//! The room between some points and a lamp: all segments from one to the other lie in it.

use catoptra_core::Aabb;
use catoptra_core::glam::DVec3;

use super::point_bounds::PointBounds;
use crate::accel::Box32;
use crate::numeric::PLAN_MARGIN;
use crate::snapshot::Ball;

/// The convex hull of the bounds of some points and of a ball, as hulls of two balls and of two boxes whose common room
/// it lies in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shaft {
    from: Ball,
    /// From the middle of the points to that of the ball.
    axis: DVec3,
    length: f64,
    /// How much larger the ball is than the one round the points.
    growth: f64,
    bounds: Aabb,
}

impl Shaft {
    /// Between points and a ball, relative to one origin.
    pub(crate) fn new(points: &PointBounds, lamp: &Ball) -> Self {
        let from = Ball { center: points.center, radius: points.radius() };
        let axis = lamp.center - from.center;
        let here = Aabb { min: points.center - points.half, max: points.center + points.half };
        let bounds = here.union(lamp.bounds());
        Self { from, axis, length: axis.length(), growth: lamp.radius - from.radius, bounds }
    }

    /// Whether it may hold a point of a ball.
    pub(crate) fn meets(&self, ball: &Ball) -> bool {
        let away = ball.center - self.from.center;
        let margin = PLAN_MARGIN * (away.abs().element_sum() + self.length + ball.radius + self.from.radius);
        let reach = ball.radius + margin;
        let nearest = ball.center.clamp(self.bounds.min, self.bounds.max);
        if nearest.distance_squared(ball.center) > reach * reach {
            return false;
        }
        // The distance from the ball's middle to the point a share t along the axis, less the radius there, is a convex
        // function of t.
        let along = if self.length > 0.0 { away.dot(self.axis) / self.length } else { 0.0 };
        let aside = (away.length_squared() - along * along).max(0.0).sqrt();
        let slope = self.growth / self.length;
        let best = if slope.abs() < 1.0 {
            along + aside * slope / (1.0 - slope * slope).sqrt()
        } else if slope > 0.0 {
            self.length
        } else {
            0.0
        };
        let best = best.clamp(0.0, self.length);
        let gap = aside.hypot(best - along) - self.from.radius - self.growth * (best / self.length);
        // NaN, where the middles coincide, is no reason to leave it out.
        !(gap > reach)
    }

    /// Whether it may hold a point of a box.
    pub(crate) fn meets_box(&self, bounds: &Box32) -> bool {
        let corner = |of: [f32; 3]| DVec3::from_array(of.map(f64::from));
        let bounds = Aabb { min: corner(bounds.min), max: corner(bounds.max) };
        self.meets(&Ball::round(bounds))
            && bounds.min.cmple(self.bounds.max).all()
            && self.bounds.min.cmple(bounds.max).all()
    }
}
