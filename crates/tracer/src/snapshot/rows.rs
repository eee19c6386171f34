//! The list of kernels, and which of them each shape uses.

use super::Instance;
use crate::kernel::{
    Apart, CuboidRow, Faces, FacetsRow, FlatRow, Kernel, PlaneRow, RoundRow, SolidRow, SphereRow, TorusRow,
    TriangleRow,
};

/// Work that is compiled once per kernel; called with the kernel of one shape.
pub(crate) trait KernelVisitor: Sized {
    /// The result of the work.
    type Output;

    /// Works with a kernel.
    fn visit(self, kernel: &impl Kernel) -> Self::Output;

    /// Works with a mesh.
    fn visit_mesh(self, instance: &Instance) -> Self::Output;

    /// Works without a kernel: the shape is crossed in `f64`, one ray at a time.
    fn visit_none(self) -> Self::Output;
}

/// Declares the kernels: a column of rows for each, and the enum [`Row`] that names one. Those of common shapes come
/// first, those that are compiled [`Apart`] last.
macro_rules! rows {
    (
        common: $($common:ident: $Common:ident($CommonRow:ident)),+;
        other: $($other:ident: $Other:ident($OtherRow:ident)),+;
        apart: $($apart:ident: $Apart:ident($ApartRow:ident)),+;
    ) => {
        /// The kernel of a shape of the snapshot, with its index in that kernel's column.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub(crate) enum Row {
            $($Common(u32),)+
            $($Other(u32),)+
            $($Apart(u32),)+
            /// The first of a number of triangles, the faces of one shape in order of their facets.
            Triangles(u32, u32),
            Instance(u32),
            /// No kernel.
            General,
        }

        /// The rows of all kernels.
        #[derive(Debug, Default)]
        pub(crate) struct Rows {
            $(pub(crate) $common: Vec<$CommonRow>,)+
            $(pub(crate) $other: Vec<$OtherRow>,)+
            $(pub(crate) $apart: Vec<$ApartRow>,)+
            pub(crate) triangles: Vec<TriangleRow>,
            pub(crate) instances: Vec<Instance>,
        }

        impl Rows {
            /// Shows a visitor a kernel of a common shape; gives the visitor back where there is none.
            #[inline(always)]
            pub(super) fn visit_common<V: KernelVisitor>(&self, row: Row, visitor: V) -> Result<V::Output, V> {
                match row {
                    $(Row::$Common(at) => Ok(visitor.visit(&self.$common[at as usize])),)+
                    _ => Err(visitor),
                }
            }

            /// Calls a visitor with a kernel that is not one of the common ones.
            #[inline(always)]
            pub(super) fn visit_other<V: KernelVisitor>(&self, row: Row, visitor: V) -> V::Output {
                match row {
                    $(Row::$Other(at) => visitor.visit(&self.$other[at as usize]),)+
                    $(Row::$Apart(at) => visitor.visit(&Apart(&self.$apart[at as usize])),)+
                    Row::Triangles(first, count) => {
                        visitor.visit(&Faces(&self.triangles[first as usize..(first + count) as usize]))
                    }
                    Row::Instance(at) => visitor.visit_mesh(&self.instances[at as usize]),
                    Row::General $(| Row::$Common(_))+ => visitor.visit_none(),
                }
            }
        }
    };
}

rows! {
    common: planes: Plane(PlaneRow), spheres: Sphere(SphereRow);
    other: flats: Flat(FlatRow), cuboids: Cuboid(CuboidRow);
    apart: rounds: Round(RoundRow), solids: Solid(SolidRow), tori: Torus(TorusRow), facets: Facets(FacetsRow);
}
