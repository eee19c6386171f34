//! Plain geometry of the torus: by the point of its ring that is nearest.

use catoptra_core::Placement;
use catoptra_core::geometry::Torus;
use catoptra_core::glam::DVec3;

use super::{Draw, Form, Sample, disk_bounds, v};

/// A ring across a unit axis, of a large and a small radius.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ring {
    pub center: DVec3,
    pub axis: DVec3,
    pub radii: [f64; 2],
}

pub(super) fn samples() -> Vec<Sample> {
    let sample = |center, axis: DVec3, [major, minor]: [f64; 2]| {
        let shape = Torus::new(center, axis, major, minor).unwrap().into();
        Sample { shape, form: Form::Ring(Ring { center, axis: axis.normalize(), radii: [major, minor] }) }
    };
    vec![
        sample(DVec3::ZERO, DVec3::Y, [2.0, 0.5]),
        sample(v(-4.0, 2.0, 9.0), v(2.0, 3.0, -6.0), [3.5, 3.0]),
        sample(v(100.0, 200.0, -100.0), v(0.0, 1e-9, -1.0), [0.1, 0.01]),
    ]
}

impl Ring {
    pub(super) fn placed(&self, at: &Placement) -> Self {
        Self {
            center: at.point(self.center),
            axis: at.direction(self.axis),
            radii: self.radii.map(|r| r * at.scale()),
        }
    }

    /// The middle of the tube at an angle.
    pub(super) fn on_ring(&self, turn: f64) -> DVec3 {
        let right = self.axis.any_orthonormal_vector();
        self.center + (right * turn.cos() + self.axis.cross(right) * turn.sin()) * self.radii[0]
    }

    pub(super) fn target(&self, draw: &Draw) -> DVec3 {
        let [turn, round] = [draw.at.x, draw.at.y].map(|share| std::f64::consts::TAU * share);
        let middle = self.on_ring(turn);
        let out = (middle - self.center).normalize();
        middle + (out * round.cos() + self.axis * round.sin()) * self.radii[1]
    }

    /// A point as seen from the nearest one of the ring.
    pub(super) fn away_from_tube(&self, p: DVec3) -> DVec3 {
        let from = p - self.center;
        let flat = from - self.axis * from.dot(self.axis);
        from - flat.normalize() * self.radii[0]
    }

    pub(super) fn bounds(&self) -> (DVec3, DVec3) {
        let (low, high) = disk_bounds(self.center, self.axis, self.radii[0]);
        (low - self.radii[1], high + self.radii[1])
    }
}
