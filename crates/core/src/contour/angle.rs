//! The two transcendental functions of the contour: the angle of a pair of numbers, and the logarithm of a ratio.
//!
//! Written out, so that every machine gives the same bits. The arc tangent is the rational approximation of Cephes (Moshier,
//! *Methods and Programs for Mathematical Functions*, 1989), off by two roundings at most.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, LN_2, PI, SQRT_2};

/// Above this the argument is turned by an eighth of a circle: tan(π/8), rounded up; the approximation holds up to 0.66.
const TURNED: f64 = 0.42;

/// atan(x)/x − 1 over x², for |x| up to 0.66: numerator and denominator (whose first coefficient is 1).
const ABOVE: [f64; 5] = [
    -8.750_608_600_031_904e-1,
    -1.615_753_718_733_365e1,
    -7.500_855_792_314_705e1,
    -1.228_866_684_490_136_1e2,
    -6.485_021_904_942_025e1,
];
const BELOW: [f64; 5] = [
    2.485_846_490_142_306_3e1,
    1.650_270_098_316_988_5e2,
    4.328_810_604_912_903e2,
    4.853_903_996_359_137e2,
    1.945_506_571_482_614e2,
];

/// The arc tangent of a number in −0.66..=0.66.
#[inline]
fn small_arc_tangent(x: f64) -> f64 {
    let z = x * x;
    let [a, b, c, d, e] = ABOVE;
    let above = (((a * z + b) * z + c) * z + d) * z + e;
    let [a, b, c, d, e] = BELOW;
    let below = ((((z + a) * z + b) * z + c) * z + d) * z + e;
    x + x * (z * above / below)
}

/// The angle, −π..=π, whose sine and cosine are to one another as `y` and `x`, to a few roundings of itself; 0 where both
/// are 0.
#[inline]
pub(super) fn angle(y: f64, x: f64) -> f64 {
    let (up, across) = (y.abs(), x.abs());
    let (less, more) = if up < across { (up, across) } else { (across, up) };
    if !(more > 0.0) {
        return 0.0;
    }
    let acute = if less > TURNED * more {
        FRAC_PI_4 + small_arc_tangent((less - more) / (less + more))
    } else {
        small_arc_tangent(less / more)
    };
    let first = if up < across { acute } else { FRAC_PI_2 - acute };
    let upper = if x < 0.0 { PI - first } else { first };
    if y < 0.0 { -upper } else { upper }
}

/// ln(b / a) / (b − a) for positive a and b, smooth where they meet; `difference` is b − a, given so that it may be more
/// exact than the two.
pub(super) fn log_ratio_over_difference(a: f64, b: f64, difference: f64) -> f64 {
    let ratio = b / a;
    if 2.0 / SQRT_2 > ratio && ratio * SQRT_2 > 1.0 {
        2.0 * area_tangent_ratio(difference / (a + b)) / (a + b)
    } else {
        logarithm(ratio) / difference
    }
}

/// The natural logarithm of a positive, finite number.
fn logarithm(x: f64) -> f64 {
    let exponent = i32::try_from((x.to_bits() >> 52) & 0x7ff).unwrap_or(0) - 1023;
    let mantissa = f64::from_bits((x.to_bits() & ((1 << 52) - 1)) | (1023 << 52));
    let (power, part) = if mantissa > SQRT_2 { (exponent + 1, mantissa / 2.0) } else { (exponent, mantissa) };
    let s = (part - 1.0) / (part + 1.0);
    f64::from(power) * LN_2 + 2.0 * s * area_tangent_ratio(s)
}

/// artanh(s)/s for |s| up to 0.1716, where eleven terms leave less than 2⁻⁵⁶.
fn area_tangent_ratio(s: f64) -> f64 {
    let z = s * s;
    (0..11_u32).rev().fold(0.0, |sum, k| sum * z + 1.0 / f64::from(2 * k + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_of_the_library() {
        for i in -2000..2000_i32 {
            let turn = f64::from(i) * 0.001_570_9;
            let (y, x) = turn.sin_cos();
            assert!((angle(y * 3.0, x * 3.0) - y.atan2(x)).abs() <= 4e-16 * turn.abs(), "{turn}");
        }
        assert_eq!(angle(0.0, 0.0), 0.0);
        assert_eq!(angle(1e-200, 1.0), 1e-200);
        assert_eq!(angle(0.0, -2.0), PI);
    }

    #[test]
    fn logarithms_of_ratios_are_smooth_where_both_numbers_meet() {
        for (a, b) in [(1.0, 1.0 + 1e-9), (2.0, 2.0), (1e-9, 5.0), (7.0, 1e-12), (1.0, 1.4), (1.0, 1.5)] {
            let truth = if a == b { 1.0 / a } else { f64::ln(b / a) / (b - a) };
            let given = log_ratio_over_difference(a, b, b - a);
            // The library's rounds the ratio.
            let off = 1e-15 * truth.abs() + if a == b { 0.0 } else { 2e-16 / (b - a).abs() };
            assert!((given - truth).abs() <= off, "{a} {b}: {given} {truth}");
        }
    }
}
