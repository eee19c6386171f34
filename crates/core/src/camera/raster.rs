//! How do the rays of a picture follow from its pixels?

use glam::DVec3;

use crate::Ray;

/// Rays as affine functions of pixels; see [`Camera::raster`](super::Camera::raster).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Raster {
    /// Where every ray starts, or round which.
    pub eye: DVec3,
    /// Direction at the top left corner of the picture.
    pub corner: DVec3,
    /// Change of direction for one pixel to the right.
    pub across: DVec3,
    /// Change of direction for one pixel down.
    pub down: DVec3,
    /// Where rays start.
    pub start: RayStart,
}

/// Where the rays of a picture start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RayStart {
    /// All at the eye.
    Eye,
    /// All over a disk round the eye.
    Lens(Lens),
    /// Each pixel's at a place of its own: they run side by side.
    Window(Window),
}

/// A rectangle round the eye, across the view, with a place for each pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// From the eye to the top left corner of the picture.
    pub corner: DVec3,
    /// What a pixel to the right adds.
    pub across: DVec3,
    /// What a pixel down adds.
    pub down: DVec3,
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
    /// The ray through (x, y), in pixels from the top left corner: from the eye, or where the pixel has its own place.
    #[must_use]
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let direction = affine(self.corner, [self.across, self.down], [x, y]);
        let origin = match &self.start {
            RayStart::Eye | RayStart::Lens(_) => self.eye,
            RayStart::Window(window) => {
                self.eye + affine(window.corner, [window.across, window.down], [x, y])
            }
        };
        Ray::new(origin, direction)
    }

    /// The ray to where that from the eye is sharp, from a point of the lens: so many of its radii to the right and upwards.
    /// Its direction has unit component along the view too. Without a lens, that from the eye.
    #[must_use]
    pub fn ray_from(&self, x: f64, y: f64, [right, up]: [f64; 2]) -> Ray {
        let ray = self.ray(x, y);
        let RayStart::Lens(lens) = self.start else { return ray };
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

/// `corner + x * across + y * down`.
fn affine(corner: DVec3, [across, down]: [DVec3; 2], [x, y]: [f64; 2]) -> DVec3 {
    let along = |corner: f64, across: f64, down: f64| x.mul_add(across, y.mul_add(down, corner));
    DVec3::new(
        along(corner.x, across.x, down.x),
        along(corner.y, across.y, down.y),
        along(corner.z, across.z, down.z),
    )
}
