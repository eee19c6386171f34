//! Which way does a random direction about a normal go? Written once over any number of lanes.

use std::f64::consts::FRAC_PI_4;

use catoptra_core::{Lane, Triple};

/// A unit vector on the side of the unit vector `normal`, likelier near it: its density is the cosine between both over π,
/// for two numbers that lie evenly in 0..1.
///
/// A point of a square is laid onto the disk below the hemisphere, ring by ring, so that what lies evenly stays so (Shirley
/// and Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997), and raised from there.
#[inline(always)]
pub(crate) fn cosine_weighted<L: Lane>(normal: Triple<L>, [u, v]: [L; 2]) -> Triple<L> {
    let (zero, one, two) = (u.number(0.0), u.number(1.0), u.number(2.0));
    let (a, b) = (two * u - one, two * v - one);
    let flat = b.abs().less(a.abs());
    let (radius, other) = (L::select(flat, a, b), L::select(flat, b, a));
    let middle = !(zero.less(radius) | radius.less(zero));
    let (sine, cosine) = sine_and_cosine(L::select(middle, zero, other / radius) * u.number(FRAC_PI_4));
    let (along, across) = (radius * cosine, radius * sine);
    let (x, y) = (L::select(flat, along, across), L::select(flat, across, along));
    let height = ((one - radius) * (one + radius)).sqrt();
    let [right, forward] = perpendicular(normal);
    right.scale_add(x, forward.scale_add(y, normal.scale(height)))
}

/// Two unit vectors that are perpendicular to a unit vector and to each other (Duff and others, "Building an Orthonormal
/// Basis, Revisited", JCGT 6(1), 2017).
#[inline(always)]
fn perpendicular<L: Lane>(n: Triple<L>) -> [Triple<L>; 2] {
    let (zero, one) = (n.z.number(0.0), n.z.number(1.0));
    let sign = L::select(n.z.less(zero), -one, one);
    let a = -one / (sign + n.z);
    let b = n.x * n.y * a;
    [
        Triple::new((sign * n.x * n.x).mul_add(a, one), sign * b, -(sign * n.x)),
        Triple::new(b, (n.y * n.y).mul_add(a, sign), -n.y),
    ]
}

/// Of an angle within ±π/4: Taylor's series, whose first terms left out are below 2⁻⁵⁴.
#[inline(always)]
fn sine_and_cosine<L: Lane>(angle: L) -> (L, L) {
    let square = angle * angle;
    let series = |terms: [f64; 8]| {
        terms.into_iter().fold(angle.number(0.0), |sum, term| sum.mul_add(square, angle.number(term)))
    };
    let over = |factorial: f64| 1.0 / factorial;
    let sine = series([
        -over(1_307_674_368_000.0),
        over(6_227_020_800.0),
        -over(39_916_800.0),
        over(362_880.0),
        -over(5_040.0),
        over(120.0),
        -over(6.0),
        1.0,
    ]);
    let cosine = series([
        over(20_922_789_888_000.0),
        -over(87_178_291_200.0),
        over(479_001_600.0),
        -over(3_628_800.0),
        over(40_320.0),
        -over(720.0),
        over(24.0),
        -over(2.0),
    ]);
    (sine * angle, cosine.mul_add(square, angle.number(1.0)))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use catoptra_core::glam::DVec3;

    use super::*;
    use crate::random::Random;
    use crate::sampler::{Sampler, share};

    fn directions(normal: DVec3, count: u32) -> impl Iterator<Item = DVec3> {
        let sampler = Sampler::new(0, 1, 2);
        (0..count).map(move |k| cosine_weighted(normal.into(), sampler.pair(k, 0).map(share)).into())
    }

    fn normals() -> Vec<DVec3> {
        let mut random = Random(5);
        let any = (0..50).map(|_| random.point().normalize());
        any.chain(DVec3::AXES).chain(DVec3::AXES.map(|axis| -axis)).collect()
    }

    #[test]
    fn directions_are_unit_vectors_on_the_side_of_the_normal() {
        for normal in normals() {
            for direction in directions(normal, 64) {
                assert!((direction.length() - 1.0).abs() < 4.0 * f64::EPSILON, "{normal} {direction}");
                assert!(direction.dot(normal) > 0.0, "{normal} {direction}");
            }
        }
    }

    #[test]
    fn the_middle_and_the_corners_of_the_square_have_directions() {
        for ends in [[0.5, 0.5], [0.0, 0.0], [0.0, 0.5], [0.5, 0.0]] {
            let direction: DVec3 = cosine_weighted(DVec3::Z.into(), ends).into();
            let radius = ends.iter().fold(0.0_f64, |most, end| most.max((2.0 * end - 1.0).abs()));
            assert!(
                (direction.truncate().length() - radius).abs() < 1e-15 && direction.is_finite(),
                "{direction}"
            );
        }
    }

    #[test]
    fn their_density_is_the_cosine_over_pi() {
        let count = 1 << 14;
        for normal in normals().into_iter().step_by(8) {
            let mean =
                |of: &dyn Fn(DVec3) -> f64| directions(normal, count).map(of).sum::<f64>() / f64::from(count);
            let side = normal.any_orthonormal_vector();
            // ∫ cosᵏ θ cos θ / π dω = 2 / (k + 2); a quarter of the whole within 30 degrees of the normal, as sin² 30° = 1/4;
            // and a fourth of the disk's second moment on each side of it.
            assert!((mean(&|d| d.dot(normal)) - 2.0 / 3.0).abs() < 1e-4);
            assert!((mean(&|d| d.dot(normal).powi(2)) - 0.5).abs() < 1e-4);
            assert!((mean(&|d| f64::from(d.dot(normal) > (PI / 6.0).cos())) - 0.25).abs() < 2e-3);
            assert!((mean(&|d| d.dot(side).powi(2)) - 0.25).abs() < 1e-4);
            assert!(mean(&|d| d.dot(side)).abs() < 1e-4);
        }
    }

    #[test]
    fn sine_and_cosine_are_right_to_the_last_digits() {
        for step in -1000..=1000 {
            let angle = FRAC_PI_4 * f64::from(step) / 1000.0;
            let (sine, cosine) = sine_and_cosine(angle);
            assert!(
                (sine - angle.sin()).abs() <= f64::EPSILON && (cosine - angle.cos()).abs() <= f64::EPSILON,
                "{angle}"
            );
        }
    }
}
