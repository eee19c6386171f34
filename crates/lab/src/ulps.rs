//! How many floating-point numbers lie between two?
//!
//! The bits of finite IEEE 754 numbers of one sign are ordered as the numbers are; turned into a sign-and-count, they are
//! ordered across zero as well, and a difference of counts is a number of steps (Bruce Dawson, "Comparing Floating Point
//! Numbers", 2012).

/// Steps between two `f32`: 0 for equal numbers (the two zeros too), 1 for neighbours; `None` where one is NaN.
/// An infinity lies one step past the largest finite number.
pub fn ulps_f32(a: f32, b: f32) -> Option<u32> {
    if a.is_nan() || b.is_nan() {
        return None;
    }
    let count = |value: f32| {
        let magnitude = i64::from(value.to_bits() & (u32::MAX >> 1));
        if value.is_sign_negative() { -magnitude } else { magnitude }
    };
    u32::try_from((count(a) - count(b)).unsigned_abs()).ok()
}

/// Steps between two `f64`, as [`ulps_f32`].
pub fn ulps_f64(a: f64, b: f64) -> Option<u64> {
    if a.is_nan() || b.is_nan() {
        return None;
    }
    let count = |value: f64| {
        let magnitude = i128::from(value.to_bits() & (u64::MAX >> 1));
        if value.is_sign_negative() { -magnitude } else { magnitude }
    };
    u64::try_from((count(a) - count(b)).unsigned_abs()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_step_apart() {
        assert_eq!(ulps_f32(1.0, 1.0 + f32::EPSILON), Some(1));
        assert_eq!(ulps_f64(1.0, 1.0 - f64::EPSILON / 2.0), Some(1));
    }

    #[test]
    fn the_two_zeros_are_one_number() {
        assert_eq!(ulps_f32(0.0, -0.0), Some(0));
    }

    #[test]
    fn counting_goes_across_zero() {
        assert_eq!(ulps_f32(f32::from_bits(1), -f32::from_bits(1)), Some(2));
    }

    #[test]
    fn the_widest_distance_fits() {
        assert_eq!(ulps_f32(f32::INFINITY, f32::NEG_INFINITY), Some(0xff00_0000));
        assert_eq!(ulps_f64(f64::INFINITY, f64::NEG_INFINITY), Some(0xffe0_0000_0000_0000));
    }

    #[test]
    fn nan_has_no_distance() {
        assert_eq!(ulps_f32(f32::NAN, f32::NAN), None);
        assert_eq!(ulps_f64(0.0, f64::NAN), None);
    }
}
