//! Sample shapes of every kind, each with what it is in plain geometry, so that tests need not ask the shape.

mod round;
mod solids;
mod torus;

use std::sync::Arc;

use catoptra_core::geometry::{
    Cuboid, Disk, Mesh, Plane, Rectangle, Shape, Sphere, Tetrahedron, Triangle, TriangleMesh,
};
use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{MeshSource, Placement, Ray};
use round::Round;
use torus::Ring;

/// A shape and its form.
#[derive(Debug, Clone)]
pub(crate) struct Sample {
    pub shape: Shape,
    pub form: Form,
}

/// Which points belong to a surface, and which side is out.
#[derive(Debug, Clone)]
pub(crate) enum Form {
    Plane {
        point: DVec3,
        normal: DVec3,
    },
    Sphere {
        center: DVec3,
        radius: f64,
    },
    Disk {
        center: DVec3,
        normal: DVec3,
        radius: f64,
    },
    Round(Round),
    Ring(Ring),
    /// Flat pieces: the facet each belongs to, and corners anticlockwise as seen from outside.
    Faces(Vec<(u32, [DVec3; 3])>),
}

/// Samples of all kinds, in the order of the list of kinds.
pub(crate) fn samples() -> Vec<Sample> {
    Shape::KINDS.iter().flat_map(|kind| samples_of(kind.name)).collect()
}

/// Samples of one kind; none where nobody has written one yet.
pub(crate) fn samples_of(kind: &str) -> Vec<Sample> {
    match kind {
        "plane" => {
            vec![plane(DVec3::ZERO, DVec3::Y), plane(v(1e3, -2e3, 5e2), v(1.0, 2.0, 3.0))]
        }
        "sphere" => {
            vec![sphere(DVec3::ZERO, 1.0), sphere(v(1e3, 2e3, -1e3), 0.01), sphere(v(0.0, -1e5, 0.0), 1e5)]
        }
        "triangle" => vec![
            triangle(DVec3::ZERO, DVec3::X, DVec3::Y),
            triangle(v(3.0, 1.0, -7.0), v(13.0, 1.1, -6.0), v(8.0, 1.1, -6.9)),
        ],
        "tetrahedron" => vec![
            tetrahedron(DVec3::ZERO, v(15.0, 0.0, 0.0), v(0.0, 20.0, 0.0), v(0.0, 0.0, -10.0)),
            tetrahedron(v(1.0, 1.0, 1.0), v(1.0, -1.0, -1.0), v(-1.0, -1.0, 1.0), v(-1.0, 1.0, -1.0)),
            tetrahedron(v(5.0, 0.0, 0.0), v(9.0, 0.0, 1.0), v(6.0, 4.0, 0.0), v(6.5, 1.0, 0.4)),
        ],
        "rectangle" => vec![
            rectangle(DVec3::ZERO, DVec3::X, DVec3::Y),
            rectangle(v(-4.0, 2.0, 9.0), v(6.0, 8.0, 0.0), v(-0.4, 0.3, 1.2)),
        ],
        "disk" => vec![
            disk(DVec3::ZERO, DVec3::Y, 1.0),
            disk(v(-4.0, 2.0, 9.0), v(2.0, 3.0, -6.0), 3.5),
            disk(v(1e3, 2e3, -1e3), v(1e-9, 0.0, -1.0), 0.1),
        ],
        "box" => vec![cuboid(DVec3::NEG_ONE, DVec3::ONE), cuboid(v(100.0, -0.5, 20.0), v(110.0, 0.0, 25.0))],
        "mesh" => vec![octahedron(), kite()],
        "torus" => torus::samples(),
        _ => [round::samples_of(kind), solids::samples_of(kind)].concat(),
    }
}

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

fn plane(point: DVec3, normal: DVec3) -> Sample {
    let shape = Plane::new(point, normal).unwrap().into();
    Sample { shape, form: Form::Plane { point, normal: normal.normalize() } }
}

fn sphere(center: DVec3, radius: f64) -> Sample {
    Sample { shape: Sphere::new(center, radius).unwrap().into(), form: Form::Sphere { center, radius } }
}

fn triangle(a: DVec3, b: DVec3, c: DVec3) -> Sample {
    Sample { shape: Triangle::new(a, b, c).unwrap().into(), form: Form::Faces(vec![(0, [a, b, c])]) }
}

fn tetrahedron(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> Sample {
    let outwards = |corners: [DVec3; 3], opposite: DVec3| {
        let [p, q, r] = corners;
        if (q - p).cross(r - p).dot(opposite - p) > 0.0 { [p, r, q] } else { corners }
    };
    let faces = [([b, c, d], a), ([a, c, d], b), ([a, b, d], c), ([a, b, c], d)];
    let faces = faces.into_iter().map(|(corners, opposite)| outwards(corners, opposite));
    let shape = Tetrahedron::new(a, b, c, d).unwrap().into();
    Sample { shape, form: Form::Faces((0..).zip(faces).collect()) }
}

fn rectangle(corner: DVec3, u: DVec3, v: DVec3) -> Sample {
    let far = corner + u + v;
    let faces = vec![(0, [corner, corner + u, far]), (0, [corner, far, corner + v])];
    Sample { shape: Rectangle::new(corner, u, v).unwrap().into(), form: Form::Faces(faces) }
}

fn disk(center: DVec3, normal: DVec3, radius: f64) -> Sample {
    let shape = Disk::new(center, normal, radius).unwrap().into();
    Sample { shape, form: Form::Disk { center, normal: normal.normalize(), radius } }
}

fn cuboid(min: DVec3, max: DVec3) -> Sample {
    let mut faces = Vec::new();
    for axis in 0..3 {
        // Turning right-handed round the axis: towards the next, then the one after.
        let (next, after) = ((axis + 1) % 3, (axis + 2) % 3);
        for (side, end) in [(0, min[axis]), (1, max[axis])] {
            let corner = |along_next: f64, along_after: f64| {
                let mut p = DVec3::ZERO;
                (p[axis], p[next], p[after]) = (end, along_next, along_after);
                p
            };
            let [a, b] = [corner(min[next], min[after]), corner(max[next], min[after])];
            let [c, d] = [corner(max[next], max[after]), corner(min[next], max[after])];
            let facet = 2 * axis as u32 + side;
            let halves = if side == 1 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
            faces.extend(halves.map(|half| (facet, half)));
        }
    }
    Sample { shape: Cuboid::new(min, max).unwrap().into(), form: Form::Faces(faces) }
}

fn mesh(mesh: TriangleMesh) -> Sample {
    let faces = (0..mesh.triangles().len() as u32).map(|i| (i, mesh.corners(i))).collect();
    let source = MeshSource { path: "sample.ply".into(), mesh: Arc::new(mesh) };
    Sample { shape: Mesh::new(source).into(), form: Form::Faces(faces) }
}

/// Eight triangles round the origin, with normals and texture coordinates.
fn octahedron() -> Sample {
    let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let corners: Vec<[f32; 3]> = corners.into_iter().flat_map(|p: [f32; 3]| [p, p.map(|x| -x)]).collect();
    let (px, nx, py, ny, pz, nz) = (0, 1, 2, 3, 4, 5);
    let upper = [[px, py, pz], [py, nx, pz], [nx, ny, pz], [ny, px, pz]];
    let lower = [[py, px, nz], [nx, py, nz], [ny, nx, nz], [px, ny, nz]];
    let uvs = corners.iter().map(|p| [p[0] / 2.0 + 0.5, p[1] / 2.0 + 0.5]).collect();
    let triangles = [upper, lower].concat();
    mesh(TriangleMesh::new(corners.clone(), triangles, Some(corners), Some(uvs)).unwrap())
}

/// Two triangles that share an edge, not in one plane, and one without area.
fn kite() -> Sample {
    let corners = vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.5], [4.0, 3.0, 0.0], [0.0, 3.0, 0.5]];
    let triangles = vec![[0, 1, 2], [1, 1, 2], [0, 2, 3]];
    let mut sample = mesh(TriangleMesh::new(corners, triangles, None, None).unwrap());
    if let Form::Faces(faces) = &mut sample.form {
        faces.retain(|(facet, _)| *facet != 1);
    }
    sample
}

impl Sample {
    /// Shape and form standing elsewhere.
    pub(crate) fn placed(&self, at: &Placement) -> Self {
        let form = match &self.form {
            Form::Plane { point, normal } => {
                Form::Plane { point: at.point(*point), normal: at.direction(*normal) }
            }
            Form::Sphere { center, radius } => {
                Form::Sphere { center: at.point(*center), radius: radius * at.scale() }
            }
            Form::Disk { center, normal, radius } => Form::Disk {
                center: at.point(*center),
                normal: at.direction(*normal),
                radius: radius * at.scale(),
            },
            Form::Round(round) => Form::Round(round.placed(at)),
            Form::Ring(ring) => Form::Ring(ring.placed(at)),
            Form::Faces(faces) => {
                Form::Faces(faces.iter().map(|(facet, face)| (*facet, face.map(|p| at.point(p)))).collect())
            }
        };
        Self { shape: self.shape.placed(at), form }
    }

    /// The ray of a draw that is aimed at this shape's surface: it meets it at the target, if not before.
    pub(crate) fn aimed(&self, draw: &Draw) -> Ray {
        let target = self.form.target(draw);
        self.through(target, draw)
    }

    /// The ray of a draw that goes through `target`, from well outside the shape.
    pub(crate) fn through(&self, target: DVec3, draw: &Draw) -> Ray {
        let origin = self.form.middle() + draw.from.normalize() * (draw.distance * self.form.reach());
        Ray::new(origin, (target - origin) * draw.stretch)
    }
}

/// A ray before it is known what it is aimed at.
#[derive(Debug, Clone)]
pub(crate) struct Draw {
    /// Where from, as a direction from the shape's middle.
    pub from: DVec3,
    /// How far, in sizes of the shape, above 1.
    pub distance: f64,
    /// Which face.
    pub pick: usize,
    /// Where on it, each in 0..1.
    pub at: DVec2,
    /// Length of the direction, in distances to the target.
    pub stretch: f64,
}

impl Form {
    /// A point on the surface, not close to the edge of a face.
    fn target(&self, draw: &Draw) -> DVec3 {
        match self {
            Self::Plane { point, normal } => {
                let across = normal.any_orthonormal_vector();
                *point + across * (9.0 * draw.at.x) + normal.cross(across) * (9.0 * draw.at.y)
            }
            Self::Sphere { center, radius } => {
                let (height, turn) = (2.0 * draw.at.x - 1.0, std::f64::consts::TAU * draw.at.y);
                let out = (1.0 - height * height).sqrt();
                *center + DVec3::new(out * turn.cos(), height, out * turn.sin()) * *radius
            }
            Self::Disk { center, normal, radius } => {
                let across = normal.any_orthonormal_vector();
                let (turn, out) = (std::f64::consts::TAU * draw.at.y, 0.98 * radius * draw.at.x.sqrt());
                *center + (across * turn.cos() + normal.cross(across) * turn.sin()) * out
            }
            Self::Round(round) => round.target(draw),
            Self::Ring(ring) => ring.target(draw),
            Self::Faces(faces) => {
                let (_, [a, b, c]) = faces[draw.pick % faces.len()];
                // Folded into the triangle, then drawn towards its middle.
                let (u, v) = (draw.at.x, draw.at.y);
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                let p = a + (b - a) * u + (c - a) * v;
                p.lerp((a + b + c) / 3.0, 0.02)
            }
        }
    }

    /// A point within a solid, from where all of it is seen, if there is one; the middle of a ring; or somewhere on what is flat.
    pub(crate) fn middle(&self) -> DVec3 {
        match self {
            Self::Plane { point, .. } => *point,
            Self::Sphere { center, .. } | Self::Disk { center, .. } => *center,
            Self::Round(round) => round.ends[0].midpoint(round.ends[1]),
            Self::Ring(ring) => ring.center,
            Self::Faces(faces) => {
                let corners: Vec<DVec3> = faces.iter().flat_map(|(_, face)| *face).collect();
                corners.iter().sum::<DVec3>() / corners.len() as f64
            }
        }
    }

    /// A point within a closed shape, and whether all of it is seen from there.
    pub(crate) fn inside(&self) -> (DVec3, bool) {
        match self {
            Self::Ring(ring) => (ring.on_ring(1.0), false),
            form => (form.middle(), true),
        }
    }

    /// No point of it is further from the middle; 10 m for what has no end.
    pub(crate) fn reach(&self) -> f64 {
        match self {
            Self::Plane { .. } => 10.0,
            Self::Sphere { radius, .. } | Self::Disk { radius, .. } => *radius,
            Self::Round(round) => round.reach(),
            Self::Ring(ring) => ring.radii[0] + ring.radii[1],
            Self::Faces(faces) => {
                let middle = self.middle();
                faces.iter().flat_map(|(_, face)| *face).map(|p| p.distance(middle)).fold(0.0, f64::max)
            }
        }
    }

    /// Whether no corner lies in front of a face, but for rounding.
    pub(crate) fn is_convex(&self) -> bool {
        let Self::Faces(faces) = self else { return !matches!(self, Self::Ring(_)) };
        let slack = 1e-12 * self.largest_coordinate();
        let corners = || faces.iter().flat_map(|(_, face)| *face);
        faces.iter().all(|(facet, [a, _, _])| {
            let normal = self.normal(*a, *facet);
            corners().all(|corner| (corner - *a).dot(normal) <= slack)
        })
    }

    /// Stretches on the surface where facets meet, or short ones across such places.
    pub(crate) fn seams(&self) -> Vec<[DVec3; 2]> {
        match self {
            Self::Plane { .. } | Self::Sphere { .. } | Self::Disk { .. } | Self::Ring(_) => Vec::new(),
            Self::Round(round) => round.seams(),
            Self::Faces(faces) => {
                faces.iter().flat_map(|(_, [a, b, c])| [[*a, *b], [*b, *c], [*c, *a]]).collect()
            }
        }
    }

    /// How far the surface is from the middle at least.
    pub(crate) fn depth(&self) -> f64 {
        match self {
            Self::Plane { .. } | Self::Disk { .. } => 0.0,
            Self::Sphere { radius, .. } => *radius,
            Self::Round(round) => round.depth(),
            Self::Ring(ring) => ring.radii[1],
            Self::Faces(faces) => {
                let middle = self.middle();
                faces.iter().map(|(_, face)| distance_to(face, middle)).fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// How far one must move along the surface at a point, at least, for the normal to turn by a radian, or as far as it reaches.
    pub(crate) fn bend(&self, p: DVec3) -> f64 {
        match self {
            Self::Round(round) => round.distance_from_axis(p),
            Self::Ring(ring) => ring.radii[1],
            form => form.reach(),
        }
    }

    /// Corners of the smallest box round it, to rounding; `None` for what has no end.
    pub(crate) fn bounds(&self) -> Option<(DVec3, DVec3)> {
        match self {
            Self::Plane { .. } => None,
            Self::Sphere { center, radius } => Some((*center - *radius, *center + *radius)),
            Self::Disk { center, normal, radius } => Some(disk_bounds(*center, *normal, *radius)),
            Self::Round(round) => Some(round.bounds()),
            Self::Ring(ring) => Some(ring.bounds()),
            Self::Faces(faces) => {
                let corners = || faces.iter().flat_map(|(_, face)| *face);
                Some((corners().reduce(DVec3::min)?, corners().reduce(DVec3::max)?))
            }
        }
    }

    /// The largest coordinate that takes part in describing it.
    pub(crate) fn largest_coordinate(&self) -> f64 {
        let largest = |p: DVec3| p.abs().max_element();
        match self {
            Self::Plane { point, .. } => largest(*point),
            Self::Sphere { center, radius } | Self::Disk { center, radius, .. } => {
                radius.max(largest(*center))
            }
            Self::Ring(ring) => largest(ring.center).max(ring.radii[0]),
            Self::Round(Round { ends, radii, .. }) => {
                ends.map(largest).into_iter().chain(*radii).fold(0.0, f64::max)
            }
            Self::Faces(faces) => faces.iter().flat_map(|(_, face)| *face).map(largest).fold(0.0, f64::max),
        }
    }

    /// How far a point is from the surface's facet.
    pub(crate) fn distance(&self, p: DVec3, facet: u32) -> f64 {
        match self {
            Self::Plane { point, normal } => normal.dot(p - *point).abs(),
            Self::Sphere { center, radius } => (p.distance(*center) - radius).abs(),
            Self::Disk { center, normal, radius } => {
                let above = normal.dot(p - *center);
                let beside = (p - *center - *normal * above).length() - radius;
                above.hypot(beside.max(0.0))
            }
            Self::Round(round) => round.distance(p, facet),
            Self::Ring(ring) => (ring.away_from_tube(p).length() - ring.radii[1]).abs(),
            Self::Faces(faces) => {
                let of_facet = faces.iter().filter(|(of, _)| *of == facet);
                of_facet.map(|(_, face)| distance_to(face, p)).fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// The unit normal at a point of a facet, as the shape's documentation turns it.
    pub(crate) fn normal(&self, p: DVec3, facet: u32) -> DVec3 {
        match self {
            Self::Plane { normal, .. } | Self::Disk { normal, .. } => *normal,
            Self::Sphere { center, .. } => (p - *center).normalize(),
            Self::Round(round) => round.normal(p, facet),
            Self::Ring(ring) => ring.away_from_tube(p).normalize(),
            Self::Faces(faces) => {
                let (_, [a, b, c]) = faces.iter().find(|(of, _)| *of == facet).expect("a facet of the shape");
                (b - a).cross(c - a).normalize()
            }
        }
    }
}

/// Corners of the smallest box round a disk.
fn disk_bounds(center: DVec3, normal: DVec3, radius: f64) -> (DVec3, DVec3) {
    // The rim is highest where the axis, laid down into the disk, points.
    let highest = |axis: DVec3| normal.cross(axis).cross(normal).normalize_or_zero() * radius;
    let half = DVec3::from(DVec3::AXES.map(|axis| highest(axis).dot(axis)));
    (center - half, center + half)
}

/// From a triangle to a point: to the plane where the point is above the triangle, else to the nearest edge. Made
/// from lengths alone, so that it holds for slivers too.
fn distance_to(face: &[DVec3; 3], p: DVec3) -> f64 {
    let [a, b, c] = face;
    let normal = (b - a).cross(c - a).normalize();
    let edges = [(a, b), (b, c), (c, a)];
    if edges.iter().all(|(from, to)| (**to - **from).cross(normal).dot(p - **from) <= 0.0) {
        return normal.dot(p - a).abs();
    }
    let to_edge = |(from, to): (&DVec3, &DVec3)| {
        let along = (p - from).dot(to - from) / (to - from).length_squared();
        p.distance(from.lerp(*to, along.clamp(0.0, 1.0)))
    };
    edges.into_iter().map(to_edge).fold(f64::INFINITY, f64::min)
}
