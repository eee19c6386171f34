//! Replaces sums of light that are not finite by values that a film can hold.

use catoptra_core::Lane;

/// Sums limited to the range of `f32`, and which of them were not finite: +∞ becomes the largest number, −∞ and NaN
/// become 0.
#[inline(always)]
pub(crate) fn storable<L: Lane>(light: L) -> (L, L::Mask) {
    let finite = light.abs().less(light.number(f64::INFINITY));
    let (zero, most) = (light.number(0.0), light.number(f64::from(f32::MAX)));
    let nearest = L::select(zero.less(light), most, zero);
    (L::select(finite, light, nearest), !finite)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_not_finite_is_changed() {
        for light in [0.0, -1.5, f64::from(f32::MAX)] {
            assert_eq!(storable(light), (light, false));
        }
        assert_eq!(storable(f64::INFINITY), (f64::from(f32::MAX), true));
        assert_eq!(storable(f64::NEG_INFINITY), (0.0, true));
        assert_eq!(storable(f64::NAN), (0.0, true));
    }
}
