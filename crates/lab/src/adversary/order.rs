//! Surfaces so close together that it is hard to say which is in front.

use catoptra_core::geometry::{Disk, Plane, Rectangle, Sphere, Triangle};
use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Shape};

use super::flat::made;
use super::random::rounded;
use super::{Group, Random, Trial};

pub(super) const CROSSING: Group = Group {
    name: "order, crossing",
    doc: "two triangles that cross, rays at the line where they do",
    make: |random| {
        let (a, b) = (random.point(4.0), random.point(4.0));
        let shapes = [(); 2].map(|()| made(Triangle::new(a, b, random.point(4.0)))).concat();
        aimed(random, shapes, &[a, b])
    },
};

pub(super) const PARALLEL: Group = Group {
    name: "order, parallel",
    doc: "triangles up to three steps of f32 apart, and tilted by one",
    make: |random| {
        let corners = [random.point(4.0), random.point(4.0), random.point(4.0)];
        let shapes = (0..3).flat_map(|_| {
            let [a, b, c] = corners.map(|p| if random.below(2) == 0 { p } else { random.beside(p, 1) });
            made(Triangle::new(a, b, c))
        });
        let shapes = shapes.collect();
        aimed(random, shapes, &corners)
    },
};

pub(super) const SPHERES: Group = Group {
    name: "order, spheres",
    doc: "spheres of which one is a few steps larger, or moved by a few",
    make: |random| {
        let (center, radius) = (random.point(100.0), random.power(-6, 6));
        let target = center + random.point(1.0).normalize_or(DVec3::X) * radius;
        let shapes = (0..3).flat_map(|_| {
            let larger = random.beside(DVec3::splat(radius), 2).x;
            let moved = if random.below(2) == 0 { center } else { random.beside(center, 1) };
            made(Sphere::new(moved, larger))
        });
        let shapes = shapes.collect();
        aimed(random, shapes, &[target, target])
    },
};

pub(super) const MIXED: Group = Group {
    name: "order, mixed",
    doc: "shapes of all kinds that touch in one point, rays at that point",
    make: |random| {
        let touch = random.point(50.0);
        let n = DVec3::new(2.0, 3.0, 6.0) * random.power(-3, 3);
        let u = DVec3::new(3.0, -6.0, 2.0);
        let v = DVec3::new(6.0, 2.0, -3.0);
        let mut shapes = made(Sphere::new(rounded(touch - n), n.length()));
        shapes.extend(made(Plane::new(touch, random.beside(n, 1))));
        shapes.extend(made(Triangle::new(random.beside(touch + u, 1), touch - u + v, touch - u - v)));
        shapes.extend(made(Rectangle::new(touch - u - v, u * 2.0, v * 2.0)));
        shapes.extend(made(Disk::new(touch, n, 3.0)));
        shapes.extend(made(Sphere::new(rounded(touch + n), n.length())));
        let first = random.below(shapes.len());
        shapes.rotate_left(first);
        aimed(random, shapes, &[touch, touch])
    },
};

pub(super) const COINCIDENT: Group = Group {
    name: "order, coincident",
    doc: "shapes in one plane, told apart by their ids alone",
    make: |random| {
        let at = random.whole_point(10.0);
        let flat = |random: &mut Random| -> Vec<Shape> {
            let k = random.power(-2, 2);
            match random.below(4) {
                0 => made(Plane::new(at + DVec3::X * k, DVec3::Y * k)),
                1 => made(Rectangle::new(at - DVec3::X * k - DVec3::Z, DVec3::X * (2.0 * k), DVec3::Z * 2.0)),
                2 => made(Disk::new(at, DVec3::NEG_Y * k, k)),
                _ => made(Triangle::new(at - DVec3::X * k, at + DVec3::X, at + DVec3::Z * k)),
            }
        };
        let shapes: Vec<Shape> = (0..4).flat_map(|_| flat(random)).collect();
        aimed(random, shapes, &[at, at + DVec3::X * 0.25])
    },
};

/// Rays at points between the targets, from all sides.
fn aimed(random: &mut Random, shapes: Vec<Shape>, targets: &[DVec3]) -> Trial {
    let ray = |_| -> Ray {
        let i = random.below(targets.len());
        let target = targets[i].lerp(targets[(i + 1) % targets.len()], random.between(0.0, 1.0));
        let from = target + random.point(1.0) * random.power(-2, 8);
        random.aimed(from, target)
    };
    let rays = (0..24).map(ray).collect();
    Trial { shapes, rays }
}
