//! Placement of a thing: a rotation, a uniform scale and a translation.

use glam::{DQuat, DVec3};

use crate::InvalidPart;

/// A similarity `p → rotation * (scale * p) + translation`. Shapes keep their kind under it.
///
/// ```
/// use catoptra_core::{Placement, glam::DVec3};
///
/// let quarter = std::f64::consts::FRAC_PI_2;
/// let placement = Placement::IDENTITY.scaled(2.0)?.turned(DVec3::ZERO, DVec3::Y, quarter)?.moved(DVec3::Y)?;
/// assert!((placement.point(DVec3::X) - DVec3::new(0.0, 1.0, -2.0)).length() < 1e-15);
/// # Ok::<(), catoptra_core::InvalidPart>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    rotation: DQuat,
    translation: DVec3,
    scale: f64,
}

impl Default for Placement {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Placement {
    /// Leaves everything where it is.
    pub const IDENTITY: Self = Self { rotation: DQuat::IDENTITY, translation: DVec3::ZERO, scale: 1.0 };

    /// From its parts; the rotation is normalised.
    ///
    /// # Errors
    /// A rotation that is zero or not finite, a translation that is not finite, a scale that is not positive.
    pub fn new(rotation: DQuat, translation: DVec3, scale: f64) -> Result<Self, InvalidPart> {
        if !(rotation.is_finite() && rotation.length_squared() > 0.0) {
            return Err(InvalidPart::new("rotation", "must be finite and not zero", rotation));
        }
        if !translation.is_finite() {
            return Err(InvalidPart::new("move", "must be finite", translation));
        }
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(InvalidPart::new("scale", "must be greater than 0 and finite", scale));
        }
        Ok(Self { rotation: rotation.normalize(), translation, scale })
    }

    /// A move and nothing else; nowhere where it is not finite.
    pub(crate) fn offset(by: DVec3) -> Self {
        Self { translation: if by.is_finite() { by } else { DVec3::ZERO }, ..Self::IDENTITY }
    }

    /// Afterwards moved by `by`.
    ///
    /// # Errors
    /// A move that is not finite.
    pub fn moved(self, by: DVec3) -> Result<Self, InvalidPart> {
        Self::new(self.rotation, self.translation + by, self.scale)
    }

    /// Afterwards turned by `angle` (radians, right-handed) about the line through `about` along `axis`.
    ///
    /// # Errors
    /// An axis that is zero, or anything not finite.
    pub fn turned(self, about: DVec3, axis: DVec3, angle: f64) -> Result<Self, InvalidPart> {
        let Some(axis) = axis.try_normalize() else {
            return Err(InvalidPart::new("turn", "must have an axis that is finite and not zero", axis));
        };
        if !(angle.is_finite() && about.is_finite()) {
            return Err(InvalidPart::new("turn", "must have a finite angle and centre", angle));
        }
        let turn = DQuat::from_axis_angle(axis, angle);
        let translation = about + turn * (self.translation - about);
        Self::new(turn * self.rotation, translation, self.scale)
    }

    /// Afterwards turned about the origin by two angles (radians): first about the y axis, then about the x axis.
    ///
    /// # Errors
    /// Angles that are not finite.
    pub fn seed_turned(self, about_y: f64, about_x: f64) -> Result<Self, InvalidPart> {
        self.turned(DVec3::ZERO, DVec3::Y, about_y)?.turned(DVec3::ZERO, DVec3::X, about_x)
    }

    /// Afterwards scaled about the origin.
    ///
    /// # Errors
    /// A factor that is not positive and finite.
    pub fn scaled(self, factor: f64) -> Result<Self, InvalidPart> {
        Self::new(self.rotation, self.translation * factor, self.scale * factor)
    }

    /// The turn, a unit quaternion.
    #[must_use]
    pub fn rotation(&self) -> DQuat {
        self.rotation
    }

    /// The move, made last.
    #[must_use]
    pub fn translation(&self) -> DVec3 {
        self.translation
    }

    /// The scale, made first; positive.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Where `point` goes.
    #[must_use]
    #[inline]
    pub fn point(&self, point: DVec3) -> DVec3 {
        self.vector(point) + self.translation
    }

    /// What becomes of the difference of two points.
    #[must_use]
    #[inline]
    pub fn vector(&self, vector: DVec3) -> DVec3 {
        self.direction(vector) * self.scale
    }

    /// What becomes of a direction or normal: turned, its length kept. Exact where nothing is turned.
    #[must_use]
    #[inline]
    pub fn direction(&self, direction: DVec3) -> DVec3 {
        if self.rotation == DQuat::IDENTITY { direction } else { self.rotation * direction }
    }

    /// What undoes this one.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.conjugate();
        let scale = 1.0 / self.scale;
        Self { rotation, translation: rotation * (-self.translation * scale), scale }
    }

    /// This one first, then `outer`: a member's placement within a group that is itself placed.
    #[must_use]
    pub fn then(&self, outer: &Self) -> Self {
        // Rays are carried over by these very numbers: where one does not turn, the other's stay what they are.
        let rotation = if outer.rotation == DQuat::IDENTITY {
            self.rotation
        } else if self.rotation == DQuat::IDENTITY {
            outer.rotation
        } else {
            (outer.rotation * self.rotation).normalize()
        };
        Self { rotation, translation: outer.point(self.translation), scale: outer.scale * self.scale }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some() -> Placement {
        Placement::IDENTITY
            .scaled(2.0)
            .and_then(|p| p.turned(DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 1.0, 0.0), 0.7))
            .and_then(|p| p.moved(DVec3::new(-4.0, 5.0, 6.0)))
            .unwrap()
    }

    #[test]
    fn inverse_undoes() {
        let p = DVec3::new(0.3, -7.0, 11.0);
        assert!((some().inverse().point(some().point(p)) - p).length() < 1e-12);
    }

    #[test]
    fn the_centre_of_a_turn_stays() {
        let about = DVec3::new(3.0, -1.0, 2.0);
        let turned = Placement::IDENTITY.turned(about, DVec3::Z, 1.1).unwrap();
        assert!((turned.point(about) - about).length() < 1e-14);
    }

    #[test]
    fn the_seed_turns_about_y_first() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let p = Placement::IDENTITY.seed_turned(quarter, quarter).unwrap();
        assert!((p.point(DVec3::X) - DVec3::Y).length() < 1e-15, "x → −z by y, −z → y by x");
    }

    #[test]
    fn then_is_composition() {
        let outer = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::Y, 0.4).unwrap().moved(DVec3::X).unwrap();
        let p = DVec3::new(1.0, 2.0, 3.0);
        assert!((some().then(&outer).point(p) - outer.point(some().point(p))).length() < 1e-13);
    }

    #[test]
    fn what_is_placed_where_it_is_keeps_every_bit() {
        for step in 1..200 {
            let angle = 0.1 * f64::from(step);
            let turned = some().turned(DVec3::X, DVec3::new(0.3, -0.2, angle), angle).unwrap();
            assert_eq!(turned.then(&Placement::IDENTITY), turned);
            assert_eq!(Placement::IDENTITY.then(&turned), turned);
        }
    }

    #[test]
    fn nonsense_is_refused() {
        assert!(Placement::IDENTITY.scaled(0.0).is_err());
        assert!(Placement::IDENTITY.scaled(f64::NAN).is_err());
        assert!(Placement::IDENTITY.moved(DVec3::splat(f64::INFINITY)).is_err());
        assert!(Placement::IDENTITY.turned(DVec3::ZERO, DVec3::ZERO, 1.0).is_err());
    }
}
