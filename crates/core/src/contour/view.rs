//! How is a lamp seen from a point?

use glam::DVec3;

use super::angle::angle;
use super::blocker::{Blocker, Kind};
use super::conic::{Conic, Cut};
use super::lamp::{Lamp, Outline};
use super::polygon::{Corner, contour, edge_to, half};

/// A lamp as seen from a point: a polygon above the horizon, and the outline within it where the lamp is round.
#[derive(Debug, Clone)]
pub(super) struct View {
    pub normal: DVec3,
    /// Unit normal of the plane that the polygon's corners lie in, away from the eye.
    pub away: DVec3,
    /// How far away that plane is.
    pub height: f64,
    pub round: Option<Conic>,
    /// Whether the plane is the lamp's own.
    pub is_flat: bool,
    corners: [Corner; 5],
    count: usize,
}

/// How far the window of a round lamp extends, in radii of its outline: anything above 1, so that they do not touch.
const WINDOW: f64 = 1.25;

impl View {
    /// `None` where nothing of the lamp's lit side lies above the horizon.
    #[inline(always)]
    pub(super) fn of(point: DVec3, normal: DVec3, lamp: &Lamp) -> Option<Self> {
        match &lamp.outline {
            Outline::Polygon(flat) => {
                let towards = flat.normal.dot(flat.corners()[0] - point);
                let is_front = is_lit(towards, lamp.two_sided)?;
                let corners = flat.corners();
                let mut from_eye = [DVec3::ZERO; 4];
                for (i, corner) in corners.iter().enumerate() {
                    // Counter-clockwise from the lit side is clockwise from outside the sphere of directions.
                    from_eye[if is_front { corners.len() - 1 - i } else { i }] = *corner - point;
                }
                let away = if is_front { -flat.normal } else { flat.normal };
                Self::new(normal, away, &from_eye[..corners.len()], None)
            }
            Outline::Disk(disk) => {
                let center = disk.center - point;
                let is_front = is_lit(disk.normal.dot(center), lamp.two_sided)?;
                let away = if is_front { -disk.normal } else { disk.normal };
                let conic = Conic::rim(normal, center, away, disk.radius);
                Self::new(normal, away, &window(&conic), Some(conic))
            }
            Outline::Sphere { center, radius } => {
                let center = *center - point;
                if !(center.length() > *radius) {
                    return None;
                }
                let conic = Conic::outline(normal, center, *radius);
                let view = Self::new(normal, conic.axis, &window(&conic), Some(conic))?;
                Some(Self { is_flat: false, ..view })
            }
        }
    }

    #[inline(always)]
    fn new(normal: DVec3, away: DVec3, from_eye: &[DVec3], round: Option<Conic>) -> Option<Self> {
        let none = Corner { at: DVec3::ZERO, edge: DVec3::ZERO };
        let (mut corners, mut count) = ([none; 5], from_eye.len());
        for (i, at) in from_eye.iter().enumerate() {
            let next = from_eye[if i + 1 < from_eye.len() { i + 1 } else { 0 }];
            corners[i] = Corner { at: *at, edge: edge_to(*at, next) };
        }
        if from_eye.iter().any(|at| normal.dot(*at) < 0.0) {
            let whole = corners;
            count = 0;
            half(&whole[..from_eye.len()], normal, 0.0, |corner| {
                if count < 5 {
                    corners[count] = corner;
                    count += 1;
                }
            });
        }
        let height = away.dot(from_eye[0]);
        if count < 3 {
            None
        } else {
            Some(Self { normal, away, height, round, is_flat: true, corners, count })
        }
    }

    /// The polygon.
    #[inline]
    pub(super) fn outline(&self) -> &[Corner] {
        &self.corners[..self.count]
    }

    /// The projected solid angle.
    #[inline]
    pub(super) fn open(&self) -> f64 {
        let twice = match &self.round {
            None => contour(self.normal, self.outline()),
            Some(conic) => match conic.cut(self.normal) {
                Cut::Within => conic.whole(),
                Cut::Outside => 0.0,
                Cut::Part(arc) => {
                    let keys = (arc.to.key() - arc.from.key()).rem_euclid(4.0);
                    let [a, b] = [conic.at(arc.to), conic.at(arc.from)];
                    conic.arc(arc, keys) + angle(self.normal.dot(a.cross(b - a)), a.dot(b))
                }
            },
        };
        // Also refuses NaN, which only coordinates whose products leave the range of numbers make.
        if twice > 0.0 { (twice / 2.0).min(std::f64::consts::PI) } else { 0.0 }
    }

    /// Whether the ball round a blocker may meet what is seen of the lamp.
    #[inline]
    pub(super) fn may_meet(&self, point: DVec3, blocker: &Blocker) -> bool {
        let (center, radius) = (blocker.bound.0 - point, blocker.bound.1);
        match blocker.kind {
            Kind::Plane(..) => return true,
            Kind::Ground(normal) => return self.outline().iter().any(|corner| normal.dot(corner.at) < 0.0),
            _ => {}
        }
        let is_beyond = self.is_flat && self.away.dot(center) - radius >= self.height;
        !is_beyond
            && self.normal.dot(center) > -radius
            && self.outline().iter().all(|corner| corner.edge.dot(center) > -radius)
    }
}

/// Whether the front of a flat lamp is seen, given how far its plane is along its normal; `None` where it is dark.
fn is_lit(towards: f64, two_sided: bool) -> Option<bool> {
    if towards < 0.0 {
        Some(true)
    } else if two_sided && towards > 0.0 {
        Some(false)
    } else {
        None
    }
}

/// Corners of a square round a round outline, counter-clockwise as seen from outside the sphere of directions.
fn window(conic: &Conic) -> [DVec3; 4] {
    let [u, v] = conic.across.map(|e| e * (conic.radius * WINDOW));
    let p = conic.center;
    [p + u + v, p - u + v, p - u - v, p + u - v]
}
