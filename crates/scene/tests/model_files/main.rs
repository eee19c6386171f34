//! Are model files read as they are meant, whatever program wrote them and in whatever state they are?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod materials;
mod normals;
mod obj;
mod ply;
mod stl;

use std::path::Path;

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Content, Node};
use catoptra_core::{MaterialId, Shape, TriangleMesh};
use catoptra_scene::model::{Folder, Model, read_bytes, read_mesh_bytes};

/// Corners of a roof, from 0.
const CORNERS: [[f64; 3]; 6] =
    [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 0.0, 2.0], [0.0, 0.0, 2.0], [0.0, 1.0, 1.0], [3.0, 1.0, 1.0]];

/// Its triangles.
const ROOF: [[usize; 3]; 8] =
    [[0, 1, 2], [0, 2, 3], [0, 3, 4], [1, 5, 2], [3, 2, 5], [3, 5, 4], [0, 4, 5], [0, 5, 1]];

/// Triangles in millionths, each from its lowest corner on, in order: what two meshes share that show the same.
type Triangles = Vec<[[i64; 3]; 3]>;

fn sorted(triangles: impl Iterator<Item = [DVec3; 3]>) -> Triangles {
    let mut all: Triangles = triangles
        .map(|triangle| {
            let mut corners = triangle.map(|corner| corner.to_array().map(|v| (v * 1e6).round() as i64));
            let lowest = (0..3).min_by_key(|&i| corners[i]).unwrap();
            corners.rotate_left(lowest);
            corners
        })
        .collect();
    all.sort_unstable();
    all
}

fn roof() -> Triangles {
    sorted(ROOF.iter().map(|triangle| triangle.map(|i| DVec3::from(CORNERS[i]))))
}

fn triangles_of(mesh: &TriangleMesh) -> Triangles {
    let triangles = 0..mesh.triangles().len() as u32;
    sorted(triangles.map(|triangle| mesh.corners(triangle).map(|corner| corner + mesh.offset())))
}

fn mesh(bytes: &[u8], name: &str) -> TriangleMesh {
    read_mesh_bytes(bytes, Path::new(name)).unwrap_or_else(|e| panic!("{e}"))
}

fn model(bytes: &[u8], name: &str) -> Model {
    read_bytes(bytes, Path::new(name), &Folder::none()).unwrap_or_else(|e| panic!("{e}"))
}

fn shape(node: &Node) -> (&TriangleMesh, MaterialId) {
    match &node.content {
        Content::Shape(Shape::Mesh(mesh), material) => (mesh.triangles(), *material),
        other => panic!("no mesh: {other:?}"),
    }
}

fn warnings(model: &Model) -> Vec<&str> {
    model.warnings.iter().map(|warning| warning.message.as_str()).collect()
}

/// A file, and what it is warned of.
struct Case {
    what: &'static str,
    bytes: Vec<u8>,
    warnings: &'static [&'static str],
}

fn assert_all_are_the_roof(cases: Vec<Case>, name: &str) {
    let mut wrong = Vec::new();
    for Case { what, bytes, warnings: expected } in cases {
        match read_bytes(&bytes, Path::new(name), &Folder::none()) {
            Err(e) => wrong.push(format!("{what}: {e}")),
            Ok(model) => {
                let told = warnings(&model);
                if told.len() != expected.len()
                    || told.iter().zip(expected).any(|(told, part)| !told.contains(part))
                {
                    wrong.push(format!("{what}: expected to be told {expected:?}, not {told:?}"));
                }
                if triangles_of(&mesh(&bytes, name)) != roof() {
                    wrong.push(format!("{what}: these are other triangles"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The area of a mesh.
fn area(mesh: &TriangleMesh) -> f64 {
    let area = |i| {
        let [a, b, c] = mesh.corners(i);
        (b - a).cross(c - a).length() / 2.0
    };
    (0..mesh.triangles().len() as u32).map(area).sum()
}
