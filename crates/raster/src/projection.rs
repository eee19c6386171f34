//! Where does a point of the world stand in the picture, and which part of a line or an area can be seen at all?
//!
//! Everything is clipped in camera space, before the division by depth: against a near plane and against the four
//! sides of the picture with a margin. What lies behind the eye is therefore cut off and never mirrored, and no
//! number that reaches the painter is infinite or far outside the picture.

use catoptra_core::glam::DVec3;
use catoptra_core::{Camera, Extent};

/// Nearest depth drawn, in metres along the camera's forward axis. Far below anything one can aim at, far above the
/// rounding of coordinates within ten thousand kilometres of the eye.
const NEAR: f64 = 1e-3;

/// Parallel lines of sight meet so far behind an orthographic camera, in heights of what it sees: things a thousand heights away
/// are off by a tenth of a pixel in five hundred, and rounding by far less.
const FAR: f64 = 5e6;

/// How far outside the picture lines still run, in pixels, so that their ends and casings never show at its border.
const MARGIN: f64 = 64.0;

/// A camera and the picture it is seen in: from world metres to pixels and back.
///
/// Pixels count from the top left corner of the picture; the centre of the first pixel is (0.5, 0.5). A picture of
/// zero width or height shows nothing: every function here answers `None` or an empty list for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    width: f64,
    height: f64,
    focal: f64,
    /// Metres from the eye to where rays start.
    ahead: f64,
}

/// A point of the world as it stands in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projected {
    /// Pixels from the left border; may lie outside the picture.
    pub x: f64,
    /// Pixels from the top border; may lie outside the picture.
    pub y: f64,
    /// Metres from where the ray through that pixel starts; positive.
    pub distance: f64,
}

/// An end of a clipped line: pixels, and the inverse of the depth, which is linear along the line in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spot {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) inverse_depth: f64,
}

impl Spot {
    /// The spot a fraction `s` of the way, in the picture, from `self` to `end`.
    pub(crate) fn towards(self, end: Spot, s: f64) -> Spot {
        let mix = |a: f64, b: f64| a + (b - a) * s;
        Spot {
            x: mix(self.x, end.x),
            y: mix(self.y, end.y),
            inverse_depth: mix(self.inverse_depth, end.inverse_depth),
        }
    }

    /// Pixels between two spots.
    pub(crate) fn pixels_to(self, other: Spot) -> f64 {
        (other.x - self.x).hypot(other.y - self.y)
    }
}

impl Projection {
    /// The projection of `camera` onto a picture of `width` x `height` pixels.
    pub fn new(camera: &Camera, width: u32, height: u32) -> Self {
        let (width, height) = (f64::from(width), f64::from(height));
        let (ahead, focal) = match camera.extent() {
            Extent::Angle(fov) => (0.0, 0.5 * height / (0.5 * fov).tan()),
            Extent::Height(metres) => (FAR * metres, FAR * height),
        };
        Self {
            eye: camera.eye() - camera.forward() * ahead,
            right: camera.right(),
            up: camera.up(),
            forward: camera.forward(),
            width,
            height,
            focal,
            ahead,
        }
    }

    /// Where all lines of sight meet, in world metres: the eye, or a point far behind an orthographic camera.
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// Where the camera stands.
    pub fn stand(&self) -> DVec3 {
        self.eye + self.forward * self.ahead
    }

    /// Width of the picture in pixels.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Height of the picture in pixels.
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Where `point` stands in the picture; `None` when it is not in front of the eye or not finite.
    pub fn project(&self, point: DVec3) -> Option<Projected> {
        let seen = self.camera_space(point);
        let spot = self.spot(seen)?;
        Some(Projected { x: spot.x, y: spot.y, distance: seen.length() - self.ahead })
    }

    /// Direction of the ray through a pixel, in world space, with a forward component of 1 (not unit length).
    pub fn direction(&self, x: f64, y: f64) -> DVec3 {
        let (across, upward) = self.slopes(x, y);
        self.forward + self.right * across + self.up * upward
    }

    /// The point of the world that stands at a spot of the picture.
    pub(crate) fn point(&self, spot: Spot) -> DVec3 {
        self.eye + self.direction(spot.x, spot.y) / spot.inverse_depth
    }

    /// Metres, across the line of sight, that one pixel spans at `point`; `None` when the point is not in front.
    ///
    /// Marks of a constant size in the picture are measured with this.
    pub fn metres_per_pixel(&self, point: DVec3) -> Option<f64> {
        let seen = self.camera_space(point);
        self.spot(seen).map(|_| seen.z / self.focal)
    }

    /// The part of the segment from `start` to `end` that can be seen, in pixels; `None` when no part can.
    pub(crate) fn segment(&self, start: DVec3, end: DVec3) -> Option<[Spot; 2]> {
        let (start, end) = (self.camera_space(start), self.camera_space(end));
        if !(start.is_finite() && end.is_finite()) {
            return None;
        }
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for side in 0..SIDES {
            let (from, to) = (self.inside(side, start), self.inside(side, end));
            if from < 0.0 && to < 0.0 {
                return None;
            }
            if from < 0.0 {
                first = first.max(from / (from - to));
            } else if to < 0.0 {
                last = last.min(from / (from - to));
            }
        }
        if first > last {
            return None;
        }
        Some([self.spot_within(start.lerp(end, first))?, self.spot_within(start.lerp(end, last))?])
    }

    /// The visible part of a flat convex polygon, as the corners of a polygon in pixels; empty when nothing is seen.
    pub(crate) fn polygon(&self, corners: &[DVec3]) -> Vec<Spot> {
        let mut seen: Vec<DVec3> = corners.iter().map(|&corner| self.camera_space(corner)).collect();
        if !seen.iter().all(|corner| corner.is_finite()) {
            return Vec::new();
        }
        for side in 0..SIDES {
            seen = self.cut(side, &seen);
        }
        seen.into_iter().filter_map(|corner| self.spot_within(corner)).collect()
    }

    /// Metres from where the ray through a spot starts to the point of the world that stands there.
    pub(crate) fn distance(&self, spot: Spot) -> f64 {
        let (across, upward) = self.slopes(spot.x, spot.y);
        // Metres from the eye per metre of depth: 1 in the centre, more towards the corners.
        let slant = (1.0 + across * across + upward * upward).sqrt();
        slant / spot.inverse_depth - self.ahead
    }

    fn slopes(&self, x: f64, y: f64) -> (f64, f64) {
        ((x - 0.5 * self.width) / self.focal, (0.5 * self.height - y) / self.focal)
    }

    fn camera_space(&self, point: DVec3) -> DVec3 {
        let offset = point - self.eye;
        DVec3::new(offset.dot(self.right), offset.dot(self.up), offset.dot(self.forward))
    }

    fn spot(&self, seen: DVec3) -> Option<Spot> {
        // A corner cut at the near plane may be rounded to just before it, hence half of NEAR here.
        if !(seen.z >= self.ahead + 0.5 * NEAR && self.width > 0.0 && self.height > 0.0) {
            return None;
        }
        let spot = Spot {
            x: 0.5 * self.width + self.focal * (seen.x / seen.z),
            y: 0.5 * self.height - self.focal * (seen.y / seen.z),
            inverse_depth: seen.z.recip(),
        };
        (spot.x.is_finite() && spot.y.is_finite() && spot.inverse_depth > 0.0).then_some(spot)
    }

    /// The spot of a point that was clipped. Lines of astronomic length leave rounding errors as large as the picture;
    /// they are held to its margin.
    fn spot_within(&self, seen: DVec3) -> Option<Spot> {
        let spot = self.spot(seen)?;
        let (x, y) =
            (spot.x.clamp(-MARGIN, self.width + MARGIN), spot.y.clamp(-MARGIN, self.height + MARGIN));
        Some(Spot { x, y, ..spot })
    }

    /// How far inside one side of the view a point of camera space lies; negative outside.
    fn inside(&self, side: usize, seen: DVec3) -> f64 {
        let wide = (0.5 * self.width + MARGIN) / self.focal;
        let high = (0.5 * self.height + MARGIN) / self.focal;
        match side {
            0 => seen.z - self.ahead - NEAR,
            1 => wide * seen.z + seen.x,
            2 => wide * seen.z - seen.x,
            3 => high * seen.z + seen.y,
            _ => high * seen.z - seen.y,
        }
    }

    /// Sutherland and Hodgman 1974: the part of a convex polygon inside one side.
    fn cut(&self, side: usize, corners: &[DVec3]) -> Vec<DVec3> {
        let mut kept = Vec::with_capacity(corners.len() + 1);
        for (index, &corner) in corners.iter().enumerate() {
            let next = corners[(index + 1) % corners.len()];
            let (here, there) = (self.inside(side, corner), self.inside(side, next));
            if here >= 0.0 {
                kept.push(corner);
            }
            if (here < 0.0) != (there < 0.0) {
                kept.push(corner.lerp(next, here / (here - there)));
            }
        }
        kept
    }
}

/// The near plane and the four sides of the picture.
const SIDES: usize = 5;

#[cfg(test)]
mod tests {
    use super::*;

    fn tilted() -> Camera {
        Camera::look_at(
            DVec3::new(3.0, -2.0, 7.0),
            DVec3::new(-1.0, 4.0, 0.5),
            DVec3::new(0.3, 1.0, 0.1),
            1.1,
        )
        .unwrap()
    }

    fn ahead() -> Projection {
        let camera = Camera::looking(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 90_f64.to_radians()).unwrap();
        Projection::new(&camera, 200, 100)
    }

    #[test]
    fn the_ray_through_the_projected_pixel_passes_through_the_point() {
        let camera = tilted();
        let view = Projection::new(&camera, 640, 360);
        for number in 0..200 {
            let step = f64::from(number);
            let point = camera.eye()
                + camera.forward() * (0.01 + step * 0.7)
                + camera.right() * (step * 0.37).sin() * step
                + camera.up() * (step * 1.7).cos() * step;
            let seen = view.project(point).unwrap();
            let ray = camera.ray(seen.x, seen.y, 640, 360);
            let met = ray.origin + ray.direction.normalize() * seen.distance;
            assert!(met.distance(point) < 1e-9 * (1.0 + seen.distance), "{point} became {met}");
        }
    }

    #[test]
    fn an_orthographic_picture_is_that_of_parallel_rays() {
        let camera = tilted().with_extent(Extent::Height(4.0)).unwrap();
        let view = Projection::new(&camera, 640, 360);
        assert!(view.stand().distance(camera.eye()) < 1e-8);
        for number in 0..200 {
            let depth = 0.01 + f64::from(number) * 0.7;
            let (x, y) = (f64::from(number * 37 % 640), f64::from(number * 91 % 360));
            let ray = camera.ray(x, y, 640, 360);
            let seen = view.project(ray.at(depth)).unwrap();
            assert!((seen.x - x).hypot(seen.y - y) < 0.01, "{x} {y} at {depth}: {seen:?}");
            assert!((seen.distance - depth).abs() < 1e-5, "{seen:?}");
            assert!((view.metres_per_pixel(ray.at(depth)).unwrap() * 360.0 - 4.0).abs() < 1e-3);
        }
        assert!(view.project(camera.eye() - camera.forward() * 0.01).is_none(), "what is behind is not seen");
        let ends = [camera.eye() - camera.forward(), camera.eye() + camera.forward() * 5.0];
        let [from, to] = view.segment(ends[0], ends[1] + camera.right()).unwrap();
        assert!((view.distance(to) - 5.0).abs() < 1e-5 && view.distance(from).abs() < 2.0 * NEAR);
    }

    #[test]
    fn the_point_of_a_spot_is_where_it_was_seen() {
        let view = Projection::new(&tilted(), 640, 360);
        let ends = [tilted().eye() + tilted().forward() * 2.0, tilted().eye() + tilted().forward() * 5.0];
        let [from, to] = view.segment(ends[0], ends[1] + tilted().right()).unwrap();
        assert!(view.point(from).distance(ends[0]) < 1e-12);
        assert!(view.point(to).distance(ends[1] + tilted().right()) < 1e-12);
    }

    #[test]
    fn the_direction_of_a_pixel_is_that_of_the_camera() {
        let camera = tilted();
        let view = Projection::new(&camera, 640, 360);
        let apart = view.direction(17.0, 300.5) - camera.ray(17.0, 300.5, 640, 360).direction;
        assert!(apart.length() < 1e-12);
    }

    #[test]
    fn nothing_stands_behind_the_eye_or_in_an_empty_picture() {
        assert!(ahead().project(DVec3::Z).is_none());
        assert!(ahead().project(DVec3::ZERO).is_none());
        assert!(ahead().project(DVec3::NAN).is_none());
        let empty = Projection::new(&tilted(), 0, 360);
        assert!(empty.project(DVec3::NEG_Y).is_none());
        assert!(empty.segment(DVec3::ZERO, DVec3::NEG_Y).is_none());
    }

    #[test]
    fn a_segment_past_the_eye_is_cut_and_not_mirrored() {
        let [start, end] = ahead().segment(DVec3::new(0.5, 0.0, -5.0), DVec3::new(0.5, 0.0, 5.0)).unwrap();
        assert!((start.x - 105.0).abs() < 1e-9);
        assert!((end.x - (200.0 + MARGIN)).abs() < 1e-6, "leaves on its own side, at {}", end.x);
    }

    #[test]
    fn a_segment_that_starts_in_the_eye_is_seen_from_the_near_plane_on() {
        let [start, end] = ahead().segment(DVec3::ZERO, DVec3::new(1.0, 0.0, -4.0)).unwrap();
        assert!((start.inverse_depth * NEAR - 1.0).abs() < 1e-9);
        assert!((start.x - end.x).abs() < 1e-6 && (end.x - 112.5).abs() < 1e-9);
    }

    #[test]
    fn a_segment_outside_the_picture_is_not_drawn() {
        assert!(ahead().segment(DVec3::new(90.0, 0.0, -1.0), DVec3::new(50.0, 3.0, -2.0)).is_none());
        assert!(ahead().segment(DVec3::X, DVec3::INFINITY).is_none());
    }

    #[test]
    fn a_huge_polygon_is_cut_to_the_picture() {
        let ground = [(-1e6, -1e6), (1e6, -1e6), (1e6, 1e6), (-1e6, 1e6)];
        let corners = ahead().polygon(&ground.map(|(x, z)| DVec3::new(x, -1.0, z)));
        assert!(corners.len() >= 3);
        for corner in corners {
            assert!(corner.x >= -MARGIN && corner.x <= 200.0 + MARGIN);
            assert!(corner.y >= 50.0 - 1e-3 && corner.y <= 100.0 + MARGIN);
        }
    }

    #[test]
    fn one_pixel_spans_what_the_projection_says() {
        let point = DVec3::new(0.0, 0.0, -7.0);
        let pixel = ahead().metres_per_pixel(point).unwrap();
        let seen = ahead().project(point + DVec3::X * pixel).unwrap();
        assert!((seen.x - 101.0).abs() < 1e-9);
    }
}
