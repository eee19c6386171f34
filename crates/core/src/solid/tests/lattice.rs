//! Solids of bodies whose corners are whole numbers, against fractions: rays along faces and edges, through corners, and rays
//! that leave what they have met.

use super::*;
use crate::geometry::{Mesh, Prism};
use crate::{MeshSource, TriangleMesh};

/// A fraction with a positive denominator.
type Fraction = (i128, i128);

/// A body of which fractions tell what lies inside.
#[derive(Debug, Clone)]
enum Body {
    Cuboid([[i128; 3]; 2]),
    /// The same as twelve triangles.
    Crate([[i128; 3]; 2]),
    /// All at that distance from a corner of the lattice, counted along the axes; eight triangles.
    Octahedron([i128; 3], i128),
    /// An upright prism from a place, of a height, over one of the [`OUTLINES`].
    Prism([i128; 3], i128, usize),
}

/// An L, a star and a U.
const OUTLINES: [&[[i128; 2]]; 3] = [
    &[[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]],
    &[[3, 0], [1, 1], [0, 3], [-1, 1], [-3, 0], [-1, -1], [0, -3], [1, -1]],
    &[[0, 0], [3, 0], [3, 3], [2, 3], [2, 1], [1, 1], [1, 3], [0, 3]],
];

fn wide(v: [i128; 3]) -> DVec3 {
    DVec3::from(v.map(|c| c as f64))
}

pub(super) fn mesh(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Shape {
    let mesh = Arc::new(TriangleMesh::new(positions, triangles, None, None).unwrap());
    Mesh::new(MeshSource { path: "mesh.ply".into(), mesh }).into()
}

/// The box between two corners as twelve triangles.
pub(super) fn crate_of(min: DVec3, max: DVec3) -> Shape {
    let corners = (0..8_u32)
        .map(|i| [0, 1, 2].map(|axis: usize| if i >> axis & 1 == 1 { max[axis] } else { min[axis] } as f32));
    let triangles = (0..3_u32).flat_map(|axis| {
        let [up, right, far] = [1 << axis, 1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3)];
        let quad = |base: u32| [base, base + right, base + right + far, base + far];
        let halves = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
        let [mut low, high] = [quad(0), quad(up)];
        low.reverse();
        [halves(low), halves(high)].concat()
    });
    mesh(corners.collect(), triangles.collect())
}

impl Body {
    fn shape(&self) -> Shape {
        match self {
            Self::Cuboid([min, max]) => Cuboid::new(wide(*min), wide(*max)).unwrap().into(),
            Self::Crate([min, max]) => crate_of(wide(*min), wide(*max)),
            Self::Octahedron(center, reach) => {
                let tip = |i: usize| {
                    let mut tip = *center;
                    tip[i / 2] += if i.is_multiple_of(2) { *reach } else { -reach };
                    tip.map(|c| c as f32)
                };
                let face = |signs: usize| {
                    let [x, y, z] = [0, 1, 2].map(|axis| (2 * axis + (signs >> axis & 1)) as u32);
                    if signs.count_ones().is_multiple_of(2) { [x, y, z] } else { [x, z, y] }
                };
                mesh((0..6).map(tip).collect(), (0..8).map(face).collect())
            }
            Self::Prism(from, height, outline) => {
                let outline = OUTLINES[*outline].iter().map(|p| glam::DVec2::from(p.map(|c| c as f64)));
                Prism::new(outline, *height as f64, wide(*from), DVec3::Y).unwrap().into()
            }
        }
    }

    /// Its planes, each as a normal and its product with a point on it.
    fn planes(&self) -> Vec<([i128; 3], i128)> {
        let across = |axis: usize, at: i128| {
            let mut normal = [0; 3];
            normal[axis] = 1;
            (normal, at)
        };
        match self {
            Self::Cuboid(ends) | Self::Crate(ends) => {
                ends.iter().flat_map(|end| [0, 1, 2].map(|axis| across(axis, end[axis]))).collect()
            }
            Self::Octahedron(center, reach) => {
                let normals = (0..8).map(|signs| [0, 1, 2].map(|axis| 1 - 2 * (signs >> axis & 1)));
                normals.map(|normal| (normal, dot(normal, *center) + reach)).collect()
            }
            Self::Prism(from, height, outline) => {
                let corners = OUTLINES[*outline];
                let side = |i: usize| {
                    let ([a, b], [c, d]) = (corners[i], corners[(i + 1) % corners.len()]);
                    let (normal, on) = ([d - b, 0, c - a], [from[0] + a, 0, from[2] - b]);
                    (normal, dot(normal, on))
                };
                let caps = [across(1, from[1]), across(1, from[1] + height)];
                caps.into_iter().chain((0..corners.len()).map(side)).collect()
            }
        }
    }

    /// Whether it holds a point, its surface included, given times `times`.
    fn holds(&self, p: [i128; 3], times: i128) -> bool {
        match self {
            Self::Cuboid([min, max]) | Self::Crate([min, max]) => {
                (0..3).all(|i| min[i] * times <= p[i] && p[i] <= max[i] * times)
            }
            Self::Octahedron(center, reach) => {
                (0..3).map(|i| (p[i] - center[i] * times).abs()).sum::<i128>() <= reach * times
            }
            Self::Prism(from, height, outline) => {
                let level = (from[1] * times..=(from[1] + height) * times).contains(&p[1]);
                level && is_in([p[0] - from[0] * times, from[2] * times - p[2]], times, OUTLINES[*outline])
            }
        }
    }
}

fn dot(a: [i128; 3], b: [i128; 3]) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Whether an outline holds a point, its edges included, by the edges that lie to its right.
fn is_in([x, y]: [i128; 2], times: i128, outline: &[[i128; 2]]) -> bool {
    let mut inside = false;
    for i in 0..outline.len() {
        let [[a, b], [c, d]] = [i, (i + 1) % outline.len()].map(|i| outline[i].map(|c| c * times));
        let side = (c - a) * (y - b) - (d - b) * (x - a);
        let between = |v: i128, p: i128, q: i128| p.min(q) <= v && v <= p.max(q);
        if side == 0 && between(x, a, c) && between(y, b, d) {
            return true;
        }
        if (b > y) != (d > y) && (side > 0) == (d > b) {
            inside = !inside;
        }
    }
    inside
}

/// All places ahead where a ray comes into a solid of such bodies or out of it, by asking in the middle between all places where
/// it crosses any plane of one.
fn reference(bodies: &[Body], rule: &Rule, origin: [i128; 3], direction: [i128; 3]) -> Vec<Fraction> {
    let mut places: Vec<Fraction> = vec![(0, 1)];
    for (normal, at) in bodies.iter().flat_map(Body::planes) {
        let (top, bottom) = (at - dot(normal, origin), dot(normal, direction));
        if bottom != 0 && top * bottom > 0 {
            places.push((top.abs(), bottom.abs()));
        }
    }
    places.sort_by(|a, b| (a.0 * b.1).cmp(&(b.0 * a.1)));
    places.dedup_by(|a, b| a.0 * b.1 == b.0 * a.1);
    let last = places[places.len() - 1];
    places.push((last.0 + last.1, last.1));
    let is_inside = |pair: &[Fraction]| {
        let (top, bottom) = (pair[0].0 * pair[1].1 + pair[1].0 * pair[0].1, 2 * pair[0].1 * pair[1].1);
        let point = [0, 1, 2].map(|i| origin[i] * bottom + direction[i] * top);
        rule.holds(&bodies.iter().map(|body| body.holds(point, bottom)).collect::<Vec<_>>())
    };
    let inside: Vec<bool> = places.windows(2).map(is_inside).collect();
    (1..inside.len()).filter(|&i| inside[i] != inside[i - 1]).map(|i| places[i]).collect()
}

fn value((top, bottom): Fraction) -> f64 {
    top as f64 / bottom as f64
}

fn body() -> impl Strategy<Value = Body> {
    let place = || [-2_i128..4, -2_i128..4, -2_i128..4];
    let ends = || {
        (place(), [1_i128..4, 1_i128..4, 1_i128..4])
            .prop_map(|(min, size)| [min, [0, 1, 2].map(|i| min[i] + size[i])])
    };
    prop_oneof![
        1 => ends().prop_map(Body::Cuboid),
        2 => ends().prop_map(Body::Crate),
        1 => (place(), 1_i128..4).prop_map(|(center, reach)| Body::Octahedron(center, reach)),
        3 => (place(), 1_i128..4, 0_usize..3).prop_map(|(from, height, outline)| Body::Prism(from, height, outline)),
    ]
}

type Line = ([i128; 3], [i128; 3]);

fn line() -> impl Strategy<Value = Line> {
    ([-4_i128..7, -4_i128..7, -4_i128..7], [-3_i128..4, -3_i128..4, -3_i128..4])
        .prop_filter("a ray runs somewhere", |(_, direction)| *direction != [0; 3])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(5000))]

    #[test]
    fn solids_of_concave_members_are_met_where_fractions_say(
        bodies in [body(), body(), body()],
        rule in rule(),
        lines in prop::collection::vec(line(), 6),
    ) {
        let solid = Arc::new(Solid::new(bodies.iter().map(Body::shape).collect(), rule.clone()).unwrap());
        for (origin, direction) in lines {
            let ray = Ray::new(wide(origin), wide(direction));
            let expected = reference(&bodies, &rule, origin, direction);
            let found = all_hits(&solid, &ray);
            prop_assert_eq!(found.len(), expected.len(), "{:?} {:?}", &ray, &expected);
            for ((_, crossing), expected) in found.iter().zip(&expected) {
                let right = value(*expected);
                prop_assert!((crossing.t - right).abs() <= 1e-13 * right, "{} {}", crossing.t, right);
            }
            // From one place to the next, leaving each surface; where the places are numbers, all is as exact.
            for (i, (member, crossing)) in found.iter().enumerate() {
                let (top, bottom) = expected[i];
                if crossing.t * bottom as f64 == top as f64 && (bottom & (bottom - 1)) == 0 {
                    let on = Ray::new(ray.at(crossing.t), ray.direction);
                    let left = Left { member: *member, facet: crossing.facet };
                    let next = hit(&solid, &on, Some(left)).map(|(_, next)| crossing.t + next.t);
                    let right = expected.get(i + 1).map(|place| value(*place));
                    let is_right = match (next, right) {
                        (Some(next), Some(right)) => (next - right).abs() < 1e-12,
                        (next, right) => next == right,
                    };
                    prop_assert!(is_right, "{:?} left at {}: {:?}, not {:?}", &ray, crossing.t, next, right);
                }
            }
        }
    }
}

#[test]
fn a_box_of_triangles_and_a_box_are_one() {
    let (min, max) = (DVec3::ZERO, DVec3::ONE);
    let pair = || vec![crate_of(min, max), cuboid([0.0; 3], [1.0; 3])];
    for (operation, is_there) in
        [(Operation::Union, true), (Operation::Intersection, true), (Operation::Difference, false)]
    {
        let solid = combined(operation, pair());
        for (origin, direction) in [
            ([0.5, 0.5, 9.0], [0.0, 0.0, -1.0]),
            ([0.25, 9.0, 0.25], [0.0, -1.0, 0.0]),
            // Along a face, along an edge, through two edges and through two corners.
            ([0.0, 0.5, 9.0], [0.0, 0.0, -1.0]),
            ([1.0, 1.0, 9.0], [0.0, 0.0, -1.0]),
            ([-1.0, 0.5, -1.0], [1.0, 0.0, 1.0]),
            ([-2.0, -2.0, -2.0], [1.0, 1.0, 1.0]),
        ] {
            let ray = Ray::new(origin.into(), direction.into());
            assert_eq!(all_hits(&solid, &ray).len(), if is_there { 2 } else { 0 }, "{operation:?} {ray:?}");
        }
    }
    // Where both faces are one, the first is seen.
    let both = combined(Operation::Union, pair());
    assert_eq!(met(&both, [0.5, 0.25, 9.0], [0.0, 0.0, -1.0]), Some((8.0, 0, DVec3::Z)));
}

#[test]
fn where_rounding_has_put_a_start_beside_an_edge_the_ray_goes_where_it_runs() {
    let solid = combined(Operation::Union, vec![Body::Prism([0; 3], 2, 0).shape()]);
    let leave = |facet: u32, origin: [f64; 3], direction: [f64; 3]| {
        let (ray, left) = (Ray::new(origin.into(), direction.into()), Some(Left { member: 0, facet }));
        [None, left].map(|left| hit(&solid, &ray, left).map(|(_, hit)| (hit.facet, hit.t)))
    };
    // Outwards from the side at x = 0, within both it and the side at z = 0 by a rounding: through neither.
    let [met, left] = leave(7, [1e-17, 1.0, -1e-17], [-1.0, 0.0, 4.0]);
    assert_eq!((met.map(|(facet, _)| facet), left), (Some(2), None));
    // Inwards by the side at x = 1, at the edge in the hollow of the L, from a rounding within the other arm.
    let [met, left] = leave(5, [1.0 + 2.0 * f64::EPSILON, 1.0, -1.0 + f64::EPSILON], [-1.0, 0.0, -1.5]);
    assert_eq!(met.map(|(facet, _)| facet), Some(4));
    assert!(left.is_some_and(|(facet, t)| facet == 7 && t > 0.9), "{left:?}");
}

#[test]
fn a_face_of_many_members_is_of_one_that_helps_the_solid_to_begin() {
    // (0 − 1) ∪ (2 ∩ 3): 1 begins where 2 and 3 do, of which neither alone makes anything.
    let pair = |operation, a, b| Rule::Combined(operation, vec![Rule::Shape(a), Rule::Shape(b)]);
    let rule = Rule::Combined(
        Operation::Union,
        vec![pair(Operation::Difference, 0, 1), pair(Operation::Intersection, 2, 3)],
    );
    let unit = || cuboid([0.0; 3], [1.0; 3]);
    let shapes = vec![cuboid([5.0; 3], [6.0; 3]), unit(), crate_of(DVec3::ZERO, DVec3::ONE), unit()];
    let solid = Arc::new(Solid::new(shapes, rule).unwrap());
    assert_eq!(met(&solid, [0.5, 0.25, 9.0], [0.0, 0.0, -1.0]), Some((8.0, 2, DVec3::Z)));
    assert_eq!(met(&solid, [0.5, 0.25, 0.5], [0.0, 0.0, -1.0]), Some((0.5, 2, DVec3::NEG_Z)));
}
