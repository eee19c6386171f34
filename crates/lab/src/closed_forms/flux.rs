//! What arrives on the walls of a closed black room in all? The power of the lamps within.

use catoptra_core::glam::DVec3;

use super::scenes::room;
use super::sweep::Rule;

/// A closed room with one lamp.
#[derive(Debug, Clone)]
pub struct ClosedRoom {
    /// Which lamp.
    pub title: &'static str,
    /// In the format of scene files.
    pub scene: String,
    /// Power of the lamp, the same in every channel: W.
    pub power: f64,
}

/// Rooms 4 x 3 x 4 with a lamp of each kind in mid-air. The planes of flat ones halve the walls, on which the light is smooth on
/// either side of them.
#[must_use]
pub fn closed_rooms() -> Vec<ClosedRoom> {
    let lamps = [
        (
            "rectangle, one side",
            "rectangle-light \"lamp\" { corner 1.5 1.5 1.6; edge-u 0.8 0 0; edge-v 0 0 0.6; power 100 }",
        ),
        (
            "rectangle, both sides",
            "rectangle-light \"lamp\" { corner 1.5 1.1 2; edge-u 0.8 0 0; edge-v 0 0.7 0; power 100; two-sided #true }",
        ),
        (
            "disk, one side",
            "disk-light \"lamp\" { center 2.2 1.5 2.1; normal 0 -1 0; radius 0.4; power 100 }",
        ),
        (
            "disk, both sides",
            "disk-light \"lamp\" { center 2 1.4 2.1; normal 1 0 0; radius 0.4; power 100; two-sided #true }",
        ),
        ("sphere", "sphere-light \"lamp\" { center 1.8 1.4 2.1; radius 0.5; power 100 }"),
    ];
    let with = |(title, lamp): (&'static str, &str)| ClosedRoom {
        title,
        scene: format!("{}{lamp}\n", room(&[])),
        power: 100.0,
    };
    lamps.into_iter().map(with).collect()
}

impl ClosedRoom {
    /// Points on the walls with their normals inwards, and the area each stands for, m²: a Gauss–Legendre rule of 16 x 16
    /// points in each of `cells` x `cells` equal parts of every wall.
    #[must_use]
    pub fn points(&self, cells: u32) -> Vec<(DVec3, DVec3, f64)> {
        let (rule, size) = (Rule::new(), DVec3::new(4.0, 3.0, 4.0));
        let mut points = Vec::new();
        let mut along = Vec::new();
        for cell in 0..cells {
            let at = |part: f64| (f64::from(cell) + part) / f64::from(cells);
            rule.for_each(|node, weight| along.push((at(node), weight / f64::from(cells))));
        }
        for (axis, upper) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
            let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
            for (s, ws) in &along {
                for (t, wt) in &along {
                    let (mut point, mut normal) = (DVec3::ZERO, DVec3::ZERO);
                    point[axis] = if upper { size[axis] } else { 0.0 };
                    normal[axis] = if upper { -1.0 } else { 1.0 };
                    (point[i], point[j]) = (s * size[i], t * size[j]);
                    points.push((point, normal, ws * wt * size[i] * size[j]));
                }
            }
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_cover_all_walls() {
        let points = closed_rooms()[0].points(2);
        let area: f64 = points.iter().map(|(.., area)| area).sum();
        assert!((area - 80.0).abs() < 1e-9, "{area}");
        // The flow of x e_x inwards is minus the room's volume.
        let flow: f64 = points.iter().map(|(point, normal, area)| point.x * normal.x * area).sum();
        assert!((flow + 48.0).abs() < 1e-9, "{flow}");
    }
}
