//! How do vertices with all that they have become a mesh, without those that no triangle uses?

use catoptra_core::{InvalidPart, TriangleMesh};

use super::Positions;

/// Vertices, each with all that a file says of it.
#[derive(Debug, Clone)]
pub(in crate::model) struct Vertices {
    pub(in crate::model) positions: Positions,
    pub(in crate::model) normals: Option<Vec<[f32; 3]>>,
    pub(in crate::model) uvs: Option<Vec<[f32; 2]>>,
    /// Linear Rec. 709.
    pub(in crate::model) colors: Option<Vec<[f32; 3]>>,
}

impl Vertices {
    /// Their mesh. Vertices that no triangle uses are left out, wherever they are.
    ///
    /// # Errors
    /// No triangles, or positions in use that are none.
    pub(in crate::model) fn mesh(self, mut triangles: Vec<[u32; 3]>) -> Result<TriangleMesh, InvalidPart> {
        let mut is_used = vec![false; self.positions.len()];
        for &corner in triangles.iter().flatten() {
            is_used[corner as usize] = true;
        }
        let used = || (0..).zip(&is_used).filter(|(_, is_used)| **is_used).map(|(index, _)| index);
        let origin = self.positions.origin(used());
        let positions = match self.positions {
            Positions::Narrow(list) if is_used.iter().all(|&is_used| is_used) => list,
            positions => {
                let kept = used().map(|index| positions.from(origin, index)).collect();
                let mut numbers = vec![0; is_used.len()];
                for (number, index) in (0..).zip(used()) {
                    numbers[index as usize] = number;
                }
                for corner in triangles.iter_mut().flatten() {
                    *corner = numbers[*corner as usize];
                }
                kept
            }
        };
        let normals = self.normals.map(|list| kept(list, &is_used));
        let uvs = self.uvs.map(|list| kept(list, &is_used));
        let mesh = TriangleMesh::new(positions, triangles, normals, uvs)?.with_offset(origin);
        match self.colors {
            Some(colors) => mesh.with_colors(kept(colors, &is_used)),
            None => Ok(mesh),
        }
    }
}

fn kept<T>(mut list: Vec<T>, is_used: &[bool]) -> Vec<T> {
    let mut used = is_used.iter();
    list.retain(|_| used.next().copied().unwrap_or(false));
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_triangle_uses_is_left_out() {
        let vertices = |positions| Vertices {
            positions,
            normals: Some((0..4).map(|i| [0.0, 0.0, i as f32]).collect()),
            uvs: Some((0..4).map(|i| [i as f32, 0.0]).collect()),
            colors: Some((0..4).map(|i| [i as f32; 3]).collect()),
        };
        let all = [[0.0, 0.0, 0.0], [f32::NAN; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let wide = all.map(|p| p.map(f64::from)).to_vec();
        for positions in [Positions::Narrow(all.to_vec()), Positions::Wide(wide)] {
            let mesh = vertices(positions).mesh(vec![[0, 2, 3]]).unwrap();
            assert_eq!(mesh.positions(), [all[0], all[2], all[3]]);
            assert_eq!(mesh.triangles(), [[0, 1, 2]]);
            assert_eq!(mesh.normals().map(|n| n[1]), Some([0.0, 0.0, 2.0]));
            assert_eq!(mesh.uvs(), Some(&[[0.0, 0.0], [2.0, 0.0], [3.0, 0.0]][..]));
            assert_eq!(mesh.colors().map(|c| c[2]), Some([3.0; 3]));
        }
        assert!(vertices(Positions::Narrow(all.to_vec())).mesh(vec![[0, 1, 2]]).is_err());
    }
}
