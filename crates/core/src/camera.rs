//! Where a picture is taken from: a perspective camera.

use std::f64::consts::PI;

use glam::DVec3;

use crate::part::{Given, degrees};
use crate::{Field, FieldKind, InvalidPart, Kind, Part, Placement, Ray, Value, Values};

/// Perspective camera: every ray starts at the eye.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    eye: DVec3,
    aim: Aim,
    up_hint: DVec3,
    fov: f64,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
}

/// What a camera looks at, as it was given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Aim {
    /// A point, metres.
    Target(DVec3),
    /// A direction of any length.
    Direction(DVec3),
}

impl Default for Camera {
    /// At the origin, looking along −z with y up and a right angle of view.
    fn default() -> Self {
        let (eye, forward, right, up) = (DVec3::ZERO, -DVec3::Z, DVec3::X, DVec3::Y);
        Self { eye, aim: Aim::Direction(forward), up_hint: up, fov: PI / 2.0, forward, right, up }
    }
}

impl Camera {
    /// What a camera is made of.
    pub const KIND: &'static Kind<Self> =
        &Kind { name: Self::NAME, doc: Self::DOC, fields: Self::FIELDS, make: crate::part::make::<Self> };

    /// From `eye` towards the point `target`, `up` roughly upwards, with a vertical field of view in radians.
    ///
    /// # Errors
    /// Anything not finite, target at the eye, `up` along the view, a field of view outside 0..π.
    pub fn look_at(eye: DVec3, target: DVec3, up: DVec3, fov: f64) -> Result<Self, InvalidPart> {
        Self::new(eye, Aim::Target(target), up, fov)
    }

    /// From `eye` along `direction`; otherwise as [`look_at`](Self::look_at).
    ///
    /// # Errors
    /// As [`look_at`](Self::look_at).
    pub fn looking(eye: DVec3, direction: DVec3, up: DVec3, fov: f64) -> Result<Self, InvalidPart> {
        Self::new(eye, Aim::Direction(direction), up, fov)
    }

    /// As [`look_at`](Self::look_at) or [`looking`](Self::looking).
    ///
    /// # Errors
    /// As [`look_at`](Self::look_at).
    pub fn new(eye: DVec3, aim: Aim, up: DVec3, fov: f64) -> Result<Self, InvalidPart> {
        let (field, along) = match aim {
            Aim::Target(target) => ("target", target - eye),
            Aim::Direction(direction) => ("direction", direction),
        };
        if !eye.is_finite() {
            return Err(InvalidPart::new("eye", "must be three finite numbers", eye));
        }
        let Some(forward) = along.try_normalize() else {
            return Err(InvalidPart::new(field, "must lie in a direction from the eye", along));
        };
        let across = upwards(forward, up);
        let Some(right) = across.try_normalize().and_then(|up| forward.cross(up).try_normalize()) else {
            return Err(InvalidPart::new("up", "must not be zero or along the view", up)
                .with_hint("leave up away, or write one across the view, such as up 0 1 0"));
        };
        if !(fov > 0.0 && fov < PI) {
            return Err(InvalidPart::new("fov", "must lie between 0 and 180 degrees", degrees(fov)));
        }
        Ok(Self { eye, aim, up_hint: up, fov, forward, right, up: right.cross(forward) })
    }

    /// Its position.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// What it looks at, as it was given.
    #[must_use]
    pub fn aim(&self) -> Aim {
        self.aim
    }

    /// Unit vector along the view.
    #[must_use]
    pub fn forward(&self) -> DVec3 {
        self.forward
    }

    /// Unit vector to the right of the picture.
    #[must_use]
    pub fn right(&self) -> DVec3 {
        self.right
    }

    /// Unit vector to the top of the picture.
    #[must_use]
    pub fn up(&self) -> DVec3 {
        self.up
    }

    /// The direction that was given as upwards; not perpendicular to the view in general.
    #[must_use]
    pub fn up_hint(&self) -> DVec3 {
        self.up_hint
    }

    /// Vertical field of view, radians.
    #[must_use]
    pub fn fov(&self) -> f64 {
        self.fov
    }

    /// Distance to the target; `None` where only a direction was given.
    #[must_use]
    pub fn focus(&self) -> Option<f64> {
        match self.aim {
            Aim::Target(target) => Some(target.distance(self.eye)),
            Aim::Direction(_) => None,
        }
    }

    /// The same camera standing elsewhere, looking at what has moved with it.
    ///
    /// # Errors
    /// Coordinates that overflow.
    pub fn placed(&self, placement: &Placement) -> Result<Self, InvalidPart> {
        let aim = match self.aim {
            Aim::Target(target) => Aim::Target(placement.point(target)),
            Aim::Direction(direction) => Aim::Direction(placement.direction(direction)),
        };
        let up = upwards(self.forward, self.up_hint);
        Self::new(placement.point(self.eye), aim, placement.direction(up), self.fov)
    }

    /// How ray directions follow from pixels, in a picture of `width` x `height` pixels:
    /// `corner + x * across + y * down`, with x and y in pixels from the top left corner.
    #[must_use]
    pub fn raster(&self, width: u32, height: u32) -> Raster {
        let pixel = 2.0 * (self.fov / 2.0).tan() / f64::from(height);
        let across = self.right * pixel;
        let down = self.up * -pixel;
        let corner = self.forward - across * (f64::from(width) / 2.0) - down * (f64::from(height) / 2.0);
        Raster { eye: self.eye, corner, across, down }
    }

    /// The ray through the point (x, y) of a picture, in pixels from the top left corner; the middle of the first
    /// pixel is (0.5, 0.5). Its direction has unit component along the view, so `t` is depth.
    #[must_use]
    pub fn ray(&self, x: f64, y: f64, width: u32, height: u32) -> Ray {
        self.raster(width, height).ray(x, y)
    }
}

/// What is used as `up` in a view along `forward`: itself, but where the view goes straight down or up the y axis and
/// `up` is that axis, the direction that a camera which looks along −z has upwards when it is tilted there.
fn upwards(forward: DVec3, up: DVec3) -> DVec3 {
    let along_y = |v: DVec3| v.x == 0.0 && v.z == 0.0;
    if along_y(forward) && along_y(up) && up.y > 0.0 { DVec3::Z * forward.y.signum() } else { up }
}

/// Ray directions as an affine function of pixels; see [`Camera::raster`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Raster {
    /// Where every ray starts.
    pub eye: DVec3,
    /// Direction at the top left corner of the picture.
    pub corner: DVec3,
    /// Change of direction for one pixel to the right.
    pub across: DVec3,
    /// Change of direction for one pixel down.
    pub down: DVec3,
}

impl Raster {
    /// The ray through (x, y), in pixels from the top left corner.
    #[must_use]
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let along = |corner: f64, across: f64, down: f64| x.mul_add(across, y.mul_add(down, corner));
        let direction = DVec3::new(
            along(self.corner.x, self.across.x, self.down.x),
            along(self.corner.y, self.across.y, self.down.y),
            along(self.corner.z, self.across.z, self.down.z),
        );
        Ray::new(self.eye, direction)
    }
}

impl Part for Camera {
    const NAME: &'static str = "camera";
    const DOC: &'static str = "A perspective camera.";
    const FIELDS: &'static [Field] = &[
        Field::required("eye", FieldKind::Point, "m", "Where the camera stands."),
        Field::required("target", FieldKind::Point, "m", "The point it looks at; give this or direction.")
            .optional(),
        Field::required("direction", FieldKind::Direction, "", "The way it looks; give this or target.")
            .optional(),
        Field::required("up", FieldKind::Direction, "", "Roughly upwards in the picture.")
            .or(|| Value::Vector(DVec3::Y)),
        Field::required("fov", FieldKind::Angle, "°", "Field of view from the lower to the upper edge.")
            .or(|| Value::Number(PI / 4.0)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let aim = match (given.has("target"), given.has("direction")) {
            (true, false) => Aim::Target(given.point("target")?),
            (false, true) => Aim::Direction(given.direction("direction")?),
            (true, true) => {
                return Err(InvalidPart::new("direction", "must not be given beside target", "given"));
            }
            (false, false) => {
                return Err(InvalidPart::new("target", "must be given, or direction", "missing"));
            }
        };
        Self::new(given.point("eye")?, aim, given.direction("up")?, given.number("fov")?)
    }

    fn values(&self) -> Values {
        let values = Values::new().with("eye", Value::Vector(self.eye));
        let values = match self.aim {
            Aim::Target(target) => values.with("target", Value::Vector(target)),
            Aim::Direction(direction) => values.with("direction", Value::Vector(direction)),
        };
        values.with("up", Value::Vector(self.up_hint)).with("fov", Value::Number(self.fov))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seed() -> Camera {
        Camera::looking(DVec3::new(0.0, 10.0, 10.0), -DVec3::Z, DVec3::Y, PI / 2.0).unwrap()
    }

    #[test]
    fn the_middle_ray_looks_forward_and_corners_span_the_field_of_view() {
        let middle = seed().ray(225.0, 225.0, 450, 450);
        assert!((middle.direction + DVec3::Z).length() < 1e-12);
        let corner = seed().ray(0.0, 0.0, 450, 450);
        assert!((corner.direction - DVec3::new(-1.0, 1.0, -1.0)).length() < 1e-12);
    }

    #[test]
    fn a_wide_picture_keeps_its_vertical_field_of_view() {
        let top = seed().ray(800.0, 0.0, 1600, 900);
        assert!((top.direction - DVec3::new(0.0, 1.0, -1.0)).length() < 1e-12);
    }

    #[test]
    fn straight_down_the_far_side_is_at_the_top() {
        let seen = |direction: DVec3| Camera::looking(DVec3::ZERO, direction, DVec3::Y, 1.0).unwrap();
        let down = seen(-DVec3::Y * 3.0);
        assert_eq!((down.up(), down.right(), down.up_hint()), (-DVec3::Z, DVec3::X, DVec3::Y));
        assert_eq!((seen(DVec3::Y).up(), seen(DVec3::Y).right()), (DVec3::Z, DVec3::X));
        // What turns with a group keeps it.
        let turned = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::X, 0.3).unwrap();
        let up = down.placed(&turned).unwrap().up();
        assert!((up - turned.direction(-DVec3::Z)).length() < 1e-12, "{up}");
    }

    #[test]
    fn impossible_views_are_refused() {
        let refused = |aim, up, fov| Camera::new(DVec3::ZERO, aim, up, fov).unwrap_err().field();
        assert_eq!(refused(Aim::Target(DVec3::ZERO), DVec3::Y, 1.0), "target");
        assert_eq!(refused(Aim::Direction(DVec3::Z), DVec3::Z, 1.0), "up");
        assert_eq!(refused(Aim::Direction(DVec3::Y), -DVec3::Y, 1.0), "up");
        assert_eq!(refused(Aim::Direction(DVec3::X), DVec3::Y, PI), "fov");
        assert_eq!(refused(Aim::Direction(DVec3::X), DVec3::Y, f64::NAN), "fov");
    }
}
