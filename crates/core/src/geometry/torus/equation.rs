//! Where along a ray is the equation of a torus 0?
//!
//! With x from the middle to a point of the ray, a the axis, R and r the radii: (x² + R² − r²)² a² = 4 R² |x × a|², which is of
//! degree four in the ray's parameter and negative inside.

use std::cmp::Ordering;

use super::Torus;
use crate::Ray;
use crate::exact::{Number, Root, Vector, Verdict};
use crate::numeric::HELD_WITHIN;

/// Where a ray meets a torus: the roots of an equation that is negative inside, from its constant coefficient upwards.
pub(super) struct Along<N> {
    pub(super) equation: [N; 5],
    /// The ray's parameter where that of the equation is 0.
    shift: f64,
    /// All roots lie between −`reach` and this, a power of two.
    pub(super) reach: f64,
}

impl<N: Number> Along<N> {
    /// A root of the equation as one on the ray.
    pub(super) fn root(&self, root: Root<N>) -> Root<N> {
        Root { rational: root.rational.plus(&N::of(self.shift)), ..root }
    }

    /// Whether the equation is negative just behind 0.
    pub(super) fn begins_inside(&self) -> Verdict<bool> {
        for coefficient in &self.equation {
            match coefficient.sign()? {
                Ordering::Equal => {}
                sign => return Ok(sign.is_lt()),
            }
        }
        Ok(false)
    }
}

impl Torus {
    /// The equation along a ray, which `leaving` says to leave the torus; `None` where it certainly passes by.
    pub(super) fn along<N: Number>(&self, own: &Ray, leaving: Option<u32>) -> Option<Along<N>> {
        let from_center = own.origin - self.center;
        // Numbers that are rounded keep their digits near the torus.
        let shift = if N::EXACT || leaving.is_some() {
            0.0
        } else {
            -from_center.dot(own.direction) / own.direction.length_squared()
        };
        let shift = if shift.is_finite() { shift } else { 0.0 };
        let mut equation = self.equation::<N>(own, shift)?;
        if leaving.is_some() {
            equation.rotate_left(1);
            equation[4] = N::of(0.0);
        }
        let coordinate = own.origin.abs().max_element() + self.center.abs().max_element();
        let distance = (from_center + own.direction * shift).length() + HELD_WITHIN * coordinate;
        Some(Along { equation, shift, reach: reach(distance, self.major + self.minor, own) })
    }

    /// The equation's coefficients along a ray whose parameter begins at `shift`, from the constant one upwards; `None` where
    /// the ray certainly passes by the ball round the torus.
    fn equation<N: Number>(&self, ray: &Ray, shift: f64) -> Option<[N; 5]> {
        let (a, d) = (Vector::<N>::of(self.upwards), Vector::of(ray.direction));
        let x = Vector::of(ray.origin).minus(&Vector::of(self.center)).plus(&d.scaled(&N::of(shift)));
        let [major, minor] = self.radii().map(N::of);
        let (d2, reach) = (d.squared(), major.plus(&minor));
        let clearance = x.cross(&d).squared().minus(&reach.squared().times(&d2));
        if clearance.sign().is_ok_and(Ordering::is_gt) {
            return None;
        }
        // x² + R² − r² is q₀ + 2 q₁ s + d² s², and |x × a|² is m² + 2 m·n s + n² s².
        let (m, n, a2) = (x.cross(&a), d.cross(&a), a.squared());
        let q0 = x.squared().plus(&reach.times(&major.minus(&minor)));
        let q1 = x.dot(&d);
        let [two, four] = [2.0, 4.0].map(N::of);
        let ring = four.times(&major.squared());
        let mixed = two.times(&q1.squared()).plus(&q0.times(&d2)).times(&two);
        Some([
            a2.times(&q0.squared()).minus(&ring.times(&m.squared())),
            four.times(&a2.times(&q0.times(&q1))).minus(&two.times(&ring.times(&m.dot(&n)))),
            a2.times(&mixed).minus(&ring.times(&n.squared())),
            four.times(&a2.times(&q1.times(&d2))),
            a2.times(&d2.squared()),
        ])
    }
}

/// A power of two that parameters from a point near a torus to all points of it are smaller than, given how far the point is
/// from the middle and how far the torus reaches.
fn reach(distance: f64, size: f64, ray: &Ray) -> f64 {
    let most = (distance + size) * (1.0 + HELD_WITHIN) / ray.direction.length();
    most.log2().ceil().exp2()
}
