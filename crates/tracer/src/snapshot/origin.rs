//! Chooses the origin of a snapshot's coordinates.
//!
//! The precision of `f32` is to be spent on detail and not on distance. What is seen sharply is what is near the eye,
//! so the origin follows the eye. It stays at the world's where that is near enough, which leaves every coordinate as
//! it was given.

use std::borrow::Cow;

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, FieldKind, Placement, Shape, Value};

use crate::numeric::FAR;

/// The origin for a scene of bounded shapes that is looked at from `eye`, if there is a camera.
pub(super) fn origin_for(bounds: impl Iterator<Item = Aabb> + Clone, eye: Option<DVec3>) -> DVec3 {
    let all = bounds.clone().fold(Aabb::EMPTY, Aabb::union);
    let (place, detail, far) = match eye {
        Some(eye) => (eye, bounds.map(|b| detail(b, eye)).fold(f64::INFINITY, f64::min), FAR),
        None => (all.centre(), all.size().length(), 1.0),
    };
    if !place.is_finite() || (all.is_empty() && eye.is_none()) {
        DVec3::ZERO
    } else if detail.is_infinite() {
        place
    } else if place.length() <= far * detail {
        DVec3::ZERO
    } else {
        rounded(place, detail)
    }
}

/// How large the smallest thing is that could be seen as sharply as a shape: as far away as that, or as large.
fn detail(bounds: Aabb, eye: DVec3) -> f64 {
    eye.distance(eye.clamp(bounds.min, bounds.max)) + bounds.size().length()
}

/// In steps of an eighth of the detail or less, a power of two: numbers so short that a difference to them is mostly
/// exact.
fn rounded(place: DVec3, detail: f64) -> DVec3 {
    let step = (detail / 8.0).log2().floor().exp2();
    let short = (place / step).round() * step;
    if short.is_finite() { short } else { place }
}

/// Where coordinates shall be zero in which shapes and rays are compared: the origin, if that rounds no number of any
/// shape, so that points near the eye are known the better; else the world's own zero, so that every shape stays what it
/// is.
pub(super) fn frame_for<'a>(mut shapes: impl Iterator<Item = &'a Shape>, origin: DVec3) -> DVec3 {
    // Where the origin is the world's own zero, the frame is the world, whatever the shapes.
    if origin != DVec3::ZERO && shapes.all(|shape| moves_exactly(shape, origin)) {
        origin
    } else {
        DVec3::ZERO
    }
}

/// Whether a shape can be moved to an origin without rounding. One that is turned or scaled sees rays through its
/// placement, which rounds them differently.
fn moves_exactly(shape: &Shape, origin: DVec3) -> bool {
    let plain = |placement: &Placement| {
        let stays = Placement::IDENTITY.moved(placement.translation());
        stays.is_ok_and(|stays| stays == *placement) && is_exact(placement.translation(), origin)
    };
    if let Some(mesh) = shape.as_mesh() {
        return plain(mesh.placement());
    }
    if let Some(solid) = shape.faceted() {
        return solid.corners().iter().all(|corner| is_exact(*corner, origin));
    }
    match shape {
        Shape::Cuboid(cuboid) => plain(cuboid.placement()),
        shape => shape.kind().fields.iter().all(|field| match shape.values().get(field.name) {
            Some(Value::Vector(point)) if field.kind == FieldKind::Point => is_exact(*point, origin),
            _ => true,
        }),
    }
}

/// Whether `point − origin` is free of rounding: taking it away from either gives the other (Dekker, Numerische
/// Mathematik 18, 1971).
pub(super) fn is_exact(point: DVec3, origin: DVec3) -> bool {
    let difference = point - origin;
    difference + origin == point && point - difference == origin
}

/// A shape as seen from an origin.
pub(super) fn relative(shape: &Shape, origin: DVec3) -> Cow<'_, Shape> {
    match Placement::IDENTITY.moved(-origin) {
        Ok(moved) if origin != DVec3::ZERO => Cow::Owned(shape.placed(&moved)),
        _ => Cow::Borrowed(shape),
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::geometry::Sphere;

    use super::*;

    fn cube(center: DVec3, edge: f64) -> Aabb {
        Aabb { min: center - DVec3::splat(edge / 2.0), max: center + DVec3::splat(edge / 2.0) }
    }

    #[test]
    fn a_scene_near_zero_keeps_its_coordinates() {
        let eye = Some(DVec3::new(3.0, 4.0, 12.0));
        assert_eq!(
            origin_for([cube(DVec3::ZERO, 1.0), cube(DVec3::X * 900.0, 5.0)].into_iter(), eye),
            DVec3::ZERO
        );
    }

    #[test]
    fn the_origin_follows_an_eye_that_is_far_away_with_something_near_it() {
        let far = DVec3::new(1e7, -3e6, 0.25);
        let shapes = [cube(DVec3::ZERO, 1.0), cube(far, 2.0)];
        let origin = origin_for(shapes.into_iter(), Some(far + DVec3::Z * 5.0));
        assert!(origin.distance(far + DVec3::Z * 5.0) < 1.0, "{origin}");
        assert_eq!(origin_for(shapes.into_iter(), Some(DVec3::Z * 5.0)), DVec3::ZERO);
    }

    #[test]
    fn without_bounded_shapes_the_eye_is_the_origin() {
        let eye = DVec3::new(1e7, 0.1, 0.2);
        assert_eq!(origin_for(std::iter::empty(), Some(eye)), eye);
    }

    #[test]
    fn without_a_camera_the_middle_counts() {
        let place = DVec3::splat(1e6);
        assert!(origin_for([cube(place, 3.0)].into_iter(), None).distance(place) < 1.0);
        assert_eq!(origin_for(std::iter::empty(), None), DVec3::ZERO);
    }

    #[test]
    fn a_tiny_scene_far_away_is_still_resolved() {
        let place = DVec3::new(1000.3, 7.7, -20.1);
        let origin = origin_for([cube(place, 1e-5)].into_iter(), Some(place + DVec3::Z * 1e-5));
        assert!(origin.distance(place) < 1e-4);
    }

    #[test]
    fn a_frame_rounds_no_shape() {
        let origin = DVec3::splat(1024.0);
        let frame = |center: DVec3| frame_for([Sphere::new(center, 1.0).unwrap().into()].iter(), origin);
        assert_eq!(frame(DVec3::new(1000.1, 1030.7, 1024.0)), origin);
        assert_eq!(frame(DVec3::new(1000.1, 0.1, 1024.0)), DVec3::ZERO, "0.1 − 1024 rounds");
    }
}
