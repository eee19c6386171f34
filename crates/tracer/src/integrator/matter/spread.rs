//! Over which part of a surface is what a ray shows to be averaged?

use catoptra_core::glam::DVec3;
use catoptra_core::{Raster, Ray, RayStart};

/// How far the rays beside a ray lie from it: those of the pixels to the right and below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Spread {
    /// A camera ray: what the pixels beside add to its direction.
    Pixel([DVec3; 2]),
    /// A camera ray among parallel ones: how far from its start those of the pixels beside start, metres.
    Parallel([DVec3; 2]),
    /// After a bounce, a cone (Akenine-Möller and others, "Texture level of detail strategies for real-time ray tracing", Ray
    /// Tracing Gems, 2019): metres across at its start, and what each metre of the way adds.
    Cone { width: f64, growth: f64 },
}

impl Spread {
    /// Of a camera ray that stands for a square of the picture of that side, in pixels.
    pub(super) fn of_pixel(raster: &Raster, side: f64) -> Self {
        match raster.start {
            RayStart::Eye | RayStart::Lens(_) => {
                Self::Pixel([raster.across, raster.down].map(|way| way * side))
            }
            RayStart::Window(window) => Self::Parallel([window.across, window.down].map(|way| way * side)),
        }
    }

    /// How far the points beside lie from where a ray meets a surface that is as good as flat, metres.
    pub(super) fn on_surface(&self, ray: &Ray, t: f64, normal: DVec3) -> [DVec3; 2] {
        let along = ray.direction.dot(normal);
        let sides = match *self {
            Self::Pixel(sides) => sides.map(|side| {
                let beside = ray.direction + side;
                beside * (t * along / beside.dot(normal)) - ray.direction * t
            }),
            Self::Parallel(sides) => sides.map(|side| side - ray.direction * (side.dot(normal) / along)),
            Self::Cone { width, growth } => {
                let unit = ray.direction.normalize_or_zero();
                let across = width + growth * t * ray.direction.length();
                let (right, up) = unit.any_orthonormal_pair();
                [right, up].map(|side| {
                    let side = side * across;
                    side - ray.direction * (side.dot(normal) / along)
                })
            }
        };
        sides.map(|side| if side.is_finite() { side } else { DVec3::ZERO })
    }

    /// The cone that goes on from there, wider by so many radians where the surface is rough.
    pub(super) fn after(&self, ray: &Ray, t: f64, wider: f64) -> Self {
        let length = ray.direction.length();
        let (width, growth) = match *self {
            Self::Pixel(sides) => (0.0, sides[0].length().max(sides[1].length()) / length),
            Self::Parallel(sides) => (sides[0].length().max(sides[1].length()), 0.0),
            Self::Cone { width, growth } => (width, growth),
        };
        Self::Cone { width: width + growth * t * length, growth: growth + wider }
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::{Camera, Extent};

    use super::*;

    /// Where the rays of the pixels beside meet a plane, from where a pixel's own does.
    #[test]
    fn pixels_beside_lie_where_their_rays_meet_the_surface() {
        let camera = Camera::looking(DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.2, -0.3, -1.0), DVec3::Y, 0.8);
        let camera = camera.expect("a camera");
        let parallel = camera.clone().with_extent(Extent::Height(2.5)).expect("a height");
        let (normal, distance) = (DVec3::new(0.3, 0.5, 0.8).normalize(), -4.0);
        for camera in [camera, parallel] {
            let raster = camera.raster(64, 48);
            let met = |x: f64, y: f64| {
                let ray = raster.ray(x, y);
                let t = (distance - normal.dot(ray.origin)) / normal.dot(ray.direction);
                (ray, t, ray.at(t))
            };
            for (x, y) in [(32.0, 24.0), (0.5, 0.5), (60.5, 3.5)] {
                let (ray, t, here) = met(x, y);
                let found = Spread::of_pixel(&raster, 0.5).on_surface(&ray, t, normal);
                let wanted = [met(x + 0.5, y).2 - here, met(x, y + 0.5).2 - here];
                for (found, wanted) in found.into_iter().zip(wanted) {
                    assert!((found - wanted).length() < 1e-9, "{camera:?}: {found} for {wanted}");
                }
                let Spread::Cone { width, .. } = Spread::of_pixel(&raster, 0.5).after(&ray, t, 0.0) else {
                    panic!()
                };
                assert!(width > 0.0 && width <= wanted[0].length().max(wanted[1].length()) * 1.0001);
            }
        }
    }
}
