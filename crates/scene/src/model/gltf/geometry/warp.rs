//! What becomes of a mesh under a matrix that no placement can be: stretched, sheared or mirrored?

use catoptra_core::TriangleMesh;
use catoptra_core::glam::{DMat3, DVec3};

use crate::model::gltf::refusal::Refusal;

/// The matrix that carries normals along with what they stand on: the inverse's transpose, times the size of the determinant.
/// Of a flattening matrix it gives the normal of the plane.
pub(crate) fn cofactors(m: DMat3) -> DMat3 {
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
    let all = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if m.determinant() < 0.0 { all * -1.0 } else { all }
}

/// A warped copy. What was outside stays outside: mirrored triangles run the other way.
///
/// # Errors
/// Coordinates that overflow.
pub(crate) fn warped(mesh: &TriangleMesh, by: DMat3) -> Result<TriangleMesh, Refusal> {
    let wide = |v: &[f32; 3]| DVec3::from(v.map(f64::from));
    let narrow = |v: DVec3| v.as_vec3().to_array();
    let positions = mesh.positions().iter().map(|p| narrow(by * wide(p))).collect();
    let turn = cofactors(by);
    let normals = mesh
        .normals()
        .map(|normals| normals.iter().map(|n| narrow((turn * wide(n)).normalize_or_zero())).collect());
    let mut triangles = mesh.triangles().to_vec();
    if by.determinant() < 0.0 {
        triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    let uvs = mesh.uvs().map(<[_]>::to_vec);
    let copy = TriangleMesh::new(positions, triangles, normals, uvs)
        .map(|copy| copy.with_offset(by * mesh.offset()));
    let copy = copy.and_then(|copy| match mesh.colors() {
        Some(colors) => copy.with_colors(colors.to_vec()),
        None => Ok(copy),
    });
    Ok(copy?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_stay_at_right_angles_and_outside() {
        let m = DMat3::from_cols(
            DVec3::new(2.0, 0.0, 0.1),
            DVec3::new(0.3, 0.5, 0.0),
            DVec3::new(0.0, -0.2, -3.0),
        );
        assert!(m.determinant() < 0.0);
        let (a, b) = (DVec3::new(1.0, 2.0, 0.0), DVec3::new(0.0, 1.0, -1.0));
        let outside = a.cross(b);
        let normal = cofactors(m) * outside;
        assert!(normal.dot(m * a).abs() < 1e-12 && normal.dot(m * b).abs() < 1e-12);
        assert!(normal.dot(m * outside) > 0.0);
    }
}
