//! Where a line meets each kind of shape.

use catoptra_core::geometry::Shape;
use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Ray};
use num_bigint::{BigInt, Sign};

use super::Place;
use super::integer::{Vector, cross, dot, doublings, integer, minus, vector};
use super::round::{Side, of_capsule, of_torus};

/// A ray whose origin and the shape's coordinates are integers of one scale, and whose direction is one of another.
pub(super) struct Line {
    pub(super) origin: Vector,
    pub(super) direction: Vector,
    /// Doublings that made coordinates integers.
    pub(super) scale: i32,
    /// What a parameter of the scaled ray must be doubled by to be one of the given ray.
    pub(super) doubled: i32,
}

impl Line {
    pub(super) fn new(ray: &Ray, coordinates: impl IntoIterator<Item = f64>) -> Self {
        let most = |values: &mut dyn Iterator<Item = f64>| values.map(doublings).max().unwrap_or(0);
        let scale = most(&mut ray.origin.to_array().into_iter().chain(coordinates));
        let fine = most(&mut ray.direction.to_array().into_iter());
        Self {
            origin: vector(ray.origin, scale),
            direction: vector(ray.direction, fine),
            scale,
            doubled: fine - scale,
        }
    }

    pub(super) fn ratio(&self, p: BigInt, q: BigInt) -> Place {
        Place::ratio(p, q, self.doubled)
    }
}

/// Everything that a line meets of a shape, with the facets it lies on.
pub(super) fn places(shape: &Shape, ray: &Ray) -> Vec<(Place, u32)> {
    let alone = |place: Option<Place>| place.map(|place| (place, 0)).into_iter().collect();
    if let Some(mesh) = shape.as_mesh() {
        let triangles = mesh.triangles();
        let one = |i| of_polygon(&triangles.corners(i), ray).map(|place| (place, i));
        return (0..triangles.triangles().len() as u32).filter_map(one).collect();
    }
    if let Some(solid) = shape.faceted() {
        let facet = |i| solid.triangles(i).filter_map(move |t| Some((of_polygon(&t, ray)?, i)));
        return (0..solid.count()).flat_map(facet).collect();
    }
    match shape {
        Shape::Plane(plane) => {
            alone(of_plane(plane.point(), plane.upwards(), ray).map(|(_, [p, q], line)| line.ratio(p, q)))
        }
        Shape::Sphere(sphere) => of_sphere(sphere.center(), sphere.radius(), ray),
        Shape::Triangle(triangle) => alone(of_polygon(&triangle.corners(), ray)),
        Shape::Tetrahedron(solid) => {
            let face = |i| of_polygon(&solid.face(i), ray).map(|place| (place, i));
            (0..4).filter_map(face).collect()
        }
        Shape::Rectangle(rectangle) => {
            let (c, [u, v]) = (rectangle.corner(), rectangle.edges());
            alone(of_parallelogram(c, u, v, ray))
        }
        Shape::Disk(disk) => alone(of_disk(disk.center(), disk.upwards(), disk.radius(), ray)),
        Shape::Cuboid(cuboid) => of_box(&cuboid.object_bounds(), ray),
        Shape::Cylinder(cylinder) => {
            let side = Side::new(cylinder.ends(), [cylinder.radius(); 2], ray);
            if cylinder.is_open() { side.places() } else { [side.places(), side.caps()].concat() }
        }
        Shape::Cone(cone) => {
            let side = Side::new(cone.ends(), cone.radii(), ray);
            if cone.is_open() { side.places() } else { [side.places(), side.caps()].concat() }
        }
        Shape::Torus(torus) => of_torus(torus.center(), torus.upwards(), torus.radii(), ray),
        Shape::Capsule(capsule) => of_capsule(capsule.ends(), capsule.radius(), ray),
        other => panic!("the reference has no test for a {}", other.kind_name()),
    }
}

/// The numerator and divisor of the place where a plane is met, and the scaled plane point.
fn of_plane(point: DVec3, normal: DVec3, ray: &Ray) -> Option<(Vector, [BigInt; 2], Line)> {
    let line = Line::new(ray, point.to_array());
    let fine = normal.to_array().into_iter().map(doublings).max().unwrap_or(0);
    let (point, normal) = (vector(point, line.scale), vector(normal, fine));
    let along = dot(&normal, &line.direction);
    let away = dot(&normal, &minus(&point, &line.origin));
    (along.sign() != Sign::NoSign).then_some((point, [away, along], line))
}

/// The quadratic equation of the sphere, solved as it stands.
pub(super) fn of_sphere(center: DVec3, radius: f64, ray: &Ray) -> Vec<(Place, u32)> {
    let line = Line::new(ray, center.to_array().into_iter().chain([radius]));
    let from_center = minus(&line.origin, &vector(center, line.scale));
    let radius = integer(radius, line.scale);
    let a = dot(&line.direction, &line.direction);
    let b = dot(&from_center, &line.direction);
    let c = dot(&from_center, &from_center) - &radius * &radius;
    let discriminant = &b * &b - &a * c;
    if discriminant.sign() == Sign::Minus {
        return Vec::new();
    }
    let place = |minus| Place::new([-b.clone(), discriminant.clone(), a.clone()], minus, line.doubled);
    vec![(place(true), 0), (place(false), 0)]
}

/// A flat convex polygon, by where the line meets its plane: on the inner side of every edge, or on it.
fn of_polygon(corners: &[DVec3], ray: &Ray) -> Option<Place> {
    let line = Line::new(ray, corners.iter().flat_map(DVec3::to_array));
    let corners: Vec<Vector> = corners.iter().map(|&p| vector(p, line.scale)).collect();
    let normal = cross(&minus(&corners[1], &corners[0]), &minus(&corners[2], &corners[0]));
    let along = dot(&normal, &line.direction);
    if along.sign() == Sign::NoSign {
        return None;
    }
    let away = dot(&normal, &minus(&corners[0], &line.origin));
    // The point of the plane, times the divisor, as seen from a corner.
    let from = |corner: &Vector| -> Vector {
        std::array::from_fn(|i| (&line.origin[i] - &corner[i]) * &along + &line.direction[i] * &away)
    };
    let inside = (0..corners.len()).all(|i| {
        let (here, next) = (&corners[i], &corners[(i + 1) % corners.len()]);
        let side = dot(&cross(&minus(next, here), &from(here)), &normal);
        side.sign() == Sign::NoSign || side.sign() == along.sign()
    });
    inside.then(|| line.ratio(away, along))
}

/// As a polygon whose corners need not be numbers of `f64`.
fn of_parallelogram(corner: DVec3, u: DVec3, v: DVec3, ray: &Ray) -> Option<Place> {
    let line = Line::new(ray, [corner, u, v].into_iter().flat_map(|p| p.to_array()));
    let [c, u, v] = [corner, u, v].map(|p| vector(p, line.scale));
    let normal = cross(&u, &v);
    let along = dot(&normal, &line.direction);
    if along.sign() == Sign::NoSign {
        return None;
    }
    let away = dot(&normal, &minus(&c, &line.origin));
    let point: Vector =
        std::array::from_fn(|i| (&line.origin[i] - &c[i]) * &along + &line.direction[i] * &away);
    // The shares of u and v times the normal's square and the divisor.
    let size = dot(&normal, &normal) * &along;
    let shares = [dot(&cross(&point, &v), &normal), dot(&cross(&u, &point), &normal)];
    let inside = shares.iter().all(|share| {
        let (share, size) =
            if size.sign() == Sign::Minus { (-share, -&size) } else { (share.clone(), size.clone()) };
        share.sign() != Sign::Minus && share <= size
    });
    inside.then(|| line.ratio(away, along))
}

fn of_disk(center: DVec3, normal: DVec3, radius: f64, ray: &Ray) -> Option<Place> {
    let (_, [away, along], _) = of_plane(center, normal, ray)?;
    let line = Line::new(ray, center.to_array().into_iter().chain([radius]));
    // The plane's own scale may be coarser than that with the radius: the parameter changes accordingly.
    let coarse = Line::new(ray, center.to_array());
    let away = away << (line.scale - coarse.scale);
    let (center, radius) = (vector(center, line.scale), integer(radius, line.scale));
    let point: Vector =
        std::array::from_fn(|i| (&line.origin[i] - &center[i]) * &along + &line.direction[i] * &away);
    let reach = radius * &along;
    (dot(&point, &point) <= &reach * &reach).then(|| line.ratio(away, along))
}

/// Every face by itself: where the line meets its plane, if that lies between the other faces. Of faces met in one place
/// that of the first axis counts, as for the tracer.
fn of_box(bounds: &Aabb, ray: &Ray) -> Vec<(Place, u32)> {
    let line = Line::new(ray, bounds.min.to_array().into_iter().chain(bounds.max.to_array()));
    let (low, high) = (vector(bounds.min, line.scale), vector(bounds.max, line.scale));
    let mut places: Vec<(Place, u32)> = Vec::new();
    for facet in 0..6_u32 {
        let axis = (facet / 2) as usize;
        let along = &line.direction[axis];
        let away = (if facet.is_multiple_of(2) { &low[axis] } else { &high[axis] }) - &line.origin[axis];
        let between = |i: usize| {
            let at = &line.origin[i] * along + &line.direction[i] * &away;
            let [a, b] = [&low[i] * along, &high[i] * along];
            if along.sign() == Sign::Minus { b <= at && at <= a } else { a <= at && at <= b }
        };
        if along.sign() != Sign::NoSign && (0..3).all(|i| i == axis || between(i)) {
            let place = line.ratio(away.clone(), along.clone());
            if places.iter().all(|(other, _)| other.compare(&place).is_ne()) {
                places.push((place, facet));
            }
        }
    }
    places
}
