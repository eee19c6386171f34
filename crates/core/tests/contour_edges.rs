//! Do faces that share edges hide a lamp together, wherever rounding puts the point that sees them?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

#[allow(dead_code, reason = "shared between tests, each of which needs a part")]
mod quadrature;

use catoptra_core::Shape;
use catoptra_core::contour::{Blocker, Lamp, Leaving, Scratch, visible};
use catoptra_core::geometry::{Cuboid, Disk, Rectangle, Sphere, Tetrahedron, Triangle};
use catoptra_core::glam::DVec3;
use quadrature::{Random, Rule, Swept};

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A lamp and what stands before it.
struct Room {
    normal: DVec3,
    lamp: Shape,
    shapes: Vec<Shape>,
}

impl Room {
    fn values(&self, points: impl Iterator<Item = DVec3>) -> Vec<f64> {
        let lamp = Lamp::of(&self.lamp, 0).unwrap();
        let blockers: Vec<_> = self.shapes.iter().map(|shape| Blocker::of(shape).unwrap()).collect();
        let list: Vec<_> = blockers.iter().map(|blocker| (blocker, Leaving::Nothing)).collect();
        let mut scratch = Scratch::default();
        points.map(|point| visible(point, self.normal, &lamp, &list, &mut scratch).unwrap()).collect()
    }

    /// Whether points that differ by some roundings see the same.
    fn sees_the_same_round(&self, point: DVec3, random: &mut Random, count: usize) -> bool {
        let size = 16.0 * f64::EPSILON * point.abs().max_element();
        let values =
            self.values((0..count).map(|i| if i == 0 { point } else { point + random.vector() * size }));
        values.iter().all(|value| (value - values[0]).abs() < 1e-9)
    }
}

fn tetrahedron(corner: DVec3, edge: f64) -> Shape {
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| corner + axis * edge);
    Tetrahedron::new(corner, x, y, z).unwrap().into()
}

#[test]
fn faces_of_a_solid_leave_no_light_between_them() {
    let corner = v(0.548_774_042_693_912_8, 2.859_153_985_749_360_4, -0.631_624_381_170_389_7);
    let room = Room {
        normal: v(-0.286_641_237_547_309_1, 1.0, 0.472_405_130_509_477_6).normalize(),
        lamp: Sphere::new(v(0.310_036, 4.204_703, -0.928_874), 0.496_997).unwrap().into(),
        shapes: vec![tetrahedron(corner, 0.161_056)],
    };
    let point = v(1.742_345_876_885_481, -0.167_533_072_220_638_8, 1.411_841_674_723_660_6);
    let swept = Swept::of(&room.lamp, false);
    let truth = Rule::new(point, room.normal, &swept, &room.shapes).value(1e-9, 40);
    let value = room.values(std::iter::once(point))[0];
    assert!((value - truth).abs() < 1e-8, "{value} is not {truth}");
    assert!(room.sees_the_same_round(point, &mut Random(1), 20_000));
}

#[test]
fn roundings_of_the_point_change_nothing() {
    let mut random = Random(7);
    let mut hidden = 0;
    for trial in 0..150 {
        let (corner, edge) = (random.vector() * 0.5, 0.2 + random.share());
        let shape: Shape = match trial % 3 {
            0 => tetrahedron(corner, edge),
            1 => Cuboid::new(corner, corner + DVec3::splat(edge)).unwrap().into(),
            // Its second half shares a diagonal with it.
            _ => Triangle::new(corner, corner + DVec3::X * edge, corner + v(edge, 0.0, edge)).unwrap().into(),
        };
        let mut shapes = vec![shape];
        if trial % 3 == 2 {
            let [a, c] = [corner, corner + v(edge, 0.0, edge)];
            shapes.push(Triangle::new(a, c, a + DVec3::Z * edge).unwrap().into());
        }
        // A ball before them has an outline of its own on what they leave.
        shapes.push(Sphere::new(random.vector() * 0.5 - DVec3::Y * 2.0, 0.2).unwrap().into());
        let lamp = Sphere::new(random.vector() * 0.5 + DVec3::Y * 4.0, 0.5 + random.share()).unwrap().into();
        let room = Room { normal: DVec3::Y, lamp, shapes };
        let point = random.vector() * 0.5 - DVec3::Y * 4.0;
        assert!(room.sees_the_same_round(point, &mut random, 1000), "trial {trial}, {point}");
        let open = Room { shapes: Vec::new(), lamp: room.lamp.clone(), ..room };
        let values = [&room, &open].map(|room| room.values(std::iter::once(point))[0]);
        hidden += u32::from(values[0] < 0.99 * values[1]);
    }
    assert!(hidden > 50, "{hidden} hide some of the lamp");
}

#[test]
fn a_disk_seen_all_but_edge_on_hides_a_line_at_most() {
    let mut random = Random(3);
    for trial in 0..200 {
        let lamp = Rectangle::new(v(-1.0, 2.0, -1.0), DVec3::X * 2.0, DVec3::Z * 2.0).unwrap().into();
        let before = random.unit() + DVec3::Y * 2.0;
        let other: Shape = Disk::new(v(0.1, 1.0, 0.1), before, 0.3).unwrap().into();
        // In a plane that passes the point by so little.
        let (center, off) = (v(random.within(-0.3, 0.3), 0.8, random.within(-0.3, 0.3)), 1e-8);
        let across = center.cross(random.unit()).normalize() + center * off;
        let edge_on: Shape = Disk::new(center, across, random.within(0.1, 0.4)).unwrap().into();
        let room = Room { normal: DVec3::Y, lamp, shapes: vec![other.clone(), edge_on] };
        let without = Room { normal: DVec3::Y, lamp: room.lamp.clone(), shapes: vec![other] };
        let values = [&room, &without].map(|room| room.values(std::iter::once(DVec3::ZERO))[0]);
        assert!(values[1] > 0.1 && (values[1] - values[0]).abs() < 1e-7, "trial {trial}: {values:?}");
    }
}
