//! Numbers at both ends of the range, and rays that are none.

use std::sync::Arc;

use catoptra_core::geometry::{Cuboid, Disk, Mesh, Plane, Rectangle, Sphere, Triangle};
use catoptra_core::glam::DVec3;
use catoptra_core::{InvalidPart, MeshSource, Ray, Shape, TriangleMesh};

use super::flat::made;
use super::random::rounded;
use super::{Group, Random, Trial};

pub(super) const SCENES: Group = Group {
    name: "scale of scenes",
    doc: "all coordinates times 2^-140 to 2^120, often near the square roots of the ends of the range",
    make: |random| {
        let scale = [random.power(-140, 120), random.power(56, 68), random.power(-80, -56)][random.below(3)];
        let shapes = shapes(random, scale);
        let ray = |_| {
            let from = [DVec3::ZERO, random.point(4.0)][random.below(2)];
            let ray = random.aimed(from, random.clone().point(1.0));
            let [origin, direction] =
                [ray.origin * scale, ray.direction * if random.below(2) == 0 { scale } else { 1.0 }];
            Ray::new(rounded(origin), rounded(direction))
        };
        let rays = (0..24).map(ray).collect();
        Trial { shapes, rays }
    },
};

pub(super) const DIRECTIONS: Group = Group {
    name: "scale of directions",
    doc: "directions times 2^-120 to 2^120",
    make: |random| {
        let shapes = shapes(random, 1.0);
        let ray = |_| {
            let from = random.point(4.0);
            let ray = random.aimed(from, random.clone().point(1.0));
            Ray::new(ray.origin, rounded(ray.direction * random.power(-120, 120)))
        };
        let rays = (0..24).map(ray).collect();
        Trial { shapes, rays }
    },
};

pub(super) const BAD_RAYS: Group = Group {
    name: "rays that are none",
    doc: "NaN and infinity in a coordinate, directions of zero",
    make: |random| {
        let shapes = shapes(random, 1.0);
        let ray = |_| {
            let mut ray = Ray::new(random.point(4.0), random.direction());
            let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][random.below(3)];
            match random.below(3) {
                0 => ray.origin[random.below(3)] = bad,
                1 => ray.direction[random.below(3)] = bad,
                _ => ray.direction = [DVec3::ZERO, -DVec3::ZERO][random.below(2)],
            }
            ray
        };
        let rays = (0..24).map(ray).collect();
        Trial { shapes, rays }
    },
};

/// A mesh of triangles whose corners `f32` holds.
fn mesh_of(triangles: &[[DVec3; 3]]) -> Result<Mesh, InvalidPart> {
    let corners = triangles.as_flattened().iter().map(|p| p.to_array().map(|c| c as f32)).collect();
    let numbers = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mesh = Arc::new(TriangleMesh::new(corners, numbers, None, None)?);
    Ok(Mesh::new(MeshSource { path: String::new(), mesh }))
}

/// One of each of some kinds.
fn shapes(random: &mut Random, scale: f64) -> Vec<Shape> {
    let mut point = |reach: f64| rounded(random.point(reach) * scale);
    let (p, q, r) = (point(1.0), point(1.0), point(1.0));
    let radius = f64::from(scale as f32) * 0.5;
    let mut shapes = made(Triangle::new(p, q, r));
    shapes.extend(made(Sphere::new(q, radius)));
    shapes.extend(made(Cuboid::new(p.min(r), p.max(r))));
    shapes.extend(made(Plane::new(r, point(1.0))));
    shapes.extend(made(Disk::new(p, point(1.0), radius)));
    shapes.extend(made(Rectangle::new(q, DVec3::X * radius, DVec3::Y * radius)));
    shapes.extend(made(mesh_of(&[[p, q, r], [r, q, -p]])));
    // Alone, now and then, so that nothing hides it.
    let first = random.below(shapes.len().max(1));
    if random.below(2) == 0 && !shapes.is_empty() { vec![shapes.swap_remove(first)] } else { shapes }
}
