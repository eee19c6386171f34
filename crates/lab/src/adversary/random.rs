//! Numbers that look random and can be had again.

use catoptra_core::Ray;
use catoptra_core::glam::DVec3;

/// A stream of numbers (SplitMix64: Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// The stream of a number.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// Below `count`, which is not 0.
    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count.max(1) as u64) as usize
    }

    /// In `low..high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A power of two between two exponents.
    pub fn power(&mut self, low: i32, high: i32) -> f64 {
        let exponent = low + self.below((high - low) as usize + 1) as i32;
        2.0_f64.powi(exponent)
    }

    /// A point of a cube round zero with coordinates that `f32` holds.
    pub fn point(&mut self, reach: f64) -> DVec3 {
        rounded(DVec3::new(
            self.between(-reach, reach),
            self.between(-reach, reach),
            self.between(-reach, reach),
        ))
    }

    /// A point with whole coordinates.
    pub fn whole_point(&mut self, reach: f64) -> DVec3 {
        self.point(reach).round()
    }

    /// A direction that is not zero, with coordinates that `f32` holds, now and then along an axis or with -0.
    pub fn direction(&mut self) -> DVec3 {
        let direction = self.point(1.0);
        let axis = self.below(12);
        match axis {
            0..3 => DVec3::AXES[axis],
            3..6 => -DVec3::AXES[axis - 3],
            6 => DVec3::new(direction.x, -0.0, direction.z),
            _ if direction == DVec3::ZERO => DVec3::X,
            _ => direction,
        }
    }

    /// A point of the circle round the origin through two vectors, which are as long as each other and perpendicular; exact at both
    /// of them and opposite.
    pub fn on_circle(&mut self, [u, v]: [DVec3; 2]) -> DVec3 {
        match self.below(6) {
            0 => u,
            1 => -u,
            2 => v,
            3 => -v,
            _ => {
                let t = self.between(-4.0, 4.0);
                (u * (1.0 - t * t) + v * (2.0 * t)) / (1.0 + t * t)
            }
        }
    }

    /// The point, each coordinate up to so many steps of `f32` beside itself.
    pub fn beside(&mut self, point: DVec3, steps: usize) -> DVec3 {
        DVec3::from(point.to_array().map(|c| {
            let (count, up) = (self.below(steps + 1), self.bits() & 1 == 0);
            let step = |c: f32| if up { c.next_up() } else { c.next_down() };
            f64::from((0..count).fold(c as f32, |c, _| step(c)))
        }))
    }

    /// A ray from a point at a target, or past it by a few steps of `f32`; its direction is now and then longer or shorter.
    pub fn aimed(&mut self, from: DVec3, target: DVec3) -> Ray {
        let steps = [0, 0, 1, 3][self.below(4)];
        let target = self.beside(target, steps);
        let stretch = self.power(-3, 3);
        Ray::new(rounded(from), rounded((target - rounded(from)) * stretch))
    }
}

/// Coordinates as `f32` holds them.
pub(super) fn rounded(p: DVec3) -> DVec3 {
    DVec3::from(p.to_array().map(|c| f64::from(c as f32)))
}
