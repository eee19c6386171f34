//! Shapes as the SIMD kernels read them: constants in `f32` to propose hits with and in `f64` to refine them with.

use std::ops::Deref;
use std::sync::Arc;

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Member, Placement, Shape};
use fearless_simd::Simd;

use super::Prim;
use super::origin::relative;
use super::rows::{KernelVisitor, Row, Rows};
use crate::accel::MeshTree;
use crate::kernel::{
    CuboidRow, FacetsRow, FlatRow, Kernel, PlaneRow, RoundRow, SolidRow, SphereRow, TorusRow, TriangleRow,
};
use crate::lanes::outlined;
use crate::numeric::ORDINARY;

/// A placed mesh.
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

    /// Round what can be met of a shape, relative to an origin.
    fn of(prim: &Prim, origin: DVec3) -> Option<Self> {
        match (&*relative(&prim.shape, origin), &prim.member) {
            (Shape::Sphere(sphere), None) => Some(Self { center: sphere.center(), radius: sphere.radius() }),
            (shape, None) => shape.bounds().map(Self::round),
            (_, Some(member)) => {
                let round = Self::round(member.bounds()?);
                Some(Self { center: round.center - origin, ..round })
            }
        }
    }
}

/// All shapes as kernels read them.
#[derive(Debug, Default)]
pub(crate) struct Columns {
    kernels: Rows,
    /// The kernel row of each shape.
    pub(crate) rows: Vec<Row>,
    /// Bounded shapes, in the order of the tree's items.
    pub(crate) bounded: Vec<u32>,
    /// A ball round each of them, in the same order.
    pub(crate) balls: Vec<Ball>,
    /// Whether any shape shades with another normal than its geometric one.
    pub(crate) smooth: bool,
    /// Unbounded shapes that have no kernel.
    pub(crate) general_unbounded: Vec<u32>,
}

impl Deref for Columns {
    type Target = Rows;

    #[inline(always)]
    fn deref(&self) -> &Rows {
        &self.kernels
    }
}

impl Columns {
    /// Relative to an origin.
    pub(crate) fn of(prims: &[Prim], bounded: &[u32], meshes: &[Arc<MeshTree>], origin: DVec3) -> Self {
        let ball = |i: u32| Ball::of(&prims[i as usize], origin);
        let balls = bounded.iter().filter_map(|&i| ball(i)).collect();
        let mut columns = Self { bounded: bounded.to_vec(), balls, ..Self::default() };
        for (prim, id) in prims.iter().zip(0..) {
            let row = columns.add(prim, origin, id, meshes);
            columns.rows.push(row);
            columns.smooth |= match row {
                Row::Instance(_) => prim.mesh.is_some_and(|m| meshes[m as usize].mesh().normals().is_some()),
                row => row == Row::General,
            };
            if row == Row::General && prim.bounds().is_none() {
                columns.general_unbounded.push(id);
            }
        }
        columns
    }

    /// Whether a shape is a sphere with a kernel.
    pub(crate) fn is_sphere(&self, prim: u32) -> bool {
        matches!(self.rows[prim as usize], Row::Sphere(_))
    }

    /// The mesh with its placement that a shape is, if it is one.
    pub(crate) fn instance(&self, prim: u32) -> Option<&Instance> {
        match self.rows[prim as usize] {
            Row::Instance(row) => Some(&self.instances[row as usize]),
            _ => None,
        }
    }

    /// Whether a shape with a kernel is flat or a convex solid: rays that leave it outwards do not meet it again.
    pub(crate) fn is_convex(&self, prim: u32) -> bool {
        match self.rows[prim as usize] {
            Row::Instance(_) | Row::Torus(_) | Row::Facets(_) | Row::General => false,
            Row::Solid(at) => self.solids[at as usize].is_convex(),
            _ => true,
        }
    }

    /// The flat faces that make up a shape, if they have a kernel.
    pub(crate) fn faces_of(&self, prim: u32) -> Option<std::ops::Range<u32>> {
        match self.rows[prim as usize] {
            Row::Triangles(first, count) => Some(first..first + count),
            _ => None,
        }
    }

    /// Whether a kernel tells of a shape which of its facets rays meet, and not of one facet how: what it leaves undecided
    /// is asked of the whole shape.
    pub(crate) fn is_asked_whole(&self, prim: u32) -> bool {
        matches!(
            self.rows[prim as usize],
            Row::Triangles(..) | Row::Round(_) | Row::Solid(_) | Row::Facets(_)
        )
    }

    /// Calls a visitor with the kernel of a shape. Kernels of common shapes are inlined into the caller, the others
    /// [`outlined`].
    #[inline(always)]
    pub(crate) fn visit<S: Simd, V: KernelVisitor>(&self, s: S, prim: u32, visitor: V) -> V::Output {
        let row = self.rows[prim as usize];
        match self.kernels.visit_common(row, visitor) {
            Ok(output) => output,
            Err(visitor) => outlined(
                s,
                #[inline(always)]
                || self.kernels.visit_other(row, visitor),
            ),
        }
    }

    /// Shows a visitor the kernel of a shape if that is a common one; gives the visitor back if it is not.
    #[inline(always)]
    pub(crate) fn visit_common<V: KernelVisitor>(&self, prim: u32, visitor: V) -> Result<V::Output, V> {
        self.kernels.visit_common(self.rows[prim as usize], visitor)
    }

    /// As [`visit`](Self::visit), with all kernels compiled into the caller.
    #[inline(always)]
    pub(crate) fn visit_here<V: KernelVisitor>(&self, prim: u32, visitor: V) -> V::Output {
        let row = self.rows[prim as usize];
        match self.kernels.visit_common(row, visitor) {
            Ok(output) => output,
            Err(visitor) => self.kernels.visit_other(row, visitor),
        }
    }

    /// Whether a point lies outside all convex solids that have a kernel.
    pub(crate) fn is_outside(&self, point: DVec3) -> bool {
        (0..self.rows.len() as u32).all(|prim| self.visit_here(prim, IsOutside(point)))
    }

    /// How many shapes have no kernel.
    pub(crate) fn without_kernel(&self) -> usize {
        self.rows.iter().filter(|&&row| row == Row::General).count()
    }

    fn add(&mut self, prim: &Prim, origin: DVec3, id: u32, meshes: &[Arc<MeshTree>]) -> Row {
        let shape = &*relative(&prim.shape, origin);
        if let Some(member) = &prim.member {
            return self.add_member(member, origin, id);
        }
        if !is_ordinary(shape) {
            return Row::General;
        }
        if let Some(mesh) = shape.as_mesh() {
            let Some(tree) = prim.mesh else { return Row::General };
            let tree = Arc::clone(&meshes[tree as usize]);
            let instance = Instance { prim: id, tree, to_object: Affine::of(mesh.to_object()) };
            return Row::Instance(push(&mut self.kernels.instances, instance));
        }
        match shape {
            Shape::Plane(plane) => {
                Row::Plane(push(&mut self.kernels.planes, PlaneRow::new(plane.point(), plane.normal(), id)))
            }
            Shape::Sphere(sphere) => {
                Row::Sphere(push(&mut self.kernels.spheres, SphereRow::new(sphere.center(), sphere.radius())))
            }
            Shape::Rectangle(r) => {
                Row::Flat(push(&mut self.kernels.flats, FlatRow::rectangle(r.corner(), r.edges(), id)))
            }
            Shape::Disk(d) => Row::Flat(push(
                &mut self.kernels.flats,
                FlatRow::disk(d.center(), d.normal(), d.radius(), id),
            )),
            Shape::Cuboid(cuboid) => {
                let Shape::Cuboid(in_frame) = &prim.shape else { return Row::General };
                Row::Cuboid(push(&mut self.kernels.cuboids, CuboidRow::new(cuboid, in_frame, id)))
            }
            Shape::Cylinder(c) if !c.is_open() => self.add_round(c.ends(), [c.radius(); 2], false),
            Shape::Cone(c) if !c.is_open() => self.add_round(c.ends(), c.radii(), false),
            Shape::Capsule(c) => self.add_round(c.ends(), [c.radius(); 2], true),
            Shape::Torus(torus) => Row::Torus(push(&mut self.kernels.tori, TorusRow::new(torus))),
            Shape::Triangle(t) => self.add_facets(id, &[t.corners()]),
            Shape::Tetrahedron(t) => self.add_facets(id, &[0, 1, 2, 3].map(|face| t.face(face))),
            shape => match SolidRow::whole(shape, &prim.shape, id) {
                Some(row) => self.add_solid(Some(row)),
                None => self.add_faceted(shape, id),
            },
        }
    }

    /// Adds the part of a solid that a shape is. One without an end is tried by itself.
    fn add_member(&mut self, member: &Member, origin: DVec3, id: u32) -> Row {
        let place = |shape: &Shape| Some(relative(shape, origin).into_owned()).filter(is_ordinary);
        let row = member.bounds().and_then(|_| SolidRow::member(member, place, id));
        self.add_solid(row)
    }

    fn add_solid(&mut self, row: Option<SolidRow>) -> Row {
        row.map_or(Row::General, |row| Row::Solid(push(&mut self.kernels.solids, row)))
    }

    /// Adds what is neither convex nor a mesh and has flat facets.
    fn add_faceted(&mut self, shape: &Shape, id: u32) -> Row {
        let row = shape.faceted().and_then(|solid| FacetsRow::new(solid, id));
        row.map_or(Row::General, |row| Row::Facets(push(&mut self.kernels.facets, row)))
    }

    fn add_round(&mut self, ends: [DVec3; 2], radii: [f64; 2], has_balls: bool) -> Row {
        Row::Round(push(&mut self.kernels.rounds, RoundRow::new(ends, radii, has_balls)))
    }

    /// Adds the triangles that a shape is made of.
    fn add_facets(&mut self, id: u32, facets: &[[DVec3; 3]]) -> Row {
        let numbered = (0..).zip(facets);
        let rows: Option<Vec<_>> =
            numbered.map(|(facet, corners)| TriangleRow::new(*corners, id, facet)).collect();
        let Some(rows) = rows else { return Row::General };
        let first = self.kernels.triangles.len() as u32;
        self.kernels.triangles.extend(rows);
        Row::Triangles(first, facets.len() as u32)
    }
}

/// Whether a point lies outside a shape that has an inside.
struct IsOutside(DVec3);

impl KernelVisitor for IsOutside {
    type Output = bool;

    fn visit(self, kernel: &impl Kernel) -> bool {
        kernel.is_outside(self.0)
    }

    fn visit_mesh(self, _: &Instance) -> bool {
        true
    }

    fn visit_none(self) -> bool {
        true
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
