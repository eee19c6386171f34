//! Where is light measured, how, and what comes of it?

use catoptra_core::glam::DVec3;
use catoptra_core::{Integrator, Rgb};

/// A point of the world and the unit normal of the flat meter that stands there.
///
/// ```
/// use catoptra_tracer::{InvalidReceiver, Receiver};
///
/// let meter = Receiver::new([0.0, 0.8, 0.0].into(), [0.0, 2.0, 0.0].into())?;
/// assert_eq!(meter.normal().to_array(), [0.0, 1.0, 0.0]);
/// # Ok::<(), InvalidReceiver>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Receiver {
    point: DVec3,
    normal: DVec3,
}

/// A receiver that is none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidReceiver {
    /// A coordinate is infinite or no number.
    #[error("every number must be finite")]
    NotFinite,
    /// The normal has no direction.
    #[error("the normal must not be zero")]
    NoNormal,
}

impl Receiver {
    /// At a point, metres in the world, looking along a normal of any length.
    ///
    /// # Errors
    /// Numbers that are not finite and a normal of zero.
    pub fn new(point: DVec3, normal: DVec3) -> Result<Self, InvalidReceiver> {
        if !(point.is_finite() && normal.is_finite()) {
            return Err(InvalidReceiver::NotFinite);
        }
        let largest = normal.abs().max_element();
        if largest == 0.0 {
            return Err(InvalidReceiver::NoNormal);
        }
        Ok(Self { point, normal: (normal / largest).normalize() })
    }

    /// Where it stands.
    #[must_use]
    pub fn point(&self) -> DVec3 {
        self.point
    }

    /// Where it looks, of length 1.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }
}

/// How light is measured where there is no closed form. By default with 1024 rays, whatever the error, direct and
/// ambient light alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProbeOptions {
    /// Rays to each lamp, rounded up to a multiple of 32: that many independent sets tell how far their mean may be off.
    pub rays: u32,
    /// Twice as many as that, again and again, until the standard error of every channel is at most this, in the unit of
    /// irradiance; ends at 4 million a lamp.
    pub max_error: Option<f64>,
    /// What random choices go by.
    pub seed: u32,
    /// What light counts: [`Path`](Integrator::Path) all of it, whatever it came by, along as many directions as there are rays
    /// to a lamp; others direct and ambient light.
    pub integrator: Integrator,
}

impl Default for ProbeOptions {
    fn default() -> Self {
        Self { rays: 1024, max_error: None, seed: 0, integrator: Integrator::Whitted }
    }
}

/// Light that arrives from the half space in front of a receiver, W/m² per channel; lux where a scene's lights are given in
/// candela, lumen and lux.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Irradiance {
    /// How much.
    pub mean: Rgb,
    /// Its standard error; 0 where no rays were drawn at random.
    pub error: Rgb,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_of_any_length_become_unit_ones_and_others_are_refused() {
        for length in [5e-324, 1e-200, 3.0, 1e300] {
            let receiver = Receiver::new(DVec3::ONE, DVec3::new(0.0, -length, 0.0)).unwrap();
            assert_eq!(receiver.normal(), DVec3::NEG_Y);
        }
        assert_eq!(Receiver::new(DVec3::ONE, DVec3::ZERO), Err(InvalidReceiver::NoNormal));
        for bad in [f64::NAN, f64::INFINITY] {
            assert_eq!(Receiver::new(DVec3::splat(bad), DVec3::X), Err(InvalidReceiver::NotFinite));
            assert_eq!(Receiver::new(DVec3::ONE, DVec3::X * bad), Err(InvalidReceiver::NotFinite));
        }
    }
}
