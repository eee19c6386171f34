//! Where on a lamp do shadow rays end, and how much of its light does each stand for?
//!
//! Points lie evenly over the solid angle under which a rectangle, a triangle or a sphere is seen, and evenly over the area
//! of a disk and of lamps so small that their solid angle is lost to rounding. Of a lamp with corners they are then drawn
//! closer where the surface is lit under a steeper angle: by a bilinear function of the shares, which has the cosines at
//! the corners (Hart, Pharr, Müller, Lopes, McGuire and Shirley, "Practical product sampling by fitting and composing
//! warps", EGSR 2020). So all points stand for nearly the same irradiance.

mod quad;
mod round;
mod triangle;
mod warp;

use glam::DVec3;

use crate::contour::{Lamp, Outline};
use crate::numeric::{LAMP_POINT_ROUNDING, SMALLEST_SOLID_ANGLE};
use quad::Quad;
use round::{Cap, Disk};
use triangle::Triangle;
use warp::Warp;

/// A point on a lamp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LampPoint {
    /// From the shaded point to it, metres.
    pub to: DVec3,
    /// Up to which share of that way things block its light: what is farther is the lamp, but for rounding.
    pub end: f64,
    /// The solid angle it stands for if it is one point alone, sr.
    pub solid: f64,
}

/// A point and the solid angle it stands for, before any warp.
#[derive(Debug, Clone, Copy)]
struct Aimed {
    to: DVec3,
    solid: f64,
}

/// How points are spread over a lamp.
#[derive(Debug, Clone, Copy)]
enum Spread {
    Quad(Quad),
    Triangle(Triangle),
    /// Evenly over a parallelogram: a corner, two edges from it, and its unit normal.
    Parallelogram([DVec3; 4]),
    /// Evenly over a triangle: likewise.
    Flat([DVec3; 4]),
    Cap(Cap),
    Disk(Disk),
}

/// A lamp as it is seen from a shaded point: what its points are drawn from.
#[derive(Debug, Clone, Copy)]
pub struct LampPoints {
    spread: Spread,
    warp: Option<Warp>,
    /// The lamp's unit normal; `None` for a sphere.
    normal: Option<DVec3>,
    /// Largest coordinate that the lamp's points were rounded at, metres.
    size: f64,
}

impl LampPoints {
    /// As seen from a point with a unit normal; `None` from inside a sphere.
    #[must_use]
    pub fn new(lamp: &Lamp, point: DVec3, normal: DVec3) -> Option<Self> {
        let (spread, own_normal, largest) = match &lamp.outline {
            Outline::Polygon(flat) => {
                let corners = flat.corners();
                let from = corners[0] - point;
                let (next, last) = (corners[1] - corners[0], corners[corners.len() - 1] - corners[0]);
                let even = [from, next, last, flat.normal];
                let spread = if corners.len() == 4 {
                    let even = || Spread::Parallelogram(even);
                    Quad::new(from, [next, last], SMALLEST_SOLID_ANGLE).map_or_else(even, Spread::Quad)
                } else {
                    let seen = [from, corners[1] - point, corners[2] - point];
                    let even = || Spread::Flat(even);
                    Triangle::new(seen, SMALLEST_SOLID_ANGLE).map_or_else(even, Spread::Triangle)
                };
                let largest = corners.iter().fold(DVec3::ZERO, |most, corner| most.max(corner.abs()));
                (spread, Some(flat.normal), largest)
            }
            Outline::Disk(disk) => {
                let spread = Disk::new(disk.center - point, disk.normal, disk.radius);
                (Spread::Disk(spread), Some(disk.normal), disk.center.abs() + DVec3::splat(disk.radius))
            }
            Outline::Sphere { center, radius } => {
                let cap = Cap::new(*center - point, *radius)?;
                (Spread::Cap(cap), None, center.abs() + DVec3::splat(*radius))
            }
        };
        let size = largest.max(point.abs()).element_sum();
        let corners = match &spread {
            Spread::Quad(_) | Spread::Parallelogram(_) => {
                Some([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
            }
            _ => None,
        };
        let cosine = |shares: [f64; 2]| spread.aim(shares).to.normalize_or_zero().dot(normal);
        let warp = corners.map(|corners| Warp::new(corners.map(cosine)));
        Some(Self { spread, warp, normal: own_normal, size })
    }

    /// The point for two shares in 0..1.
    #[must_use]
    pub fn point(&self, shares: [f64; 2]) -> LampPoint {
        let (shares, density) = match &self.warp {
            Some(warp) => warp.place(shares),
            None => (shares, 1.0),
        };
        let Aimed { to, solid } = self.spread.aim(shares);
        if !(to.is_finite() && solid.is_finite()) {
            // In the lamp itself, or edge-on.
            return LampPoint { to: DVec3::ZERO, end: 0.0, solid: 0.0 };
        }
        LampPoint { to, end: self.end(to), solid: solid / density }
    }

    /// Where on the way to a point of the lamp the lamp itself may be met by rounding: the point is off its plane by a few
    /// roundings, which a slanted ray meets the earlier. Along the limb of a sphere all of that is the sphere.
    fn end(&self, to: DVec3) -> f64 {
        let off = self.size * LAMP_POINT_ROUNDING;
        let (length, slope) = match (&self.spread, self.normal) {
            (Spread::Cap(cap), _) => (to.length(), cap.slope(to)),
            (_, normal) => (to.length(), normal.map_or(1.0, |normal| normal.dot(to).abs() / to.length())),
        };
        let share = off / (length * slope.max((off / length).sqrt()));
        if share < 1.0 { (1.0 - share).min(1.0_f64.next_down()) } else { 0.0 }
    }
}

impl Spread {
    fn aim(&self, shares: [f64; 2]) -> Aimed {
        match self {
            Self::Quad(quad) => quad.point(shares),
            Self::Triangle(triangle) => triangle.point(shares),
            Self::Parallelogram([corner, u, v, normal]) => {
                let to = *corner + *u * shares[0] + *v * shares[1];
                Aimed { to, solid: solid_of(u.cross(*v).length(), *normal, to) }
            }
            Self::Flat([corner, u, v, normal]) => {
                let root = shares[0].sqrt();
                let to = *corner + *u * (1.0 - root) + *v * (root * shares[1]);
                Aimed { to, solid: solid_of(u.cross(*v).length() / 2.0, *normal, to) }
            }
            Self::Cap(cap) => cap.point(shares),
            Self::Disk(disk) => disk.point(shares),
        }
    }
}

/// The solid angle that an area stands for at a point of it, seen from the origin.
fn solid_of(area: f64, normal: DVec3, to: DVec3) -> f64 {
    let distance2 = to.length_squared();
    let solid = area * normal.dot(to).abs() / (distance2 * distance2.sqrt());
    if solid.is_finite() { solid } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a lamp is made from.
    #[derive(Debug)]
    enum Form {
        /// A corner and two edges.
        Rectangle([DVec3; 3]),
        Triangle([DVec3; 3]),
        Disk(DVec3, DVec3, f64),
        Sphere(DVec3, f64),
    }

    impl Form {
        fn points(&self, from: DVec3, normal: DVec3) -> Option<LampPoints> {
            let lamp = match *self {
                Self::Rectangle([at, u, v]) => Lamp::polygon(&[at, at + u, at + u + v, at + v]),
                Self::Triangle(corners) => Lamp::polygon(&corners),
                Self::Disk(center, normal, radius) => Lamp::disk(center, normal, radius),
                Self::Sphere(center, radius) => Lamp::sphere(center, radius),
            };
            LampPoints::new(&lamp?, from, normal)
        }
    }

    fn shapes() -> [Form; 6] {
        let (x, z) = (DVec3::X, DVec3::Z);
        [
            Form::Rectangle([DVec3::new(-1.0, 3.0, 0.5), x * 2.0, z * 0.5]),
            Form::Rectangle([DVec3::new(0.1, 0.2, -0.5), x * 5.0, DVec3::new(0.0, 3.0, 4.0)]),
            Form::Rectangle([DVec3::new(0.0, 300.0, 0.0), x * 0.2, z * 0.1]),
            Form::Triangle([
                DVec3::new(-1.0, 3.0, 0.5),
                DVec3::new(2.0, 2.0, 0.0),
                DVec3::new(0.0, 1.0, 4.0),
            ]),
            Form::Disk(DVec3::new(1.0, 2.0, 0.3), DVec3::new(0.0, -0.6, 0.8), 0.7),
            Form::Sphere(DVec3::new(0.4, 1.5, -0.6), 0.9),
        ]
    }

    /// Every share of a fine grid, in its middle.
    fn grid(steps: usize) -> impl Iterator<Item = [f64; 2]> {
        let share = move |k: usize| (k as f64 + 0.5) / steps as f64;
        (0..steps * steps).map(move |k| [share(k % steps), share(k / steps)])
    }

    /// The projected solid angle, by an even grid over the area.
    fn by_area(shape: &Form, normal: DVec3) -> f64 {
        let facing = |to: DVec3, area: DVec3| {
            let distance = to.length();
            (to.dot(normal) / distance).max(0.0) * to.dot(area).abs() / distance.powi(3)
        };
        let steps = 700;
        let sum: f64 = grid(steps)
            .map(|[u, v]| match *shape {
                Form::Rectangle([corner, a, b]) => facing(corner + a * u + b * v, a.cross(b)),
                Form::Triangle([a, b, c]) => {
                    let (first, second) = if u + v < 1.0 { (u, v) } else { (1.0 - u, 1.0 - v) };
                    facing(a + (b - a) * first + (c - a) * second, (b - a).cross(c - a) / 2.0)
                }
                Form::Disk(center, axis, radius) => {
                    let (right, up) = axis.any_orthonormal_pair();
                    let (sin, cos) = (v * std::f64::consts::TAU).sin_cos();
                    let to = center + (right * cos + up * sin) * (radius * u.sqrt());
                    facing(to, axis * (std::f64::consts::PI * radius * radius))
                }
                Form::Sphere(center, radius) => {
                    let (height, (sin, cos)) = (2.0 * u - 1.0, (v * std::f64::consts::TAU).sin_cos());
                    let round = (1.0 - height * height).sqrt();
                    let out = DVec3::new(round * cos, height, round * sin);
                    let to = center + out * radius;
                    if to.dot(out) < 0.0 {
                        facing(to, out * (2.0 * std::f64::consts::TAU * radius * radius))
                    } else {
                        0.0
                    }
                }
            })
            .sum();
        sum / (steps * steps) as f64
    }

    #[test]
    fn points_stand_for_the_projected_solid_angle() {
        for shape in shapes() {
            for normal in [DVec3::Y, DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, 0.6, -0.8)] {
                let points = shape.points(DVec3::ZERO, normal).unwrap();
                let weight = |shares| {
                    let LampPoint { to, solid, end } = points.point(shares);
                    assert!(end > 1.0 - 1e-6 && end < 1.0, "{shape:?} {end}");
                    to.normalize().dot(normal).max(0.0) * solid
                };
                let mean = grid(200).map(weight).sum::<f64>() / 40_000.0;
                let expected = by_area(&shape, normal);
                assert!(
                    (mean - expected).abs() < 2e-4 * expected + 1e-7,
                    "{shape:?} {normal}: {mean} {expected}"
                );
            }
        }
    }

    #[test]
    fn points_lie_on_the_lamp() {
        let from = DVec3::new(0.3, -0.2, 0.1);
        for shape in shapes() {
            let points = shape.points(from, DVec3::Y).unwrap();
            for shares in grid(9) {
                let at = from + points.point(shares).to;
                let off = match shape {
                    Form::Rectangle([corner, u, v]) => {
                        let (a, b) = (
                            (at - corner).dot(u) / u.length_squared(),
                            (at - corner).dot(v) / v.length_squared(),
                        );
                        assert!(
                            (-1e-9..1.0 + 1e-9).contains(&a) && (-1e-9..1.0 + 1e-9).contains(&b),
                            "{a} {b}"
                        );
                        (at - corner).dot(u.cross(v).normalize())
                    }
                    Form::Triangle([a, b, c]) => {
                        let inward = |p: DVec3, q: DVec3| (q - p).cross(at - p).dot((b - a).cross(c - a));
                        assert!([inward(a, b), inward(b, c), inward(c, a)].iter().all(|side| *side > -1e-9));
                        (at - a).dot((b - a).cross(c - a).normalize())
                    }
                    Form::Disk(center, normal, radius) => {
                        assert!(at.distance(center) < radius + 1e-9);
                        (at - center).dot(normal)
                    }
                    Form::Sphere(center, radius) => at.distance(center) - radius,
                };
                assert!(off.abs() < 1e-12, "{shape:?} {off:e}");
            }
        }
    }

    #[test]
    fn the_warp_makes_points_stand_for_nearly_the_same_irradiance() {
        let shape = Form::Rectangle([DVec3::new(0.5, 0.0, -1.0), DVec3::Y * 2.0, DVec3::Z * 2.0]);
        let points = shape.points(DVec3::ZERO, DVec3::Y).unwrap();
        let plain = LampPoints { warp: None, ..points };
        let spread = |points: &LampPoints| {
            let weights: Vec<f64> = grid(32)
                .map(|shares| {
                    let point = points.point(shares);
                    point.to.normalize().dot(DVec3::Y) * point.solid
                })
                .collect();
            let mean = weights.iter().sum::<f64>() / weights.len() as f64;
            (weights.iter().map(|w| (w / mean - 1.0).powi(2)).sum::<f64>() / weights.len() as f64).sqrt()
        };
        assert!(spread(&points) < 0.4 * spread(&plain), "{} {}", spread(&points), spread(&plain));
    }

    #[test]
    fn inside_a_sphere_there_are_no_points_and_odd_lamps_give_finite_ones() {
        assert!(Form::Sphere(DVec3::X, 2.0).points(DVec3::ZERO, DVec3::Y).is_none());
        let odd = [
            Form::Rectangle([DVec3::ZERO, DVec3::X, DVec3::Y]),
            Form::Rectangle([DVec3::new(1.0, 0.0, 0.0), DVec3::X, DVec3::Y]),
            Form::Triangle([DVec3::ZERO, DVec3::X, DVec3::Y]),
            Form::Triangle([DVec3::X, DVec3::X * 2.0, DVec3::Y]),
            Form::Disk(DVec3::ZERO, DVec3::Y, 1.0),
            Form::Rectangle([DVec3::splat(1e12), DVec3::X, DVec3::Y]),
        ];
        for shape in odd {
            let Some(points) = shape.points(DVec3::ZERO, DVec3::Y) else { continue };
            for shares in grid(7) {
                let LampPoint { to, end, solid } = points.point(shares);
                assert!(
                    to.is_finite() && solid.is_finite() && (0.0..1.0).contains(&end),
                    "{shape:?}: {to} {end} {solid}"
                );
            }
        }
    }
}
