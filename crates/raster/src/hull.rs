//! Which outline do points in the picture have together?

use crate::projection::Spot;

/// The convex hull of the points, counter-clockwise in a picture whose y points down; fewer than three corners when
/// the points have no area. Andrew 1979, monotone chain.
pub(crate) fn hull(mut points: Vec<Spot>) -> Vec<Spot> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup_by(|a, b| a.x == b.x && a.y == b.y);
    if points.len() < 3 {
        return points;
    }
    let mut outline = chain(points.iter());
    outline.pop();
    outline.extend(chain(points.iter().rev()));
    outline.pop();
    outline
}

fn chain<'a>(points: impl Iterator<Item = &'a Spot>) -> Vec<Spot> {
    let mut corners: Vec<Spot> = Vec::new();
    for &point in points {
        while let [.., before, last] = corners[..] {
            let turn =
                (last.x - before.x) * (point.y - before.y) - (last.y - before.y) * (point.x - before.x);
            if turn > 0.0 {
                break;
            }
            corners.pop();
        }
        corners.push(point);
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(x: f64, y: f64) -> Spot {
        Spot { x, y, inverse_depth: 1.0 }
    }

    #[test]
    fn inner_points_are_left_out() {
        let corners = [spot(0.0, 0.0), spot(4.0, 0.0), spot(4.0, 4.0), spot(0.0, 4.0)];
        let mut points = corners.to_vec();
        points.extend([spot(1.0, 2.0), spot(3.0, 3.0), spot(2.0, 0.0)]);
        let outline = hull(points);
        assert_eq!(outline.len(), 4);
        assert!(corners.iter().all(|corner| outline.contains(corner)));
    }

    #[test]
    fn points_on_a_line_have_no_area() {
        assert!(hull(vec![spot(0.0, 0.0), spot(1.0, 1.0), spot(2.0, 2.0)]).len() < 3);
        assert!(hull(Vec::new()).is_empty());
    }
}
