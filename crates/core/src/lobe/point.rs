//! Where is a surface met, and how does it lie there?

use glam::{DVec2, DVec3};

use crate::{Lane, Triple};

/// Where and from where a surface is seen.
#[derive(Debug, Clone, Copy)]
pub struct ShadingPoint<L: Lane> {
    /// The point, metres, relative to the origin that the material was made for; see
    /// [`Surface::relative_to`](crate::Surface::relative_to).
    pub position: Triple<L>,
    /// Unit normal on the viewer's side.
    pub normal: Triple<L>,
    /// Unit vector to the viewer.
    pub to_viewer: Triple<L>,
    /// Metres to the viewer.
    pub distance: L,
    /// Whether the viewer is on the side that the shape's own normal points to; of a closed shape the outside.
    pub front: L::Mask,
}

impl ShadingPoint<f64> {
    /// The origin, seen along its normal from a metre away.
    pub const HEAD_ON: Self = Self {
        position: Triple::new(0.0, 0.0, 0.0),
        normal: Triple::new(0.0, 0.0, 1.0),
        to_viewer: Triple::new(0.0, 0.0, 1.0),
        distance: 1.0,
        front: true,
    };
}

/// Where and from where a surface is seen, with what textures, smooth normals and refraction need.
#[derive(Debug, Clone, Copy)]
pub struct SurfacePoint {
    /// Point, shading normal and viewer.
    pub shading: ShadingPoint<f64>,
    /// Unit normal of the shape itself, on the viewer's side.
    pub geometric: DVec3,
    /// Texture coordinates.
    pub uv: DVec2,
    /// Where the first texture coordinate grows: the derivative of the point by it, of any length; zero where there is none.
    pub tangent: DVec3,
    /// Index of refraction of what is round the solid: 1 in air.
    pub outside_ior: f64,
}

impl SurfacePoint {
    /// A point of a flat surface in air, without texture coordinates.
    #[must_use]
    pub fn flat(shading: ShadingPoint<f64>) -> Self {
        Self {
            geometric: shading.normal.into(),
            shading,
            uv: DVec2::ZERO,
            tangent: DVec3::ZERO,
            outside_ior: 1.0,
        }
    }

    /// Unit shading normal on the viewer's side.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.shading.normal.into()
    }

    /// Unit vector to the viewer.
    #[must_use]
    pub fn to_viewer(&self) -> DVec3 {
        self.shading.to_viewer.into()
    }
}
