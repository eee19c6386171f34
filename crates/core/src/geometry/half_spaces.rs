//! Which solid do half spaces have in common? Its corners are where three planes meet within all others, found exactly; only
//! where they lie is rounded.

use std::cmp::Ordering;
use std::collections::HashMap;

use glam::DVec3;

use crate::exact::{Bounded, Dyadic, Number, Vector, Verdict, decide};

/// The half space `normal · p <= offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HalfSpace {
    pub(super) normal: DVec3,
    pub(super) offset: f64,
}

/// Corners closer together than this share of the largest coordinate are one: where more than three planes were meant to meet
/// in a point and rounding has parted them. 2⁻⁴⁰: some thousands of roundings, for planes that meet at a slant.
const SAME_CORNER: f64 = 1.0 / (1_u64 << 40) as f64;

/// Corners and outlines of the faces, in the order of the planes that have one, counter-clockwise as seen from outside; `None`
/// where the half spaces enclose no finite solid.
pub(super) fn common(spaces: &[HalfSpace]) -> Option<(Vec<DVec3>, Vec<Vec<u32>>)> {
    let corners = corners(spaces);
    let mut faces: Vec<Vec<usize>> = Vec::new();
    for (plane, space) in spaces.iter().enumerate() {
        let of_plane: Vec<usize> =
            (0..corners.len()).filter(|&c| corners[c].planes.contains(&plane)).collect();
        if of_plane.len() < 3 || faces.iter().any(|face| are_same_set(face, &of_plane)) {
            continue;
        }
        faces.push(outline(&corners, plane, &of_plane, space.normal)?);
    }
    // A face that is open has no outline, and one that is missing leaves edges with a single one.
    let mut edges: HashMap<[usize; 2], u32> = HashMap::new();
    for [from, to] in faces.iter().flat_map(|face| loop_of(face)) {
        *edges.entry([from.min(to), from.max(to)]).or_default() += 1;
    }
    if faces.len() < 4 || edges.values().any(|&sides| sides != 2) {
        return None;
    }
    Some(joined(&corners, faces))
}

/// Where planes meet.
#[derive(Debug)]
struct Corner {
    place: DVec3,
    /// All that meet there, in order.
    planes: Vec<usize>,
}

/// The solid's corners.
fn corners(spaces: &[HalfSpace]) -> Vec<Corner> {
    let mut corners: Vec<Corner> = Vec::new();
    for a in 0..spaces.len() {
        for b in a + 1..spaces.len() {
            for c in b + 1..spaces.len() {
                let known = |corner: &Corner| [a, b, c].iter().all(|plane| corner.planes.contains(plane));
                let three = [a, b, c].map(|i| spaces[i]);
                if corners.iter().any(known) {
                    continue;
                }
                if let Some(planes) = meeting(spaces, three) {
                    corners.push(Corner { place: place(three), planes });
                }
            }
        }
    }
    corners
}

/// All planes that meet where three do, if that is one point and lies within all half spaces.
fn meeting(spaces: &[HalfSpace], three: [HalfSpace; 3]) -> Option<Vec<usize>> {
    fn sides<N: Number>(spaces: &[HalfSpace], three: [HalfSpace; 3]) -> Verdict<Option<Vec<usize>>> {
        let (point, weight) = homogeneous::<N>(three);
        let up = weight.sign()?;
        let mut planes = Vec::new();
        for (i, space) in spaces.iter().enumerate() {
            let beyond = Vector::of(space.normal).dot(&point).minus(&N::of(space.offset).times(&weight));
            match beyond.sign()? {
                Ordering::Equal => planes.push(i),
                side if side == up => return Ok(None),
                _ => {}
            }
        }
        Ok((up.is_ne()).then_some(planes))
    }
    decide(|| sides::<Bounded>(spaces, three), || sides::<Dyadic>(spaces, three))
}

/// Where three planes meet, times a number: by Cramer's rule.
fn homogeneous<N: Number>(three: [HalfSpace; 3]) -> (Vector<N>, N) {
    let [a, b, c] = three.map(|space| Vector::<N>::of(space.normal));
    let [p, q, r] = three.map(|space| N::of(space.offset));
    let point = b.cross(&c).scaled(&p).plus(&c.cross(&a).scaled(&q)).plus(&a.cross(&b).scaled(&r));
    (point, a.dot(&b.cross(&c)))
}

fn place(three: [HalfSpace; 3]) -> DVec3 {
    let (point, weight) = homogeneous::<Dyadic>(three);
    DVec3::new(point.x.over(&weight), point.y.over(&weight), point.z.over(&weight))
}

fn are_same_set(face: &[usize], corners: &[usize]) -> bool {
    face.len() == corners.len() && corners.iter().all(|corner| face.contains(corner))
}

fn loop_of(face: &[usize]) -> impl Iterator<Item = [usize; 2]> {
    (0..face.len()).map(|i| [face[i], face[(i + 1) % face.len()]])
}

/// The corners of a face in order: two that lie on another plane too have an edge in common.
fn outline(corners: &[Corner], plane: usize, of_plane: &[usize], normal: DVec3) -> Option<Vec<usize>> {
    let are_joined = |a: usize, b: usize| {
        corners[a].planes.iter().any(|other| {
            let on_both = |c: &&usize| corners[**c].planes.contains(other);
            *other != plane
                && corners[b].planes.contains(other)
                && of_plane.iter().filter(on_both).count() == 2
        })
    };
    let mut outline = vec![of_plane[0]];
    while outline.len() < of_plane.len() {
        let last = outline[outline.len() - 1];
        let next = of_plane.iter().find(|&&c| !outline.contains(&c) && are_joined(last, c))?;
        outline.push(*next);
    }
    if !are_joined(outline[0], outline[outline.len() - 1]) {
        return None;
    }
    let place = |i: usize| corners[outline[i]].place;
    let area: DVec3 = (2..outline.len()).map(|i| (place(i - 1) - place(0)).cross(place(i) - place(0))).sum();
    if area.dot(normal) < 0.0 {
        outline.reverse();
    }
    Some(outline)
}

/// Makes one corner of those that lie in one place.
fn joined(corners: &[Corner], faces: Vec<Vec<usize>>) -> (Vec<DVec3>, Vec<Vec<u32>>) {
    let largest = corners.iter().map(|corner| corner.place.abs().max_element()).fold(0.0, f64::max);
    let mut places: Vec<DVec3> = Vec::new();
    let mut number_of = Vec::new();
    for corner in corners {
        let near = |p: &DVec3| p.distance(corner.place) <= SAME_CORNER * largest;
        number_of.push(places.iter().position(near).unwrap_or_else(|| {
            places.push(corner.place);
            places.len() - 1
        }) as u32);
    }
    let outlines = faces.into_iter().map(|face| {
        let mut outline: Vec<u32> = face.into_iter().map(|corner| number_of[corner]).collect();
        outline.dedup();
        if outline.first() == outline.last() {
            outline.pop();
        }
        outline
    });
    (places, outlines.filter(|outline| outline.len() > 2).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spaces(rows: &[[f64; 4]]) -> Vec<HalfSpace> {
        rows.iter().map(|&[x, y, z, offset]| HalfSpace { normal: DVec3::new(x, y, z), offset }).collect()
    }

    fn cube() -> Vec<HalfSpace> {
        let axes = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
        axes.map(|normal| HalfSpace { normal, offset: 1.0 }).collect()
    }

    #[test]
    fn six_make_a_cube_and_more_that_touch_it_change_nothing() {
        let mut six = cube();
        let check = |spaces: &[HalfSpace]| {
            let (corners, faces) = common(spaces).unwrap();
            assert!(corners.len() == 8 && corners.iter().all(|c| c.abs() == DVec3::ONE), "{corners:?}");
            assert!(faces.len() == 6 && faces.iter().all(|face| face.len() == 4), "{faces:?}");
            for face in faces {
                let [a, b, c] = [0, 1, 2].map(|i| corners[face[i] as usize]);
                assert!((b - a).cross(c - b).dot(a + c) > 0.0, "outwards");
            }
        };
        check(&six);
        // Through a corner, along an edge, the same face again, and beyond.
        six.extend(spaces(&[
            [1.0, 1.0, 1.0, 3.0],
            [1.0, 1.0, 0.0, 2.0],
            [2.0, 0.0, 0.0, 2.0],
            [0.0, 1.0, 0.0, 9.0],
        ]));
        check(&six);
    }

    #[test]
    fn four_faces_meet_in_each_corner_of_an_octahedron() {
        let eight = (0..8_u32).map(|i| {
            let sign = |k: u32| if i >> k & 1 == 0 { 1.0 } else { -1.0 };
            HalfSpace { normal: DVec3::new(sign(0), sign(1), sign(2)), offset: 0.7 }
        });
        let (corners, faces) = common(&eight.collect::<Vec<_>>()).unwrap();
        assert_eq!((corners.len(), faces.len()), (6, 8));
        assert!(faces.iter().all(|face| face.len() == 3));
    }

    #[test]
    fn planes_that_rounding_has_parted_meet_in_one_corner() {
        // Twenty planes, five of which meet in each corner but for rounding.
        let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
        let mut twenty = Vec::new();
        for i in 0..8_u32 {
            let sign = |k: u32| if i >> k & 1 == 0 { 1.0 } else { -1.0 };
            twenty.push(DVec3::new(sign(0), sign(1), sign(2)));
            if i < 4 {
                let (a, b) = (sign(0) / golden, sign(1) * golden);
                twenty.extend([DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)]);
            }
        }
        let spaces: Vec<_> =
            twenty.into_iter().map(|n| HalfSpace { normal: n.normalize(), offset: 0.3 }).collect();
        let (corners, faces) = common(&spaces).unwrap();
        assert_eq!((corners.len(), faces.len()), (12, 20));
        assert!(faces.iter().all(|face| face.len() == 3), "{faces:?}");
    }

    #[test]
    fn what_is_open_or_empty_is_no_solid() {
        assert!(common(&cube()[..5]).is_none());
        let far = spaces(&[[1.0, 0.0, 0.0, -5.0]]);
        assert!(common(&[cube(), far].concat()).is_none());
        let flat = spaces(&[[1.0, 0.0, 0.0, -1.0]]);
        assert!(common(&[cube(), flat].concat()).is_none());
        assert!(common(&[]).is_none());
    }
}
