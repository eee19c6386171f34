//! Shapes with flat faces, and rays at their rims, along their faces and nearly so.

use catoptra_core::geometry::{
    Cuboid, Disk, Plane, Platonic, Polyhedron, Prism, Rectangle, Tetrahedron, Triangle,
};
use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{InvalidPart, Placement, Ray, Shape};

use super::random::rounded;
use super::{Group, Random, Trial};

pub(super) const TRIANGLES: Group = Group {
    name: "triangle",
    doc: "rays within steps of its edges",
    make: |random| {
        let corners = [random.point(2.0), random.point(2.0), random.point(2.0)];
        rim(random, Triangle::new(corners[0], corners[1], corners[2]), &corners)
    },
};

pub(super) const RECTANGLES: Group = Group {
    name: "rectangle",
    doc: "rays within steps of its edges, along the axes or turned",
    make: |random| {
        let (corner, width, height) = (random.point(2.0), random.power(-3, 3), random.power(-3, 3));
        let flat = Rectangle::new(corner, DVec3::X * width, DVec3::Z * height);
        let Ok(flat) = flat.map(|flat| place(random, flat.into())) else { return nothing() };
        let Shape::Rectangle(rectangle) = &flat else { return nothing() };
        let (c, [u, v]) = (rectangle.corner(), rectangle.edges());
        rim(random, Ok(flat.clone()), &[c, c + u, c + u + v, c + v])
    },
};

pub(super) const DISKS: Group = Group {
    name: "disk",
    doc: "rays at points of its rim",
    make: |random| {
        let (center, normal, radius) = (random.point(2.0), random.direction(), random.power(-3, 3));
        let u = normal.any_orthogonal_vector().normalize() * radius;
        let v = normal.cross(u).normalize() * radius;
        // Points of the rim as exactly as a rational circle gives them.
        let at = |t: f64| center + (u * (1.0 - t * t) + v * (2.0 * t)) / (1.0 + t * t);
        let corners: Vec<DVec3> = (-8..8).map(|i| at(f64::from(i) / 4.0)).collect();
        rim(random, Disk::new(center, normal, radius), &corners)
    },
};

pub(super) const TETRAHEDRA: Group = Group {
    name: "tetrahedron",
    doc: "rays at its edges and corners",
    make: |random| {
        let [a, b, c, d] = [(); 4].map(|()| random.point(2.0));
        rim(random, Tetrahedron::new(a, b, c, d), &[a, b, c, d, a, c, b, d])
    },
};

pub(super) const POLYHEDRA: Group = Group {
    name: "polyhedron",
    doc: "hulls of points and cuts of planes, with many points in one plane; rays at edges, corners and across faces",
    make: |random| {
        let size = random.power(-2, 6);
        let solid = if random.below(2) == 0 {
            let center = random.whole_point(50.0);
            let points: Vec<DVec3> = (0..12).map(|_| center + random.whole_point(4.0) * size).collect();
            Polyhedron::hull_of(points)
        } else {
            let half =
                (0..8).map(|i| if i % 2 == 0 { DVec3::AXES[i / 2 % 3] } else { -DVec3::AXES[i / 2 % 3] });
            let cuts = [(); 4].map(|()| (random.direction(), size));
            let half: Vec<_> = half.map(|normal| (normal, size)).chain(cuts).collect();
            Polyhedron::between(half)
        };
        facets(random, solid)
    },
};

pub(super) const PLATONIC: Group = Group {
    name: "platonic",
    doc: "rays at edges and corners of the five regular solids, and across their faces",
    make: |random| {
        let solid = ["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"][random.below(5)];
        let (center, radius) = (random.point(10.0), random.power(-6, 6));
        facets(random, Platonic::new(solid, center, radius))
    },
};

pub(super) const PRISMS: Group = Group {
    name: "prism",
    doc: "rays at edges and corners of straight solids over concave outlines, and in the planes of their faces",
    make: |random| {
        let outline = (0..9).map(|i| {
            let out = if i % 3 == 1 { 2.0 } else { random.between(3.0, 9.0) };
            let (sine, cosine) = (f64::from(i) * 0.69).sin_cos();
            DVec2::new(cosine * out, sine * out).round()
        });
        let outline: Vec<DVec2> = outline.collect();
        let (height, from) = (random.power(-3, 3), random.whole_point(10.0));
        let axis = [DVec3::Y, DVec3::X, random.direction()][random.below(3)];
        facets(random, Prism::new(outline, height, from, axis))
    },
};

/// Of a solid with facets, now and then placed elsewhere: rays at its edges, and at points of the triangles they are cut into.
fn facets(random: &mut Random, solid: Result<impl Into<Shape>, InvalidPart>) -> Trial {
    let Ok(shape) = solid.map(|solid| place(random, solid.into())) else { return nothing() };
    let Some(solid) = shape.faceted() else { return nothing() };
    let ends = (0..solid.count()).flat_map(|facet| solid.triangles(facet)).flat_map(|[a, b, c]| [a, b, c, a]);
    let ends: Vec<DVec3> = ends.collect();
    rim(random, Ok(shape), &ends)
}

pub(super) const BOXES: Group = Group {
    name: "box",
    doc: "rays at edges and corners, in the planes of faces, from faces; flat and turned boxes",
    make: |random| {
        let (low, mut size) = (random.point(2.0), random.point(1.0).abs());
        if random.below(4) == 0 {
            size[random.below(3)] = 0.0;
        }
        let high = rounded(low + size);
        let Ok(cuboid) = Cuboid::new(low, high) else { return nothing() };
        let corners = cuboid.object_bounds().corners();
        let mut trial =
            rim(random, Ok(cuboid), &[0, 1, 3, 2, 6, 7, 5, 4, 0, 2, 6, 4, 5, 1, 3, 7].map(|i| corners[i]));
        for _ in 0..8 {
            // Along an axis through a point whose coordinates are those of faces, now and then.
            let (axis, mut from) = (random.below(3), low.lerp(high, 0.3));
            from[(axis + 1) % 3] = [low, high][random.below(2)][(axis + 1) % 3];
            from[axis] = [low[axis], low[axis] - 1.0, high[axis]][random.below(3)];
            trial.rays.push(Ray::new(rounded(from), DVec3::AXES[axis]));
        }
        if random.below(3) == 0 {
            trial.shapes = trial.shapes.into_iter().map(|shape| place(random, shape)).collect();
        }
        trial
    },
};

pub(super) const PLANES: Group = Group {
    name: "plane",
    doc: "grazing and nearly parallel rays, origins close to the plane",
    make: |random| {
        let (point, normal) = (random.point(100.0), random.direction());
        let rays = (0..24).map(|_| {
            let along = normal.cross(random.point(1.0)) + normal * random.power(-40, -1);
            let near = point + normal.cross(random.point(10.0)) + normal * random.power(-60, 3);
            Ray::new(rounded(near), rounded(along))
        });
        let rays = rays.collect();
        Trial { shapes: made(Plane::new(point, normal)), rays }
    },
};

pub(super) const CANCELLING_PLANES: Group = Group {
    name: "plane, cancelling",
    doc: "normals whose products with the point cancel, from spread exponents",
    make: |random| {
        let (a, b, large) = (random.between(1.0, 2.0), random.between(1.0, 2.0), random.power(4, 30));
        let small = random.power(-40, 0);
        let point = rounded(DVec3::new(a, b, b));
        let rays = (0..24).map(|_| Ray::new(random.point(1.0) * random.power(-60, 0), random.direction()));
        let rays = rays.map(|ray| Ray::new(rounded(ray.origin), ray.direction)).collect();
        Trial { shapes: made(Plane::new(point, DVec3::new(small, -large, large))), rays }
    },
};

fn nothing() -> Trial {
    Trial { shapes: Vec::new(), rays: Vec::new() }
}

pub(super) fn made(shape: Result<impl Into<Shape>, InvalidPart>) -> Vec<Shape> {
    shape.into_iter().map(Into::into).collect()
}

/// Somewhere else, now and then.
fn place(random: &mut Random, shape: Shape) -> Shape {
    if random.below(2) == 0 {
        return shape;
    }
    let turned = Placement::IDENTITY.turned(DVec3::ZERO, random.direction(), random.between(-3.0, 3.0));
    shape.placed(&turned.and_then(|p| p.moved(random.point(10.0))).unwrap_or_default())
}

/// Rays at the corners and edges of a ring of corners, from all sides.
fn rim(random: &mut Random, shape: Result<impl Into<Shape>, InvalidPart>, corners: &[DVec3]) -> Trial {
    let aim = |_| {
        let i = random.below(corners.len());
        let share = [0.0, 0.5, random.between(0.0, 1.0)][random.below(3)];
        let target = corners[i].lerp(corners[(i + 1) % corners.len()], share);
        let from = target + random.point(1.0) * random.power(-6, 10);
        random.aimed(from, target)
    };
    let rays = (0..24).map(aim).collect();
    Trial { shapes: made(shape), rays }
}
