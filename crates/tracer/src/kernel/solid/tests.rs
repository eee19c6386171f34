//! Is what the kernel says of parts of solids right wherever it is certain? Rays past edges and corners, along faces and from
//! surfaces, against the exact answers of [`Member::cross`].

use std::sync::Arc;

use catoptra_core::geometry::Plane;
use catoptra_core::glam::DVec3;
use catoptra_core::solid::{Left, Rule, Solid};
use catoptra_core::{Member, Operation, Placement, Ray, Shape, Span};
use fearless_simd::{Level, Simd, dispatch};

use super::super::error_bounds_tests::{
    Record, assert_attacked, hull, packet, place_near, propose_of, some_box, swept,
};
use super::SolidRow;
use crate::film::NOTHING;
use crate::lanes::{F, M, U};
use crate::random::Random;

/// A convex shape near the origin, and points of its rim.
fn some_shape(random: &mut Random) -> Option<(Shape, Vec<DVec3>)> {
    use catoptra_core::geometry::{Capsule, Cone, Cylinder, Sphere};
    let kind = random.bits() % 7;
    if kind < 2 {
        return if kind == 0 { some_box(random, 1.0) } else { hull(random, 1.0) };
    }
    let ([from, to], radius, rim) = swept(random, 1.0);
    let shape: Shape = match kind {
        2 => Sphere::new(from, radius).ok()?.into(),
        3 => Cylinder::new(from, to, radius).ok()?.into(),
        4 => Capsule::new(from, to, radius).ok()?.into(),
        5 => Cone::new(from, to, radius, radius / 2.0).ok()?.into(),
        _ => Plane::new(from, to - from).ok()?.into(),
    };
    Some((shape, rim))
}

/// A rule over shapes of these numbers.
fn some_rule(random: &mut Random, shapes: &[u32]) -> Rule {
    let operation = Operation::ALL[random.bits() as usize % 3];
    if let [one] = shapes {
        return Rule::Shape(*one);
    }
    let cut = 1 + random.bits() as usize % (shapes.len() - 1);
    let (left, right) = shapes.split_at(cut);
    let mut members = vec![some_rule(random, left)];
    if random.bits().is_multiple_of(2) {
        members.push(some_rule(random, right));
    } else {
        members.extend(right.iter().map(|shape| Rule::Shape(*shape)));
    }
    Rule::Combined(operation, members)
}

/// Moved so that shapes overlap, some of them with common faces.
fn some_solid(random: &mut Random) -> Option<(Arc<Solid>, Vec<DVec3>)> {
    let count = 2 + random.bits() as u32 % 3;
    let (mut shapes, mut rim) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let (shape, points) = some_shape(random)?;
        let place = if random.bits().is_multiple_of(2) { points[0] } else { random.point() };
        let scale = 1.0 / points.iter().map(|p| p.distance(place)).fold(1e-9, f64::max);
        let put = Placement::IDENTITY.moved(-place).ok()?.scaled(scale).ok()?;
        rim.extend(points.iter().map(|p| put.point(*p)));
        shapes.push(shape.placed(&put));
    }
    let rule = some_rule(random, &(0..count).collect::<Vec<_>>());
    Some((Arc::new(Solid::new(shapes, rule)?), rim))
}

/// A ray, and which surface of the solid it leaves.
fn shot(random: &mut Random, parts: &[Member], rim: &[DVec3]) -> (Ray, Option<Left>) {
    let target = place_near(random, rim, 1.0);
    let way = if random.bits().is_multiple_of(3) { random.axis() } else { random.point() };
    let from = target + way * random.power(-2, 4);
    let ray = Ray::new(from, target - from);
    if random.bits().is_multiple_of(2) {
        return (ray, None);
    }
    let met = parts.iter().filter_map(|part| Some((part, part.cross(&ray, Span::AHEAD, None)?)));
    let Some((part, met)) = met.min_by(|a, b| a.1.t.total_cmp(&b.1.t)) else { return (ray, None) };
    let start = ray.at(met.t);
    let direction = place_near(random, rim, 1.0) - start;
    (Ray::new(start, direction), Some(Left { member: part.number(), facet: met.facet }))
}

fn try_one<S: Simd>(s: S, random: &mut Random, record: &mut Record) -> Option<()> {
    let (solid, rim) = some_solid(random)?;
    let count = solid.shapes().len() as u32;
    let parts: Vec<Member> = (0..count).filter_map(|i| Member::new(Arc::clone(&solid), i)).collect();
    let shots: Vec<_> = (0..F::<S>::LANES).map(|_| shot(random, &parts, &rim)).collect();
    let rays: Vec<_> = shots.iter().map(|shot| (shot.0, None)).collect();
    for part in &parts {
        let kernel = SolidRow::member(part, |shape| Some(shape.clone()), 0)?;
        let facets: Vec<u32> = shots
            .iter()
            .map(|(_, left)| {
                left.filter(|left| left.member == part.number()).map_or(NOTHING, |left| left.facet)
            })
            .collect();
        let (proposal, facet) = propose_of(s, &kernel, &packet(s, &rays), U::load(s, &facets));
        for (lane, (ray, left)) in shots.iter().enumerate() {
            let is = |mask: M<S>| mask.bits() >> lane & 1 == 1;
            if !ray.is_valid() {
                continue;
            }
            if is(proposal.undecided) {
                record.undecided += 1;
                continue;
            }
            record.certain += 1;
            record.within += u64::from(left.is_some());
            let exact = part.cross(ray, Span::AHEAD, *left);
            assert_eq!(is(proposal.hit), exact.is_some(), "{ray:?} {left:?} {part:?}");
            let Some(crossing) = exact else { continue };
            assert_eq!(facet.lane(lane), crossing.facet, "{ray:?} {left:?} {part:?}");
            let off = (f64::from(proposal.t.lane(lane)) - crossing.t * ray.direction.length()).abs();
            let ratio = off / f64::from(proposal.error.lane(lane));
            assert!(ratio <= 1.0, "{ratio} of the bound: {ray:?} {part:?}");
            record.worst = record.worst.max(ratio);
        }
    }
    Some(())
}

#[test]
fn parts_of_solids() {
    let (mut random, mut record) = (Random(11), Record::default());
    for _ in 0..6_000 {
        dispatch!(Level::new(), s => try_one(s, &mut random, &mut record));
    }
    assert!(record.within > 10_000, "{}", record.within);
    assert_attacked(&record, 0.02);
}

#[test]
fn normals_of_what_is_taken_away_point_the_other_way() {
    let ball = |x: f64| Shape::from(catoptra_core::geometry::Sphere::new(DVec3::X * x, 1.0).unwrap());
    let rule = Rule::Combined(Operation::Difference, vec![Rule::Shape(0), Rule::Shape(1)]);
    let solid = Arc::new(Solid::new(vec![ball(0.0), ball(0.5)], rule).unwrap());
    let kernel = |number| {
        let member = Member::new(Arc::clone(&solid), number).unwrap();
        SolidRow::member(&member, |shape| Some(shape.clone()), 0).unwrap()
    };
    assert_eq!([kernel(0).outwards, kernel(1).outwards], [1.0, -1.0]);
}
