//! Even triangles on a ball.

use std::collections::HashMap;

use catoptra_core::glam::DVec3;

/// Corners, and three corner numbers for each triangle.
pub type Triangles = (Vec<[f32; 3]>, Vec<[u32; 3]>);

/// The triangles of an icosahedron on the unit ball, each cut into four `levels` times: `20 * 4^levels` of them, a closed surface
/// seen anticlockwise from outside. Six levels make 81,920.
#[must_use]
pub fn icosphere(levels: u32) -> Triangles {
    let (mut corners, mut triangles) = icosahedron();
    for _ in 0..levels {
        let mut middles = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                corners.push((corners[a as usize] + corners[b as usize]).normalize());
                corners.len() as u32 - 1
            })
        };
        let quarters = |&[a, b, c]: &[u32; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.iter().flat_map(quarters).collect();
    }
    (corners.iter().map(|corner| corner.as_vec3().to_array()).collect(), triangles)
}

/// Corners at distance 1, and the faces.
fn icosahedron() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let signs = [[-1.0, golden], [1.0, golden], [-1.0, -golden], [1.0, -golden]];
    let turned: [fn(f64, f64) -> DVec3; 3] =
        [|a, b| DVec3::new(a, b, 0.0), |a, b| DVec3::new(0.0, a, b), |a, b| DVec3::new(b, 0.0, a)];
    let corners = turned.iter().flat_map(|turn| signs.map(|[a, b]| turn(a, b).normalize())).collect();
    let faces = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    (corners, faces)
}

#[cfg(test)]
mod tests {
    use catoptra_core::TriangleMesh;

    use super::*;

    #[test]
    fn it_is_closed_and_turned_outwards() {
        for levels in 0..4 {
            let (corners, triangles) = icosphere(levels);
            assert_eq!(triangles.len(), 20 << (2 * levels));
            let mesh = TriangleMesh::new(corners, triangles, None, None).unwrap();
            assert!(mesh.open_edge().is_none(), "{levels} levels");
            for triangle in 0..mesh.triangles().len() as u32 {
                let [a, b, c] = mesh.corners(triangle);
                assert!((b - a).cross(c - a).dot(a) > 0.0, "triangle {triangle} of {levels} levels");
            }
        }
    }
}
