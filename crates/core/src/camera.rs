//! Where a picture is taken from: a perspective camera, with a pinhole or a thin lens.
//!
//! A thin lens lets light in over a disk; of what lies in its plane of focus each point is seen in one place of the picture
//! from all over the disk (Cook, Porter and Carpenter, "Distributed ray tracing", SIGGRAPH 1984).

use std::f64::consts::PI;

use glam::DVec3;

use crate::part::{Given, LARGEST, degrees};
use crate::{Field, FieldKind, InvalidPart, Kind, Part, Placement, Ray, Value, Values};

/// Perspective camera: every ray starts at the eye, or on a lens round it.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    eye: DVec3,
    aim: Aim,
    up_hint: DVec3,
    fov: f64,
    lens_radius: f64,
    /// As it was given.
    focus: Option<f64>,
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

const LENS_RADIUS: &str = "lens-radius";
const FOCUS: &str = "focus";

impl Default for Camera {
    /// At the origin, looking along −z with y up and a right angle of view.
    fn default() -> Self {
        let (eye, forward, right, up) = (DVec3::ZERO, -DVec3::Z, DVec3::X, DVec3::Y);
        let aim = Aim::Direction(forward);
        Self { eye, aim, up_hint: up, fov: PI / 2.0, lens_radius: 0.0, focus: None, forward, right, up }
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
        let up_hint = up;
        let up = right.cross(forward);
        Ok(Self { eye, aim, up_hint, fov, lens_radius: 0.0, focus: None, forward, right, up })
    }

    /// The same with a lens of that radius in metres (0 for a pinhole), sharp at `focus` metres along the view; without
    /// `focus`, at the target.
    ///
    /// # Errors
    /// A radius that is negative or not finite, a focus that is not greater than 0 or not finite, a lens without focus or
    /// target.
    pub fn with_lens(self, radius: f64, focus: Option<f64>) -> Result<Self, InvalidPart> {
        if !(0.0..=LARGEST).contains(&radius) {
            return Err(InvalidPart::new(LENS_RADIUS, "must be a finite number of at least 0", radius));
        }
        if let Some(focus) = focus.filter(|focus| !(*focus > 0.0 && *focus <= LARGEST)) {
            return Err(InvalidPart::new(FOCUS, "must be a finite number greater than 0", focus));
        }
        let camera = Self { lens_radius: radius, focus, ..self };
        if radius > 0.0 && camera.focus().is_none() {
            return Err(InvalidPart::new(
                FOCUS,
                "must be given beside a lens-radius and a direction",
                "left out",
            )
            .with_hint("write how far away things are sharp, such as focus 5, or give a target"));
        }
        Ok(camera)
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
    pub fn target_distance(&self) -> Option<f64> {
        match self.aim {
            Aim::Target(target) => Some(target.distance(self.eye)),
            Aim::Direction(_) => None,
        }
    }

    /// Radius of the lens, metres; 0 for a pinhole.
    #[must_use]
    pub fn lens_radius(&self) -> f64 {
        self.lens_radius
    }

    /// How far along the view things are sharp, metres: as it was given, or the distance to the target; `None` where neither
    /// is known.
    #[must_use]
    pub fn focus(&self) -> Option<f64> {
        self.focus.or_else(|| self.target_distance())
    }

    /// How far along the view things are sharp, metres, where that was given.
    #[must_use]
    pub fn given_focus(&self) -> Option<f64> {
        self.focus
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
        let camera = Self::new(placement.point(self.eye), aim, placement.direction(up), self.fov)?;
        let scale = placement.scale();
        camera.with_lens(self.lens_radius * scale, self.focus.map(|focus| focus * scale))
    }

    /// How ray directions follow from pixels, in a picture of `width` x `height` pixels:
    /// `corner + x * across + y * down`, with x and y in pixels from the top left corner.
    #[must_use]
    pub fn raster(&self, width: u32, height: u32) -> Raster {
        let pixel = 2.0 * (self.fov / 2.0).tan() / f64::from(height);
        let across = self.right * pixel;
        let down = self.up * -pixel;
        let corner = self.forward - across * (f64::from(width) / 2.0) - down * (f64::from(height) / 2.0);
        let lens = self.focus().filter(|_| self.lens_radius > 0.0).map(|focus| Lens {
            right: self.right * self.lens_radius,
            up: self.up * self.lens_radius,
            inverse_focus: focus.recip(),
        });
        Raster { eye: self.eye, corner, across, down, lens }
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
    /// What rays start on, where that is not the eye alone.
    pub lens: Option<Lens>,
}

/// A disk round the eye, across the view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lens {
    /// From the eye to its rim on the right.
    pub right: DVec3,
    /// From the eye to its upper rim.
    pub up: DVec3,
    /// 1 over the distance along the view at which things are sharp.
    pub inverse_focus: f64,
}

impl Raster {
    /// The ray from the eye through (x, y), in pixels from the top left corner.
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

    /// The ray to where that from the eye is sharp, from a point of the lens: so many of its radii to the right and upwards.
    /// Its direction has unit component along the view too. Without a lens, that from the eye.
    #[must_use]
    pub fn ray_from(&self, x: f64, y: f64, [right, up]: [f64; 2]) -> Ray {
        let ray = self.ray(x, y);
        let Some(lens) = self.lens else { return ray };
        let along = |of_right: f64, of_up: f64| of_right.mul_add(right, of_up * up);
        let aside = DVec3::new(
            along(lens.right.x, lens.up.x),
            along(lens.right.y, lens.up.y),
            along(lens.right.z, lens.up.z),
        );
        let towards = |aside: f64, direction: f64| aside.mul_add(-lens.inverse_focus, direction);
        let direction = DVec3::new(
            towards(aside.x, ray.direction.x),
            towards(aside.y, ray.direction.y),
            towards(aside.z, ray.direction.z),
        );
        Ray::new(self.eye + aside, direction)
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
        Field::required(
            LENS_RADIUS,
            FieldKind::Number,
            "m",
            "Radius of the lens; 0 for a pinhole, which sees all sharp.",
        )
        .or(|| Value::Number(0.0)),
        Field::required(FOCUS, FieldKind::Length, "m", "How far along the view things are sharp.").optional(),
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
        let focus = given.has(FOCUS).then(|| given.positive(FOCUS)).transpose()?;
        Self::new(given.point("eye")?, aim, given.direction("up")?, given.number("fov")?)?
            .with_lens(given.not_negative(LENS_RADIUS)?, focus)
    }

    fn values(&self) -> Values {
        let values = Values::new().with("eye", Value::Vector(self.eye));
        let values = match self.aim {
            Aim::Target(target) => values.with("target", Value::Vector(target)),
            Aim::Direction(direction) => values.with("direction", Value::Vector(direction)),
        };
        let values = values.with("up", Value::Vector(self.up_hint)).with("fov", Value::Number(self.fov));
        let values = values.with(LENS_RADIUS, Value::Number(self.lens_radius));
        match self.focus {
            Some(focus) => values.with(FOCUS, Value::Number(focus)),
            None => values,
        }
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
    fn rays_from_all_over_a_lens_meet_where_things_are_sharp() {
        let camera = seed().with_lens(0.25, Some(3.0)).unwrap();
        let raster = camera.raster(40, 30);
        for (x, y) in [(20.0, 15.0), (0.5, 29.5), (33.0, 2.25)] {
            let sharp = raster.ray(x, y).at(3.0);
            for (right, up) in [(0.0, 0.0), (1.0, 0.0), (0.0, -1.0), (-0.6, 0.8)] {
                let ray = raster.ray_from(x, y, [right, up]);
                assert!((ray.at(3.0) - sharp).length() < 1e-12, "{x} {y} {right} {up}");
                let from = ray.origin - camera.eye();
                assert!((from - (camera.right() * right + camera.up() * up) * 0.25).length() < 1e-12);
            }
        }
    }

    #[test]
    fn a_lens_is_sharp_at_the_target_unless_told_otherwise() {
        let camera = Camera::look_at(DVec3::ZERO, DVec3::X * 4.0, DVec3::Y, 1.0).unwrap();
        let lens = |radius, focus| camera.clone().with_lens(radius, focus);
        assert_eq!(lens(0.1, None).unwrap().focus(), Some(4.0));
        assert_eq!(lens(0.1, Some(2.0)).unwrap().focus(), Some(2.0));
        assert_eq!(lens(0.0, None).unwrap().raster(8, 8).lens, None);
        let placement = Placement::IDENTITY.scaled(2.0).unwrap();
        let placed = lens(0.1, Some(2.0)).unwrap().placed(&placement).unwrap();
        assert_eq!((placed.lens_radius(), placed.focus()), (0.2, Some(4.0)));
        for (radius, focus, field) in [
            (-0.1, None, "lens-radius"),
            (f64::NAN, None, "lens-radius"),
            (f64::INFINITY, None, "lens-radius"),
            (0.1, Some(0.0), "focus"),
            (0.1, Some(f64::NAN), "focus"),
        ] {
            assert_eq!(lens(radius, focus).unwrap_err().field(), field, "{radius} {focus:?}");
        }
        assert_eq!(seed().with_lens(0.1, None).unwrap_err().field(), "focus");
        assert!(seed().with_lens(0.0, None).is_ok());
    }

    #[test]
    fn values_make_an_equal_camera() {
        for camera in [seed(), seed().with_lens(0.1, Some(2.0)).unwrap()] {
            assert_eq!((Camera::KIND.make)(&Part::values(&camera)).unwrap(), camera);
        }
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
