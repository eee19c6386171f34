//! Materials and lights as the SIMD backend reads them: values that every packet needs, computed once per snapshot.

use catoptra_core::geometry::Plane;
use catoptra_core::glam::DVec3;
use catoptra_core::{Light, LobeKinds, Material, Placement, Ray, Span};

use crate::kernel::End;
use crate::numeric::magnitude_of;

/// A material.
#[derive(Debug, Clone)]
pub(crate) struct MaterialRow {
    pub(crate) material: Material,
    /// Which lobes it has.
    pub(crate) lobes: LobeKinds,
    /// Whether its look jumps from one position to the next, and is seen.
    pub(crate) is_pattern: bool,
}

impl MaterialRow {
    pub(crate) fn new(material: &Material) -> Self {
        let lobes = material.lobe_kinds();
        Self { material: material.clone(), lobes, is_pattern: material.is_pattern() && lobes.base }
    }
}

/// A light, relative to the snapshot's origin.
#[derive(Debug, Clone)]
pub(crate) struct LightRow {
    pub(crate) light: Light,
    /// Its position, or the unit vector towards it when `at_infinity`.
    pub(crate) position: DVec3,
    /// The same in the snapshot's frame.
    pub(crate) in_frame: DVec3,
    pub(crate) at_infinity: bool,
    /// What its coordinates add to what rounding errors grow with.
    pub(crate) reach: f32,
    /// For every plane, how far the light lies on the side that the plane's normal does not point to; only the sign
    /// counts, and 0 is a light in the plane.
    pub(crate) behind: Vec<f64>,
}

impl LightRow {
    pub(crate) fn new(light: &Light, origin: DVec3, planes: &[&Plane]) -> Self {
        let own = light.placed(&Placement::IDENTITY.moved(-origin).unwrap_or_default());
        let position =
            |light: &Light| light.position().or_else(|| light.direction().map(|d| -d)).unwrap_or(DVec3::ZERO);
        let at_infinity = light.position().is_none();
        let behind = |plane: &&Plane| {
            if at_infinity {
                plane.side_of_direction(position(light))
            } else {
                plane.side_of(position(light))
            }
        };
        Self {
            position: position(&own),
            in_frame: position(light),
            at_infinity,
            reach: if at_infinity { 0.0 } else { magnitude_of(position(&own)) },
            behind: planes.iter().map(behind).map(|side| -f64::from(side as i8)).collect(),
            light: own,
        }
    }

    /// Where it is, as the common end of shadow rays.
    #[inline(always)]
    pub(crate) fn end(&self) -> End {
        if self.at_infinity { End::AtInfinity(self.position) } else { End::At(self.position) }
    }

    /// The segment from a point to the light, in the snapshot's frame.
    pub(crate) fn segment_from(&self, point: DVec3) -> (Ray, Span) {
        if self.at_infinity {
            (Ray::new(point, self.in_frame), Span::AHEAD)
        } else {
            (Ray::new(point, self.in_frame - point), Span::TO_LIGHT)
        }
    }
}
