//! Where do new things go, and how large are they? On the surface that is seen at a point of the picture, or as far away as
//! one looks; as large as a share of the picture there.

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Placement};

use crate::camera_control;
use crate::viewer::Viewer;

/// The share of the picture's height that a new thing takes.
const SHARE: f64 = 0.2;

/// How far over a surface a new light hangs, in sizes of new things.
const OVER: f64 = 3.0;

/// A place for something new.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spot {
    /// In the world.
    pub(crate) point: DVec3,
    /// Away from the surface there, a unit vector.
    pub(crate) up: DVec3,
    /// How large a new thing is there, in metres.
    pub(crate) size: f64,
}

/// The place that is seen at a point of the picture, in pixels; in the middle without one.
pub(crate) fn spot(viewer: &Viewer, at: Option<(f64, f64)>) -> Spot {
    let (width, height) = viewer.size;
    let (x, y) = at.unwrap_or((f64::from(width) / 2.0, f64::from(height) / 2.0));
    let ray = |x: f64, y: f64| viewer.camera.ray(x, y, width.max(1), height.max(1));
    let seen = ray(x, y);
    let (point, up) = match viewer.pick(x, y) {
        Some(hit) => (hit.point, hit.normal),
        None => (seen.at(camera_control::focus(&viewer.camera)), DVec3::Y),
    };
    // One more pixel, as far away.
    let beside = ray(x + 1.0, y);
    let along = (point - seen.origin).dot(seen.direction) / seen.direction.length_squared();
    let pixel = beside.at(along).distance(seen.at(along));
    let size = tidy(SHARE * f64::from(height.max(1)) * pixel);
    Spot { point, up, size }
}

/// A number with one digit: 1, 2 or 5 times a power of ten, not larger than `size`.
fn tidy(size: f64) -> f64 {
    if !(size.is_finite() && size > 0.0) {
        return 1.0;
    }
    let ten = 10_f64.powf(size.log10().floor());
    match size / ten {
        digit if digit >= 5.0 => 5.0 * ten,
        digit if digit >= 2.0 => 2.0 * ten,
        _ => ten,
    }
}

impl Spot {
    /// How something of those bounds is moved to stand there.
    pub(crate) fn stand(&self, bounds: &Aabb) -> Placement {
        let half = 0.5 * bounds.size();
        let lift = self.up.abs().dot(half);
        self.moved(self.point + self.up * lift - bounds.centre())
    }

    /// How something about the origin is moved to hang over it.
    pub(crate) fn hang(&self) -> Placement {
        let up = if self.up.y < -0.5 { self.up } else { DVec3::Y };
        self.moved(self.point + up * OVER * self.size)
    }

    /// A move, to about a thousandth of the size.
    fn moved(&self, by: DVec3) -> Placement {
        let step = tidy(self.size) * 1e-3;
        let rounded = (by / step).round() * step;
        let tidy = rounded.to_array().map(|v| format!("{v:.9}").parse().unwrap_or(v));
        Placement::IDENTITY.moved(DVec3::from_array(tidy)).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_one_digit() {
        for (size, tidied) in
            [(0.37, 0.2), (0.99, 0.5), (1.0, 1.0), (730.0, 500.0), (0.0, 1.0), (f64::NAN, 1.0)]
        {
            assert!((tidy(size) - tidied).abs() < 1e-12 * tidied, "{size}");
        }
    }

    #[test]
    fn things_stand_on_floors_and_touch_walls() {
        let bounds = Aabb { min: DVec3::new(-1.0, 0.0, -1.0), max: DVec3::new(1.0, 3.0, 1.0) };
        let spot = |up| Spot { point: DVec3::new(5.0, 1.0, 2.0), up, size: 1.0 };
        assert_eq!(spot(DVec3::Y).stand(&bounds).translation(), DVec3::new(5.0, 1.0, 2.0));
        assert_eq!(spot(DVec3::X).stand(&bounds).translation(), DVec3::new(6.0, -0.5, 2.0));
        assert_eq!(spot(DVec3::X).hang().translation(), DVec3::new(5.0, 4.0, 2.0));
        assert_eq!(spot(DVec3::NEG_Y).hang().translation(), DVec3::new(5.0, -2.0, 2.0));
    }
}
