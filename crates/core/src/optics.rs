//! Where does light go on from a surface: mirrored, or refracted?

use glam::DVec3;

use crate::{Arithmetic, Triple};

/// A direction of any length mirrored about a unit normal; the sign of the normal does not matter.
#[inline(always)]
#[must_use]
pub fn reflect<T: Arithmetic>(direction: Triple<T>, normal: Triple<T>) -> Triple<T> {
    let along = direction.dot(normal);
    normal.scale_add(-(along + along), direction)
}

/// A unit direction refracted by a surface whose unit `normal` points to the side that it comes from; `ratio` is the
/// index of refraction on that side over the one beyond. `None` for total reflection.
///
/// Snell's law in vectors (Glassner (ed.), *An Introduction to Ray Tracing*, 1989, section 4.4), with the sine taken
/// from the direction's part along the surface, which keeps its digits at every angle.
#[must_use]
pub fn refract(direction: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    let along = (direction - normal * direction.dot(normal)) * ratio;
    let cosine2 = 1.0 - along.length_squared();
    (cosine2 > 0.0).then(|| along - normal * cosine2.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_keep_the_ratio_of_the_indices() {
        let direction = DVec3::new(0.6, -0.8, 0.0);
        let bent = refract(direction, DVec3::Y, 1.0 / 1.5).unwrap();
        assert!((bent.x - 0.4).abs() < 1e-15 && (bent.length() - 1.0).abs() < 1e-15 && bent.y < 0.0);
    }

    #[test]
    fn the_way_back_is_the_way_there() {
        let direction = DVec3::new(1.0, -2.0, 0.5).normalize();
        let inside = refract(direction, DVec3::Y, 1.0 / 1.33).unwrap();
        assert!(refract(-inside, -DVec3::Y, 1.33).unwrap().distance(-direction) < 1e-15);
    }

    #[test]
    fn beyond_the_critical_angle_everything_is_reflected() {
        let flat = DVec3::new(0.8, -0.6, 0.0);
        assert_eq!(refract(flat, DVec3::Y, 1.5), None);
        assert_eq!(reflect(flat.into(), DVec3::Y.into()), Triple::new(0.8, 0.6, 0.0));
    }
}
