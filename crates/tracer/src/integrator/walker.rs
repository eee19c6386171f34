//! The state of an integrator that follows one path at a time in `f64`, and the surfaces that its rays hit.

use catoptra_core::glam::DVec3;
use catoptra_core::material::Footprint;
use catoptra_core::{Material, Raster, Ray, ShadingPoint};

use super::Search;
use super::lamp_sight::LampSight;
use super::matter::PathRay;
use crate::sampler::Sampler;
use crate::{Frame, Hit, Stats};

/// A ray from the camera, in the snapshot's frame, and the sampler of its path.
pub(crate) struct CameraRay {
    pub(super) ray: Ray,
    /// The numbers of the pixel.
    pub(super) sampler: Sampler<u32>,
    /// Its number in the sequence that its choices go by.
    pub(super) sample: u32,
    /// The side of the square of the picture that it stands for, in pixels, where looks are averaged over it.
    pub(super) side: Option<f64>,
}

/// Follows paths of one frame, and counts their rays.
pub(crate) struct Walker<'a, S> {
    pub(super) search: &'a S,
    pub(super) frame: &'a Frame<'a>,
    pub(super) stats: Stats,
    /// Room for light from surfaces.
    pub(super) sight: LampSight,
    /// Rays that are still to be followed.
    pub(super) pending: Vec<PathRay>,
}

/// A hit of a ray, with what shading needs of the surface.
pub(super) struct SurfaceHit<'a> {
    pub(super) hit: Hit,
    pub(super) ray: Ray,
    pub(super) material: &'a Material,
    pub(super) point: DVec3,
    /// The surface's own unit normal, on the viewer's side.
    pub(super) normal: DVec3,
    /// With the normal to shade with, on the same side.
    pub(super) shading: ShadingPoint<f64>,
}

impl<'a, S: Search> Walker<'a, S> {
    /// Of a frame, with nothing counted yet.
    pub(super) fn new(search: &'a S, frame: &'a Frame<'a>) -> Self {
        Self { search, frame, stats: Stats::default(), sight: LampSight::default(), pending: Vec::new() }
    }

    /// The square of the picture that a ray from the camera stands for.
    pub(super) fn footprint(&self, camera: &CameraRay) -> Option<Footprint<f64>> {
        let length = camera.ray.direction.length();
        let Raster { across, down, .. } = self.frame.raster;
        let of = |side: f64| Footprint {
            direction: (camera.ray.direction / length).into(),
            sides: [across, down].map(|way| (way * (side / length)).into()),
        };
        camera.side.map(of)
    }

    /// The surface at a hit of a ray.
    pub(super) fn surface_at(&self, hit: Hit, ray: Ray) -> SurfaceHit<'a> {
        let snapshot = self.frame.snapshot;
        let prim = &snapshot.prims()[hit.surface.prim as usize];
        let point = ray.at(hit.crossing.t);
        let front = !(hit.crossing.normal.dot(ray.direction) > 0.0);
        let side = if front { 1.0 } else { -1.0 };
        let length = ray.direction.length();
        SurfaceHit {
            hit,
            ray,
            material: &snapshot.materials()[prim.material as usize],
            point,
            normal: hit.crossing.normal * side,
            shading: ShadingPoint {
                position: (point - snapshot.origin_in_frame()).into(),
                normal: (hit.crossing.shading_normal * side).into(),
                to_viewer: (ray.direction / -length).into(),
                distance: hit.crossing.t * length,
                front,
            },
        }
    }
}
