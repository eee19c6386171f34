//! Solids with tori, prisms and meshes of any numbers among their members, against points that plain formulas place inside or outside.

use std::f64::consts::TAU;

use glam::{DQuat, DVec2};

use super::lattice::mesh;
use super::*;
use crate::geometry::{Prism, Torus};

fn torus(center: [f64; 3], axis: [f64; 3], radii: [f64; 2]) -> Shape {
    Torus::new(center.into(), axis.into(), radii[0], radii[1]).unwrap().into()
}

/// 3 and 1 m, lying flat.
fn ring() -> Shape {
    torus([0.0; 3], [0.0, 1.0, 0.0], [3.0, 1.0])
}

/// All `t` at which a ray meets a solid, with the members.
fn places(solid: &Arc<Solid>, origin: [f64; 3], direction: [f64; 3]) -> Vec<(f64, u32)> {
    let ray = Ray::new(origin.into(), direction.into());
    all_hits(solid, &ray).into_iter().map(|(member, crossing)| (crossing.t, member)).collect()
}

fn assert_near(found: &[(f64, u32)], right: &[(f64, u32)]) {
    let near = |(a, b): (&(f64, u32), &(f64, u32))| a.1 == b.1 && (a.0 - b.0).abs() < 1e-14 * b.0;
    assert!(found.len() == right.len() && found.iter().zip(right).all(near), "{found:?}, not {right:?}");
}

#[test]
fn a_ring_is_cut_by_a_box() {
    let solid = combined(Operation::Difference, vec![ring(), cuboid([0.0, -2.0, -9.0], [9.0, 2.0, 9.0])]);
    // Of four places along the middle two are left; the cut is seen from the other side.
    assert_near(&places(&solid, [10.0, 0.0, 0.0], [-1.0, 0.0, 0.0]), &[(12.0, 0), (14.0, 0)]);
    assert_eq!(met(&solid, [10.0, 0.0, 3.0], [-1.0, 0.0, 0.0]), Some((10.0, 1, DVec3::X)));
    let kept = combined(Operation::Intersection, vec![ring(), cuboid([0.0, -2.0, -9.0], [9.0, 2.0, 9.0])]);
    assert_near(&places(&kept, [10.0, 0.0, 0.0], [-1.0, 0.0, 0.0]), &[(6.0, 0), (8.0, 0)]);
}

#[test]
fn a_ring_less_a_ring_leaves_nothing_or_a_pipe() {
    let nothing = combined(Operation::Difference, vec![ring(), ring()]);
    let pipe = combined(Operation::Difference, vec![ring(), torus([0.0; 3], [0.0, 2.0, 0.0], [3.0, 0.5])]);
    let one = combined(Operation::Union, vec![ring(), ring()]);
    for (origin, direction) in [
        ([10.0, 0.0, 0.0], [-1.0, 0.0, 0.0]),
        ([3.0, 9.0, 0.0], [0.1, -1.0, 0.3]),
        ([0.0, 0.25, 0.0], [1.0, 0.1, 0.7]),
        // Along the top, which is only touched.
        ([10.0, 1.0, 0.0], [-1.0, 0.0, 0.0]),
    ] {
        assert_eq!(places(&nothing, origin, direction), []);
        let alone = combined(Operation::Union, vec![ring()]);
        assert_near(&places(&one, origin, direction), &places(&alone, origin, direction));
    }
    let right = [(6.0, 0), (6.5, 1), (7.5, 1), (8.0, 0), (12.0, 0), (12.5, 1), (13.5, 1), (14.0, 0)];
    assert_near(&places(&pipe, [10.0, 0.0, 0.0], [-1.0, 0.0, 0.0]), &right);
}

#[test]
fn ordinary_rays_need_no_exact_numbers() {
    let star = Prism::new(star(), 2.0, DVec3::new(3.0, -1.0, 0.3), DVec3::Y).unwrap();
    let members = vec![ring(), star.into(), sphere([-3.0, 0.5, 0.2], 0.8)];
    let solid = combined(Operation::Difference, members);
    let (before, mut met) = (crate::exact::answers(), 0);
    for i in 0..1000_u32 {
        let at = |k: u32| f64::from(i * 8 + k).sin();
        let origin = DVec3::new(at(0), 1.0 + at(1), at(2)) * 6.0;
        let ray = Ray::new(origin, DVec3::new(at(3), 0.2 * at(4), at(5)) * 3.0 - origin);
        met += usize::from(hit(&solid, &ray, None).is_some());
    }
    let exact = (crate::exact::answers() - before).exact;
    assert!(met > 500 && exact < 5, "{met} {exact}");
}

#[test]
fn rings_that_touch_are_told_apart() {
    // Side by side; from within one along the line through both middles, out of it where the other begins.
    let beside = |off: f64| vec![ring(), torus([8.0 + off, 0.0, 0.0], [0.0, 1.0, 0.0], [3.0, 1.0])];
    let count =
        |off: f64| places(&combined(Operation::Union, beside(off)), [3.5, 0.0, 0.0], [1.0, 0.0, 0.0]).len();
    assert_eq!((count(0.0), count(f64::EPSILON * 8.0), count(-f64::EPSILON * 8.0)), (3, 5, 3));
}

/// A ball with bumps: an icosahedron whose triangles are parted in four, so many times.
fn bumpy(center: DVec3, times: u32) -> (Shape, Vec<[DVec3; 3]>) {
    let ends = [-1.0, 1.0];
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let mut points: Vec<DVec3> = Vec::new();
    for (a, b) in ends.into_iter().flat_map(|a| ends.map(|b| (a, b * golden))) {
        points.extend([DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)]);
    }
    let near = |a: DVec3, b: DVec3| (a.distance(b) - 2.0).abs() < 1e-9;
    let mut faces: Vec<[DVec3; 3]> = Vec::new();
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate().skip(i + 1) {
            for c in points.iter().skip(j + 1).filter(|c| near(*a, *b) && near(*b, **c) && near(*a, **c)) {
                faces.push(if a.cross(*b).dot(*c) > 0.0 { [*a, *b, *c] } else { [*a, *c, *b] });
            }
        }
    }
    for _ in 0..times {
        let split = |[a, b, c]: [DVec3; 3]| {
            let [ab, bc, ca] = [a + b, b + c, c + a].map(|p| p.normalize() * a.length());
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        faces = faces.into_iter().flat_map(split).collect();
    }
    let bump = |p: DVec3| {
        let p = p.normalize();
        center + p * (0.8 + 0.25 * (4.0 * p.x).sin() * (5.0 * p.y + 1.0).cos())
    };
    let corners: Vec<[f32; 3]> = faces.iter().flatten().map(|p| bump(*p).as_vec3().to_array()).collect();
    let triangles = (0..faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let wide = |p: &[f32; 3]| DVec3::from(p.map(f64::from));
    let placed = corners.chunks(3).map(|p| [wide(&p[0]), wide(&p[1]), wide(&p[2])]).collect();
    (mesh(corners, triangles), placed)
}

/// How often triangles go round a point, by the solid angles that they fill (van Oosterom and Strackee 1983).
fn rounds(triangles: &[[DVec3; 3]], point: DVec3) -> f64 {
    let angle = |corners: &[DVec3; 3]| {
        let [a, b, c] = corners.map(|p| p - point);
        let [x, y, z] = [a.length(), b.length(), c.length()];
        let below = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    triangles.iter().map(angle).sum::<f64>() / (2.0 * TAU)
}

/// A star with five points.
fn star() -> Vec<DVec2> {
    (0..10).map(|i| DVec2::from_angle(TAU * f64::from(i) / 10.0) * [1.0, 0.45][i as usize % 2]).collect()
}

/// Whether a closed outline goes round a point, by the angles under which its edges are seen.
fn goes_round(outline: &[DVec2], p: DVec2) -> bool {
    let angle = |i: usize| (outline[i] - p).angle_to(outline[(i + 1) % outline.len()] - p);
    (0..outline.len()).map(angle).sum::<f64>().abs() > 3.0
}

/// A ring, a star and a bumpy ball, each with what lies inside.
struct Sample {
    solid: Arc<Solid>,
    rule: Rule,
    inside: Vec<Box<dyn Fn(DVec3) -> bool>>,
}

impl Sample {
    fn new(at: [DVec3; 3], turn: DQuat, rule: Rule) -> Self {
        let (axis, middle) = (turn * DVec3::Z, at[0]);
        let ring = Torus::new(middle, axis, 0.8, 0.35).unwrap();
        let placement = crate::Placement::IDENTITY.turned(DVec3::ZERO, turn * DVec3::X, 1.0).unwrap();
        let placement = placement.moved(at[1]).unwrap();
        let shape: Shape = Prism::new(star(), 0.7, DVec3::ZERO, DVec3::Y).unwrap().into();
        let (ball, triangles) = bumpy(at[2], 1);
        let (outline, back) = (star(), placement.inverse());
        let inside: Vec<Box<dyn Fn(DVec3) -> bool>> = vec![
            Box::new(move |p| {
                let (from, along) = (p - middle, (p - middle).dot(axis));
                ((from - axis * along).length() - 0.8).hypot(along) < 0.35
            }),
            Box::new(move |p| {
                let own = back.point(p);
                (0.0..0.7).contains(&own.y) && goes_round(&outline, DVec2::new(own.x, -own.z))
            }),
            Box::new(move |p| rounds(&triangles, p) > 0.5),
        ];
        let shapes = vec![ring.into(), shape.placed(&placement), ball];
        Self { solid: Arc::new(Solid::new(shapes, rule.clone()).unwrap()), rule, inside }
    }

    fn holds(&self, point: DVec3) -> bool {
        self.rule.holds(&self.inside.iter().map(|inside| inside(point)).collect::<Vec<_>>())
    }
}

fn vector(reach: f64) -> impl Strategy<Value = DVec3> {
    [-reach..reach, -reach..reach, -reach..reach].prop_map(DVec3::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn solids_with_rings_stars_and_meshes_are_met_where_inside_and_outside_change(
        at in [vector(0.6), vector(0.6), vector(0.6)],
        turn in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0, 0.1..1.0],
        rule in rule(),
        rays in prop::collection::vec((vector(2.5), vector(1.0)), 6),
    ) {
        let sample = Sample::new(at, DQuat::from_array(turn).normalize(), rule);
        for (origin, direction) in rays {
            // Through the middle, more or less.
            let ray = Ray::new(origin, (direction - origin).normalize_or(DVec3::X));
            let found = all_hits(&sample.solid, &ray);
            let starts_inside = sample.holds(origin);
            let state = |t: f64| starts_inside != (found.iter().filter(|(_, hit)| hit.t < t).count() % 2 == 1);
            for k in 1..40 {
                let t = f64::from(k) * 0.15;
                let is_near = found.iter().any(|(_, hit)| (hit.t - t).abs() < 1e-6);
                prop_assert!(is_near || sample.holds(ray.at(t)) == state(t), "{:?} at {}: {:?}", &ray, t, &found);
            }
            for (i, (member, hit)) in found.iter().enumerate() {
                prop_assert_eq!(hit.normal.dot(ray.direction) < 0.0, state(hit.t + 1e-12));
                // What is left is not met again, and all else is.
                let left = Left { member: *member, facet: hit.facet };
                let on = Ray::new(ray.at(hit.t), ray.direction);
                let next = super::hit(&sample.solid, &on, Some(left)).map(|(member, next)| (member, hit.t + next.t));
                let right = found.get(i + 1).map(|(member, next)| (*member, next.t));
                let is_right = match (next, right) {
                    (Some(next), Some(right)) => next.0 == right.0 && (next.1 - right.1).abs() < 1e-9,
                    (next, right) => next == right,
                };
                prop_assert!(is_right, "{:?} left at {}: {:?}, not {:?}", &ray, hit.t, next, right);
            }
        }
    }
}

#[test]
fn a_mesh_as_a_member_is_met_as_it_is_alone() {
    let (ball, triangles) = bumpy(DVec3::ZERO, 3);
    let solid = combined(Operation::Intersection, vec![ball.clone(), cuboid([-9.0; 3], [9.0; 3])]);
    for i in 0..2000_u32 {
        let at = |k: u32| f64::from(i * 8 + k).sin();
        let origin = DVec3::new(at(0), at(1), at(2)) * 3.0;
        // At a corner, at the middle of an edge, or at any point of a triangle.
        let [p, q, r] = triangles[(i * 7 % 1280) as usize];
        let goal = match i % 3 {
            0 => p,
            1 => p.midpoint(q),
            _ => p * 0.2 + q * 0.5 + r * 0.3,
        };
        let ray = Ray::new(origin, goal - origin);
        // What is touched, at a corner or an edge that is seen against what is behind it, is no way into a solid; within rounding of
        // that both may tell otherwise.
        let touches = |t: f64| [-1e-6, 1e-6].iter().all(|off| rounds(&triangles, ray.at(t + off)) < 0.5);
        let mut span = Span::AHEAD;
        let alone = loop {
            let next = ball.cross(&ray, span, None);
            match next.filter(|next| touches(next.t)) {
                Some(touched) => span.min = touched.latest() + 1e-9,
                None => break next,
            }
        };
        let found = all_hits(&solid, &ray).into_iter().find(|(_, hit)| !touches(hit.t));
        // Each is known within its error.
        let is_same = match (alone, found) {
            (Some(alone), Some((_, found))) => (found.t - alone.t).abs() <= found.error + alone.error,
            (alone, found) => alone.is_none() && found.is_none(),
        };
        assert!(is_same, "{ray:?}: {alone:?} {found:?}");
    }
}
