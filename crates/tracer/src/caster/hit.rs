//! What is told of a place where a ray meets a surface?

use catoptra_core::EntityId;
use catoptra_core::glam::{DVec2, DVec3};

use crate::SurfaceId;

/// Where a ray of the world meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct WorldHit {
    /// Which shape of the scene, or which light that is one.
    pub entity: EntityId,
    /// Which triangle of a mesh, in the order that the triangles were given in; which face of a solid that has faces; 0 of all else.
    pub triangle: u32,
    /// How far along the ray, in lengths of its direction.
    pub t: f64,
    /// Where in the world, metres: the ray's point at `t`, rounded.
    pub point: DVec3,
    /// Unit geometric normal on the outer side, whichever side the ray comes from: of a triangle the side from which its corners run
    /// anticlockwise.
    pub normal: DVec3,
    /// Unit normal to shade with; differs from `normal` only on meshes with vertex normals.
    pub shading_normal: DVec3,
    /// Texture coordinates, as [`Geometry::parametrization`](catoptra_core::Geometry::parametrization) defines them for each
    /// shape; on triangles that have none of their own, the weights of the second and the third corner.
    pub uv: DVec2,
    /// The surface, for [`WorldRay::leaving`](crate::WorldRay::leaving) in the same caster.
    pub surface: SurfaceId,
}
