//! Bounds of the origins and directions of a stream's rays, and of the shapes that they may meet.

use catoptra_core::Aabb;
use catoptra_core::glam::DVec3;

use super::point_bounds::PointBounds;
use crate::kernel::PlaneRow;
use crate::numeric::PLAN_MARGIN;
use crate::snapshot::{Ball, Columns};

/// Rays from within a box in directions within a box.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Beam {
    /// Which shape they leave.
    pub(crate) prim: u32,
    pub(super) center: DVec3,
    pub(super) half: DVec3,
    /// Middle of the unit directions.
    pub(super) axis: DVec3,
    pub(super) half_spread: DVec3,
}

/// Where the rays of a beam meet a plane.
pub(crate) enum Crosses {
    /// Nowhere.
    Never,
    /// In no other place.
    Within(PointBounds),
    /// Perhaps unbounded.
    Anywhere,
}

impl Beam {
    /// Of rays that leave a shape.
    pub(crate) fn new(prim: u32, start: Aabb, unit: Aabb) -> Self {
        let center = start.centre();
        let margin = PLAN_MARGIN * (center.abs().element_sum() + start.size().element_sum());
        Self {
            prim,
            center,
            half: start.size() / 2.0 + DVec3::splat(margin),
            axis: unit.centre(),
            half_spread: unit.size() / 2.0 + DVec3::splat(PLAN_MARGIN),
        }
    }

    /// Its rays once they have been mirrored in a place, about unit normals within `half` of one in every coordinate.
    ///
    /// d − 2 (d·n) n with n = m + g is M d − 2 ((d·g) m + (d·m) g + (d·g) g), where M = 1 − 2 m mᵀ.
    pub(crate) fn mirrored(&self, points: &PointBounds, normal: DVec3, half: DVec3) -> Self {
        let mirrored = |v: DVec3| v - normal * (2.0 * v.dot(normal));
        let most = self.axis.abs() + self.half_spread;
        let (along, aside) =
            (self.axis.dot(normal).abs() + self.half_spread.dot(normal.abs()), most.dot(half));
        let turned = DVec3::AXES.map(|axis| mirrored(axis).abs() * self.half_spread.dot(axis));
        let spread =
            turned.into_iter().sum::<DVec3>() + (normal.abs() * aside + half * (along + aside)) * 2.0;
        Self {
            prim: points.prim,
            center: points.center,
            half: points.half,
            axis: mirrored(self.axis),
            half_spread: spread + DVec3::splat(PLAN_MARGIN),
        }
    }

    /// Whether a ray may meet any plane or bounded shape. Where all rays stay outside all convex solids, those that leave
    /// one do not meet it again.
    pub(crate) fn may_meet_any(&self, columns: &Columns, outside: bool) -> bool {
        let mut balls = columns.bounded.iter().zip(&columns.balls);
        columns.planes.iter().any(|row| self.may_cross(row))
            || balls.any(|(&prim, ball)| self.may_meet_shape(columns, prim, ball, outside))
    }

    /// Whether a ray may meet a bounded shape within a ball.
    pub(crate) fn may_meet_shape(&self, columns: &Columns, prim: u32, ball: &Ball, outside: bool) -> bool {
        !(outside && self.prim == prim && columns.is_convex(prim)) && self.may_meet(ball)
    }

    /// Whether a ray may meet a ball.
    ///
    /// Rays c + e + t (m + f) with |e| ≤ ρ and |f| ≤ δ meet a ball of radius R round c + L only if there is a t ≥ 0
    /// with |t m − L| ≤ R + ρ + t δ, that is t² (|m|² − δ²) − 2 t (m·L + δ (R + ρ)) + |L|² − (R + ρ)² ≤ 0.
    fn may_meet(&self, ball: &Ball) -> bool {
        let to_ball = ball.center - self.center;
        let (spread, reach) = (self.half_spread.length(), ball.radius + self.half.length());
        let reach = reach + PLAN_MARGIN * (reach + to_ball.length());
        let square = self.axis.length_squared() - spread * spread;
        let linear = self.axis.dot(to_ball) + spread * reach;
        let constant = to_ball.length_squared() - reach * reach;
        let never = constant > 0.0 && square > 0.0 && (linear < 0.0 || linear * linear < square * constant);
        !never && self.may_cross_box(to_ball, ball.radius * (1.0 + PLAN_MARGIN))
    }

    /// Whether a ray may meet a box of half the size `radius` round a place seen from the middle of the starts: along
    /// every axis it is there from some t to another, and these stretches must overlap.
    fn may_cross_box(&self, middle: DVec3, radius: f64) -> bool {
        let (mut from, mut to) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let reach = radius + self.half[axis] + PLAN_MARGIN * middle[axis].abs();
            let (nearest, farthest) = (middle[axis].abs() - reach, middle[axis].abs() + reach);
            let slowest = self.axis[axis] * middle[axis].signum() - self.half_spread[axis];
            let fastest = self.axis[axis] * middle[axis].signum() + self.half_spread[axis];
            if nearest > 0.0 {
                if fastest <= 0.0 {
                    return false;
                }
                from = from.max(nearest / fastest);
                if slowest > 0.0 {
                    to = to.min(farthest / slowest);
                }
            } else if slowest > 0.0 {
                to = to.min(farthest / slowest);
            } else if fastest < 0.0 {
                to = to.min(nearest / fastest);
            }
        }
        from * (1.0 - PLAN_MARGIN) <= to * (1.0 + PLAN_MARGIN)
    }

    /// Whether a ray may meet a plane.
    pub(crate) fn may_cross(&self, row: &PlaneRow) -> bool {
        !matches!(self.crosses(row), Crosses::Never)
    }

    /// Where rays meet a plane.
    pub(crate) fn crosses(&self, row: &PlaneRow) -> Crosses {
        if self.prim == row.prim {
            return Crosses::Never;
        }
        let size = row.normal.abs();
        let behind = row.distance - row.normal.dot(self.center);
        let slope = row.normal.dot(self.axis);
        let margin = PLAN_MARGIN * (row.distance.abs() + self.center.abs().element_sum());
        let margin = margin + row.distance_error;
        let (off, lean) = (size.dot(self.half) + margin, size.dot(self.half_spread));
        if (behind > off && slope < -lean) || (behind < -off && slope > lean) {
            return Crosses::Never;
        }
        let slowest = slope.abs() - lean;
        if !(slowest > 0.0) {
            return Crosses::Anywhere;
        }
        let longest = (behind.abs() + off) / slowest;
        let (shortest, middle) = ((behind.abs() - off).max(0.0) / (slope.abs() + lean), longest / 2.0);
        let middle = middle + shortest / 2.0;
        let reach = self.half + self.axis.abs() * (longest - middle) + self.half_spread * longest;
        let center = self.center + self.axis * middle;
        Crosses::Within(PointBounds::new(row.prim, Aabb { min: center - reach, max: center + reach }))
    }
}
