//! What must a lobe of a [`Bsdf`](super::Bsdf) answer, and in which frame?
//!
//! Lobes see directions in a frame of their own: the shading normal is z, the viewer is at z > 0, and light that is
//! transmitted comes from z < 0. Directions point away from the surface, to the viewer (`o`) and to where light comes from
//! (`i`).
//!
//! What a lobe weighs is radiance over the squared index of refraction of its medium: that is what stays along a ray, so a
//! surface that loses nothing shows 1 in an even surrounding of 1 from both of its sides. A renderer whose camera and lights
//! stand in one medium needs no other factor. Reciprocity then reads f(o, i) / n²(i) = f(i, o) / n²(o).

use glam::DVec3;

use crate::Rgb;

/// Axes at a point of a surface.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    x: DVec3,
    y: DVec3,
    z: DVec3,
}

impl Frame {
    /// With a unit normal for z, and x as near to a tangent as it can be; any x where the tangent is zero or along the normal.
    #[must_use]
    pub fn new(normal: DVec3, tangent: DVec3) -> Self {
        let along = tangent - normal * tangent.dot(normal);
        let x = along.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        // Once more, as a tangent close to the normal leaves few digits.
        let x = (x - normal * x.dot(normal)).normalize();
        Self { x, y: normal.cross(x), z: normal }
    }

    /// The same frame turned about its normal, radians anticlockwise as the viewer sees it.
    #[must_use]
    pub fn turned(self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { x: self.x * cos + self.y * sin, y: self.y * cos - self.x * sin, z: self.z }
    }

    /// A vector of the world in this frame.
    #[must_use]
    pub fn to_local(&self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.x), v.dot(self.y), v.dot(self.z))
    }

    /// A vector of this frame in the world.
    #[must_use]
    pub fn to_world(&self, v: DVec3) -> DVec3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }
}

/// A direction that a lobe chose.
#[derive(Debug, Clone, Copy)]
pub struct LocalSample {
    /// Unit vector to where the light comes from.
    pub direction: DVec3,
    /// Of a lobe that sends light on in single directions: what one unit of radiance from there shows, over the chance with
    /// which this direction was chosen. `None` for the others, whose weight follows from `evaluate` and `pdf`.
    pub delta: Option<Rgb>,
    /// Index of refraction where the direction leads over that on the viewer's side.
    pub eta: f64,
}

impl LocalSample {
    /// A direction of a lobe that has a density, within one medium.
    #[must_use]
    pub const fn spread(direction: DVec3) -> Self {
        Self { direction, delta: None, eta: 1.0 }
    }
}

/// The single rays of a lobe, for an integrator that follows no others: what a unit of radiance from there shows.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rays {
    /// From the mirrored direction.
    pub mirrored: Rgb,
    /// From behind the surface, bent.
    pub refracted: Option<(DVec3, Rgb)>,
    /// From straight behind the surface.
    pub straight: Rgb,
}

/// A lobe of a [`Bsdf`](super::Bsdf), in its frame. `o` has z > 0 and every direction unit length.
pub trait LocalLobe {
    /// Radiance shown for each unit of irradiance at normal incidence from `i`: the BSDF times |cosine|. Black for lobes that
    /// send light on in single directions.
    fn evaluate(&self, _o: DVec3, _i: DVec3) -> Rgb {
        Rgb::BLACK
    }

    /// How densely [`sample`](Self::sample) spreads directions over solid angle at `i`, 1/sr; 0 as above.
    fn pdf(&self, _o: DVec3, _i: DVec3) -> f64 {
        0.0
    }

    /// A direction that light may come from, chosen by three numbers in 0..1. `None` counts as one that brings no light.
    fn sample(&self, o: DVec3, choose: f64, u: [f64; 2]) -> Option<LocalSample>;

    /// What is shown in an even surrounding of radiance 1, exactly or nearly; directions are shared out among lobes by it.
    fn albedo(&self, o: DVec3) -> Rgb;

    /// The rays that an integrator follows which follows only single ones.
    fn rays(&self, _o: DVec3) -> Rays {
        Rays::default()
    }

    /// What of the surrounding such an integrator shows beside its [`rays`](Self::rays), for each unit of its radiance.
    fn ambient(&self, o: DVec3) -> Rgb {
        self.albedo(o)
    }
}

/// `v` mirrored about z.
#[must_use]
pub(super) fn mirrored(v: DVec3) -> DVec3 {
    DVec3::new(-v.x, -v.y, v.z)
}
