//! Do the kernels' bounds hold, and do they have to be as large as they are? Rays aimed at rims and silhouettes, against
//! the shapes' own exact answers: what a kernel is certain of must be right, `t` must lie within its bound, and the worst
//! of all errors must come near the bound, so that a bound cut down would be found out.

use catoptra_core::geometry::{Plane, Rectangle, Sphere, Triangle};
use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, Ray, Shape, Span};
use fearless_simd::{Level, Simd, dispatch};

use super::{PlaneRow, Proposal, Rays, RectangleRow, SphereRow, TriangleRow, magnitude};
use crate::lanes::{F, F3, M};
use crate::random::Random;

/// A shape and points of its rim.
type Target = (Shape, Vec<DVec3>);

/// How the kernel of a kind of shape did.
#[derive(Default)]
struct Record {
    certain: u64,
    undecided: u64,
    /// Largest error of `t` in units of its bound.
    worst: f64,
}

/// Rays as the backend makes them, and the same in `f64`; about shapes in so many metres.
fn aimed<S: Simd>(s: S, random: &mut Random, rim: &[DVec3], unit: f64) -> (Rays<S>, Vec<Ray>) {
    let lanes = F::<S>::LANES;
    let reach = unit * random.power(-2, 8);
    let rays: Vec<Ray> = (0..lanes)
        .map(|_| {
            let (a, b) = (rim[random.bits() as usize % rim.len()], rim[random.bits() as usize % rim.len()]);
            let share = [0.0, 0.5, random.number()][random.bits() as usize % 3];
            let target = a.lerp(b, share) + random.point() * unit * random.power(-40, -10);
            let from = target + random.point() * reach;
            Ray::new(from, target - from)
        })
        .collect();
    let column =
        |of: &dyn Fn(&Ray) -> f64| F::load(s, &rays.iter().map(|ray| of(ray) as f32).collect::<Vec<_>>());
    let triple = |of: &dyn Fn(&Ray) -> DVec3| {
        F3::new(column(&|ray| of(ray).x), column(&|ray| of(ray).y), column(&|ray| of(ray).z))
    };
    let (origin, direction) = (triple(&|ray| ray.origin), triple(&|ray| ray.direction));
    let inverse_length = F::splat(s, 1.0) / direction.dot(direction).sqrt();
    (Rays { origin, direction: direction.scale(inverse_length), reach: magnitude(origin) }, rays)
}

/// `None` for shapes without a kernel.
fn propose<S: Simd>(s: S, shape: &Shape, rays: &Rays<S>) -> Option<Proposal<S>> {
    Some(match shape {
        Shape::Plane(plane) => PlaneRow::new(plane.point(), plane.normal(), 0).propose(s, rays),
        Shape::Sphere(sphere) => {
            SphereRow::new(sphere.center(), sphere.radius()).propose(s, rays, M::splat(s, false))
        }
        Shape::Rectangle(r) => RectangleRow::new(r.corner(), r.edges(), 0).propose(s, rays),
        Shape::Triangle(triangle) => TriangleRow::new(triangle.corners(), 0, 0)?.propose(s, rays),
        _ => return None,
    })
}

/// Targets of the size of so many metres.
fn attack(target: impl Fn(&mut Random, f64) -> Option<Target>) -> Record {
    let mut record = Record::default();
    let mut random = Random(7);
    for _ in 0..8_000 {
        let unit = random.unit();
        let Some(target) = target(&mut random, unit) else { continue };
        dispatch!(Level::new(), s => try_one(s, &mut random, (&target, unit), &mut record));
    }
    record
}

fn try_one<S: Simd>(s: S, random: &mut Random, ((shape, rim), unit): (&Target, f64), record: &mut Record) {
    let (packet, rays) = aimed(s, random, rim, unit);
    let Some(proposal) = propose(s, shape, &packet) else { return };
    for (lane, ray) in rays.iter().enumerate() {
        let is = |mask: M<S>| mask.bits() >> lane & 1 == 1;
        if is(proposal.undecided) {
            record.undecided += 1;
            continue;
        }
        record.certain += 1;
        let exact = shape.cross(ray, Span::AHEAD, None);
        assert_eq!(is(proposal.hit), exact.is_some(), "{ray:?} {shape:?}");
        if let Some(crossing) = exact {
            let off = (f64::from(proposal.t.lane(lane)) - crossing.t * ray.direction.length()).abs();
            let ratio = off / f64::from(proposal.error.lane(lane));
            assert!(ratio <= 1.0, "{ratio} of the bound: {ray:?} {shape:?}");
            record.worst = record.worst.max(ratio);
        }
    }
}

/// Both sides of the bound are met.
fn assert_attacked(record: &Record, least: f64) {
    let share = record.undecided as f64 / (record.certain + record.undecided) as f64;
    println!("worst {:.3} of the bound, {:.1} % undecided", record.worst, 100.0 * share);
    assert!(record.certain > 1000 && record.undecided > 10, "{} {}", record.certain, record.undecided);
    assert!(record.worst > least, "the worst error is but {} of its bound", record.worst);
}

#[test]
fn planes() {
    let record = attack(|random, unit| {
        let (point, normal) = (random.point() * unit * random.power(-4, 10), random.point());
        let along = normal.cross(random.point());
        // A rim far along the plane makes rays graze it.
        let rim = vec![
            point,
            point + along * unit * random.power(0, 10),
            point + normal * unit * random.power(-20, 0),
        ];
        Some((Plane::new(point, normal).ok()?.into(), rim))
    });
    assert_attacked(&record, 0.05);
}

#[test]
fn spheres() {
    let record = attack(|random, unit| {
        let (center, radius) = (random.point() * unit * random.power(-4, 6), unit * random.power(-6, 6));
        let axis = random.point().normalize();
        let side = axis.any_orthonormal_vector();
        let rim = (0..8).map(|i| center + (axis * f64::from(i).sin() + side * f64::from(i).cos()) * radius);
        Some((Sphere::new(center, radius).ok()?.into(), rim.collect()))
    });
    assert_attacked(&record, 0.05);
}

#[test]
fn rectangles() {
    let record = attack(|random, unit| {
        let corner = random.point() * unit * random.power(-4, 6);
        let u = random.point() * unit * random.power(-4, 4);
        let v = u.normalize().any_orthonormal_vector() * unit * random.power(-4, 4);
        let rim = vec![corner, corner + u, corner + u + v, corner + v];
        Some((Rectangle::new(corner, u, v).ok()?.into(), rim))
    });
    assert_attacked(&record, 0.02);
}

#[test]
fn triangles() {
    let record = attack(|random, unit| {
        let (place, size) = (random.point() * unit * random.power(-4, 6), unit * random.power(-6, 4));
        let [a, b, c] = [(); 3].map(|()| place + random.point() * size);
        Some((Triangle::new(a, b, c).ok()?.into(), vec![a, b, c]))
    });
    assert_attacked(&record, 0.02);
}
