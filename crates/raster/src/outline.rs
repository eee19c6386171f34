//! Which curve tells the surface of a light, which ways does it shine, and where are the handles of its size?

use crate::projection::Projection;
use catoptra_core::glam::DVec3;
use catoptra_core::{Light, Shape};
use std::f64::consts::TAU;

/// Corners of a circle.
const CORNERS: u32 = 72;
/// Pixels that the circle of a ball stands off its edge, so that the ball does not hide it.
const OFF: f64 = 1.0;

/// The surface of a light in world space.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Outline {
    /// The edges leave the corner.
    Rectangle { corner: DVec3, edges: [DVec3; 2] },
    /// A disk, by its unit normal.
    Disk { center: DVec3, normal: DVec3, radius: f64 },
    /// A sphere.
    Ball { center: DVec3, radius: f64 },
}

impl Outline {
    /// Of a light; `None` where it is no surface.
    pub(crate) fn of(light: &Light) -> Option<Self> {
        match light.lamp()?.shape {
            Shape::Rectangle(shape) => Some(Self::Rectangle { corner: shape.corner(), edges: shape.edges() }),
            Shape::Disk(disk) => {
                let (center, normal, radius) = (disk.center(), disk.normal(), disk.radius());
                Some(Self::Disk { center, normal: normal.normalize(), radius })
            }
            Shape::Sphere(ball) => Some(Self::Ball { center: ball.center(), radius: ball.radius() }),
            _ => None,
        }
    }

    /// The middle of the surface; of a ball seen from outside, the point that is nearest to the eye.
    pub(crate) fn middle(&self, eye: DVec3) -> DVec3 {
        match *self {
            Self::Rectangle { corner, edges: [u, v] } => corner + 0.5 * u + 0.5 * v,
            Self::Disk { center, .. } => center,
            Self::Ball { center, radius } => {
                let way = eye - center;
                let distance = way.length();
                if distance > radius { center + way * (radius / distance) } else { center }
            }
        }
    }

    /// The unit normal on the lit side of a flat surface.
    pub(crate) fn normal(&self) -> Option<DVec3> {
        match *self {
            Self::Rectangle { edges: [u, v], .. } => u.normalize().cross(v.normalize()).try_normalize(),
            Self::Disk { normal, .. } => Some(normal),
            Self::Ball { .. } => None,
        }
    }

    /// The outline as it is seen, as a closed line; the last point repeats the first. Empty for a ball round the eye.
    pub(crate) fn curve(&self, view: &Projection) -> Vec<DVec3> {
        match *self {
            Self::Rectangle { corner, edges: [u, v] } => {
                vec![corner, corner + u, corner + u + v, corner + v, corner]
            }
            Self::Disk { .. } => (0..=CORNERS).map(|step| self.rim(azimuth(step, CORNERS))).collect(),
            Self::Ball { center, radius } => {
                let off = view.metres_per_pixel(center).unwrap_or(0.0) * OFF;
                let circle = tangent_circle(view.eye(), center, radius + off);
                circle.map_or_else(Vec::new, |circle| {
                    (0..=CORNERS).map(|step| circle.rim(azimuth(step, CORNERS))).collect()
                })
            }
        }
    }

    /// Where a size can be taken hold of: corners and the middles of edges, or points of a rim.
    pub(crate) fn handles(&self, view: &Projection) -> Vec<DVec3> {
        match *self {
            Self::Rectangle { .. } => {
                let corners = self.curve(view);
                let middles = corners.windows(2).map(|edge| edge[0].midpoint(edge[1]));
                corners[1..].iter().copied().chain(middles).collect()
            }
            Self::Disk { .. } => (0..4).map(|step| self.rim(azimuth(step, 4))).collect(),
            Self::Ball { center, radius } => {
                let circle = tangent_circle(view.eye(), center, radius);
                circle
                    .map_or_else(Vec::new, |circle| (0..4).map(|step| circle.rim(azimuth(step, 4))).collect())
            }
        }
    }

    /// The point of a disk's rim at an azimuth about its normal; the middle of what is none.
    pub(crate) fn rim(&self, azimuth: f64) -> DVec3 {
        let Self::Disk { center, normal, radius } = *self else { return self.middle(DVec3::NAN) };
        center + outwards(normal, azimuth) * radius
    }
}

/// The unit vector at an azimuth about a unit normal.
pub(crate) fn outwards(normal: DVec3, azimuth: f64) -> DVec3 {
    let (across, upward) = normal.any_orthonormal_pair();
    across * azimuth.cos() + upward * azimuth.sin()
}

/// The azimuth about a unit normal of a vector: the inverse of [`outwards`].
pub(crate) fn azimuth_about(normal: DVec3, vector: DVec3) -> f64 {
    let (across, upward) = normal.any_orthonormal_pair();
    vector.dot(upward).atan2(vector.dot(across))
}

/// The circle along which rays from the eye touch a ball, as a disk; `None` from inside.
fn tangent_circle(eye: DVec3, center: DVec3, radius: f64) -> Option<Outline> {
    let way = eye - center;
    let share = radius / way.length();
    let normal = way.try_normalize()?;
    (share < 1.0).then(|| Outline::Disk {
        center: center + way * (share * share),
        normal,
        radius: radius * (1.0 - share * share).sqrt(),
    })
}

fn azimuth(step: u32, steps: u32) -> f64 {
    TAU * f64::from(step % steps) / f64::from(steps)
}
