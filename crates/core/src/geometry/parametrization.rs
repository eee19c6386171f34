//! Where on a surface does a point lie, in texture coordinates, and how do they run?

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

/// Texture coordinates at a point of a surface, and how far one moves along it when they grow by 1, in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parametrization {
    /// Texture coordinates; u to the right, v upwards as seen from the side that the normal points to.
    pub uv: DVec2,
    /// The derivative of the point by u; zero where there is none.
    pub along_u: DVec3,
    /// The derivative of the point by v; zero where there is none.
    pub along_v: DVec3,
}

impl Parametrization {
    /// How far the texture coordinates move when the point moves along the surface by each of two vectors (metres): of a
    /// vector that leaves the surface, what lies along it. Zero where the coordinates have no derivative.
    #[must_use]
    pub fn footprint(&self, spread: [DVec3; 2]) -> [DVec2; 2] {
        let (u, v) = (self.along_u, self.along_v);
        let (uu, uv, vv) = (u.length_squared(), u.dot(v), v.length_squared());
        let determinant = uu * vv - uv * uv;
        if !(determinant > 0.0) {
            return [DVec2::ZERO; 2];
        }
        spread.map(|side| {
            let (a, b) = (side.dot(u), side.dot(v));
            DVec2::new(a * vv - b * uv, b * uu - a * uv) / determinant
        })
    }

    /// A unit vector along the surface to where u grows; any along it where there is none such.
    #[must_use]
    pub fn tangent(&self, normal: DVec3) -> DVec3 {
        let along = self.along_u - normal * self.along_u.dot(normal);
        along.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector())
    }
}

/// Two unit vectors along a flat surface: to the right and upwards, for an upright one; x and −z for one that lies flat.
pub(super) fn level_axes(normal: DVec3) -> [DVec3; 2] {
    let right = DVec3::Y.cross(normal);
    // A surface that lies flat but for rounding counts as flat.
    let right = if right.length_squared() > 1e-18 { right.normalize() } else { DVec3::X };
    [right, normal.cross(right)]
}

/// Longitude and latitude on a sphere of that radius, of a point as seen from its centre; +z is the middle.
pub(super) fn on_sphere(from_center: DVec3, radius: f64) -> Parametrization {
    let uv = crate::texture::longitude_and_latitude(from_center);
    let ((sine, cosine), (up, level)) = ((TAU * (uv.x - 0.5)).sin_cos(), (PI * (uv.y - 0.5)).sin_cos());
    Parametrization {
        uv,
        along_u: DVec3::new(cosine, 0.0, -sine) * (TAU * radius * level),
        along_v: DVec3::new(-sine * up, level, -cosine * up) * (PI * radius),
    }
}

/// Angle and distance from the middle of a disk, both in parts of the whole; the angle runs counterclockwise as seen from
/// the side of the normal.
pub(super) fn on_disk(from_center: DVec3, normal: DVec3, radius: f64) -> Parametrization {
    let turn = turn_about(normal, from_center);
    let out = turn.outwards.dot(from_center);
    Parametrization {
        uv: DVec2::new(turn.share, out / radius),
        along_u: turn.along,
        along_v: turn.outwards * radius,
    }
}

/// How far round an axis a point lies.
pub(super) struct Turn {
    /// In parts of a whole turn, from the right (see [`level_axes`]), counterclockwise as seen against the axis.
    pub(super) share: f64,
    /// How far the point moves in a whole turn at its speed.
    pub(super) along: DVec3,
    /// The unit vector away from the axis.
    pub(super) outwards: DVec3,
}

/// How far round a unit axis a point lies that is given as seen from a point of the axis.
pub(super) fn turn_about(axis: DVec3, from_axis: DVec3) -> Turn {
    let [right, up] = level_axes(axis);
    let place = DVec2::new(from_axis.dot(right), from_axis.dot(up));
    let angle = place.y.atan2(place.x);
    let (sine, cosine) = angle.sin_cos();
    Turn {
        share: (angle / TAU).rem_euclid(1.0),
        along: (up * cosine - right * sine) * (TAU * place.length()),
        outwards: right * cosine + up * sine,
    }
}

/// In a triangle, from the texture coordinates of its corners. A point beside it is taken for the one below.
pub(super) fn in_triangle(
    [a, b, c]: &[DVec3; 3],
    [at_a, at_b, at_c]: [DVec2; 3],
    point: DVec3,
) -> Parametrization {
    let (p, q, from_a) = (b - a, c - a, point - a);
    let (pp, pq, qq) = (p.length_squared(), p.dot(q), q.length_squared());
    let shares = DVec2::new(from_a.dot(p), from_a.dot(q));
    let area2 = pp * qq - pq * pq;
    let [to_b, to_c] = if area2 > 0.0 {
        [(shares.x * qq - shares.y * pq) / area2, (shares.y * pp - shares.x * pq) / area2]
    } else {
        [1.0 / 3.0; 2]
    };
    let (along_b, along_c) = (at_b - at_a, at_c - at_a);
    let determinant = along_b.perp_dot(along_c);
    let [along_u, along_v] = if determinant == 0.0 {
        [DVec3::ZERO; 2]
    } else {
        [p * along_c.y - q * along_b.y, q * along_b.x - p * along_c.x].map(|v| v / determinant)
    };
    Parametrization { uv: at_a + along_b * to_b + along_c * to_c, along_u, along_v }
}

/// What corners have that have no texture coordinates of their own: 0 0, 1 0 and 0 1.
pub(super) const BARYCENTRIC: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];
