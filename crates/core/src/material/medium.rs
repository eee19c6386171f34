//! What fills a solid that light goes through?

use crate::Rgb;
use crate::part::LARGEST;

/// Clear matter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// Index of refraction.
    pub ior: f64,
    /// What is absorbed, 1/m per channel: exp(−absorption · d) of light is left after d metres (Beer and Lambert).
    pub absorption: Rgb,
    /// Of two media in one place the one with the higher priority is there.
    pub priority: u32,
}

/// The absorption, 1/m, that leaves `tint` of white light after `distance` metres; what leaves none is as large as numbers of
/// parts get.
#[must_use]
pub fn absorption(tint: Rgb, distance: f64) -> Rgb {
    // Of white it is 0 and not −0.
    tint.map(|share| (-share.ln() / distance).clamp(0.0, LARGEST) + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tint_is_what_is_left_after_its_distance() {
        let tint = Rgb::new(1.0, 0.5, 1e-3);
        for distance in [0.01, 1.0, 30.0] {
            let left = |metres: f64| absorption(tint, distance).map(|a| (-a * metres).exp());
            for (left, tint) in left(distance).to_array().into_iter().zip(tint.to_array()) {
                assert!((left - tint).abs() < 1e-15);
            }
            // Through the middle of a ball of radius `distance`.
            assert!((left(2.0 * distance).g - 0.25).abs() < 1e-15);
        }
        assert_eq!(absorption(Rgb::BLACK, 1e-3), Rgb::grey(LARGEST));
        assert_eq!(absorption(Rgb::WHITE, 1.0).r.to_bits(), 0.0_f64.to_bits());
    }
}
