//! Where a picture is taken from: a perspective camera, with a pinhole or a thin lens, or an orthographic one.
//!
//! A thin lens lets light in over a disk; of what lies in its plane of focus each point is seen in one place of the picture
//! from all over the disk (Cook, Porter and Carpenter, "Distributed ray tracing", SIGGRAPH 1984).

mod part;
mod raster;

use std::f64::consts::PI;

pub use raster::{Lens, Raster, RayStart, Window};

use glam::DVec3;

use crate::part::{LARGEST, degrees};
use crate::{InvalidPart, Kind, Part, Placement, Ray};
use part::{FOCUS, FOV, HEIGHT, LENS_RADIUS};

/// A camera: every ray starts at the eye, on a lens round it or, for parallel rays, on the plane through it across the view.
///
/// ```
/// use catoptra_core::{Camera, glam::DVec3};
///
/// let camera = Camera::look_at(DVec3::new(0.0, 2.0, 6.0), DVec3::Y, DVec3::Y, 40.0_f64.to_radians())?;
/// // Through the middle of a picture of 640 x 480 pixels it looks at its target.
/// let ray = camera.ray(320.0, 240.0, 640, 480);
/// assert!((ray.direction.normalize() - (DVec3::Y - ray.origin).normalize()).length() < 1e-12);
/// # Ok::<(), catoptra_core::InvalidPart>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    eye: DVec3,
    aim: Aim,
    up_hint: DVec3,
    extent: Extent,
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

/// How much a camera sees from the lower to the upper edge of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extent {
    /// Perspective: an angle, radians.
    Angle(f64),
    /// Orthographic: metres, as far away as it may be.
    Height(f64),
}

impl Default for Camera {
    /// At the origin, looking along −z with y up and a right angle of view.
    fn default() -> Self {
        let (eye, forward, right, up) = (DVec3::ZERO, -DVec3::Z, DVec3::X, DVec3::Y);
        let aim = Aim::Direction(forward);
        let extent = Extent::Angle(PI / 2.0);
        Self { eye, aim, up_hint: up, extent, lens_radius: 0.0, focus: None, forward, right, up }
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
        let up_hint = up;
        let up = right.cross(forward);
        // Replaced at once by what is given.
        let extent = Extent::Angle(PI / 2.0);
        let camera = Self { eye, aim, up_hint, extent, lens_radius: 0.0, focus: None, forward, right, up };
        camera.with_extent(Extent::Angle(fov))
    }

    /// The same, seeing so much. What is orthographic has no lens.
    ///
    /// # Errors
    /// A field of view outside 0..π, a height that is not greater than 0 or not finite, or one beside a lens.
    pub fn with_extent(self, extent: Extent) -> Result<Self, InvalidPart> {
        match extent {
            Extent::Angle(fov) if !(fov > 0.0 && fov < PI) => {
                Err(InvalidPart::new(FOV, "must lie between 0 and 180 degrees", degrees(fov)))
            }
            Extent::Height(height) if !(height > 0.0 && height <= LARGEST) => {
                Err(InvalidPart::new(HEIGHT, "must be a finite number greater than 0", height))
            }
            Extent::Height(_) if self.lens_radius > 0.0 => Err(lens_beside_parallel(self.lens_radius)),
            extent => Ok(Self { extent, ..self }),
        }
    }

    /// The same with a lens of that radius in metres (0 for a pinhole), sharp at `focus` metres along the view; without
    /// `focus`, at the target.
    ///
    /// # Errors
    /// A radius that is negative or not finite, a focus that is not greater than 0 or not finite, a lens without focus or
    /// target, or of a camera that is orthographic.
    pub fn with_lens(self, radius: f64, focus: Option<f64>) -> Result<Self, InvalidPart> {
        if !(0.0..=LARGEST).contains(&radius) {
            return Err(InvalidPart::new(LENS_RADIUS, "must be a finite number of at least 0", radius));
        }
        if let Some(focus) = focus.filter(|focus| !(*focus > 0.0 && *focus <= LARGEST)) {
            return Err(InvalidPart::new(FOCUS, "must be a finite number greater than 0", focus));
        }
        if radius > 0.0 && self.is_orthographic() {
            return Err(lens_beside_parallel(radius));
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

    /// How much it sees from the lower to the upper edge of a picture.
    #[must_use]
    pub fn extent(&self) -> Extent {
        self.extent
    }

    /// Whether its rays are parallel.
    #[must_use]
    pub fn is_orthographic(&self) -> bool {
        matches!(self.extent, Extent::Height(_))
    }

    /// Vertical field of view, radians; of an orthographic camera that of a perspective one which sees as much where that is
    /// sharp, or as far away as its height if that is not known.
    #[must_use]
    pub fn fov(&self) -> f64 {
        match self.extent {
            Extent::Angle(fov) => fov,
            Extent::Height(height) => 2.0 * (height / 2.0 / self.focus().unwrap_or(height)).atan(),
        }
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
        let scale = placement.scale();
        let extent = match self.extent {
            Extent::Angle(fov) => Extent::Angle(fov),
            Extent::Height(height) => Extent::Height(height * scale),
        };
        let camera = Self::new(placement.point(self.eye), aim, placement.direction(up), PI / 2.0)?;
        let camera = camera.with_extent(extent)?;
        camera.with_lens(self.lens_radius * scale, self.focus.map(|focus| focus * scale))
    }

    /// How rays follow from pixels, in a picture of `width` x `height` pixels: directions are
    /// `corner + x * across + y * down`, with x and y in pixels from the top left corner.
    #[must_use]
    pub fn raster(&self, width: u32, height: u32) -> Raster {
        let of_picture = match self.extent {
            Extent::Angle(fov) => 2.0 * (fov / 2.0).tan(),
            Extent::Height(metres) => metres,
        };
        let pixel = of_picture / f64::from(height);
        let across = self.right * pixel;
        let down = self.up * -pixel;
        let to_corner = across * (f64::from(width) / 2.0) + down * (f64::from(height) / 2.0);
        if self.is_orthographic() {
            let start = RayStart::Window(Window { corner: -to_corner, across, down });
            let still = DVec3::ZERO;
            return Raster { eye: self.eye, corner: self.forward, across: still, down: still, start };
        }
        let corner = self.forward - across * (f64::from(width) / 2.0) - down * (f64::from(height) / 2.0);
        let lens = self.focus().filter(|_| self.lens_radius > 0.0).map(|focus| Lens {
            right: self.right * self.lens_radius,
            up: self.up * self.lens_radius,
            inverse_focus: focus.recip(),
        });
        Raster { eye: self.eye, corner, across, down, start: lens.map_or(RayStart::Eye, RayStart::Lens) }
    }

    /// The ray through the point (x, y) of a picture, in pixels from the top left corner; the middle of the first
    /// pixel is (0.5, 0.5). Its direction has unit component along the view, so `t` is depth.
    #[must_use]
    pub fn ray(&self, x: f64, y: f64, width: u32, height: u32) -> Ray {
        self.raster(width, height).ray(x, y)
    }
}

fn lens_beside_parallel(radius: f64) -> InvalidPart {
    InvalidPart::new(LENS_RADIUS, "must be 0 where the projection is orthographic", radius)
        .with_hint("rays that run side by side meet in no point of a lens: leave lens-radius away")
}

/// What is used as `up` in a view along `forward`: itself, but where the view goes straight down or up the y axis and
/// `up` is that axis, the direction that a camera which looks along −z has upwards when it is tilted there.
fn upwards(forward: DVec3, up: DVec3) -> DVec3 {
    let along_y = |v: DVec3| v.x == 0.0 && v.z == 0.0;
    if along_y(forward) && along_y(up) && up.y > 0.0 { DVec3::Z * forward.y.signum() } else { up }
}

#[cfg(test)]
mod tests;
