//! Which normals do corners have that share faces smoothly, in a file that gives none?
//!
//! The mean of the faces' normals, each weighted by the angle that the face has at the corner, so that it does not matter how
//! faces are cut (G. Thürmer and C. Wüthrich, "Computing vertex normals from polygonal facets", Journal of Graphics Tools 3(1),
//! 1998).

use std::collections::HashMap;

use catoptra_core::glam::DVec3;

use super::normal_of;

/// Sums of normals, by corner and by the group of faces that are smooth among each other.
#[derive(Debug, Default)]
pub(in crate::model) struct Smoothing {
    rows: HashMap<[u32; 2], u32, foldhash::fast::RandomState>,
    sums: Vec<DVec3>,
}

impl Smoothing {
    /// Adds a face of a group: the numbers of its corners and where they are.
    pub(in crate::model) fn add(&mut self, corners: &[u32], outline: &[DVec3], group: u32) {
        let normal = normal_of(outline);
        let count = outline.len();
        for (i, &corner) in corners.iter().enumerate() {
            let [before, after] =
                [i + count - 1, i + 1].map(|k| (outline[k % count] - outline[i]).normalize_or_zero());
            let angle = before.angle_between(after);
            let row = self.row(corner, group);
            if angle.is_finite() {
                self.sums[row as usize] += normal * angle;
            }
        }
    }

    /// Which of the [`normals`](Self::normals) a corner has in a group, if a face of the group has it.
    pub(in crate::model) fn find(&self, corner: u32, group: u32) -> Option<u32> {
        self.rows.get(&[corner, group]).copied()
    }

    fn row(&mut self, corner: u32, group: u32) -> u32 {
        let next = self.sums.len() as u32;
        let row = *self.rows.entry([corner, group]).or_insert(next);
        if row == next {
            self.sums.push(DVec3::ZERO);
        }
        row
    }

    /// Of unit length, or zero where faces cancel out.
    pub(in crate::model) fn normals(&self) -> impl Iterator<Item = [f32; 3]> {
        self.sums.iter().map(|sum| sum.normalize_or_zero().as_vec3().to_array())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corner_of_a_box_looks_along_its_diagonal_however_its_faces_are_cut() {
        let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
        let mut smoothing = Smoothing::default();
        smoothing.add(&[0, 1, 2, 3], &[DVec3::ZERO, y, x + y, x], 1);
        smoothing.add(&[0, 4, 5], &[DVec3::ZERO, z, y + z], 1);
        smoothing.add(&[0, 5, 1], &[DVec3::ZERO, y + z, y], 1);
        smoothing.add(&[0, 3, 4], &[DVec3::ZERO, x * 9.0, z], 1);
        smoothing.add(&[0, 3, 4], &[DVec3::ZERO, x, z], 2);
        let row = smoothing.find(0, 1).unwrap() as usize;
        let normals: Vec<[f32; 3]> = smoothing.normals().collect();
        let normal = DVec3::from(normals[row].map(f64::from));
        assert!((normal - DVec3::splat(-1.0 / 3.0_f64.sqrt())).length() < 1e-6, "{normal}");
        let alone = smoothing.find(3, 2).unwrap() as usize;
        assert_eq!(normals[alone], [0.0, -1.0, 0.0]);
    }

    #[test]
    fn faces_that_cancel_out_or_have_no_area_give_no_direction() {
        let mut smoothing = Smoothing::default();
        let outline = [DVec3::ZERO, DVec3::X, DVec3::Y];
        smoothing.add(&[0, 1, 2], &outline, 1);
        smoothing.add(&[0, 2, 1], &[outline[0], outline[2], outline[1]], 1);
        smoothing.add(&[3, 4, 5], &[DVec3::ONE; 3], 1);
        assert!(smoothing.normals().all(|normal| normal == [0.0; 3]));
    }
}
