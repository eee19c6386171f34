//! Where are the corners of a file, and how are they kept as `f32` without loss that can be seen?

use catoptra_core::glam::DVec3;

/// Coordinates beyond this in magnitude are none: differences of two must be numbers of `f32`.
const LARGEST: f64 = 1e38;

/// Of corners further from zero than so many times their spread, `f32` is counted from a point among them. It then holds 2²¹
/// steps across them at least, well below what can be seen; nearer ones lose no more than three of its digits to where they
/// stand.
const FAR: f64 = 8.0;

/// Corners as a file has them.
#[derive(Debug, Clone)]
pub(in crate::model) enum Positions {
    /// Numbers of `f32`.
    Narrow(Vec<[f32; 3]>),
    /// Numbers that `f32` may not hold.
    Wide(Vec<[f64; 3]>),
}

impl Positions {
    /// How many there are.
    pub(in crate::model) fn len(&self) -> usize {
        match self {
            Self::Narrow(list) => list.len(),
            Self::Wide(list) => list.len(),
        }
    }

    /// One of them; may be no number.
    pub(in crate::model) fn at(&self, index: u32) -> DVec3 {
        match self {
            Self::Narrow(list) => DVec3::from(list[index as usize].map(f64::from)),
            Self::Wide(list) => DVec3::from(list[index as usize]),
        }
    }

    /// From where those that are used are best counted: zero, unless that would cost digits.
    pub(in crate::model) fn origin(&self, used: impl Iterator<Item = u32>) -> DVec3 {
        let Self::Wide(list) = self else { return DVec3::ZERO };
        let (mut min, mut max, mut is_exact) = (DVec3::INFINITY, DVec3::NEG_INFINITY, true);
        for index in used {
            let corner = list[index as usize];
            is_exact &= corner.iter().all(|&v| f64::from(v as f32) == v);
            (min, max) = (min.min(corner.into()), max.max(corner.into()));
        }
        let size = (max - min).max_element();
        if is_exact || !(min.abs().max(max.abs()).max_element() > FAR * size) || size <= 0.0 {
            return DVec3::ZERO;
        }
        // A round number, so that differences from it are hardly rounded.
        let step = 2.0_f64.powi(size.log2().floor() as i32);
        ((min + max) * (0.5 / step)).round() * step
    }

    /// One of them as counted from an origin.
    pub(in crate::model) fn from(&self, origin: DVec3, index: u32) -> [f32; 3] {
        match self {
            Self::Narrow(list) if origin == DVec3::ZERO => list[index as usize],
            _ => (self.at(index) - origin).as_vec3().to_array(),
        }
    }
}

/// Whether coordinates can be those of a corner.
pub(in crate::model) fn is_place(point: DVec3) -> bool {
    // Also false for NaN, which the largest of several numbers may hide.
    point.abs().cmple(DVec3::splat(LARGEST)).all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_corners_are_counted_from_a_point_among_them() {
        let corners: Vec<[f64; 3]> =
            (0..50).map(|i| [408_201.58 + f64::from(i) * 0.01, 4_080_928.02, f64::from(i % 7)]).collect();
        let positions = Positions::Wide(corners.clone());
        let origin = positions.origin(0..50);
        for (index, corner) in (0..).zip(&corners) {
            let kept = DVec3::from(positions.from(origin, index).map(f64::from)) + origin;
            assert!((kept - DVec3::from(*corner)).length() < 1e-6);
        }
        assert_ne!(origin, DVec3::ZERO);
    }

    #[test]
    fn what_is_no_number_is_no_place() {
        for bad in [f64::NAN, f64::INFINITY, -1e39] {
            for point in [[bad, 0.0, 0.0], [0.0, bad, 0.0], [0.0, 0.0, bad]] {
                assert!(!is_place(point.into()), "{point:?}");
            }
        }
        assert!(is_place(DVec3::new(-1e38, 0.0, 5.0)));
    }

    #[test]
    fn near_corners_and_those_of_single_precision_stay_as_they_are() {
        let near = Positions::Wide(vec![[0.1, 0.2, 0.3], [1.1, 1.2, 1.3]]);
        assert_eq!((near.origin(0..2), near.from(DVec3::ZERO, 0)), (DVec3::ZERO, [0.1, 0.2, 0.3]));
        assert_eq!(Positions::Wide(vec![[1e6, 0.0, 0.0], [1e6 + 1.0, 0.0, 0.0]]).origin(0..2), DVec3::ZERO);
        assert_eq!(Positions::Wide(vec![[1e6 + 0.1; 3]; 2]).origin(0..2), DVec3::ZERO);
        assert_eq!(Positions::Wide(Vec::new()).origin(0..0), DVec3::ZERO);
        // Only what is used counts.
        let beside = Positions::Wide(vec![[1e6 + 0.1; 3], [1e6 + 0.3; 3], [0.0; 3]]);
        assert_ne!(beside.origin(0..2), DVec3::ZERO);
        assert_eq!(beside.origin(0..3), DVec3::ZERO);
    }
}
