//! How do things in space appear in the picture? Outlines of segments, balls and circles as seen from an eye, directly or in
//! plane mirrors.
//!
//! A direction d = corner + x across + y down is linear in the place (x, y). What is straight and what is round in space is
//! an equation of degree one or two for d, and so for the place.

use catoptra_core::Raster;
use catoptra_core::glam::{DMat3, DVec3};

use super::form::Form;
use crate::numeric::NEAREST_SHARE;

/// An eye and its picture: the camera's, or its image behind plane mirrors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sight {
    pub(crate) eye: DVec3,
    /// Directions at the picture's corner, and what a pixel to the right and down adds.
    axes: DMat3,
    /// From directions to places in the picture: across, down, depth.
    places: DMat3,
}

/// An outline, and the part of the picture it lies in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Outline {
    pub(crate) form: Form,
    /// Left, top, right, bottom.
    pub(crate) bounds: [f64; 4],
}

/// The whole plane of the picture.
pub(crate) const EVERYWHERE: [f64; 4] = [f64::NEG_INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY];

/// What two parts of the picture have in common.
pub(crate) fn common(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [a[0].max(b[0]), a[1].max(b[1]), a[2].min(b[2]), a[3].min(b[3])]
}

impl Sight {
    pub(crate) fn new(raster: &Raster) -> Self {
        Self::of(raster.eye, DMat3::from_cols(raster.across, raster.down, raster.corner))
    }

    fn of(eye: DVec3, axes: DMat3) -> Self {
        Self { eye, axes, places: axes.inverse() }
    }

    /// What is seen in a mirror of unit normal `normal` through `point`.
    pub(crate) fn mirrored(&self, normal: DVec3, point: DVec3) -> Self {
        let mirrored = |v: DVec3| v - normal * (2.0 * v.dot(normal));
        let axes = DMat3::from_cols(
            mirrored(self.axes.x_axis),
            mirrored(self.axes.y_axis),
            mirrored(self.axes.z_axis),
        );
        Self::of(point + mirrored(self.eye - point), axes)
    }

    /// Coefficients of normal · d.
    pub(crate) fn linear(&self, normal: DVec3) -> [f64; 3] {
        [normal.dot(self.axes.x_axis), normal.dot(self.axes.y_axis), normal.dot(self.axes.z_axis)]
    }

    /// The directions across a normal: a horizon, or an edge together with the eye.
    pub(crate) fn across(&self, normal: DVec3) -> Form {
        Form::line(self.linear(normal))
    }

    /// dᵀ Q d.
    pub(crate) fn quadratic(&self, q: &DMat3) -> Form {
        let [x, y, one] = [self.axes.x_axis, self.axes.y_axis, self.axes.z_axis];
        let [qx, qy, q1] = [*q * x, *q * y, *q * one];
        Form {
            xx: x.dot(qx),
            xy: 2.0 * x.dot(qy),
            yy: y.dot(qy),
            x: 2.0 * x.dot(q1),
            y: 2.0 * y.dot(q1),
            one: one.dot(q1),
        }
    }

    /// Where a point is seen, and how deep it lies in units of the picture's directions.
    fn place(&self, point: DVec3) -> DVec3 {
        self.places * (point - self.eye)
    }

    /// The outline of a segment; `None` where it lies behind the eye or is seen end on.
    pub(crate) fn segment(&self, [from, to]: [DVec3; 2]) -> Option<Outline> {
        let ends = [self.place(from), self.place(to)];
        let deepest = ends[0].z.max(ends[1].z);
        let least = deepest * NEAREST_SHARE;
        if !(least > 0.0) {
            return None;
        }
        let normal = (from - self.eye).cross(to - self.eye);
        let [a, b] = [(ends[0], ends[1]), (ends[1], ends[0])].map(|(end, other)| {
            let end = if end.z >= least {
                end
            } else {
                end + (other - end) * ((least - end.z) / (other.z - end.z))
            };
            [end.x / end.z, end.y / end.z]
        });
        let bounds = [a[0].min(b[0]), a[1].min(b[1]), a[0].max(b[0]), a[1].max(b[1])];
        Some(Outline { form: self.across(normal), bounds })
    }

    /// The outline of a line through a point that has no end.
    pub(crate) fn line(&self, point: DVec3, along: DVec3) -> Outline {
        Outline { form: self.across((point - self.eye).cross(along)), bounds: EVERYWHERE }
    }

    /// An outline given by dᵀ Q d, of something within a ball.
    pub(crate) fn conic(&self, q: &DMat3, center: DVec3, radius: f64) -> Option<Outline> {
        let form = self.quadratic(q);
        let bounds = self.bounds_of_ball(center, radius)?;
        let ellipse = form.ellipse_bounds().unwrap_or(EVERYWHERE);
        let bounds = if bounds == EVERYWHERE { EVERYWHERE } else { ellipse };
        Some(Outline { form, bounds })
    }

    /// What part of the picture a ball is seen in; `None` for one behind the eye, everything where it reaches to the eye's
    /// own plane.
    pub(crate) fn bounds_of_ball(&self, center: DVec3, radius: f64) -> Option<[f64; 4]> {
        // Depth along the picture's axis, and how much of it a metre can be.
        let (depth, most) = (self.place(center).z, radius * self.depth_of_a_metre());
        if depth + most <= 0.0 {
            return None;
        }
        if depth - most <= 0.0 {
            return Some(EVERYWHERE);
        }
        let bounds = self.quadratic(&silhouette(center - self.eye, radius)).ellipse_bounds();
        Some(bounds.unwrap_or(EVERYWHERE))
    }

    fn depth_of_a_metre(&self) -> f64 {
        let places = self.places.transpose();
        places.z_axis.length()
    }
}

/// The cone round a ball, relative to its apex: (c·d)² − d² (c² − r²) is zero where d touches the ball.
pub(crate) fn silhouette(center: DVec3, radius: f64) -> DMat3 {
    outer(center, center) - DMat3::from_diagonal(DVec3::splat(center.length_squared() - radius * radius))
}

/// The cone over the circle in which the plane p·v = k cuts a ball, relative to its apex: with v = d k / (p·d),
/// k² d² − 2k (p·d) (c·d) + (c² − r²) (p·d)² is zero where d meets the circle.
pub(crate) fn circle(normal: DVec3, offset: f64, center: DVec3, radius: f64) -> DMat3 {
    let both = outer(normal, center) + outer(center, normal);
    DMat3::from_diagonal(DVec3::splat(offset * offset)) - both * offset
        + outer(normal, normal) * (center.length_squared() - radius * radius)
}

/// a bᵀ.
pub(crate) fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn sight() -> Sight {
        Sight::new(&Raster {
            eye: DVec3::new(0.3, 1.2, 5.0),
            corner: DVec3::new(-0.5, 0.4, -1.0),
            across: DVec3::new(0.01, 0.0, 0.0004),
            down: DVec3::new(0.0002, -0.01, 0.0),
            start: catoptra_core::RayStart::Eye,
        })
    }

    /// How far off the outline a point is seen, in pixels.
    fn off(sight: &Sight, outline: &Outline, point: DVec3) -> f64 {
        let place = sight.place(point);
        let square = super::super::form::Square { x: place.x / place.z, y: place.y / place.z, half: 1.0 };
        let form = outline.form.within(square);
        form.one.abs() / form.x.hypot(form.y)
    }

    fn random_vector(random: &mut Random) -> DVec3 {
        DVec3::new(random.number(), random.number(), random.number())
    }

    #[test]
    fn points_of_segments_circles_and_silhouettes_lie_on_their_outlines() {
        let (sight, mut random) = (sight(), Random(4));
        for _ in 0..300 {
            let [a, b] = [random_vector(&mut random), random_vector(&mut random)];
            let segment = sight.segment([a, b]).unwrap();
            assert!(off(&sight, &segment, a + (b - a) * 0.3) < 1e-9);
            let (normal, radius) = (b.normalize(), 0.2 + random.number().abs());
            let side = normal.any_orthonormal_vector();
            let q = circle(normal, normal.dot(a - sight.eye), a - sight.eye, radius);
            let rim = sight.conic(&q, a, radius).unwrap();
            assert!(off(&sight, &rim, a + side * radius) < 1e-6);
            // A point where a line through the eye touches the ball.
            let to_eye = sight.eye - a;
            let share = radius * radius / to_eye.length_squared();
            let aside = to_eye.normalize().any_orthonormal_vector() * (radius * (1.0 - share).sqrt());
            let silhouette = sight.conic(&silhouette(-to_eye, radius), a, radius).unwrap();
            assert!(off(&sight, &silhouette, a + to_eye * share + aside) < 1e-6);
        }
    }

    #[test]
    fn a_mirror_shows_points_where_their_images_are_seen() {
        let (sight, mut random) = (sight(), Random(8));
        for _ in 0..100 {
            let [point, on, normal] = [(); 3].map(|()| random_vector(&mut random));
            let normal = normal.normalize();
            let image = point - normal * (2.0 * normal.dot(point - on));
            let [seen, direct] = [sight.mirrored(normal, on).place(point), sight.place(image)];
            assert!((seen - direct).length() < 1e-9 * (1.0 + direct.length()), "{seen} {direct}");
        }
    }

    #[test]
    fn what_lies_behind_the_eye_has_no_outline() {
        let sight = sight();
        assert!(sight.segment([DVec3::new(0.0, 1.0, 7.0), DVec3::new(1.0, 1.0, 6.0)]).is_none());
        assert!(sight.bounds_of_ball(DVec3::new(0.0, 1.0, 9.0), 1.0).is_none());
        assert_eq!(sight.bounds_of_ball(sight.eye, 1.0), Some(EVERYWHERE));
    }
}
