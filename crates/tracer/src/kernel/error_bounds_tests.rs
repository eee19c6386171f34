//! Do the kernels' bounds hold, and do they have to be as large as they are? Rays aimed at rims and silhouettes, against
//! the shapes' own exact answers: what a kernel is certain of must be right, `t` must lie within its bound, and the worst
//! of all errors must come near the bound, so that a bound cut down would be found out.

use std::f64::consts::PI;

use catoptra_core::geometry::{
    Capsule, Cone, Cuboid, Cylinder, Disk, Plane, Polyhedron, Prism, Rectangle, Sphere, Torus, Triangle,
};
use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{Lane, Placement, Ray, Shape, Span};
use fearless_simd::{Level, Simd, dispatch};

use super::{
    CuboidRow, FacetsRow, FlatRow, Kernel, Leaving, PlaneRow, Proposal, Rays, RoundRow, SolidRow, SphereRow,
    TorusRow, TriangleRow, Tried,
};
use crate::film::NOTHING;
use crate::lanes::{F, F3, M, U, magnitude};
use crate::numeric::DIRECTION_ERROR;
use crate::random::Random;

/// A shape and points of its rim.
pub(super) type Target = (Shape, Vec<DVec3>);

/// A ray, and the facet of the target that it leaves for its inside.
pub(super) type Shot = (Ray, Option<u32>);

/// How the kernel of a kind of shape did.
#[derive(Default)]
pub(super) struct Record {
    pub(super) certain: u64,
    /// Of these, rays that begin on the shape and run through its inside.
    pub(super) within: u64,
    pub(super) undecided: u64,
    /// Largest error of `t` in units of its bound.
    pub(super) worst: f64,
}

/// Makes a ray at a target; the numbers are the target's size and the distance, in metres.
type Aim = fn(&mut Random, &Target, f64, f64) -> Shot;

/// A point near a rim of a shape whose size is about `unit` metres.
pub(super) fn place_near(random: &mut Random, rim: &[DVec3], unit: f64) -> DVec3 {
    let (a, b) = (rim[random.bits() as usize % rim.len()], rim[random.bits() as usize % rim.len()]);
    let share = [0.0, 0.5, random.number()][random.bits() as usize % 3];
    a.lerp(b, share) + random.point() * unit * random.power(-40, -10)
}

/// From a given distance, towards the rim.
fn from_afar(random: &mut Random, (_, rim): &Target, unit: f64, reach: f64) -> Shot {
    let target = place_near(random, rim, unit);
    // Some run along an axis, or as good as.
    let along = DVec3::AXES[random.bits() as usize % 3] + random.point() * random.power(-60, -10);
    let way = if random.bits().is_multiple_of(4) { along } else { random.point() };
    let from = target + way * reach;
    (Ray::new(from, target - from), None)
}

/// From the surface of a solid through its inside towards its rim.
fn from_within(random: &mut Random, target: &Target, unit: f64, reach: f64) -> Shot {
    let (ray, _) = from_afar(random, target, unit, reach);
    let Some(met) = target.0.cross(&ray, Span::AHEAD, None) else { return (ray, None) };
    let from = ray.at(met.t);
    let way = (place_near(random, &target.1, unit) - from).normalize_or_zero();
    // The backend does not ask about flatter ones.
    let inwards = way.dot(met.normal) < -f64::from(DIRECTION_ERROR);
    if inwards { (Ray::new(from, way * reach), Some(met.facet)) } else { (ray, None) }
}

/// Rays as the backend makes them.
pub(super) fn packet<S: Simd>(s: S, shots: &[Shot]) -> Rays<S> {
    let column = |of: &dyn Fn(&Ray) -> f64| {
        F::load(s, &shots.iter().map(|shot| of(&shot.0) as f32).collect::<Vec<_>>())
    };
    let triple = |of: &dyn Fn(&Ray) -> DVec3| {
        F3::new(column(&|ray| of(ray).x), column(&|ray| of(ray).y), column(&|ray| of(ray).z))
    };
    let (origin, direction) = (triple(&|ray| ray.origin), triple(&|ray| ray.direction));
    let inverse_length = F::splat(s, 1.0) / direction.dot(direction).sqrt();
    Rays { origin, direction: direction.scale(inverse_length), reach: magnitude(origin) }
}

/// What a kernel says, and on which facets; `None` for shapes without a kernel.
fn propose<S: Simd>(s: S, shape: &Shape, shots: &[Shot]) -> Option<(Proposal<S>, U<S>)> {
    let rays = &packet(s, shots);
    let leaving = U::load(s, &shots.iter().map(|shot| shot.1.unwrap_or(NOTHING)).collect::<Vec<_>>());
    let proposal = match shape {
        Shape::Cuboid(cuboid) => return Some(CuboidRow::new(cuboid, cuboid, 0).propose(s, rays, leaving)),
        Shape::Plane(plane) => PlaneRow::new(plane.point(), plane.normal(), 0).propose(s, rays),
        Shape::Sphere(sphere) => {
            SphereRow::new(sphere.center(), sphere.radius()).propose(s, rays, M::splat(s, false))
        }
        Shape::Rectangle(r) => FlatRow::rectangle(r.corner(), r.edges(), 0).propose(s, rays),
        Shape::Disk(d) => FlatRow::disk(d.center(), d.normal(), d.radius(), 0).propose(s, rays),
        Shape::Cylinder(c) => return Some(RoundRow::new(c.ends(), [c.radius(); 2], false).propose(s, rays)),
        Shape::Cone(c) => return Some(RoundRow::new(c.ends(), c.radii(), false).propose(s, rays)),
        Shape::Capsule(c) => return Some(RoundRow::new(c.ends(), [c.radius(); 2], true).propose(s, rays)),
        Shape::Triangle(triangle) => TriangleRow::new(triangle.corners(), 0, 0)?.propose(s, rays),
        Shape::Torus(torus) => return Some(propose_of(s, &TorusRow::new(torus), rays, leaving)),
        shape => {
            return Some(match SolidRow::whole(shape, shape, 0) {
                Some(kernel) => propose_of(s, &kernel, rays, leaving),
                None => propose_of(s, &FacetsRow::new(shape.faceted()?, 0)?, rays, leaving),
            });
        }
    };
    Some((proposal, U::splat(s, 0)))
}

/// What a kernel says of rays that leave these facets of its shape.
pub(super) fn propose_of<S: Simd>(
    s: S,
    kernel: &impl Kernel,
    rays: &Rays<S>,
    leaving: U<S>,
) -> (Proposal<S>, U<S>) {
    let (nothing, all) = (U::splat(s, NOTHING), M::splat(s, true));
    let prim = U::pick(leaving.is(NOTHING), nothing, U::splat(s, 0));
    let leaving = Leaving { prim, facet: leaving, any: true };
    let tried = Tried { prim: 0, lanes: all, leaving, entered: nothing, outside: false };
    let mut found = None;
    kernel.propose(s, rays, &tried, |crossing| {
        found = Some((crossing.proposal, crossing.facet.in_lanes(s)));
    });
    found.expect("it always proposes something")
}

/// Aims at targets of random sizes, which the function gets in metres.
fn attack(target: impl Fn(&mut Random, f64) -> Option<Target>) -> Record {
    attack_by(from_afar, target)
}

fn attack_by(aim: Aim, target: impl Fn(&mut Random, f64) -> Option<Target>) -> Record {
    let mut record = Record::default();
    let mut random = Random(7);
    for _ in 0..8_000 {
        let unit = random.unit();
        let Some(target) = target(&mut random, unit) else { continue };
        let reach = unit * random.power(-2, 8);
        let mut shot = || aim(&mut random, &target, unit, reach);
        dispatch!(Level::new(), s => try_one(s, &target.0, &mut shot, &mut record));
    }
    record
}

fn try_one<S: Simd>(s: S, shape: &Shape, shot: &mut impl FnMut() -> Shot, record: &mut Record) {
    let shots: Vec<Shot> = (0..F::<S>::LANES).map(|_| shot()).collect();
    let Some((proposal, facet)) = propose(s, shape, &shots) else { return };
    for (lane, (ray, leaving)) in shots.iter().enumerate() {
        let is = |mask: M<S>| mask.bits() >> lane & 1 == 1;
        if is(proposal.undecided) {
            record.undecided += 1;
            continue;
        }
        record.certain += 1;
        record.within += u64::from(leaving.is_some());
        let exact = shape.cross(ray, Span::AHEAD, *leaving);
        assert_eq!(is(proposal.hit), exact.is_some(), "{ray:?} {shape:?}");
        if let Some(crossing) = exact {
            assert_eq!(facet.lane(lane), crossing.facet, "{ray:?} {shape:?}");
            let off = (f64::from(proposal.t.lane(lane)) - crossing.t * ray.direction.length()).abs();
            let ratio = off / f64::from(proposal.error.lane(lane));
            assert!(ratio <= 1.0, "{ratio} of the bound: {ray:?} {shape:?}");
            record.worst = record.worst.max(ratio);
        }
    }
}

/// Both sides of the bound are met.
pub(super) fn assert_attacked(record: &Record, least: f64) {
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

/// A centre, a radius, an axis and a rim round it.
fn round(random: &mut Random, unit: f64) -> (DVec3, f64, DVec3, Vec<DVec3>) {
    let (center, radius) = (random.point() * unit * random.power(-4, 6), unit * random.power(-6, 6));
    let axis = random.point().normalize();
    let [a, b] = [axis.any_orthonormal_vector(), axis.cross(axis.any_orthonormal_vector())];
    let rim = (0..8).map(|i| center + (a * f64::from(i).sin() + b * f64::from(i).cos()) * radius);
    (center, radius, axis, rim.collect())
}

#[test]
fn spheres() {
    let record = attack(|random, unit| {
        let (center, radius, _, rim) = round(random, unit);
        Some((Sphere::new(center, radius).ok()?.into(), rim))
    });
    assert_attacked(&record, 0.05);
}

#[test]
fn disks() {
    let record = attack(|random, unit| {
        let (center, radius, axis, rim) = round(random, unit);
        Some((Disk::new(center, axis, radius).ok()?.into(), rim))
    });
    assert_attacked(&record, 0.02);
}

/// Ends, a radius, and two rims, points beyond the ends and places on the axis.
pub(super) fn swept(random: &mut Random, unit: f64) -> ([DVec3; 2], f64, Vec<DVec3>) {
    let (center, radius, axis, mut rim) = round(random, unit);
    let length = unit * random.power(-6, 6);
    let (to, up) = (center + axis * length, axis * radius);
    rim.extend(rim.clone().into_iter().map(|p| p + axis * length));
    rim.extend([center, to, center - up, to + up]);
    ([center, to], radius, rim)
}

#[test]
fn cylinders() {
    let record = attack(|random, unit| {
        let ([from, to], radius, rim) = swept(random, unit);
        Some((Cylinder::new(from, to, radius).ok()?.into(), rim))
    });
    assert_attacked(&record, 0.02);
}

#[test]
fn capsules() {
    let record = attack(|random, unit| {
        let ([from, to], radius, rim) = swept(random, unit);
        Some((Capsule::new(from, to, radius).ok()?.into(), rim))
    });
    assert_attacked(&record, 0.02);
}

#[test]
fn cones() {
    let record = attack(|random, unit| {
        let ([from, to], radius, rim) = swept(random, unit);
        let top = [0.0, radius * random.power(-4, 4)][random.bits() as usize % 2];
        Some((Cone::new(from, to, radius, top).ok()?.into(), rim))
    });
    assert_attacked(&record, 0.02);
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

/// A box, turned or not.
pub(super) fn some_box(random: &mut Random, unit: f64) -> Option<Target> {
    let corner = random.point() * unit * random.power(-4, 6);
    let size = random.point().abs() * unit * random.power(-4, 4);
    let cuboid = Cuboid::new(corner, corner + size).ok()?;
    let turned = Placement::IDENTITY
        .turned(corner, random.point(), random.number())
        .ok()?
        .moved(random.point() * unit * random.power(-4, 6))
        .ok()?;
    // Along axes too, and within faces.
    let place = if random.bits().is_multiple_of(2) { Placement::IDENTITY } else { turned };
    let rim = cuboid.object_bounds().corners().map(|p| place.point(p)).to_vec();
    Some((Shape::from(cuboid).placed(&place), rim))
}

#[test]
fn boxes() {
    assert_attacked(&attack(some_box), 0.02);
}

#[test]
fn boxes_from_within() {
    let record = attack_by(from_within, some_box);
    assert!(record.within > 1000, "{}", record.within);
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

/// The hull of some points, or of points on a ball.
pub(super) fn hull(random: &mut Random, unit: f64) -> Option<Target> {
    let (place, size) = (random.point() * unit * random.power(-4, 6), unit * random.power(-6, 4));
    let on_ball = random.bits().is_multiple_of(2);
    let points: Vec<_> = (0..4 + random.bits() % 12)
        .map(|_| random.point())
        .map(|p| place + size * if on_ball { p.normalize() } else { p })
        .collect();
    Some((Polyhedron::hull_of(points.iter().copied()).ok()?.into(), points))
}

#[test]
fn polyhedra() {
    assert_attacked(&attack(hull), 0.02);
}

#[test]
fn polyhedra_from_within() {
    let record = attack_by(from_within, hull);
    assert!(record.within > 1000, "{}", record.within);
    assert_attacked(&record, 0.02);
}

/// A torus, and points of its outer and inner rims and of its tops.
fn some_torus(random: &mut Random, unit: f64) -> Option<Target> {
    let (center, major, axis, _) = round(random, unit);
    let minor = major * [0.5, random.power(-6, -1), 1.0 - random.power(-6, -1)][random.bits() as usize % 3];
    let [a, b] = [axis.any_orthonormal_vector(), axis.cross(axis.any_orthonormal_vector())];
    let rim = (0..24_u32).map(|i| {
        let out = a * f64::from(i).sin() + b * f64::from(i).cos();
        center + out * major + [out, -out, axis, -axis][i as usize % 4] * minor
    });
    Some((Torus::new(center, axis, major, minor).ok()?.into(), rim.collect()))
}

#[test]
fn tori() {
    assert_attacked(&attack(some_torus), 0.02);
}

/// From its surface across its hole, or away.
fn from_outside(random: &mut Random, target: &Target, unit: f64, reach: f64) -> Shot {
    let (ray, _) = from_afar(random, target, unit, reach);
    let Some(met) = target.0.cross(&ray, Span::AHEAD, None) else { return (ray, None) };
    let from = ray.at(met.t);
    (Ray::new(from, place_near(random, &target.1, unit) - from), Some(met.facet))
}

#[test]
fn tori_that_rays_leave() {
    let record = attack_by(from_outside, some_torus);
    assert!(record.within > 1000, "{}", record.within);
    assert_attacked(&record, 0.02);
}

/// A star of five rays, standing anywhere, and its corners.
fn star(random: &mut Random, unit: f64) -> Option<Target> {
    let (center, radius, axis, _) = round(random, unit);
    let inner = radius * random.power(-4, -1);
    let outline: Vec<DVec2> = (0..10)
        .map(|i| DVec2::from_angle(f64::from(i) * 0.2 * PI) * if i % 2 == 0 { radius } else { inner })
        .collect();
    let height = radius * random.power(-3, 1);
    let prism = Prism::new(outline, height, center, axis).ok()?;
    let corners = prism.solid().corners().to_vec();
    Some((prism.into(), corners))
}

#[test]
fn prisms_that_are_not_convex() {
    assert_attacked(&attack(star), 0.02);
}

#[test]
fn prisms_that_rays_leave() {
    let record = attack_by(from_outside, star);
    assert!(record.within > 1000, "{}", record.within);
    assert_attacked(&record, 0.02);
}
