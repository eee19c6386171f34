//! The view frustum of a part of a picture, and how much of it a shape covers.

use std::cell::OnceCell;

use catoptra_core::Aabb;
use catoptra_core::glam::DVec3;

use super::beam::Beam;
use super::point_bounds::PointBounds;
use crate::film::{BLOCK, NOTHING};
use crate::frame::Frame;
use crate::kernel::{PlaneRow, TriangleRow};
use crate::numeric::PLAN_MARGIN;
use crate::snapshot::Ball;
use crate::{Region, Size};

/// The quarters of a region, in whole blocks; fewer where it is too small for that.
pub(crate) fn quarters(region: Region) -> impl Iterator<Item = Region> {
    let halves = |start: u32, length: u32| {
        let first = (length / 2).next_multiple_of(BLOCK).min(length);
        [(start, first), (start + first, length - first)].into_iter().filter(|&(_, length)| length > 0)
    };
    let Size { width, height } = region.size;
    halves(region.y, height).flat_map(move |(y, height)| {
        halves(region.x, width).map(move |(x, width)| Region::new(x, y, Size::new(width, height)))
    })
}

/// The camera rays of a region, all from the eye: those within four directions.
pub(crate) struct Frustum {
    eye: DVec3,
    corners: [DVec3; 4],
    /// Inward unit normals of the four sides, computed when they are first needed.
    sides: OnceCell<[DVec3; 4]>,
}

/// How much of a frustum something takes up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Coverage {
    /// No ray meets it.
    Nothing,
    /// Some rays may meet it.
    Part,
    /// Every ray meets it.
    All,
}

impl Frustum {
    pub(crate) fn new(frame: &Frame<'_>, region: &Region) -> Self {
        let raster = &frame.raster;
        // Samples may lie beyond the pixels that they belong to.
        let margin = frame.view.filter.margin();
        let ends = |start: u32, length: u32| [f64::from(start) - margin, f64::from(start + length) + margin];
        let [left, right] = ends(region.x, region.size.width);
        let [top, bottom] = ends(region.y, region.size.height);
        let corner = |x: f64, y: f64| raster.corner + raster.across * x + raster.down * y;
        let corners = [corner(left, top), corner(right, top), corner(right, bottom), corner(left, bottom)];
        Self { eye: frame.eye, corners, sides: OnceCell::new() }
    }

    fn sides(&self) -> &[DVec3; 4] {
        self.sides.get_or_init(|| {
            let middle: DVec3 = self.corners.iter().sum();
            std::array::from_fn(|i| {
                let side = self.corners[i].cross(self.corners[(i + 1) % 4]).normalize_or_zero();
                side * side.dot(middle).signum()
            })
        })
    }

    /// The rays through it.
    pub(crate) fn beam(&self) -> Beam {
        let length = self.corners[0].length();
        Beam::new(NOTHING, Aabb::of([self.eye]), Aabb::of(self.corners.map(|corner| corner / length)))
    }

    /// How far the eye lies on the side of a plane that its normal does not point to, to a share of [`PLAN_MARGIN`];
    /// `None` where that is not known so well.
    fn behind(&self, row: &PlaneRow) -> Option<f64> {
        let behind = row.distance - row.normal.dot(self.eye);
        let error = row.distance_error + PLAN_MARGIN * PLAN_MARGIN * self.eye.abs().element_sum();
        (behind.abs() * PLAN_MARGIN > error).then_some(behind)
    }

    /// 1 / t of a plane along the four corners; NaN where the eye lies in it, as far as that is known.
    pub(crate) fn inverse_t(&self, row: &PlaneRow) -> [f64; 4] {
        let inverse = self.behind(row).map_or(f64::NAN, f64::recip);
        let (normal, [a, b, c, d]) = (row.normal, &self.corners);
        [
            normal.dot(*a) * inverse,
            normal.dot(*b) * inverse,
            normal.dot(*c) * inverse,
            normal.dot(*d) * inverse,
        ]
    }

    /// Bounds of the points of a plane that are seen through the frustum; `None` where they may be unbounded.
    pub(crate) fn bounds_on(&self, row: &PlaneRow) -> Option<PointBounds> {
        let inverse_t = self.inverse_t(row);
        let margin = PLAN_MARGIN * inverse_t.iter().fold(0.0, |m, w| w.abs().max(m));
        if !inverse_t.iter().all(|w| *w > margin && w.is_finite()) {
            return None;
        }
        let points = std::array::from_fn::<_, 4, _>(|i| self.eye + self.corners[i] / inverse_t[i]);
        Some(PointBounds::new(row.prim, Aabb::of(points)))
    }

    /// Whether a ball may be seen.
    pub(crate) fn may_show(&self, ball: &Ball) -> bool {
        let to_center = ball.center - self.eye;
        let reach = ball.radius + PLAN_MARGIN * (to_center.length() + ball.radius);
        self.sides().iter().all(|side| side.dot(to_center) >= -reach)
    }

    /// How much of the frustum a face takes up.
    ///
    /// Directions that meet a triangle make a convex cone with three sides, as those of the frustum make one with four:
    /// they are disjoint where all corners of one lie beyond a side of the other, and the frustum lies within the
    /// triangle where its corners do.
    pub(crate) fn coverage(&self, face: &TriangleRow) -> Coverage {
        let corners = face.corners().map(|corner| corner - self.eye);
        let size = corners.map(|corner| corner.abs().element_sum()).into_iter().fold(0.0, f64::max);
        let margin = PLAN_MARGIN * (size + self.eye.abs().element_sum());
        if self.sides().iter().any(|side| corners.iter().all(|corner| side.dot(*corner) < -margin)) {
            return Coverage::Nothing;
        }
        let [a, b, c] = corners;
        let volume = a.cross(b).dot(c);
        // The eye may lie on the other side of so flat a face, as its corners are rounded.
        if !(volume.abs() > margin * size * size) {
            return Coverage::Part;
        }
        let longest = self.corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
        let margin = margin * size * longest;
        let mut all = true;
        for side in [a.cross(b), b.cross(c), c.cross(a)] {
            let off = self.corners.map(|corner| volume.signum() * side.dot(corner));
            if off.iter().all(|off| *off < -margin) {
                return Coverage::Nothing;
            }
            all &= off.iter().all(|off| *off > margin);
        }
        if all { Coverage::All } else { Coverage::Part }
    }

    /// Whether the eye may see the outer side of a face.
    pub(crate) fn may_face(&self, face: &TriangleRow) -> bool {
        let PlaneRow { normal, distance, .. } = face.plane;
        let margin = PLAN_MARGIN * (distance.abs() + self.eye.abs().element_sum());
        !(normal.dot(self.eye) - distance < -margin)
    }

    /// Where the points of a ball lie that are seen through the frustum, from outside it: on its near side.
    ///
    /// At an angle θ to the ball's centre, its near side is |L| cos θ − √(R² − |L|² sin² θ) away, which grows with θ up
    /// to the silhouette. The frustum holds the directions within ω of its middle.
    pub(crate) fn bounds_on_ball(&self, prim: u32, ball: &Ball) -> PointBounds {
        let to_center = ball.center - self.eye;
        let (distance2, radius2) = (to_center.length_squared(), ball.radius * ball.radius);
        let middle = self.corners.iter().sum::<DVec3>().normalize_or_zero();
        let widest =
            self.corners.iter().map(|c| c.dot(middle) / c.length()).fold(1.0, f64::min) - PLAN_MARGIN;
        let spread = (1.0 - widest * widest).max(0.0).sqrt();
        let (along, aside) = (to_center.dot(middle), to_center.cross(middle).length());
        let near_side = |along: f64, aside: f64| {
            let half_chord2 = radius2 - aside * aside;
            if along > 0.0 && half_chord2 > 0.0 {
                along - half_chord2.sqrt()
            } else {
                (distance2 - radius2).max(0.0).sqrt()
            }
        };
        let towards = (along * widest + aside * spread, (aside * widest - along * spread).max(0.0));
        let least =
            if towards.1 > 0.0 { near_side(towards.0, towards.1) } else { distance2.sqrt() - ball.radius };
        let most = near_side(along * widest - aside * spread, aside * widest + along * spread);
        let reach = (most - least) / 2.0 + most * (2.0 - 2.0 * widest).max(0.0).sqrt();
        let reach = DVec3::splat(reach);
        let center = self.eye + middle * ((least + most) / 2.0);
        PointBounds::new(prim, Aabb { min: center - reach, max: center + reach })
    }

    /// Whether the eye may lie within a ball.
    pub(crate) fn is_within(&self, ball: &Ball) -> bool {
        !(ball.center.distance(self.eye) > ball.radius * (1.0 + PLAN_MARGIN))
    }

    /// Whether every ray meets a ball from outside.
    pub(crate) fn filled_by_ball(&self, ball: &Ball) -> bool {
        let to_center = ball.center - self.eye;
        let (distance2, radius2) = (to_center.length_squared(), ball.radius * ball.radius);
        // Directions that meet a ball from outside make a convex cone.
        self.corners.iter().all(|d| {
            let along = d.dot(to_center);
            let rest = d.length_squared() * ((distance2 - radius2) + PLAN_MARGIN * distance2);
            along > 0.0 && along * along > rest
        })
    }

    /// Whether a plane certainly does not lie between the eye and these points.
    pub(crate) fn is_free_of(&self, row: &PlaneRow, points: &PointBounds) -> bool {
        self.behind(row).is_some_and(|behind| !points.may_lie_beyond(row, behind))
    }
}
