//! The reference for what a ray meets: whole numbers without end, and other formulas than the tracer's.
//!
//! All coordinates of a question are scaled to integers, so that nothing is rounded; a place on the ray is kept as
//! `(p ± √s) / q`. Slow, exhaustive, and independent of `catoptra-core`'s own exact arithmetic: another crate of big
//! integers, other tests for every shape, and roots compared by enclosing them ever more closely.

mod integer;
mod isolated;
mod place;
mod round;
mod shape;

use catoptra_core::geometry::{Mesh, Shape};
use catoptra_core::{Geometry, Ray, Span};

pub use place::Place;

use crate::ulps_f32;

/// What a ray meets.
#[derive(Debug, Clone)]
pub struct Met {
    /// Which of the shapes.
    pub shape: usize,
    /// Which flat piece of it: a triangle of a mesh, a face of a solid; 0 for the others.
    pub facet: u32,
    /// Where on the ray.
    pub place: Place,
}

/// Everything that a ray meets on a stretch, nearest first, then by shape and facet.
///
/// Placed meshes and boxes are met by the ray that their placement makes of the given one in `f64`: that ray is taken
/// as it is.
///
/// # Panics
/// For a kind of shape that the reference has no test for.
#[must_use]
pub fn meetings(shapes: &[Shape], ray: &Ray, span: Span) -> Vec<Met> {
    let mut met: Vec<Met> = Vec::new();
    for (shape, number) in shapes.iter().zip(0..) {
        let own = own_ray(shape, ray);
        if !own.is_valid() {
            continue;
        }
        let places = shape::places(shape, &own).into_iter();
        met.extend(places.filter(|(place, _)| place.lies_on(span)).map(|(place, facet)| Met {
            shape: number,
            facet,
            place,
        }));
    }
    met.sort_by(|a, b| a.place.compare(&b.place).then((a.shape, a.facet).cmp(&(b.shape, b.facet))));
    met
}

/// Whether what a tracer says that a ray meets first is right: the same shape and facet (but for boxes, whose edges
/// belong to two faces), at a `t` that rounds to the same `f32` or the one beside it. Ties go to the lower shape.
///
/// # Errors
/// What is met, in words.
///
/// # Panics
/// As [`meetings`].
pub fn confirm(
    shapes: &[Shape],
    ray: &Ray,
    span: Span,
    said: Option<(catoptra_tracer::SurfaceId, f64)>,
) -> Result<(), String> {
    let met = meetings(shapes, ray, span).into_iter().next();
    let right = match (&met, said) {
        (None, None) => true,
        (Some(met), Some((place, t))) => {
            let same_facet = met.facet == place.facet || matches!(shapes[met.shape], Shape::Cuboid(_));
            met.shape == place.prim as usize && same_facet && is_same_parameter(t, met.place.to_f64())
        }
        // Beyond the largest number.
        (Some(met), None) => met.place.to_f64().is_infinite(),
        (None, Some(_)) => false,
    };
    let met = met.map(|met| (met.shape, met.facet, met.place.to_f64()));
    if right { Ok(()) } else { Err(format!("{said:?} rather than {met:?}: {ray:?}")) }
}

/// Whether `t`, rounded to `f32`, is the rounded exact one or its neighbour; where `f32` has no such number, whether it is
/// as near as that.
#[must_use]
pub fn is_same_parameter(t: f64, exact: f64) -> bool {
    let size = exact.abs();
    if exact == 0.0 || (f64::from(f32::MIN_POSITIVE)..=f64::from(f32::MAX)).contains(&size) {
        ulps_f32(t as f32, exact as f32).is_some_and(|steps| steps <= 1)
    } else {
        (t - exact).abs() <= size * f64::from(f32::EPSILON)
    }
}

/// The ray in the space that the numbers of a shape are given in.
fn own_ray(shape: &Shape, ray: &Ray) -> Ray {
    match shape {
        shape if shape.as_mesh().is_some() => shape.as_mesh().map_or(*ray, |mesh| Mesh::own_ray(mesh, ray)),
        Shape::Cuboid(cuboid) => cuboid.own_ray(ray),
        _ => *ray,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use catoptra_core::geometry::{
        Capsule, Cone, Cuboid, Cylinder, Disk, Heightfield, Plane, Platonic, Polyhedron, Prism, Rectangle,
        Sphere, Tetrahedron, Torus, Triangle,
    };
    use catoptra_core::glam::{DVec2, DVec3};
    use catoptra_core::{Image, ImageSource, MeshSource, TriangleMesh};

    use super::*;

    /// One of every kind, all of which the ray down from (0.25, 4, 0.25) meets first at t = 4.
    fn one_of_each() -> Vec<Shape> {
        let (o, x, z) = (DVec3::ZERO, DVec3::X, DVec3::Z);
        let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let mesh = TriangleMesh::new(corners, vec![[0, 1, 2]], None, None).unwrap();
        vec![
            Plane::new(o, DVec3::new(0.0, -3.0, 0.0)).unwrap().into(),
            Sphere::new(DVec3::new(0.25, -2.0, 0.25), 2.0).unwrap().into(),
            Triangle::new(o, x, z).unwrap().into(),
            Tetrahedron::new(o, x, z, -DVec3::Y).unwrap().into(),
            Rectangle::new(o, x, z).unwrap().into(),
            Disk::new(o, DVec3::Y, 1.0).unwrap().into(),
            Cuboid::new(-DVec3::ONE, DVec3::new(1.0, 0.0, 1.0)).unwrap().into(),
            Mesh::new(MeshSource { path: String::new(), mesh: Arc::new(mesh) }).into(),
            Cylinder::new(o, DVec3::NEG_Y * 3.0, 1.0).unwrap().into(),
            // Leaning so that its uppermost line lies in the plane y = 0, below it the ray.
            Cone::new(DVec3::new(-3.0, -1.0, 0.25), DVec3::new(3.0, -1.0, 0.25), 1.0, 1.0).unwrap().into(),
            Capsule::new(DVec3::new(-3.0, -1.0, 0.25), DVec3::new(3.0, -1.0, 0.25), 1.0).unwrap().into(),
            Polyhedron::hull_of([o, x, z, x + z, -DVec3::Y]).unwrap().into(),
            // Whose upper face lies in the plane, as its corners are powers of two.
            Platonic::new("cube", -DVec3::Y, 3.0_f64.sqrt()).unwrap().into(),
            Prism::new(
                [[0.0, 0.0], [1.0, 0.0], [1.0, -1.0], [0.0, -1.0]].map(Into::into),
                1.0,
                -DVec3::Y,
                DVec3::Y,
            )
            .unwrap()
            .into(),
            black_picture(),
            // Whose tube touches the plane above the ray.
            Torus::new(DVec3::new(-2.75, -1.0, 0.25), DVec3::Y, 3.0, 1.0).unwrap().into(),
        ]
    }

    /// Flat ground.
    fn black_picture() -> Shape {
        let image = Arc::new(Image::from_bytes([2, 2], 1, vec![0; 4]).unwrap());
        let picture = ImageSource { path: String::new(), image };
        Heightfield::new(picture, DVec2::ONE, 1.0, false).unwrap().into()
    }

    #[test]
    fn every_kind_of_shape_is_met_where_it_is() {
        let shapes = one_of_each();
        let down = Ray::new(DVec3::new(0.25, 4.0, 0.25), DVec3::NEG_Y);
        for kind in Shape::KINDS {
            let shape = shapes.iter().find(|shape| shape.kind_name() == kind.name);
            let shape = shape.unwrap_or_else(|| panic!("no {} here", kind.name)).clone();
            let met = meetings(std::slice::from_ref(&shape), &down, Span::AHEAD);
            assert_eq!(met[0].place.to_f64(), 4.0, "{}", kind.name);
            assert!(meetings(&[shape], &down, Span::until(4.0_f64.next_down())).is_empty(), "{}", kind.name);
        }
    }

    #[test]
    fn what_is_met_in_one_place_comes_in_the_order_of_the_shapes() {
        let shapes = one_of_each();
        let down = Ray::new(DVec3::new(0.25, 4.0, 0.25), DVec3::NEG_Y);
        let met = meetings(&shapes, &down, Span { min: 4.0, max: 4.0 });
        // Where it meets the diagonals of faces, it meets two triangles of them.
        let mut order: Vec<usize> = met.iter().map(|met| met.shape).collect();
        order.dedup();
        assert_eq!(order, (0..shapes.len()).collect::<Vec<_>>());
    }

    #[test]
    fn a_tangent_is_met_and_one_step_beside_it_is_not() {
        let sphere = [Sphere::new(DVec3::ZERO, 1.0).unwrap().into()];
        let beside =
            |x: f64| meetings(&sphere, &Ray::new(DVec3::new(x, 5.0, 0.0), DVec3::NEG_Y), Span::AHEAD).len();
        assert_eq!([beside(1.0), beside(1.0_f64.next_up()), beside(1.0_f64.next_down())], [2, 0, 2]);
    }

    #[test]
    fn a_wrong_answer_is_not_confirmed() {
        let shapes = one_of_each();
        let down = Ray::new(DVec3::new(0.25, 4.0, 0.25), DVec3::NEG_Y);
        let place = |prim| catoptra_tracer::SurfaceId { prim, facet: 0 };
        let confirmed = |said| confirm(&shapes, &down, Span::AHEAD, said).is_ok();
        assert!(confirmed(Some((place(0), 4.0))));
        assert!(!confirmed(Some((place(1), 4.0))), "the plane comes before the sphere");
        assert!(!confirmed(Some((place(0), 4.000_001))) && !confirmed(None));
    }
}
