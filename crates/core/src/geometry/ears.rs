//! How is a flat outline cut into triangles, concave or not? Ear by ear (Meisters, "Polygons have ears", American Mathematical
//! Monthly 82, 1975), all decided exactly.

use std::cmp::Ordering;

use glam::DVec2;

use crate::exact::{Bounded, Dyadic, Number, Verdict, decide};

/// What an outline has that goes once round an area does not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fault {
    /// Two edges cross or touch, each named by the number of the corner that it starts from.
    Meet(u32, u32),
    /// A corner lies where the next one does, or the way comes straight back from it.
    Folds(u32),
}

/// On which side of the line from a to b a point lies: `Greater` to the left.
pub(super) fn side(a: DVec2, b: DVec2, p: DVec2) -> Ordering {
    fn area<N: Number>([a, b, p]: [DVec2; 3]) -> Verdict<Option<Ordering>> {
        let from_a = |q: DVec2| [N::of(q.x).minus(&N::of(a.x)), N::of(q.y).minus(&N::of(a.y))];
        let ([bx, by], [px, py]) = (from_a(b), from_a(p));
        N::compare_products([&bx, &py], [&by, &px]).map(Some)
    }
    decide(|| area::<Bounded>([a, b, p]), || area::<Dyadic>([a, b, p])).unwrap_or(Ordering::Equal)
}

/// Whether a point lies on the stretch between two others, ends included.
fn is_between(a: DVec2, b: DVec2, p: DVec2) -> bool {
    side(a, b, p).is_eq() && a.min(b).cmple(p).all() && p.cmple(a.max(b)).all()
}

/// Whether two stretches have a point in common.
fn meet([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let (of_c, of_d, of_a, of_b) = (side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b));
    let crosses = |p: Ordering, q: Ordering| p.is_ne() && p == q.reverse();
    crosses(of_c, of_d) && crosses(of_a, of_b)
        || is_between(a, b, c)
        || is_between(a, b, d)
        || is_between(c, d, a)
        || is_between(c, d, b)
}

/// Refuses outlines that do not go once round an area.
pub(super) fn check(outline: &[DVec2]) -> Result<(), Fault> {
    let count = outline.len();
    let edge = |i: usize| [outline[i], outline[(i + 1) % count]];
    for i in 0..count {
        let ([a, b], c) = (edge(i), outline[(i + 2) % count]);
        let comes_back = side(a, b, c).is_eq() && (b - a).dot(c - b) <= 0.0;
        if a == b || b == c || comes_back {
            return Err(Fault::Folds(((i + 1) % count) as u32));
        }
        for j in i + 2..count {
            let are_neighbours = (j + 1) % count == i;
            if !are_neighbours && meet(edge(i), edge(j)) {
                return Err(Fault::Meet(i as u32, j as u32));
            }
        }
    }
    Ok(())
}

/// Whether an outline without faults runs counter-clockwise: by the lowest of its corners, and of those the leftmost.
pub(super) fn is_counter_clockwise(outline: &[DVec2]) -> bool {
    let count = outline.len();
    let lowest = (0..count).min_by(|&i, &j| {
        let key = |i: usize| (outline[i].y, outline[i].x);
        key(i).partial_cmp(&key(j)).unwrap_or(Ordering::Equal)
    });
    let i = lowest.unwrap_or(0);
    side(outline[(i + count - 1) % count], outline[i], outline[(i + 1) % count]).is_gt()
}

/// The triangles of an outline without faults that runs counter-clockwise, by the numbers of its corners, wound alike. Each has
/// an area; corners on a straight edge are corners of triangles too.
pub(super) fn triangles(outline: &[DVec2]) -> Vec<[u32; 3]> {
    let mut left: Vec<u32> = (0..outline.len() as u32).collect();
    let mut triangles = Vec::with_capacity(outline.len());
    let at = |i: u32| outline[i as usize];
    let mut start = 0;
    while left.len() > 3 {
        let count = left.len();
        let corner = |i: usize| left[i % count];
        let is_ear = |i: usize| {
            let ear = [corner(i + count - 1), corner(i), corner(i + 1)];
            let [a, b, c] = ear.map(at);
            let holds = |p: DVec2| side(a, b, p).is_ge() && side(b, c, p).is_ge() && side(c, a, p).is_ge();
            side(a, b, c).is_gt() && !left.iter().any(|other| !ear.contains(other) && holds(at(*other)))
        };
        // There always is one. Beginning after the last one spreads them round the outline.
        let Some(i) = (start..start + count).find(|&i| is_ear(i)) else { break };
        triangles.push([corner(i + count - 1), corner(i), corner(i + 1)]);
        left.remove(i % count);
        start = i % count;
    }
    if let [a, b, c] = left[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[[f64; 2]]) -> Vec<DVec2> {
        list.iter().map(|&p| p.into()).collect()
    }

    /// Twice the area.
    fn area(outline: &[DVec2]) -> f64 {
        (0..outline.len()).map(|i| outline[i].perp_dot(outline[(i + 1) % outline.len()])).sum()
    }

    #[test]
    fn triangles_cover_a_concave_outline_once() {
        let comb = points(&[
            [0.0, 0.0],
            [7.0, 0.0],
            [7.0, 3.0],
            [6.0, 1.0],
            [5.0, 3.0],
            [4.0, 1.0],
            [3.0, 3.0],
            [2.0, 1.0],
            [1.0, 3.0],
        ]);
        let star: Vec<DVec2> = (0..14)
            .map(|i| {
                DVec2::from_angle(f64::from(i) * std::f64::consts::TAU / 14.0) * f64::from(1 + i % 2 * 3)
            })
            .collect();
        // With corners on straight edges, three in a row of them.
        let beaded = points(&[
            [0.0, 0.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [2.0, 4.0],
            [2.0, 2.0],
            [0.0, 2.0],
            [0.0, 1.0],
        ]);
        for outline in [comb, star, beaded] {
            assert_eq!(check(&outline), Ok(()));
            assert!(is_counter_clockwise(&outline));
            let cut = triangles(&outline);
            assert_eq!(cut.len(), outline.len() - 2);
            let areas = cut.iter().map(|t| area(&t.map(|i| outline[i as usize])));
            assert!(areas.clone().all(|area| area > 0.0));
            assert!((areas.sum::<f64>() - area(&outline)).abs() < 1e-12);
            let reversed: Vec<DVec2> = outline.iter().rev().copied().collect();
            assert!(!is_counter_clockwise(&reversed));
        }
    }

    #[test]
    fn crossing_touching_and_folding_outlines_are_told() {
        let bow = points(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
        assert_eq!(check(&bow), Err(Fault::Meet(0, 2)));
        // The corner 3 touches the edge from 0.
        let touching = points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
        assert_eq!(check(&touching), Err(Fault::Meet(0, 2)));
        let twice = points(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(check(&twice), Err(Fault::Folds(1)));
        let back = points(&[[0.0, 0.0], [3.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(check(&back), Err(Fault::Folds(1)));
    }
}
