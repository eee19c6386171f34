//! Does a point lie on a surface, but for rounding? Whoever names a point on a surface has rounded it.

use glam::DVec3;

use super::lamp::{Lamp, Outline};
use super::place::nearest_on_lamp;
use super::swept::Swept;
use crate::Shape;
use crate::geometry::Faceted;
use crate::numeric::HELD_WITHIN;

/// How far from a surface through `on` a point counts as lying on it.
pub(super) fn reach(point: DVec3, on: DVec3) -> f64 {
    HELD_WITHIN * (point.abs().max_element() + on.abs().max_element())
}

/// Whether two unit vectors are the same or opposite, but for rounding.
pub(crate) fn are_parallel(a: DVec3, b: DVec3) -> bool {
    a.cross(b).length() <= HELD_WITHIN
}

/// Whether a point is within reach of a sphere's surface.
pub(super) fn on_sphere(point: DVec3, center: DVec3, radius: f64) -> bool {
    let reach = reach(point, center) + HELD_WITHIN * radius;
    (point.distance(center) - radius).abs() <= reach
}

/// Whether a facet of a shape, numbered as [`Crossing::facet`](crate::Crossing::facet), holds a point: whether the point lies
/// within [`HELD_WITHIN`] of it, in parts of the coordinates' size. Never for a facet without area.
#[must_use]
pub fn facet_holds(shape: &Shape, facet: u32, point: DVec3) -> bool {
    if let Shape::Plane(plane) = shape {
        let off = plane.normal().dot(point - plane.point());
        return facet == 0 && off.abs() <= reach(point, plane.point());
    }
    if let Some(solid) = shape.faceted() {
        let holds = |face: [DVec3; 3]| Lamp::polygon(&face).is_some_and(|lamp| lamp_holds(&lamp, point));
        return facet < solid.count() && solid.triangles(facet).any(holds);
    }
    let swept = match shape {
        Shape::Cylinder(shape) => Some(Swept::of_cylinder(shape)),
        Shape::Cone(shape) => Some(Swept::of_cone(shape)),
        Shape::Capsule(shape) => Some(Swept::of_capsule(shape)),
        _ => None,
    };
    if let Some(swept) = swept {
        return facet < facets_that_hold(shape) && swept.distance(point, facet) <= swept.reach(point);
    }
    if let Shape::Torus(torus) = shape {
        let reach = reach(point, torus.center()) + HELD_WITHIN * torus.radii()[0];
        return facet == 0 && torus.distance(point) <= reach;
    }
    Lamp::of(shape, facet).is_some_and(|lamp| lamp_holds(&lamp, point))
}

/// How many facets of a shape may hold a point.
#[must_use]
pub fn facets_that_hold(shape: &Shape) -> u32 {
    match shape {
        Shape::Plane(_) | Shape::Torus(_) => 1,
        Shape::Cylinder(_) | Shape::Cone(_) | Shape::Capsule(_) => shape.pieces(),
        _ => shape.faceted().map_or_else(|| Lamp::facets(shape), Faceted::count),
    }
}

fn lamp_holds(lamp: &Lamp, point: DVec3) -> bool {
    match &lamp.outline {
        Outline::Sphere { center, radius } => on_sphere(point, *center, *radius),
        _ => {
            let on = nearest_on_lamp(lamp, point);
            // The corners' size, not the nearest point's alone, is what its plane is known by.
            let (middle, size) = lamp.ball();
            on.distance(point) <= reach(point, middle) + HELD_WITHIN * size
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cuboid, Plane, Sphere, Triangle};

    #[test]
    fn points_that_were_rounded_lie_on_their_surfaces_and_others_do_not() {
        let triangle: Shape =
            Triangle::new(DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0), DVec3::new(3.0, -1.0, 0.5)).unwrap().into();
        let on = DVec3::new(1.0, 2.0, 3.0) * 0.3 + DVec3::new(3.0, -1.0, 0.5) * 0.1;
        assert!(facet_holds(&triangle, 0, on));
        assert!(!facet_holds(&triangle, 0, on + DVec3::X * 1e-9));
        // In its plane, but beside it.
        assert!(!facet_holds(&triangle, 0, on * -1.0));
        let ball: Shape = Sphere::new(DVec3::new(5.0, 0.0, 0.0), 0.7).unwrap().into();
        let out = DVec3::new(0.3, 0.5, -0.9).normalize();
        assert!(facet_holds(&ball, 0, DVec3::X * 5.0 + out * 0.7));
        assert!(!facet_holds(&ball, 0, DVec3::X * 5.0 + out * 0.699));
        let plane: Shape = Plane::new(DVec3::new(0.0, 1e6, 0.0), DVec3::new(1.0, 2.0, 0.0)).unwrap().into();
        assert!(facet_holds(&plane, 0, DVec3::new(2e6, 0.0, 3.0)));
        assert!(!facet_holds(&plane, 0, DVec3::new(2e6, 1e-3, 3.0)));
    }

    #[test]
    fn the_edge_of_a_box_lies_on_two_faces() {
        let solid: Shape = Cuboid::new(DVec3::ZERO, DVec3::ONE).unwrap().into();
        let held = |point| (0..6).filter(|facet| facet_holds(&solid, *facet, point)).collect::<Vec<_>>();
        assert_eq!(held(DVec3::new(1.0, 0.3, 1.0)), [1, 5]);
        assert_eq!(held(DVec3::ONE), [1, 3, 5]);
        assert_eq!(held(DVec3::splat(0.5)), Vec::<u32>::new());
    }
}
