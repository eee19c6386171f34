//! Culls reflections that meet nothing but a black background, before any hit is refined: bounds of the points and of the
//! directions of arriving rays give bounds of the reflected ones.

use super::beam::Beam;
use super::point_bounds::PointBounds;
use crate::kernel::Kernel;
use crate::snapshot::{Columns, Instance, KernelVisitor};

/// Whether no ray of a beam meets anything once it is mirrored at given points of a shape.
pub(super) fn goes_dark(columns: &Columns, beam: &Beam, bounds: &PointBounds, outside: bool) -> bool {
    columns.visit_here(bounds.prim, GoesDark { columns, beam, bounds, outside })
}

struct GoesDark<'a> {
    columns: &'a Columns,
    beam: &'a Beam,
    bounds: &'a PointBounds,
    outside: bool,
}

impl KernelVisitor for GoesDark<'_> {
    type Output = bool;

    fn visit(self, kernel: &impl Kernel) -> bool {
        let Self { columns, beam, bounds, outside } = self;
        kernel.all_normals(bounds.center, bounds.half, |normal, half| {
            !beam.mirrored(bounds, normal, half).may_meet_any(columns, outside)
        })
    }

    fn visit_mesh(self, _: &Instance) -> bool {
        false
    }

    fn visit_none(self) -> bool {
        false
    }
}
