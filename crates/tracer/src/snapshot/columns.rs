//! Shapes as the SIMD kernels read them: constants in `f32` to propose with and in `f64` to settle with.

use std::sync::Arc;

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Placement, Shape};

use super::Prim;
use super::origin::relative;
use crate::accel::MeshTree;
use crate::kernel::{CuboidRow, FlatRow, PlaneRow, SphereRow, TriangleRow};
use crate::numeric::{ORDINARY, PLAN_MARGIN};

/// Where a mesh stands.
#[derive(Debug, Clone)]
pub(crate) struct Instance {
    pub(crate) prim: u32,
    pub(crate) tree: Arc<MeshTree>,
    /// From the world to the mesh's own space; `None` where they are the same.
    pub(crate) to_object: Option<Affine>,
}

/// `p → matrix · p + shift`, row by row.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Affine {
    pub(crate) matrix: [DVec3; 3],
    pub(crate) shift: DVec3,
}

impl Affine {
    /// The same map as a placement; `None` for the one that leaves everything where it is.
    fn of(placement: &Placement) -> Option<Self> {
        let columns = DVec3::AXES.map(|axis| placement.vector(axis));
        let matrix = [0, 1, 2].map(|row| DVec3::from(columns.map(|column| column[row])));
        (*placement != Placement::IDENTITY).then(|| Self { matrix, shift: placement.point(DVec3::ZERO) })
    }
}

/// What stands behind a shape of the snapshot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Row {
    Plane(u32),
    Sphere(u32),
    Flat(u32),
    Cuboid(u32),
    /// The first of so many triangles, the faces of one shape in order of their facets.
    Triangles(u32, u32),
    Instance(u32),
    /// No kernel: crossed in `f64`, one ray at a time.
    General,
}

/// A ball round a shape.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ball {
    pub(crate) center: DVec3,
    pub(crate) radius: f64,
}

impl Ball {
    /// Round a box.
    pub(crate) fn round(bounds: Aabb) -> Self {
        Self { center: bounds.centre(), radius: bounds.size().length() / 2.0 }
    }

    /// The box round it.
    pub(crate) fn bounds(&self) -> Aabb {
        let reach = DVec3::splat(self.radius);
        Aabb { min: self.center - reach, max: self.center + reach }
    }

    fn of(shape: &Shape) -> Option<Self> {
        match shape {
            Shape::Sphere(sphere) => Some(Self { center: sphere.center(), radius: sphere.radius() }),
            shape => shape.bounds().map(Self::round),
        }
    }
}

/// The rows of all kernels.
#[derive(Debug, Default)]
pub(crate) struct Columns {
    pub(crate) planes: Vec<PlaneRow>,
    pub(crate) spheres: Vec<SphereRow>,
    pub(crate) flats: Vec<FlatRow>,
    pub(crate) cuboids: Vec<CuboidRow>,
    pub(crate) triangles: Vec<TriangleRow>,
    pub(crate) instances: Vec<Instance>,
    /// What stands behind each shape.
    pub(crate) rows: Vec<Row>,
    /// Shapes that have an end, in the order of the tree's items.
    pub(crate) bounded: Vec<u32>,
    /// A ball round each of them, in the same order.
    pub(crate) balls: Vec<Ball>,
    /// Whether any shape shades with another normal than its geometric one.
    pub(crate) smooth: bool,
    /// Shapes without an end that have no kernel.
    pub(crate) general_unbounded: Vec<u32>,
}

impl Columns {
    /// Relative to an origin.
    pub(crate) fn of(prims: &[Prim], bounded: &[u32], meshes: &[Arc<MeshTree>], origin: DVec3) -> Self {
        let ball = |i: u32| Ball::of(&relative(&prims[i as usize].shape, origin));
        let balls = bounded.iter().filter_map(|&i| ball(i)).collect();
        let mut columns = Self { bounded: bounded.to_vec(), balls, ..Self::default() };
        for (prim, id) in prims.iter().zip(0..) {
            let row = columns.add(prim, &relative(&prim.shape, origin), id, meshes);
            columns.rows.push(row);
            columns.smooth |= match row {
                Row::Instance(_) => prim.mesh.is_some_and(|m| meshes[m as usize].mesh().normals().is_some()),
                row => row == Row::General,
            };
            if row == Row::General && prim.shape.bounds().is_none() {
                columns.general_unbounded.push(id);
            }
        }
        columns
    }

    /// Whether a shape is a sphere with a kernel.
    pub(crate) fn is_sphere(&self, prim: u32) -> bool {
        matches!(self.rows[prim as usize], Row::Sphere(_))
    }

    /// Whether a shape with a kernel is flat or a convex solid: rays that leave it outwards do not meet it again.
    pub(crate) fn is_convex(&self, prim: u32) -> bool {
        !matches!(self.rows[prim as usize], Row::Instance(_) | Row::General)
    }

    /// The flat faces that make up a shape, if they have a kernel.
    pub(crate) fn faces_of(&self, prim: u32) -> Option<std::ops::Range<u32>> {
        match self.rows[prim as usize] {
            Row::Triangles(first, count) => Some(first..first + count),
            _ => None,
        }
    }

    /// The plane that a facet of a flat shape or of a solid with flat faces lies in.
    #[inline(always)]
    pub(crate) fn plane_of(&self, row: Row, facet: u32) -> Option<&PlaneRow> {
        match row {
            Row::Plane(row) => Some(&self.planes[row as usize]),
            Row::Flat(row) => Some(&self.flats[row as usize].plane),
            Row::Cuboid(row) => self.cuboids[row as usize].faces.get(facet as usize),
            Row::Triangles(first, _) => self.triangles.get((first + facet) as usize).map(|face| &face.plane),
            Row::Sphere(_) | Row::Instance(_) | Row::General => None,
        }
    }

    /// Whether a point lies outside all convex solids that have a kernel.
    pub(crate) fn is_outside(&self, point: DVec3) -> bool {
        let off_sphere = |row: &SphereRow| row.center.distance(point) > row.radius * (1.0 + PLAN_MARGIN);
        let before = |face: &PlaneRow| {
            let PlaneRow { normal, distance, .. } = *face;
            normal.dot(point) - distance > PLAN_MARGIN * (distance.abs() + point.abs().element_sum())
        };
        let mut shapes = self.triangles.chunk_by(|a, b| a.plane.prim == b.plane.prim);
        self.spheres.iter().all(off_sphere)
            && self.cuboids.iter().all(|cuboid| cuboid.faces.iter().any(before))
            && shapes.all(|faces| faces.len() == 1 || faces.iter().any(|face| before(&face.plane)))
    }

    /// How many shapes have no kernel.
    pub(crate) fn without_kernel(&self) -> usize {
        self.rows.iter().filter(|&&row| row == Row::General).count()
    }

    fn add(&mut self, prim: &Prim, shape: &Shape, id: u32, meshes: &[Arc<MeshTree>]) -> Row {
        if !is_ordinary(shape) {
            return Row::General;
        }
        match shape {
            Shape::Plane(plane) => {
                Row::Plane(push(&mut self.planes, PlaneRow::new(plane.point(), plane.normal(), id)))
            }
            Shape::Sphere(sphere) => {
                Row::Sphere(push(&mut self.spheres, SphereRow::new(sphere.center(), sphere.radius())))
            }
            Shape::Rectangle(r) => {
                Row::Flat(push(&mut self.flats, FlatRow::rectangle(r.corner(), r.edges(), id)))
            }
            Shape::Disk(d) => {
                Row::Flat(push(&mut self.flats, FlatRow::disk(d.center(), d.normal(), d.radius(), id)))
            }
            Shape::Cuboid(cuboid) => {
                let Shape::Cuboid(in_frame) = &prim.shape else { return Row::General };
                Row::Cuboid(push(&mut self.cuboids, CuboidRow::new(cuboid, in_frame, id)))
            }
            Shape::Triangle(t) => self.add_facets(id, &[t.corners()]),
            Shape::Tetrahedron(t) => self.add_facets(id, &[0, 1, 2, 3].map(|face| t.face(face))),
            Shape::Mesh(mesh) => match prim.mesh {
                Some(tree) => {
                    let tree = Arc::clone(&meshes[tree as usize]);
                    let instance = Instance { prim: id, tree, to_object: Affine::of(mesh.to_object()) };
                    Row::Instance(push(&mut self.instances, instance))
                }
                None => Row::General,
            },
            _ => Row::General,
        }
    }

    /// Adds the triangles that a shape is made of.
    fn add_facets(&mut self, id: u32, facets: &[[DVec3; 3]]) -> Row {
        let numbered = (0..).zip(facets);
        let rows: Option<Vec<_>> =
            numbered.map(|(facet, corners)| TriangleRow::new(*corners, id, facet)).collect();
        let Some(rows) = rows else { return Row::General };
        let first = self.triangles.len() as u32;
        self.triangles.extend(rows);
        Row::Triangles(first, facets.len() as u32)
    }
}

/// Whether `f32` holds squares and products of a shape's coordinates; of others it could be certain and wrong.
fn is_ordinary(shape: &Shape) -> bool {
    let [least, most] = ORDINARY;
    match (shape, shape.bounds()) {
        (Shape::Plane(plane), _) => plane.point().abs().max_element() <= most,
        (_, Some(bounds)) => {
            let largest = bounds.min.abs().max(bounds.max.abs()).max_element();
            (least..=most).contains(&largest)
        }
        (_, None) => true,
    }
}

fn push<T>(rows: &mut Vec<T>, row: T) -> u32 {
    rows.push(row);
    rows.len() as u32 - 1
}
