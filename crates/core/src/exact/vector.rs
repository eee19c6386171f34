//! Vectors of any kind of number.

use glam::DVec3;

use super::Number;

/// Three coordinates.
#[derive(Debug, Clone)]
pub struct Vector<N> {
    /// Along the first axis.
    pub x: N,
    /// Along the second.
    pub y: N,
    /// Along the third.
    pub z: N,
}

impl<N: Number> Vector<N> {
    /// Finite coordinates as they are.
    #[must_use]
    #[inline]
    pub fn of(v: DVec3) -> Self {
        Self { x: N::of(v.x), y: N::of(v.y), z: N::of(v.z) }
    }

    /// `self + other`.
    #[must_use]
    #[inline]
    pub fn plus(&self, other: &Self) -> Self {
        Self { x: self.x.plus(&other.x), y: self.y.plus(&other.y), z: self.z.plus(&other.z) }
    }

    /// `self − other`.
    #[must_use]
    #[inline]
    pub fn minus(&self, other: &Self) -> Self {
        Self { x: self.x.minus(&other.x), y: self.y.minus(&other.y), z: self.z.minus(&other.z) }
    }

    /// Each coordinate times a number.
    #[must_use]
    #[inline]
    pub fn scaled(&self, by: &N) -> Self {
        Self { x: self.x.times(by), y: self.y.times(by), z: self.z.times(by) }
    }

    /// Scalar product.
    #[must_use]
    #[inline]
    pub fn dot(&self, other: &Self) -> N {
        self.x.times(&other.x).plus(&self.y.times(&other.y)).plus(&self.z.times(&other.z))
    }

    /// Scalar product with itself.
    #[must_use]
    #[inline]
    pub fn squared(&self) -> N {
        self.dot(self)
    }

    /// Vector product.
    #[must_use]
    #[inline]
    pub fn cross(&self, other: &Self) -> Self {
        let minor = |a: &N, d: &N, b: &N, c: &N| a.times(d).minus(&b.times(c));
        Self {
            x: minor(&self.y, &other.z, &self.z, &other.y),
            y: minor(&self.z, &other.x, &self.x, &other.z),
            z: minor(&self.x, &other.y, &self.y, &other.x),
        }
    }
}
