mod lattice;
mod round;

use std::collections::BTreeSet;

use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::geometry::{Cuboid, Cylinder, Plane, Sphere, Tetrahedron};

fn cuboid(min: [f64; 3], max: [f64; 3]) -> Shape {
    Cuboid::new(min.into(), max.into()).unwrap().into()
}

fn sphere(center: [f64; 3], radius: f64) -> Shape {
    Sphere::new(center.into(), radius).unwrap().into()
}

fn combined(operation: Operation, shapes: Vec<Shape>) -> Arc<Solid> {
    let rule = Rule::Combined(operation, (0..shapes.len() as u32).map(Rule::Shape).collect());
    Arc::new(Solid::new(shapes, rule).unwrap())
}

/// The nearest place of all members.
fn hit(solid: &Arc<Solid>, ray: &Ray, leaving: Option<Left>) -> Option<(u32, Crossing)> {
    let members = 0..solid.shapes().len() as u32;
    let met = members.filter_map(|number| {
        let member = Member::new(Arc::clone(solid), number).unwrap();
        member.cross(ray, Span::AHEAD, leaving).map(|crossing| (number, crossing))
    });
    met.min_by(|a, b| a.1.t.total_cmp(&b.1.t))
}

/// All places ahead where a ray comes into a solid or out of it.
fn all_hits(solid: &Arc<Solid>, ray: &Ray) -> Vec<(u32, Crossing)> {
    let (mut found, mut span) = (Vec::new(), Span::AHEAD);
    loop {
        let members = 0..solid.shapes().len() as u32;
        let met = members.filter_map(|number| {
            let member = Member::new(Arc::clone(solid), number).unwrap();
            member.cross(ray, span, None).map(|crossing| (number, crossing))
        });
        let Some(next) = met.min_by(|a, b| a.1.t.total_cmp(&b.1.t)) else { return found };
        span.min = next.1.latest();
        found.push(next);
    }
}

fn met(solid: &Arc<Solid>, origin: [f64; 3], direction: [f64; 3]) -> Option<(f64, u32, DVec3)> {
    let ray = Ray::new(origin.into(), direction.into());
    hit(solid, &ray, None).map(|(member, crossing)| (crossing.t, member, crossing.normal))
}

#[test]
fn a_cut_shows_the_face_of_what_cuts() {
    let solid =
        combined(Operation::Difference, vec![cuboid([-2.0; 3], [2.0; 3]), sphere([0.0, 2.0, 0.0], 1.0)]);
    assert_eq!(met(&solid, [0.0, 9.0, 0.0], [0.0, -1.0, 0.0]), Some((8.0, 1, DVec3::Y)));
    assert_eq!(met(&solid, [1.5, 9.0, 0.0], [0.0, -1.0, 0.0]), Some((7.0, 0, DVec3::Y)));
    // From within the hollow, and from within the solid up into the hollow.
    assert_eq!(met(&solid, [0.0, 1.5, 0.0], [0.0, -1.0, 0.0]), Some((0.5, 1, DVec3::Y)));
    assert_eq!(met(&solid, [0.0, 0.5, 0.0], [0.0, 1.0, 0.0]), Some((0.5, 1, DVec3::Y)));
    assert_eq!(met(&solid, [0.0, 1.5, 0.0], [0.0, 1.0, 0.0]), None);
}

#[test]
fn the_common_part_of_a_ball_and_half_of_space_is_half_a_ball() {
    let below: Shape = Plane::new(DVec3::ZERO, DVec3::Y).unwrap().into();
    let solid = combined(Operation::Intersection, vec![sphere([0.0; 3], 1.0), below]);
    assert_eq!(met(&solid, [0.0, 9.0, 0.0], [0.0, -1.0, 0.0]), Some((9.0, 1, DVec3::Y)));
    assert_eq!(met(&solid, [0.0, -9.0, 0.0], [0.0, 1.0, 0.0]), Some((8.0, 0, DVec3::NEG_Y)));
    assert_eq!(met(&solid, [-9.0, 0.5, 0.0], [1.0, 0.0, 0.0]), None);
}

#[test]
fn a_drilled_hole_is_seen_through() {
    let drill = Cylinder::new(DVec3::new(0.0, -2.0, 0.0), DVec3::new(0.0, 2.0, 0.0), 0.5).unwrap();
    let block = combined(Operation::Difference, vec![cuboid([-1.0; 3], [1.0; 3]), drill.clone().into()]);
    assert_eq!(met(&block, [0.25, 9.0, 0.0], [0.0, -1.0, 0.0]), None);
    assert_eq!(met(&block, [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]), Some((0.5, 1, DVec3::NEG_X)));
    assert_eq!(
        met(&block, [0.25, 9.0, 0.0], [0.25, -9.0, 0.0]).map(|(t, member, _)| (t, member)),
        Some((1.0, 1))
    );
    // A blind hole has a floor: the cap of what drilled it.
    let short = Cylinder::new(DVec3::ZERO, DVec3::Y * 2.0, 0.5).unwrap();
    let blind = combined(Operation::Difference, vec![cuboid([-1.0; 3], [1.0; 3]), short.into()]);
    assert_eq!(met(&blind, [0.25, 9.0, 0.0], [0.0, -1.0, 0.0]), Some((9.0, 1, DVec3::Y)));
    assert!(Solid::new(vec![drill.opened().into()], Rule::Shape(0)).is_none());
}

#[test]
fn faces_that_lie_on_each_other_leave_nothing_between() {
    let halves = vec![cuboid([0.0; 3], [1.0; 3]), cuboid([1.0, 0.0, 0.0], [2.0, 1.0, 1.0])];
    let whole = combined(Operation::Union, halves.clone());
    assert_eq!(met(&whole, [0.5, 0.5, 0.5], [1.0, 0.0, 0.0]), Some((1.5, 1, DVec3::X)));
    assert_eq!(met(&whole, [-1.0, 0.5, 0.5], [1.0, 0.0, 0.0]), Some((1.0, 0, DVec3::NEG_X)));
    // What is common to both is a face, which encloses nothing.
    assert_eq!(
        met(&combined(Operation::Intersection, halves.clone()), [-1.0, 0.5, 0.5], [1.0, 0.0, 0.0]),
        None
    );
    // A lid as high as the box leaves no skin.
    let lid = vec![cuboid([0.0; 3], [1.0; 3]), cuboid([0.25, 0.5, 0.25], [0.75, 1.0, 0.75])];
    let pot = combined(Operation::Difference, lid);
    assert_eq!(met(&pot, [0.5, 9.0, 0.5], [0.0, -1.0, 0.0]), Some((8.5, 1, DVec3::Y)));
    let nothing = combined(Operation::Difference, vec![cuboid([0.0; 3], [1.0; 3]); 2]);
    assert_eq!(met(&nothing, [0.5, 9.0, 0.5], [0.0, -1.0, 0.0]), None);
}

#[test]
fn a_ray_that_leaves_a_face_leaves_those_that_lie_on_it() {
    // Two slabs whose upper sides are one; the start lies a rounding below both.
    let solid = combined(
        Operation::Union,
        vec![cuboid([0.0; 3], [1.0, 0.1, 1.0]), cuboid([0.5, 0.0, 0.0], [2.0, 0.1, 1.0])],
    );
    let start = DVec3::new(0.75, 0.1_f64.next_down(), 0.5);
    let left = Some(Left { member: 0, facet: 3 });
    assert!(hit(&solid, &Ray::new(start, DVec3::new(0.1, 1.0, 0.0)), None).is_some());
    assert_eq!(hit(&solid, &Ray::new(start, DVec3::new(0.1, 1.0, 0.0)), left), None);
    // Downwards it goes through both.
    let through = hit(&solid, &Ray::new(start, DVec3::NEG_Y), left).unwrap();
    assert!((through.1.t - 0.1).abs() < 1e-15 && through.1.normal == DVec3::NEG_Y, "{through:?}");
}

#[test]
fn what_only_touches_is_not_met() {
    let solid = combined(Operation::Union, vec![sphere([0.0; 3], 1.0), cuboid([5.0; 3], [6.0; 3])]);
    assert_eq!(met(&solid, [-9.0, 1.0, 0.0], [1.0, 0.0, 0.0]), None);
}

#[test]
fn open_surfaces_make_no_solids() {
    let flat: Shape = crate::geometry::Rectangle::new(DVec3::ZERO, DVec3::X, DVec3::Y).unwrap().into();
    assert_eq!(Solid::new(vec![flat], Rule::Shape(0)), None);
    assert_eq!(Solid::new(vec![sphere([0.0; 3], 1.0)], Rule::Shape(1)), None);
}

/// A fraction with a positive denominator.
type Fraction = (i64, i64);

/// Where a ray meets a solid of boxes with whole numbers for corners, by asking in the middle between all places where it
/// crosses any box; in fractions.
fn reference(
    boxes: &[[[i64; 3]; 2]],
    rule: &Rule,
    origin: [i64; 3],
    direction: [i64; 3],
) -> Option<Fraction> {
    let mut places: Vec<Fraction> = Vec::new();
    for corner in boxes.iter().flatten() {
        for axis in (0..3).filter(|&axis| direction[axis] != 0) {
            let (top, bottom) = (corner[axis] - origin[axis], direction[axis]);
            places.push(if bottom < 0 { (-top, -bottom) } else { (top, bottom) });
        }
    }
    places.retain(|&(top, _)| top >= 0);
    places.push((0, 1));
    places.sort_by(|a, b| (a.0 * b.1).cmp(&(b.0 * a.1)));
    places.dedup_by(|a, b| a.0 * b.1 == b.0 * a.1);
    let end = places.last().map(|&(top, bottom)| (top + bottom, bottom))?;
    places.push(end);
    let middles = places
        .windows(2)
        .map(|pair| (pair[0].0 * pair[1].1 + pair[1].0 * pair[0].1, 2 * pair[0].1 * pair[1].1));
    let is_inside = |(top, bottom): Fraction| {
        // Faces a line runs in count as inside, as a box has them.
        let holds = |[min, max]: &[[i64; 3]; 2]| {
            (0..3).all(|axis| {
                let at = origin[axis] * bottom + direction[axis] * top;
                min[axis] * bottom <= at && at <= max[axis] * bottom
            })
        };
        let inside: Vec<bool> = boxes.iter().map(holds).collect();
        rule.holds(&inside)
    };
    let inside: Vec<bool> = middles.map(is_inside).collect();
    (1..inside.len()).find(|&i| inside[i] != inside[i - 1]).map(|i| places[i])
}

fn rule() -> impl Strategy<Value = Rule> {
    let operation = || prop::sample::select(&Operation::ALL[..]);
    (operation(), operation(), any::<bool>()).prop_map(|(outer, inner, first)| {
        let pair = Rule::Combined(inner, vec![Rule::Shape(0), Rule::Shape(1)]);
        let third = Rule::Shape(2);
        Rule::Combined(outer, if first { vec![pair, third] } else { vec![third, pair] })
    })
}

fn whole_box() -> impl Strategy<Value = [[i64; 3]; 2]> {
    [(0_i64..4, 1_i64..4), (0_i64..4, 1_i64..4), (0_i64..4, 1_i64..4)]
        .prop_map(|sides| [sides.map(|(min, _)| min), sides.map(|(min, size)| min + size)])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn solids_of_boxes_with_common_faces_are_met_where_fractions_say(
        boxes in [whole_box(), whole_box(), whole_box()],
        rule in rule(),
        origin in [-2_i64..9, -2_i64..9, -2_i64..9],
        direction in [-3_i64..4, -3_i64..4, -3_i64..4],
    ) {
        prop_assume!(direction != [0; 3]);
        let wide = |v: [i64; 3]| v.map(|v| v as f64);
        let shapes = boxes.iter().map(|[min, max]| cuboid(wide(*min), wide(*max))).collect();
        let solid = Arc::new(Solid::new(shapes, rule.clone()).unwrap());
        let found = met(&solid, wide(origin), wide(direction)).map(|(t, ..)| t);
        let expected = reference(&boxes, &rule, origin, direction).map(|(top, bottom)| top as f64 / bottom as f64);
        prop_assert_eq!(found, expected.filter(|t| *t > 0.0));
    }

    #[test]
    fn solids_of_many_kinds_change_between_inside_and_outside_where_they_are_met(
        centers in prop::collection::vec([-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], 3),
        rule in rule(),
        origin in [-3.0..3.0_f64, -3.0..3.0, -3.0..3.0],
        direction in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0],
    ) {
        let [a, b, c] = [0, 1, 2].map(|i| DVec3::from(centers[i]));
        let pyramid = Tetrahedron::new(c, c + DVec3::X, c + DVec3::Y * 1.5, c + DVec3::Z).unwrap();
        let shapes = vec![Sphere::new(a, 0.9).unwrap().into(), Cuboid::new(b, b + 1.1).unwrap().into(), pyramid.clone().into()];
        let holds = |p: DVec3| {
            let corner = p - c;
            let inside = [
                p.distance(a) < 0.9,
                (p - b).cmpgt(DVec3::ZERO).all() && (p - b).cmplt(DVec3::splat(1.1)).all(),
                corner.cmpgt(DVec3::ZERO).all() && corner.x + corner.y / 1.5 + corner.z < 1.0,
            ];
            rule.holds(&inside)
        };
        let ray = Ray::new(origin.into(), DVec3::from(direction).normalize_or(DVec3::X));
        let solid = Arc::new(Solid::new(shapes, rule.clone()).unwrap());
        let found = hit(&solid, &ray, None);
        let until = found.map_or(12.0, |(_, crossing)| crossing.t);
        // Nothing changes before, unless in a piece too thin for the steps.
        let steps: BTreeSet<bool> = (1..2000).map(|k| holds(ray.at(until * f64::from(k) / 2000.0))).collect();
        prop_assert!(steps.len() == 1 || found.is_some() && steps.len() == 2 && until < 1e-6);
        if let Some((_, crossing)) = found {
            let [before, after] = [-1e-9, 1e-9].map(|off| holds(ray.at(crossing.t + off)));
            if before == after {
                prop_assert!(thin(&holds, &ray, crossing.t));
            } else {
                prop_assert_eq!(crossing.normal.dot(ray.direction) < 0.0, after);
            }
        }
    }
}

/// Whether the solid is thinner there than what lies between two places that are asked.
fn thin(holds: &impl Fn(DVec3) -> bool, ray: &Ray, t: f64) -> bool {
    let near: BTreeSet<bool> = (-50..50).map(|k| holds(ray.at(t + 1e-10 * f64::from(k)))).collect();
    near.len() == 2 && holds(ray.at(t - 1e-9)) == holds(ray.at(t + 1e-9))
}
