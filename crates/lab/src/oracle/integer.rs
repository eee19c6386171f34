//! Coordinates as integers: every `f64` is one once it is scaled far enough.

use catoptra_core::glam::DVec3;
use num_bigint::BigInt;

/// Three integers.
pub(super) type Vector = [BigInt; 3];

/// How often a number must be doubled to be an integer; at least 0.
pub(super) fn doublings(value: f64) -> i32 {
    if value == 0.0 {
        return 0;
    }
    let (mantissa, exponent) = parts(value);
    (-(exponent + mantissa.trailing_zeros() as i32)).max(0)
}

fn parts(value: f64) -> (u64, i32) {
    let bits = value.abs().to_bits();
    let fraction = bits & ((1 << 52) - 1);
    if bits >> 52 == 0 { (fraction, -1074) } else { (fraction | 1 << 52, (bits >> 52) as i32 - 1075) }
}

/// The number times 2^`scale`, which must be at least its [`doublings`].
pub(super) fn integer(value: f64, scale: i32) -> BigInt {
    let (mantissa, exponent) = parts(value);
    let shift = exponent + scale;
    let size = if shift >= 0 { BigInt::from(mantissa) << shift } else { BigInt::from(mantissa) >> -shift };
    if value < 0.0 { -size } else { size }
}

pub(super) fn vector(v: DVec3, scale: i32) -> Vector {
    v.to_array().map(|c| integer(c, scale))
}

pub(super) fn minus(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|i| &a[i] - &b[i])
}

pub(super) fn dot(a: &Vector, b: &Vector) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &a[j] * &b[k] - &a[k] * &b[j]
    })
}
