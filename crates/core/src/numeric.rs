//! Which numbers decide something: every tolerance of the workspace's numerics, each with its source.

/// Unit roundoff of `f32` with rounding to nearest: 2⁻²⁴.
pub const UNIT_ROUNDOFF_F32: f64 = 1.0 / (1_u64 << 24) as f64;

/// Unit roundoff of `f64` with rounding to nearest: 2⁻⁵³.
pub const UNIT_ROUNDOFF_F64: f64 = 1.0 / (1_u64 << 53) as f64;

/// Cosine of the largest deviation from a right angle that a rectangle's edges may show.
///
/// A rectangle is given by numbers that a person or a rotation has rounded; 10⁻⁹ is far above what rounding in
/// `f64` leaves (about 10⁻¹⁵) and far below what can be seen.
pub const RIGHT_ANGLE_TOLERANCE: f64 = 1e-9;

/// Rounding in the edges of a flat shape: each coordinate of an edge may be off by this times the largest coordinate
/// of a corner, summed over the edge's three components.
///
/// Two corners that were rounded when they were written down, and their difference: 3 roundings of at most that
/// size, √3 of it in length: 5.2, and the products that follow stay below 8.
pub const EDGE_ROUNDING: f64 = 8.0 * UNIT_ROUNDOFF_F64;

/// How far from a surface, in parts of the sum of both coordinates' sizes, a point still counts as lying on it, for what it
/// sees: 2⁻⁴⁰, 8,192 roundings; of a room some picometres, below the size of an atom.
///
/// A corner that someone wrote down is off by a rounding or two. A point where a ray meets a surface is off along the ray by
/// some 8 roundings over the cosine under which it arrives, and by as much from *another* surface that meets the first one
/// there: so cosines down to a thousandth are covered. Without that, points where two walls meet lie behind one of them by
/// chance.
pub const HELD_WITHIN: f64 = 1.0 / (1_u64 << 40) as f64;

/// Error of an edge value `(a × b) · d` in `f64`, relative to R² |d|₁, where R bounds the coordinates of the corners a and
/// b as seen from the origin.
///
/// Each of those is rounded once, each product of two once more (3u), their difference once (4u of 2R²); the product with
/// d adds one, and the sum of three products two: 7u of 2R² |d|₁, so 14u, rounded up for the terms of higher order.
pub const EDGE_VALUE_ERROR: f64 = 16.0 * UNIT_ROUNDOFF_F64;

/// How well a root is known, relative to itself, before it counts as found in `f64`: 2⁻³⁶, a 4,096th of the step between
/// two `f32`, so that rounding it to `f32` gives the right number or the one beside it.
pub const ROOT_PRECISION: f64 = 1.0 / (1_u64 << 36) as f64;

/// Two conics seen from a point are the same where what tells them apart, (r N·x)² − |N × (x × P)|², stays below this times
/// r (|x| |P|)² over the whole of a curve.
///
/// Each factor r N·x and |N × (x × P)| is at most r |x| and known to 8 roundings of |x| |P| (one in each of x and P, three in
/// each of two products); of two squares it is twice that, and the sum of six coefficients doubles it again.
pub const CONIC_ROUNDING: f64 = 32.0 * UNIT_ROUNDOFF_F64;

/// How far a corner of a polygon may be from a plane through the eye, as a share of the polygon's distance, and still count as
/// lying in it.
///
/// A corner where an edge was cut is off by 3 roundings, the product with a unit normal adds 3, and the normal of the plane
/// through an edge is known to 4 over the sine of the angle under which the edge is seen: so 64 are enough down to a
/// fifteenth. What is thinner than that gives less light than the 10⁻¹² that values are known to.
pub const CUT_ROUNDING: f64 = 64.0 * UNIT_ROUNDOFF_F64;

/// Products of two `f64` from here on lose nothing of `f64`'s range to rounding: their last digit is worth at least
/// 2⁻¹⁰⁶ of them, and this is 2¹⁰⁶ of the smallest number, 2⁻¹⁰⁷⁴.
pub const WHOLE_PRODUCT: f64 = f64::from_bits((1023 - 968) << 52);

/// The least sine of the angle between two edges whose vector product is taken in `f64`: 2⁻²⁰.
///
/// The product is off by 5u of the product of the edges' lengths (one rounding in each coordinate of both, three in a
/// difference of products), so its direction is off by at most 5u 2²⁰, about 6e-10. Thinner triangles get theirs exactly.
pub const NORMAL_SINE: f64 = 1.0 / (1_u64 << 20) as f64;

/// How far, in cells, the edges of a pattern lie beside whole numbers: 2⁻¹⁴.
///
/// Scenes are written in whole numbers, and so whole rows of pixels fall exactly on an edge, where rounding would
/// decide.
pub const PATTERN_SHIFT: f64 = 1.0 / (1_u64 << 14) as f64;

/// How far a cell number `c = position · scale + phase` in `f32` may be off, in cells and per cell of |c| + 2, beside
/// what the position's error makes of it: one rounding each in the scale, the phase (below 2) and the fused sum; 3,
/// rounded up.
pub const PATTERN_ERROR: f64 = 4.0 * UNIT_ROUNDOFF_F32;

/// How far a point that was put on a lamp may be off its surface, relative to the sum of the largest coordinates.
///
/// The difference to the shaded point, the products with two shares, their sum, and turning it into a direction and
/// back: 8 roundings of at most that size.
pub const LAMP_POINT_ROUNDING: f64 = 8.0 * UNIT_ROUNDOFF_F64;

/// How densely points of a lamp are drawn at least, as a share of the largest density: so that none is drawn so rarely that
/// it stands for much more than its share.
pub const LEAST_DENSITY: f64 = 1.0 / 8.0;

/// Solid angles under this, sr, are lost to rounding where angles near π are subtracted: 2⁻²⁰, of which 10 roundings of
/// 2π take less than a hundred-millionth.
pub const SMALLEST_SOLID_ANGLE: f64 = 1.0 / (1_u64 << 20) as f64;

/// Most pairs of lines between squares that are told apart within a footprint: a mean over more squares is taken as grey, from
/// which it is off by less than a tenth, and by a hundredth on average.
pub const MOST_SQUARES: u32 = 64;

/// Least slope of a line in parts of its larger one, in place of none: lines that far from meeting an edge of a footprint within
/// it add 2⁻⁴⁰ of its area, below what `f32` can tell.
pub const LEAST_SLOPE: f64 = 1.0 / (1_u64 << 40) as f64;

/// Slopes of a rough surface below which it counts as smooth: a reflection is then blurred by less than a hundredth of a
/// degree, a sixth of what an eye resolves.
pub const SMOOTH_SLOPE: f64 = 1e-4;

/// The least cosine to the shading normal under which a surface is seen. A smooth normal may lean away from the viewer; what is
/// seen there is seen at a grazing angle, and quotients by the cosine stay finite.
pub const LEAST_COSINE: f64 = 1.0 / (1_u64 << 20) as f64;

/// How far from 1 the ratio of two indices of refraction must be for them to differ: below, no light is reflected (a squared
/// quarter of this at normal incidence) and none is bent.
pub const LEAST_INDEX_STEP: f64 = 1e-4;

/// γₙ = n·u / (1 − n·u): the relative error bound of `n` accumulated roundings in `f32`
/// (Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., lemma 3.1).
#[must_use]
pub const fn gamma_f32(n: u32) -> f64 {
    let nu = n as f64 * UNIT_ROUNDOFF_F32;
    nu / (1.0 - nu)
}

/// γₙ for `f64`, as [`gamma_f32`].
#[must_use]
pub const fn gamma_f64(n: u32) -> f64 {
    let nu = n as f64 * UNIT_ROUNDOFF_F64;
    nu / (1.0 - nu)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roundoffs_are_half_the_machine_epsilons() {
        assert_eq!(UNIT_ROUNDOFF_F32, f64::from(f32::EPSILON) / 2.0);
        assert_eq!(UNIT_ROUNDOFF_F64, f64::EPSILON / 2.0);
    }
}
