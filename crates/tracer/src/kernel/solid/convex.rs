//! Convex shapes whose kernels tell where lines run inside them.

use catoptra_core::Shape;
use catoptra_core::geometry::Faceted;
use catoptra_core::glam::DVec3;
use fearless_simd::Simd;

use super::super::contract::{off_planes, surface_on_planes};
use super::super::faces::planes_met;
use super::super::{CuboidRow, Kernel, NearHit, PlaneRow, Rays, RoundRow, SphereRow};
use super::{Stretch, half_spaces};
use crate::lanes::{D3, F, F3};

/// A convex shape.
#[derive(Debug, Clone)]
pub(super) enum Convex {
    Sphere(SphereRow),
    Cuboid(Box<CuboidRow>),
    Round(Box<RoundRow>),
    /// What lies behind all of some planes, in the order of their facets.
    HalfSpaces(Vec<PlaneRow>),
}

/// Calls a closure with the kernel of a convex shape, and another where it is bounded by planes.
macro_rules! each {
    ($convex:expr, $kernel:ident => $work:expr, $planes:ident => $flat:expr) => {
        match $convex {
            Convex::Sphere($kernel) => $work,
            Convex::Cuboid($kernel) => $work,
            Convex::Round($kernel) => $work,
            Convex::HalfSpaces($planes) => $flat,
        }
    };
}

/// As many planes are tried one after another.
const MOST_PLANES: u32 = 64;

/// A facet narrower than this share of its length has no certain direction.
const NARROW: f64 = 1.0 / (1_u64 << 20) as f64;

impl Convex {
    /// A shape relative to an origin; `in_frame` is the same in the frame that rays are carried into its own space from.
    /// `None` of shapes that are not convex, or have no inside.
    pub(super) fn new(shape: &Shape, in_frame: &Shape, prim: u32) -> Option<Self> {
        let round = |ends, radii, has_balls| Self::Round(Box::new(RoundRow::new(ends, radii, has_balls)));
        Some(match (shape, in_frame) {
            (Shape::Sphere(sphere), _) => Self::Sphere(SphereRow::new(sphere.center(), sphere.radius())),
            (Shape::Cuboid(cuboid), Shape::Cuboid(in_frame)) => {
                Self::Cuboid(Box::new(CuboidRow::new(cuboid, in_frame, prim)))
            }
            (Shape::Cylinder(c), _) if !c.is_open() => round(c.ends(), [c.radius(); 2], false),
            (Shape::Cone(c), _) if !c.is_open() => round(c.ends(), c.radii(), false),
            (Shape::Capsule(c), _) => round(c.ends(), [c.radius(); 2], true),
            (Shape::Plane(plane), _) => {
                Self::HalfSpaces(vec![PlaneRow::new(plane.point(), plane.normal(), prim)])
            }
            (Shape::Tetrahedron(t), _) => {
                let planes = [0, 1, 2, 3].map(|face| plane_through(&t.face(face), prim));
                Self::HalfSpaces(planes.into_iter().collect::<Option<_>>()?)
            }
            (shape, _) => Self::HalfSpaces(planes_of(shape.faceted()?, prim)?),
        })
    }

    #[inline(always)]
    pub(super) fn stretch<S: Simd>(&self, s: S, rays: &Rays<S>) -> Stretch<S> {
        each!(self, kernel => kernel.stretch(s, rays), planes => half_spaces::stretch(s, planes, rays))
    }

    #[inline(always)]
    pub(super) fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>) {
        each!(self, kernel => kernel.surface(s, hit), planes => {
            let (normal, distance) = planes_met(s, planes, hit);
            surface_on_planes(normal, distance, hit)
        })
    }

    #[inline(always)]
    pub(super) fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
        each!(self, kernel => kernel.off(s, hit), planes => {
            let (normal, distance) = planes_met(s, planes, hit);
            off_planes(normal, distance, hit)
        })
    }

    #[inline(always)]
    pub(super) fn normal<S: Simd>(&self, s: S, hit: &impl NearHit<S>, point: D3<S>) -> D3<S> {
        each!(self, kernel => kernel.normal(s, hit, point), planes => planes_met(s, planes, hit).0)
    }

    pub(super) fn all_normals(
        &self,
        center: DVec3,
        half: DVec3,
        test: impl Fn(DVec3, DVec3) -> bool,
    ) -> bool {
        each!(self, kernel => kernel.all_normals(center, half, test), planes => {
            planes.iter().all(|plane| test(plane.normal, DVec3::ZERO))
        })
    }

    pub(super) fn is_outside(&self, point: DVec3) -> bool {
        each!(self, kernel => kernel.is_outside(point), planes => {
            planes.iter().any(|plane| plane.is_before(point))
        })
    }
}

/// The planes of a convex solid's facets; `None` of others, and where a facet gives no certain plane.
fn planes_of(solid: &Faceted, prim: u32) -> Option<Vec<PlaneRow>> {
    if !solid.is_convex() || solid.count() > MOST_PLANES {
        return None;
    }
    let corners = |facet: u32| -> Vec<DVec3> {
        solid.outline(facet).iter().map(|&i| solid.corners()[i as usize]).collect()
    };
    (0..solid.count()).map(|facet| plane_through(&corners(facet), prim)).collect()
}

/// The plane of a flat outline, which is counter-clockwise as seen from outside; `None` where it is too narrow to tell.
fn plane_through(outline: &[DVec3], prim: u32) -> Option<PlaneRow> {
    let from = outline[0];
    let doubled: DVec3 = outline.windows(2).map(|pair| (pair[0] - from).cross(pair[1] - from)).sum();
    let length2 = outline.iter().map(|p| p.distance_squared(from)).fold(0.0, f64::max);
    let normal = doubled.try_normalize()?;
    (doubled.length() > NARROW * length2).then(|| PlaneRow::new(from, normal, prim))
}
