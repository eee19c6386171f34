//! Which curves tell the cone of a spot light?
//!
//! All rings lie on a sphere about the apex, so that a full cone angle of 180 degrees is still a ring of finite size
//! and a light of any strength arrives there from one distance: only the falloff of the cone changes over the sphere.

use crate::stage::{PlacedLight, Stage};
use catoptra_core::Light;
use catoptra_core::glam::DVec3;
use std::f64::consts::TAU;

/// Corners of a ring.
const CORNERS: u32 = 72;

/// Irradiance on the axis at the rings, in W/m², unless a surface is nearer: what a sunlit room's lamp leaves on a
/// desk, and 1 by the formula `intensity / distance²` makes the reach the square root of the intensity.
const IRRADIANCE: f64 = 1.0;

/// How far before a lit surface the rings stop, as a fraction of the way.
const BEFORE_SURFACE: f64 = 0.985;

/// The cone of one spot light in world space; angles are half angles in radians, from 0 to pi.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cone {
    pub(crate) apex: DVec3,
    pub(crate) axis: DVec3,
    pub(crate) reach: f64,
    pub(crate) inner: f64,
    pub(crate) outer: f64,
    falloff: f64,
    across: DVec3,
    upward: DVec3,
}

impl Cone {
    /// The cone of a light; `None` when it is no spot light.
    pub(crate) fn of(stage: &Stage<'_>, placed: &PlacedLight) -> Option<Self> {
        let Light::SpotLight(spot) = &placed.light else { return None };
        let (apex, axis) = (placed.light.position()?, placed.light.direction()?);
        let free = (placed.power.max_channel() / IRRADIANCE).sqrt().clamp(1e-3, 1e6);
        let reach = stage.nearest_surface(apex, axis).map_or(free, |wall| free.min(BEFORE_SURFACE * wall));
        let (across, upward) = axis.any_orthonormal_pair();
        let (inner, outer) = (0.5 * spot.inner(), 0.5 * spot.outer());
        let falloff = spot.falloff();
        Some(Self { apex, axis, reach, inner, outer, falloff, across, upward })
    }

    /// The point of the ring of a half angle that lies at an azimuth about the axis.
    pub(crate) fn point(&self, half: f64, azimuth: f64) -> DVec3 {
        let out = self.across * azimuth.cos() + self.upward * azimuth.sin();
        self.apex + (self.axis * half.cos() + out * half.sin()) * self.reach
    }

    /// The ring of a half angle as a closed line; the last point repeats the first.
    pub(crate) fn ring(&self, half: f64) -> Vec<DVec3> {
        (0..=CORNERS).map(|corner| self.point(half, azimuth(corner))).collect()
    }

    /// The half angle at which the cone lets a fraction `level` of the light through.
    pub(crate) fn half_angle_of(&self, level: f64) -> f64 {
        let (inner, outer) = (self.inner.cos(), self.outer.cos());
        let share = level.clamp(0.0, 1.0).powf(self.falloff.recip());
        (outer + (inner - outer) * share).clamp(-1.0, 1.0).acos()
    }

    /// Azimuths at which the cone of a half angle turns its edge to `eye`; `None` when it is seen from inside, from
    /// the front or the back, or is flat.
    pub(crate) fn edges(&self, half: f64, eye: DVec3) -> Option<[f64; 2]> {
        let towards = eye - self.apex;
        let (x, y) = (towards.dot(self.across), towards.dot(self.upward));
        let share = half.tan() * towards.dot(self.axis) / x.hypot(y);
        (share.abs() < 1.0).then(|| {
            let (middle, turn) = (y.atan2(x), share.acos());
            [middle - turn, middle + turn]
        })
    }

    /// Whether a point lies in the cone of a half angle, between its apex and its ring.
    pub(crate) fn holds(&self, half: f64, point: DVec3) -> bool {
        let offset = point - self.apex;
        let along = offset.dot(self.axis);
        let aside = (offset - self.axis * along).length();
        along > 0.0 && along <= self.reach * half.cos() && aside <= along * half.tan()
    }

    /// Azimuth of the point of a ring that is nearest to a point of the world.
    pub(crate) fn azimuth_of(&self, point: DVec3) -> f64 {
        let offset = point - self.apex;
        offset.dot(self.upward).atan2(offset.dot(self.across))
    }
}

fn azimuth(corner: u32) -> f64 {
    TAU * f64::from(corner % CORNERS) / f64::from(CORNERS)
}
