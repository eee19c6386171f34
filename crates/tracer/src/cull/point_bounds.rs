//! Bounds of the visible points of one shape, and tests which lights reach them and which shapes may occlude those.

use catoptra_core::Aabb;
use catoptra_core::glam::DVec3;

use crate::kernel::PlaneRow;
use crate::numeric::{CONE_MARGIN, PLAN_MARGIN};
use crate::snapshot::{Ball, LightRow};

/// A box round the points that are seen of one shape.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PointBounds {
    pub(crate) prim: u32,
    pub(crate) center: DVec3,
    pub(crate) half: DVec3,
    radius: f64,
}

impl PointBounds {
    pub(crate) fn new(prim: u32, bounds: Aabb) -> Self {
        let center = bounds.centre();
        let margin = PLAN_MARGIN * (center.abs().element_sum() + bounds.size().element_sum());
        let half = bounds.size() / 2.0 + DVec3::splat(margin);
        Self { prim, center, half, radius: half.length() }
    }

    /// Round one point of a shape.
    pub(crate) fn at(prim: u32, point: DVec3) -> Self {
        Self::new(prim, Aabb { min: point, max: point })
    }

    /// Radius of the ball round the middle that holds all points.
    pub(super) fn radius(&self) -> f64 {
        self.radius
    }

    /// What rounding may make of distances to a plane.
    pub(super) fn margin(&self, row: &PlaneRow) -> f64 {
        PLAN_MARGIN * (row.distance.abs() + self.center.abs().element_sum())
    }

    /// Whether a point may lie on the other side of a plane than a light that is `behind` metres behind it.
    pub(crate) fn may_lie_beyond(&self, row: &PlaneRow, behind: f64) -> bool {
        if self.prim == row.prim {
            return false;
        }
        let middle = row.distance - row.normal.dot(self.center);
        let spread = row.normal.abs().dot(self.half);
        let least = if behind > 0.0 { middle - spread } else { -middle - spread };
        !(least > self.margin(row) + row.distance_error)
    }

    /// Whether anything may arrive from a light.
    pub(crate) fn is_reached_by(&self, light: &LightRow) -> bool {
        let farthest = light.position.distance(self.center) + self.radius;
        light.light.may_reach(self.center, self.radius * (1.0 + PLAN_MARGIN) + CONE_MARGIN * farthest)
    }

    /// Whether shadow rays from the points to a light may meet a ball.
    pub(crate) fn shaft_meets(&self, light: &LightRow, ball: &Ball) -> bool {
        let to_ball = ball.center - self.center;
        let reach =
            (ball.radius + self.radius) * (1.0 + PLAN_MARGIN) + PLAN_MARGIN * to_ball.abs().element_sum();
        let way = if light.at_infinity { light.position } else { light.position - self.center };
        let most = if light.at_infinity { f64::INFINITY } else { 1.0 };
        let share = (to_ball.dot(way) / way.length_squared()).clamp(0.0, most);
        !((to_ball - way * share).length_squared() > reach * reach)
    }
}
