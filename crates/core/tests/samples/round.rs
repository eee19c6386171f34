//! Plain geometry of what is round about an axis: in the half plane of distance from the axis and height.

use catoptra_core::Placement;
use catoptra_core::geometry::{Capsule, Cone, Cylinder};
use catoptra_core::glam::{DVec2, DVec3};

use super::{Draw, Form, Sample, disk_bounds, v};

/// Samples of one kind.
pub(super) fn samples_of(kind: &str) -> Vec<Sample> {
    match kind {
        "cylinder" => vec![
            cylinder([DVec3::ZERO, v(0.0, 4.0, 0.0)], 1.0),
            tube([v(5.0, 2.0, -3.0), v(7.0, 5.0, 3.0)], 3.5),
            cylinder([v(1e3, 2e3, -1e3), v(1001.0, 2e3 + 1e-9, -1e3)], 0.1),
        ],
        "cone" => vec![
            cone([DVec3::ZERO, v(0.0, 4.0, 0.0)], [2.0, 0.0]),
            cone([v(5.0, 2.0, -3.0), v(7.0, 5.0, 3.0)], [0.5, 3.5]),
            funnel([v(1.0, 2.0, 3.0), v(-4.0, 2.5, 3.0)], [2.0, 0.25]),
            cone([v(1e3, 2e3, -1e3), v(1001.0, 2e3, -1e3)], [0.25, 0.2]),
        ],
        "capsule" => vec![
            capsule([DVec3::ZERO, v(0.0, 4.0, 0.0)], 1.0),
            capsule([v(5.0, 2.0, -3.0), v(7.0, 5.0, 3.0)], 3.5),
            capsule([v(1e3, 2e3, -1e3), v(1001.0, 2e3, -1e3)], 0.1),
        ],
        _ => Vec::new(),
    }
}

fn cylinder(ends: [DVec3; 2], radius: f64) -> Sample {
    let shape = Cylinder::new(ends[0], ends[1], radius).unwrap().into();
    Sample { shape, form: Form::Round(Round { ends, radii: [radius; 2], caps: Ends::Flat }) }
}

fn tube(ends: [DVec3; 2], radius: f64) -> Sample {
    let shape = Cylinder::new(ends[0], ends[1], radius).unwrap().opened().into();
    Sample { shape, form: Form::Round(Round { ends, radii: [radius; 2], caps: Ends::Open }) }
}

fn cone(ends: [DVec3; 2], radii: [f64; 2]) -> Sample {
    let shape = Cone::new(ends[0], ends[1], radii[0], radii[1]).unwrap().into();
    Sample { shape, form: Form::Round(Round { ends, radii, caps: Ends::Flat }) }
}

fn funnel(ends: [DVec3; 2], radii: [f64; 2]) -> Sample {
    let shape = Cone::new(ends[0], ends[1], radii[0], radii[1]).unwrap().opened().into();
    Sample { shape, form: Form::Round(Round { ends, radii, caps: Ends::Open }) }
}

fn capsule(ends: [DVec3; 2], radius: f64) -> Sample {
    let shape = Capsule::new(ends[0], ends[1], radius).unwrap().into();
    Sample { shape, form: Form::Round(Round { ends, radii: [radius; 2], caps: Ends::Balls }) }
}

/// How the two ends are closed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ends {
    Open,
    Flat,
    Balls,
}

/// A side between two circles, facet 0, and what closes its ends, facets 1 and 2.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Round {
    pub ends: [DVec3; 2],
    pub radii: [f64; 2],
    pub caps: Ends,
}

impl Round {
    fn axis(&self) -> DVec3 {
        (self.ends[1] - self.ends[0]).normalize()
    }

    fn length(&self) -> f64 {
        self.ends[0].distance(self.ends[1])
    }

    /// Distance from the axis, and height.
    fn plane(&self, p: DVec3) -> DVec2 {
        let (axis, from) = (self.axis(), p - self.ends[0]);
        DVec2::new(from.cross(axis).length(), from.dot(axis))
    }

    pub(super) fn placed(&self, at: &Placement) -> Self {
        Self {
            ends: self.ends.map(|p| at.point(p)),
            radii: self.radii.map(|r| r * at.scale()),
            caps: self.caps,
        }
    }

    /// A point of the surface, not close to a rim.
    pub(super) fn target(&self, draw: &Draw) -> DVec3 {
        let axis = self.axis();
        let (right, turn) = (axis.any_orthonormal_vector(), std::f64::consts::TAU * draw.at.y);
        let out = right * turn.cos() + axis.cross(right) * turn.sin();
        let facet = match self.caps {
            Ends::Open => 0,
            _ => draw.pick % 3,
        };
        let share = 0.02 + 0.96 * draw.at.x;
        if facet == 0 || self.radii[facet - 1] == 0.0 {
            let radius = self.radii[0] + (self.radii[1] - self.radii[0]) * share;
            return self.ends[0].lerp(self.ends[1], share) + out * radius;
        }
        let (end, radius) = (self.ends[facet - 1], self.radii[facet - 1]);
        let beyond = if facet == 1 { -axis } else { axis };
        match self.caps {
            Ends::Balls => end + (beyond * share + out * (1.0 - share * share).sqrt()) * radius,
            _ => end + out * (0.98 * radius * draw.at.x.sqrt()),
        }
    }

    /// Points of both rims, as exact as they can be.
    pub(super) fn seams(&self) -> Vec<[DVec3; 2]> {
        let axis = self.axis();
        let (u, count) = (axis.any_orthonormal_vector(), 64);
        let point = |i: usize, step: u32| {
            let turn = std::f64::consts::TAU * f64::from(step) / f64::from(count);
            self.ends[i] + (u * turn.cos() + axis.cross(u) * turn.sin()) * self.radii[i]
        };
        (0..count).flat_map(|step| [[point(0, step); 2], [point(1, step); 2]]).collect()
    }

    /// How far the surface is from the middle at least.
    pub(super) fn depth(&self) -> f64 {
        let middle = self.ends[0].midpoint(self.ends[1]);
        let ends = if self.caps == Ends::Balls { f64::INFINITY } else { self.length() / 2.0 };
        self.distance(middle, 0).min(ends)
    }

    pub(super) fn distance_from_axis(&self, p: DVec3) -> f64 {
        self.plane(p).x
    }

    pub(super) fn reach(&self) -> f64 {
        self.length() / 2.0 + self.radii[0].max(self.radii[1])
    }

    pub(super) fn bounds(&self) -> (DVec3, DVec3) {
        let [lower, upper] = [0, 1].map(|i| match self.caps {
            Ends::Balls => (self.ends[i] - self.radii[i], self.ends[i] + self.radii[i]),
            _ => disk_bounds(self.ends[i], self.axis(), self.radii[i]),
        });
        (lower.0.min(upper.0), lower.1.max(upper.1))
    }

    pub(super) fn distance(&self, p: DVec3, facet: u32) -> f64 {
        let (p, length) = (self.plane(p), self.length());
        let rims = [DVec2::new(self.radii[0], 0.0), DVec2::new(self.radii[1], length)];
        if facet == 0 {
            return to_stretch(rims, p);
        }
        let i = facet as usize - 1;
        let middle = DVec2::new(0.0, rims[i].y);
        if self.caps != Ends::Balls {
            return to_stretch([middle, rims[i]], p);
        }
        let is_beyond = if facet == 1 { p.y <= 0.0 } else { p.y >= length };
        if is_beyond { (p.distance(middle) - self.radii[i]).abs() } else { p.distance(rims[i]) }
    }

    pub(super) fn normal(&self, p: DVec3, facet: u32) -> DVec3 {
        let axis = self.axis();
        if facet == 0 {
            let from = p - self.ends[0];
            let out = (from - axis * from.dot(axis)).normalize();
            return (out + axis * ((self.radii[0] - self.radii[1]) / self.length())).normalize();
        }
        match self.caps {
            Ends::Balls => (p - self.ends[facet as usize - 1]).normalize(),
            _ if facet == 1 => -axis,
            _ => axis,
        }
    }

    /// Whether a point lies within the solid that the surface bounds, or would if it were closed.
    pub(crate) fn holds(&self, p: DVec3) -> bool {
        let (p, length) = (self.plane(p), self.length());
        let share = p.y / length;
        if (0.0..=1.0).contains(&share) {
            return p.x <= self.radii[0] + (self.radii[1] - self.radii[0]) * share;
        }
        let end = if share < 0.0 { 0.0 } else { length };
        self.caps == Ends::Balls && p.distance(DVec2::new(0.0, end)) <= self.radii[0]
    }

    /// Whether a facet is curved, so that a ray from it can meet it again.
    pub(crate) fn is_curved(&self, facet: u32) -> bool {
        facet == 0 || self.caps == Ends::Balls
    }
}

/// From a stretch of a straight line to a point.
fn to_stretch([a, b]: [DVec2; 2], p: DVec2) -> f64 {
    let along = (p - a).dot(b - a) / (b - a).length_squared();
    p.distance(a.lerp(b, along.clamp(0.0, 1.0)))
}
