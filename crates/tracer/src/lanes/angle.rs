//! Which angle has a vector? The arctangent of two numbers, in every lane.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use catoptra_core::{Arithmetic, Lane};
use fearless_simd::Simd;

use super::{F, polynomial};

/// The angle of the vector (x, y) from the x axis, within 4·2⁻²⁴ of its own size; 0 where both are 0, and any number where
/// one is NaN.
#[inline(always)]
pub(super) fn atan2<S: Simd>(y: F<S>, x: F<S>) -> F<S> {
    let (zero, tiny) = (x.number(0.0), x.number(f64::from(f32::MIN_POSITIVE)));
    let (across, along) = (y.abs(), x.abs());
    let (less, more) = (across.min(along), across.max(along));
    // From 22.5° on, the angle that is left of 45°, so that the series need not reach far.
    let wide = (more * x.number(TAN_22_5)).less(less);
    let slope = F::pick(wide, less - more, less) / F::pick(wide, less + more, more).max(tiny);
    let slope2 = slope * slope;
    let series = (polynomial(slope2, ATAN) * slope2).mul_add(slope, slope);
    let octant = F::pick(wide, x.number(FRAC_PI_4) + series, series);
    let quadrant = F::pick(along.less(across), x.number(FRAC_PI_2) - octant, octant);
    let half = F::pick(x.less(zero), x.number(PI) - quadrant, quadrant);
    F::pick(y.less(zero), -half, half)
}

/// tan 22.5° = √2 − 1.
const TAN_22_5: f64 = std::f64::consts::SQRT_2 - 1.0;

/// (atan s / s − 1) / s² as a polynomial in s², for s up to tan 22.5°: fitted for the least largest error of atan s / s,
/// which is 6.6e-10.
const ATAN: [f32; 5] = [-0.060_834_53, 0.105_960_01, -0.142_438_49, 0.199_984_9, -0.333_333_15];

#[cfg(test)]
mod tests {
    use fearless_simd::Level;

    use super::*;
    use crate::lanes::{Work, at_level};

    struct Worst;

    impl Work for Worst {
        type Output = f64;

        fn with<S: Simd>(self, s: S) -> f64 {
            let mut worst: f64 = 0.0;
            for i in 0..40_000 {
                let turn = (f64::from(i) / 20_000.0 - 1.0) * PI;
                let size = 10.0_f64.powi(i % 13 - 6);
                let (y, x) = ((turn.sin() * size) as f32, (turn.cos() * size) as f32);
                let found = f64::from(atan2(F::splat(s, y), F::splat(s, x)).lane(0));
                let expected = f64::from(y).atan2(f64::from(x));
                worst = worst.max(((found - expected) / expected.abs().max(1e-30)).abs());
            }
            worst
        }
    }

    struct Corners;

    impl Work for Corners {
        type Output = Vec<f32>;

        fn with<S: Simd>(self, s: S) -> Vec<f32> {
            let corners = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)];
            corners.map(|(y, x)| atan2(F::splat(s, y), F::splat(s, x)).lane(0)).to_vec()
        }
    }

    #[test]
    fn angles_are_right_all_round() {
        let worst = at_level(Level::new(), Worst);
        assert!(worst <= 4.0 / f64::from(1 << 24), "{worst:e}");
    }

    #[test]
    fn axes_have_their_angles_and_no_vector_has_none() {
        let found = at_level(Level::new(), Corners);
        let quarter = FRAC_PI_2 as f32;
        assert_eq!(found, [0.0, 0.0, quarter, 2.0 * quarter, -quarter]);
    }
}
