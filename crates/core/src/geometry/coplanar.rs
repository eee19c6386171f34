//! Which triangles lie in one plane, exactly?
//!
//! A ray that leaves a plane never meets it again, so one that leaves a triangle of a mesh meets none of those that lie in its plane,
//! whatever rounding has made of where it starts.

use glam::DVec3;

use crate::exact::{Difference, sign_of_determinant};
use crate::numeric::EDGE_VALUE_ERROR;

/// Whether all corners of a triangle lie in the plane of another; in that of one without area all do.
pub(super) fn lies_in_plane(triangle: &[DVec3; 3], of: &[DVec3; 3]) -> bool {
    triangle.iter().all(|p| of.contains(p) || common_plane(of, *p))
}

/// Whether a point lies in the plane of a triangle.
fn common_plane(&[a, b, c]: &[DVec3; 3], p: DVec3) -> bool {
    let [u, v, w] = [b, c, p].map(|to| to - a);
    let (reach, off) = (u.abs().max(v.abs()), w.abs());
    // Differences are zero of equal numbers alone: across an axis nothing is left to be worked out.
    if reach.max(off).min_element() == 0.0 {
        return true;
    }
    let (reach, size) = (reach.max_element(), off.element_sum());
    // That of a volume, and the rounding of the third difference.
    let error = 2.0 * EDGE_VALUE_ERROR * reach * reach * size + f64::MIN_POSITIVE * (1.0 + size);
    if u.cross(v).dot(w).abs() > error {
        return false;
    }
    let from_a = |to: DVec3| Difference { from: a, to };
    sign_of_determinant(&[from_a(b), from_a(c), from_a(p)]).is_eq()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::exact::{Dyadic, Vector};

    /// The volume that a point spans with a triangle, exactly.
    fn is_flat(&[a, b, c]: &[DVec3; 3], p: DVec3) -> bool {
        let [u, v, w] = [b, c, p].map(|to| Vector::<Dyadic>::of(to).minus(&Vector::of(a)));
        u.cross(&v).dot(&w).signum().is_eq()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn planes_are_told_exactly(
            base in prop::array::uniform3([-9_i32..10, -9..10, -9..10]),
            shares in prop::array::uniform3([-20_i32..21, -20..21]),
            off in 0..4_usize, scale in -60_i32..60,
        ) {
            let [at, u, v] = base.map(|c| DVec3::from(c.map(f64::from)) * 0.7_f64.powi(scale));
            let in_plane = |[x, y]: [i32; 2]| at + u * f64::from(x) + v * f64::from(y);
            let of = [at, at + u, at + v];
            let mut triangle = shares.map(in_plane);
            if off < 3 {
                let component = &mut triangle[off][off];
                *component = if shares[0][0] % 2 == 0 { component.next_up() } else { *component };
            }
            prop_assert_eq!(lies_in_plane(&triangle, &of), triangle.iter().all(|p| is_flat(&of, *p)));
        }
    }
}
