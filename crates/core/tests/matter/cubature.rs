//! Integrals over boxes and over directions, finer where it matters.

use std::f64::consts::{PI, TAU};

use catoptra_core::glam::DVec3;

/// Gauss and Legendre's rule of four points over 0..1.
const NODES: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// A box of two dimensions.
#[derive(Clone, Copy)]
pub(crate) struct Patch {
    pub(crate) from: [f64; 2],
    pub(crate) size: [f64; 2],
}

impl Patch {
    fn quarters(self) -> [Self; 4] {
        let size = self.size.map(|s| 0.5 * s);
        [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]
            .map(|at| Self { from: [0, 1].map(|k| self.from[k] + at[k] * size[k]), size })
    }

    fn once(self, f: &impl Fn(f64, f64) -> f64) -> f64 {
        let at = |k: usize, t: f64| t.mul_add(self.size[k], self.from[k]);
        let row = |(t, weight): (f64, f64)| {
            weight * NODES.iter().map(|(u, w)| w * f(at(0, t), at(1, *u))).sum::<f64>()
        };
        self.size[0] * self.size[1] * NODES.into_iter().map(row).sum::<f64>()
    }

    /// The integral of `f`; parts are quartered until that changes each by less than `error`.
    pub(crate) fn integral(self, error: f64, f: &impl Fn(f64, f64) -> f64) -> f64 {
        fn refine(patch: Patch, whole: f64, depth: u32, error: f64, f: &impl Fn(f64, f64) -> f64) -> f64 {
            let parts = patch.quarters().map(|part| (part, part.once(f)));
            let sum: f64 = parts.iter().map(|(_, sum)| sum).sum();
            if depth == 0 || (sum - whole).abs() < error {
                return sum;
            }
            parts.into_iter().map(|(part, sum)| refine(part, sum, depth - 1, error, f)).sum()
        }
        refine(self, self.once(f), 9, error, f)
    }
}

/// ∫ `f` over all directions on the side of `z = 0` that `around` lies on, whose neighbourhood is looked at closest. About z
/// itself the horizon is met exactly.
pub(crate) fn over_side(around: DVec3, error: f64, f: impl Fn(DVec3) -> f64) -> f64 {
    let (x, y) = around.any_orthonormal_pair();
    let most = if around.z.abs() == 1.0 { 0.5 * PI } else { PI };
    let value = |a: f64, turn: f64| {
        let polar = most * a * a * a;
        let (sin, cos) = polar.sin_cos();
        let (across, along) = (TAU * turn).sin_cos();
        let i = (x * along + y * across) * sin + around * cos;
        if i.z * around.z > 0.0 { f(i) * sin * 3.0 * most * a * a * TAU } else { 0.0 }
    };
    let patches = (0..8).flat_map(|a| (0..4).map(move |turn| (f64::from(a), f64::from(turn))));
    patches
        .map(|(a, turn)| {
            let patch = Patch { from: [a / 8.0, turn / 4.0], size: [1.0 / 8.0, 1.0 / 4.0] };
            patch.integral(error, &value)
        })
        .sum()
}

#[test]
fn a_half_sphere_has_two_pi() {
    for around in [DVec3::Z, DVec3::NEG_Z, DVec3::new(0.8, 0.0, 0.6)] {
        assert!((over_side(around, 1e-6, |_| 1.0) - TAU).abs() < 1e-3);
        assert!((over_side(around, 1e-6, |i| i.z.abs()) - PI).abs() < 1e-5);
    }
}
