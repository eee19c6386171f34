//! Which facets does the convex hull of points have? Decided exactly, so that points in one plane share a facet.
//!
//! Point by point (Preparata and Shamos, *Computational Geometry*, 1985, section 3.4.3): what of the hull so far a point sees
//! is replaced by triangles from the rim of that to the point. A triangle whose plane holds the point counts as seen, if any
//! other is seen: then no triangle is without area, as a point on the line of an edge sees both sides of it, and no corner
//! stays that has come to lie within an edge or a facet.

use std::cmp::Ordering;
use std::collections::{HashMap, HashSet};

use glam::DVec3;

use crate::exact::{Bounded, Dyadic, Number, Vector, Verdict, decide};

/// The outlines of the hull's facets by the numbers of points, counter-clockwise as seen from outside; `None` where all points
/// lie in one plane.
pub(super) fn hull(points: &[DVec3]) -> Option<Vec<Vec<u32>>> {
    let mut triangles = simplex(points)?;
    for (point, number) in points.iter().zip(0..) {
        let sides: Vec<Ordering> =
            triangles.iter().map(|triangle| side(triangle.map(|i| points[i as usize]), *point)).collect();
        if !sides.contains(&Ordering::Greater) {
            continue;
        }
        let (mut kept, mut rim) = (Vec::new(), HashSet::new());
        for (triangle, side) in triangles.into_iter().zip(sides) {
            if side.is_lt() {
                kept.push(triangle);
                continue;
            }
            for [from, to] in edges(&triangle) {
                // An edge between two that are seen is run along both ways.
                if !rim.remove(&[to, from]) {
                    rim.insert([from, to]);
                }
            }
        }
        let mut rim: Vec<[u32; 2]> = rim.into_iter().collect();
        rim.sort_unstable();
        kept.extend(rim.into_iter().map(|[from, to]| [from, to, number]));
        triangles = kept;
    }
    Some(merged(points, &triangles))
}

/// Four points that span a solid, as the triangles of that.
fn simplex(points: &[DVec3]) -> Option<Vec<[u32; 3]>> {
    let at = |i: u32| points[i as usize];
    let numbers = 0..points.len() as u32;
    let a = 0;
    let b = numbers.clone().find(|&i| at(i) != at(a))?;
    let c = numbers.clone().find(|&i| !are_in_line([at(a), at(b), at(i)]))?;
    let (d, order) =
        numbers.map(|i| (i, side([at(a), at(b), at(c)], at(i)))).find(|(_, side)| side.is_ne())?;
    let [b, c] = if order.is_lt() { [b, c] } else { [c, b] };
    Some(vec![[a, b, c], [a, d, b], [b, d, c], [c, d, a]])
}

/// On which side of a triangle's plane a point lies: `Greater` where the triangle runs counter-clockwise as seen from there.
fn side([a, b, c]: [DVec3; 3], point: DVec3) -> Ordering {
    fn volume<N: Number>(points: [DVec3; 4]) -> Verdict<Option<Ordering>> {
        let [a, b, c, point] = points.map(Vector::<N>::of);
        b.minus(&a).cross(&c.minus(&a)).dot(&point.minus(&a)).sign().map(Some)
    }
    let points = [a, b, c, point];
    decide(|| volume::<Bounded>(points), || volume::<Dyadic>(points)).unwrap_or(Ordering::Equal)
}

fn are_in_line(points: [DVec3; 3]) -> bool {
    fn product<N: Number>(points: [DVec3; 3]) -> Verdict<Option<bool>> {
        let [a, b, c] = points.map(Vector::<N>::of);
        let n = b.minus(&a).cross(&c.minus(&a));
        for coordinate in [&n.x, &n.y, &n.z] {
            if coordinate.sign()?.is_ne() {
                return Ok(Some(false));
            }
        }
        Ok(Some(true))
    }
    decide(|| product::<Bounded>(points), || product::<Dyadic>(points)).unwrap_or(true)
}

fn edges(&[a, b, c]: &[u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Outlines of what triangles in one plane are together.
fn merged(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let at = |i: u32| points[i as usize];
    let owner: HashMap<[u32; 2], usize> =
        (0..).zip(triangles).flat_map(|(i, t)| edges(t).map(|e| (e, i))).collect();
    let mut facet_of: Vec<Option<usize>> = vec![None; triangles.len()];
    let mut outlines = Vec::new();
    for first in 0..triangles.len() {
        if facet_of[first].is_some() {
            continue;
        }
        let (facet, plane) = (outlines.len(), triangles[first].map(at));
        facet_of[first] = Some(facet);
        let (mut waiting, mut next) = (vec![first], HashMap::new());
        while let Some(i) = waiting.pop() {
            for [from, to] in edges(&triangles[i]) {
                match owner.get(&[to, from]) {
                    Some(&beyond) if triangles[beyond].iter().all(|&p| side(plane, at(p)).is_eq()) => {
                        if facet_of[beyond].is_none() {
                            facet_of[beyond] = Some(facet);
                            waiting.push(beyond);
                        }
                    }
                    _ => {
                        next.insert(from, to);
                    }
                }
            }
        }
        let start = triangles[first].into_iter().find(|corner| next.contains_key(corner)).unwrap_or_default();
        let walk = std::iter::successors(next.get(&start).copied(), |corner| next.get(corner).copied());
        let mut outline = vec![start];
        outline.extend(walk.take_while(|&corner| corner != start).take(next.len()));
        outlines.push(outline);
    }
    outlines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_grid_is_its_box_whatever_the_order() {
        let mut points: Vec<DVec3> =
            (0..27).map(|i| DVec3::new(f64::from(i % 3), f64::from(i / 3 % 3), f64::from(i / 9))).collect();
        for turn in 0..27 {
            points.rotate_left(1);
            points.swap(turn, (turn * 7 + 3) % 27);
            let facets = hull(&points).unwrap();
            assert_eq!(facets.len(), 6);
            for facet in facets {
                let [a, b, c, d] = facet[..] else { panic!("{facet:?}") };
                let [a, b, c, d] = [a, b, c, d].map(|i| points[i as usize]);
                assert_eq!((a + c, a.distance(b)), (b + d, 2.0));
                let normal = (b - a).cross(c - b);
                assert!(normal.dot(a - DVec3::ONE) > 0.0, "outwards");
            }
        }
    }

    #[test]
    fn a_facet_that_is_bent_by_the_last_bit_is_two() {
        let mut cube: Vec<DVec3> =
            (0..8_u32).map(|i| DVec3::new((i & 1).into(), (i >> 1 & 1).into(), (i >> 2).into())).collect();
        cube[7] *= 1.0_f64.next_up();
        assert_eq!(hull(&cube).unwrap().len(), 9, "three faces are bent along a diagonal");
    }

    #[test]
    fn euler_holds_and_no_point_lies_outside() {
        for seed in 0..40_u32 {
            let points: Vec<DVec3> = (0..60_u32)
                .map(|i| {
                    let angle = f64::from(seed * 97 + i * 3 + 1);
                    (DVec3::new(angle.sin(), (angle * 1.7).cos(), (angle * 0.3).sin()) * 4.0).round()
                })
                .collect();
            let facets = hull(&points).unwrap();
            let edges: usize = facets.iter().map(Vec::len).sum();
            let mut corners: Vec<u32> = facets.concat();
            corners.sort_unstable();
            corners.dedup();
            assert_eq!(corners.len() + facets.len(), edges / 2 + 2);
            for facet in &facets {
                let plane = [0, 1, 2].map(|k| points[facet[k] as usize]);
                assert!(points.iter().all(|p| side(plane, *p).is_le()));
            }
        }
    }

    #[test]
    fn points_in_a_plane_have_none() {
        assert!(hull(&[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(3.0, 4.0, 0.0)]).is_none());
        assert!(hull(&[DVec3::ZERO, DVec3::X, DVec3::X * 2.0]).is_none() && hull(&[]).is_none());
    }
}
