//! Random numbers of tests: the same ones every time.

use catoptra_core::glam::DVec3;

/// A stream of numbers (SplitMix64: Steele, Lea and Flood 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// From −1 to 1.
    pub(crate) fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn point(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    /// A coordinate axis.
    pub(crate) fn axis(&mut self) -> DVec3 {
        DVec3::AXES[self.bits() as usize % 3]
    }

    /// A power of two between two exponents.
    pub(crate) fn power(&mut self, low: i32, high: i32) -> f64 {
        2.0_f64.powi(low + (self.bits() % (high - low + 1) as u64) as i32)
    }

    /// A size in metres: an ordinary one, or one that leads `f32` to its ends.
    pub(crate) fn unit(&mut self) -> f64 {
        if self.bits().is_multiple_of(2) { 1.0 } else { self.power(-64, 40) }
    }
}
