//! How do two numbers become a direction on one side of a surface?

use crate::{Lane, Triple};

/// A point of the unit disk in polar form.
pub(super) struct Disk<L> {
    /// 0..=1; its square is spread evenly.
    pub(super) radius: L,
    cosine: L,
    sine: L,
}

impl<L: Lane> Disk<L> {
    /// The point that two numbers in 0..1 choose, spread evenly: squares become rings (Shirley and Chiu, "A low
    /// distortion map between disk and square", JGT 2(3), 1997).
    #[inline(always)]
    pub(super) fn at([u, v]: [L; 2]) -> Self {
        let (zero, one) = (u.number(0.0), u.number(1.0));
        let (x, y) = (u + u - one, v + v - one);
        let steep = x.abs().less(y.abs());
        let [major, minor] = [L::select(steep, y, x), L::select(steep, x, y)];
        let radius = major.abs();
        let slope = L::select(zero.less(radius), minor / major, zero);
        let [cosine, sine] = eighth_turns(slope);
        let sign = L::select(major.less(zero), -one, one);
        Self {
            radius,
            cosine: L::select(steep, sine, cosine) * sign,
            sine: L::select(steep, cosine, sine) * sign,
        }
    }

    /// Its coordinates.
    #[inline(always)]
    fn coordinates(&self) -> [L; 2] {
        [self.cosine * self.radius, self.sine * self.radius]
    }

    /// The vector in this point's direction, so far across from the z axis and so far along it.
    #[inline(always)]
    pub(super) fn raised(&self, across: L, along: L) -> Triple<L> {
        Triple::new(self.cosine * across, self.sine * across, along)
    }
}

/// The point of the unit disk that two numbers in 0..1 choose, spread evenly.
#[inline(always)]
#[must_use]
pub fn point_of_disk<L: Lane>(numbers: [L; 2]) -> [L; 2] {
    Disk::at(numbers).coordinates()
}

/// Cosine and sine of as many eighths of a turn, −1..=1: Taylor's series, whose first terms left out are below 5e-17.
#[inline(always)]
fn eighth_turns<L: Lane>(eighths: L) -> [L; 2] {
    let angle = eighths * eighths.number(std::f64::consts::FRAC_PI_4);
    let square = angle * angle;
    [series(square, 1, 8), angle * series(square, 2, 7)]
}

/// 1 − x²/(a (a + 1)) (1 − x²/((a + 2) (a + 3)) (…)), `terms` terms of it: with a = 1 the cosine's 1 − x²/2! + x⁴/4! …,
/// with a = 2 the sine's 1 − x²/3! + x⁴/5! ….
#[inline(always)]
fn series<L: Lane>(square: L, first: u32, terms: u32) -> L {
    let one = square.number(1.0);
    let mut sum = one;
    for term in (0..terms).rev() {
        let below = f64::from(first + 2 * term);
        sum = (square * sum).mul_add(square.number(-1.0 / (below * (below + 1.0))), one);
    }
    sum
}

/// A vector that is given as seen from a unit normal, which is its z axis.
///
/// Duff, Burgess, Christensen, Hery, Kensler, Liani and Villemin, "Building an orthonormal basis, revisited", JCGT 6(1),
/// 2017.
#[inline(always)]
pub(super) fn about<L: Lane>(normal: Triple<L>, v: Triple<L>) -> Triple<L> {
    let one = normal.z.number(1.0);
    let sign = L::select(normal.z.less(one.number(0.0)), -one, one);
    let a = -one / (sign + normal.z);
    let b = normal.x * normal.y * a;
    let first = Triple::new((sign * normal.x * normal.x).mul_add(a, one), sign * b, -(sign * normal.x));
    let second = Triple::new(b, (normal.y * normal.y).mul_add(a, sign), -normal.y);
    first.scale_add(v.x, second.scale_add(v.y, normal.scale(v.z)))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn eighths_of_a_turn_are_those_of_the_library() {
        for i in -100..=100 {
            let eighths = f64::from(i) / 100.0;
            let (sin, cos) = (eighths * std::f64::consts::FRAC_PI_4).sin_cos();
            let [cosine, sine] = eighth_turns(eighths);
            assert!((cosine - cos).abs() < 3e-16 && (sine - sin).abs() < 3e-16, "{eighths}");
        }
    }

    #[test]
    fn the_disk_is_filled_evenly_by_quarters_and_rings() {
        let (steps, mut quarters, mut inner) = (400, [0; 4], 0);
        for (i, j) in (0..steps).flat_map(|i| (0..steps).map(move |j| (i, j))) {
            let disk = Disk::at([i, j].map(|i| (f64::from(i) + 0.5) / f64::from(steps)));
            assert!((disk.cosine.hypot(disk.sine) - 1.0).abs() < 1e-15 && disk.radius <= 1.0);
            quarters[usize::from(disk.cosine < 0.0) + 2 * usize::from(disk.sine < 0.0)] += 1;
            inner += u32::from(disk.radius < 0.5);
        }
        assert_eq!((quarters, inner), ([40_000; 4], 40_000));
    }

    #[test]
    fn the_middle_of_the_disk_is_a_point() {
        let disk = Disk::at([0.5, 0.5]);
        assert_eq!((disk.radius, disk.cosine, disk.sine), (0.0, 1.0, 0.0));
    }

    #[test]
    fn vectors_about_a_normal_keep_lengths_and_angles() {
        for normal in [DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::new(-2.0, 1.0, -2.0) / 3.0] {
            let turned = |v: DVec3| DVec3::from(about(normal.into(), v.into()));
            let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(turned);
            assert!(z.distance(normal) < 1e-15);
            assert!(x.cross(y).distance(z) < 1e-15 && (x.length() - 1.0).abs() < 1e-15, "{normal}");
        }
    }
}
