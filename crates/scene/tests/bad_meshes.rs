//! Is every bad mesh file refused with its place, and every good one read as it is?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::Path;

use catoptra_core::TriangleMesh;
use catoptra_scene::model::{ModelError, read_mesh, read_mesh_bytes};

/// The header of an ascii PLY of a triangle, and its rows.
fn ascii(header: &str, rows: &str) -> Vec<u8> {
    format!("ply\nformat ascii 1.0\n{header}end_header\n{rows}").into_bytes()
}

const XYZ: &str = "property float x\nproperty float y\nproperty float z\n";
const LIST: &str = "property list uchar int vertex_indices\n";

/// Three vertices (lines 3 to 6) and one face (lines 7 and 8); rows from line 10.
fn triangle(rows: &str) -> Vec<u8> {
    ascii(&format!("element vertex 3\n{XYZ}element face 1\n{LIST}"), rows)
}

/// The same in binary, with 3 vertices of 12 bytes and one face of 13.
fn binary(format: &str, vertices: usize, faces: usize, body: &[u8]) -> Vec<u8> {
    let header = format!(
        "ply\nformat {format} 1.0\nelement vertex {vertices}\n{XYZ}element face {faces}\n{LIST}end_header\n"
    );
    [header.as_bytes(), body].concat()
}

fn body(indices: [i32; 3], x: f32, bytes: fn(&[u8; 4]) -> [u8; 4]) -> Vec<u8> {
    let mut out = Vec::new();
    for v in [x, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        out.extend(bytes(&v.to_le_bytes()));
    }
    out.push(3);
    for i in indices {
        out.extend(bytes(&i.to_le_bytes()));
    }
    out
}

const LITTLE: fn(&[u8; 4]) -> [u8; 4] = |b| *b;
const BIG: fn(&[u8; 4]) -> [u8; 4] = |b| [b[3], b[2], b[1], b[0]];

/// A bad file and what its refusal says after the file's name.
struct Case(&'static str, Vec<u8>, &'static str);

#[allow(clippy::too_many_lines, reason = "a table")]
fn bad_plys() -> Vec<Case> {
    let le = "binary_little_endian";
    let whole = binary(le, 3, 1, &body([0, 1, 2], 0.0, LITTLE));
    let start = whole.len() - 49;
    let good_rows = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let header = |text: &str| ascii(text, good_rows);
    vec![
        Case("an empty file", vec![], ":1: the file is empty"),
        Case("no ply", b"solid x\n".to_vec(), ":1: is no PLY file"),
        Case(
            "a header that ends",
            b"ply\nformat ascii 1.0\nelement vertex 3\n".to_vec(),
            ":4: the file ends before",
        ),
        Case(
            "a header without end",
            [b"ply\n".to_vec(), b"comment x\n".repeat(10_000)].concat(),
            "end_header",
        ),
        Case(
            "an unknown format",
            b"ply\nformat utf8 1.0\nend_header\n".to_vec(),
            ":2: unknown format \"utf8\"",
        ),
        Case(
            "a wrong version",
            b"ply\nformat ascii 2.0\nend_header\n".to_vec(),
            ":2: \"format ascii 2.0\" must be",
        ),
        Case("no format", b"ply\nelement vertex 1\nend_header\n".to_vec(), "lacks its \"format\""),
        Case("no vertices", header(&format!("element face 1\n{LIST}")), "no element vertex"),
        Case("no face element", header(&format!("element vertex 3\n{XYZ}")), "no element face"),
        Case(
            "no z",
            header(&format!("element vertex 3\nproperty float x\nproperty float y\nelement face 1\n{LIST}")),
            ":3: the vertices lack",
        ),
        Case(
            "no list",
            header(&format!("element vertex 3\n{XYZ}element face 1\nproperty int a\n")),
            ":7: the faces lack",
        ),
        Case(
            "an unknown type",
            header("element vertex 3\nproperty real x\n"),
            ":4: unknown number type \"real\"",
        ),
        Case(
            "a float count",
            header(&format!(
                "element vertex 3\n{XYZ}element face 1\nproperty list float int vertex_indices\n"
            )),
            ":8: the count of a list",
        ),
        Case(
            "a twice named property",
            header(&format!("element vertex 3\nproperty float x\n{XYZ}element face 1\n{LIST}")),
            ":5: property x is announced twice",
        ),
        Case(
            "a twice named element",
            header(&format!("element vertex 3\n{XYZ}element vertex 3\n")),
            ":7: element vertex is announced twice",
        ),
        Case(
            "a negative count",
            header("element vertex -3\n"),
            ":3: element vertex needs a count of at least 0, not \"-3\"",
        ),
        Case(
            "a count beyond numbers",
            header("element vertex 99999999999999999999999\n"),
            ":3: element vertex needs a count",
        ),
        Case("a property of nothing", header("property float x\n"), ":3: a property stands before"),
        Case(
            "a huge count",
            header(&format!("element vertex 1000000000\n{XYZ}element face 1\n{LIST}")),
            ":3: the header announces 1000000000 rows of vertex, the file has room for at most",
        ),
        Case("no number", triangle("0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n"), ":11: \"zero\" is no number"),
        Case(
            "not a number",
            triangle("0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"),
            ":11: coordinates must be finite numbers",
        ),
        Case(
            "an infinite number",
            triangle("0 0 0\n1 0 1e99\n0 1 0\n3 0 1 2\n"),
            ":11: coordinates must be finite",
        ),
        Case("too few numbers", triangle("0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), ":11: the row has too few numbers"),
        Case(
            "an index out of range",
            triangle("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
            ":13: a face refers to vertex 3, but there are 3",
        ),
        Case(
            "a negative index",
            triangle("0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"),
            ":13: a face refers to vertex -1",
        ),
        Case("half an index", triangle("0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n"), ":13: 1.5 is no whole number"),
        Case("a long list", triangle("0 0 0\n1 0 0\n0 1 0\n250 0 1 2\n"), ":13: a list announces 250 items"),
        Case("no corners at all", triangle("0 0 0\n1 0 0\n0 1 0\n0\n"), ": holds no faces"),
        Case("rows that end", triangle("0 0 0\n1 0 0\n\n\n0 1 0\n\n"), ":16: the file ends before"),
        Case(
            "no faces",
            ascii(&format!("element vertex 1\n{XYZ}element face 0\n{LIST}"), "0 0 0\n"),
            ": holds no faces",
        ),
        Case("a cut binary", whole[..whole.len() - 1].to_vec(), "byte 206: a list announces 3 items"),
        Case("a binary without its faces", whole[..start + 36].to_vec(), "room for at most 0"),
        Case(
            "a binary nan",
            binary(le, 3, 1, &body([0, 1, 2], f32::NAN, LITTLE)),
            ", byte 169: coordinates must be finite",
        ),
        Case(
            "a binary index out of range",
            binary(le, 3, 1, &body([0, 1, 9], 0.0, LITTLE)),
            ", byte 205: a face refers to vertex 9",
        ),
        Case(
            "a big-endian index out of range",
            binary("binary_big_endian", 3, 1, &body([0, -1, 2], 0.0, BIG)),
            "refers to vertex -1",
        ),
        Case(
            "a binary huge count",
            binary(le, 1 << 60, 1, &body([0, 1, 2], 0.0, LITTLE)),
            ":3: the header announces 1152921504606846976",
        ),
        Case(
            "a binary of many faces",
            binary(le, 3, 1 << 40, &body([0, 1, 2], 0.0, LITTLE)),
            ":7: the header announces 1099511627776",
        ),
    ]
}

fn bad_objs() -> Vec<Case> {
    let obj = |text: &str| text.as_bytes().to_vec();
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    vec![
        Case("an empty file", obj(""), ": the file is empty"),
        Case("no faces", obj(three), ": holds no faces"),
        Case("a foreign file", obj("ply\nformat ascii 1.0\n"), ":3: the file ends before \"end_header\""),
        Case(
            "curves alone",
            obj(&format!("{three}cstype bspline\nend\n")),
            "free-form curves and surfaces are not drawn",
        ),
        Case("no number", obj("v 0 0 0\nv 1 x 0\n"), ":2: \"x\" is no number"),
        Case("a decimal comma", obj("v 0 0 0\nv 1,5 0 0\n"), ":2: \"1,5\" is no number: write a point"),
        Case(
            "not a number",
            obj(&format!("v 9 9 9\n\n{three}v 0 nan 0\nf 2 3 5\n")),
            ":6: coordinates must be finite numbers",
        ),
        Case(
            "beyond all numbers",
            obj(&format!("{three}v 0 1e39 0\nf 2 3 4\n")),
            ":4: coordinates must be finite",
        ),
        Case("too few numbers", obj("v 0 0\n"), ":1: the line has 2 numbers where 3 are needed"),
        Case(
            "an index out of range",
            obj(&format!("{three}f 1 2 4\n")),
            ":4: a face refers to vertex 4, but there are 3",
        ),
        Case("index 0", obj(&format!("{three}f 0 1 2\n")), ":4: a face refers to vertex 0"),
        Case("a far negative index", obj(&format!("{three}f -4 1 2\n")), ":4: a face refers to vertex -4"),
        Case(
            "a huge index",
            obj(&format!("{three}f 1 2 99999999999999999999\n")),
            ":4: \"99999999999999999999\" is no index",
        ),
        Case(
            "the least index",
            obj(&format!("{three}f 1 2 -9223372036854775808\n")),
            ":4: a face refers to vertex -9223372036854775808",
        ),
        Case("a word as index", obj(&format!("{three}f 1 2 c\n")), ":4: \"c\" is no index of a vertex"),
        Case(
            "a corner of four",
            obj(&format!("{three}vt 0 0\nvn 0 0 1\nf 1/1/1/1 2 3\n")),
            ":6: the corner \"1/1/1/1\" has more",
        ),
        Case("two corners", obj(&format!("{three}f 1 2\n")), ": holds no faces"),
        Case("bytes that are no text", b"v 0 0 0\nv \xff 0 0\n".to_vec(), ":2: \"ÿ\" is no number"),
    ]
}

#[test]
fn every_bad_mesh_is_refused_with_its_place() {
    let mut wrong = Vec::new();
    for (name, cases) in [("bad.ply", bad_plys()), ("bad.obj", bad_objs())] {
        for Case(what, bytes, message) in cases {
            match read_mesh_bytes(&bytes, Path::new(name)) {
                Ok(_) => wrong.push(format!("{what} ({name}) was read")),
                Err(e) if e.to_string().starts_with(name) && e.to_string().contains(message) => {}
                Err(e) => wrong.push(format!("{what} ({name}): expected {message:?}, got {e}")),
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn good(bytes: &[u8], name: &str) -> TriangleMesh {
    read_mesh_bytes(bytes, Path::new(name)).unwrap_or_else(|e: ModelError| panic!("{e}"))
}

#[test]
fn ascii_and_both_byte_orders_give_the_same_mesh() {
    let text = good(&triangle("0.5 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "a.ply");
    assert_eq!(text.positions(), [[0.5, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(text.triangles(), [[0, 1, 2]]);
    assert_eq!(good(&binary("binary_little_endian", 3, 1, &body([0, 1, 2], 0.5, LITTLE)), "a.ply"), text);
    assert_eq!(good(&binary("binary_big_endian", 3, 1, &body([0, 1, 2], 0.5, BIG)), "a.ply"), text);
    assert_eq!(good(b"v 0.5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", "a.OBJ"), text);
}

#[test]
fn polygons_are_cut_into_fans() {
    let rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n\n4 0 1 2 3\n";
    let mesh = good(&ascii(&format!("element vertex 4\n{XYZ}element face 1\n{LIST}"), rows), "a.ply");
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    let mesh = good(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1 # a square", "a.obj");
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn normals_and_texture_coordinates_come_along() {
    let header = format!(
        "comment made by hand\nelement vertex 3\n{XYZ}property uchar red\nproperty double nx\nproperty float ny\n\
         property float nz\nproperty float s\nproperty float t\nelement edge 1\nproperty int a\nproperty int b\n\
         element face 1\nproperty list uchar float weights\nproperty list uchar int vertex_index\n"
    );
    let rows = "0 0 0 255 0 0 1 0 0\n1 0 0 0 0 0 1 1 0\n0 1 0 7 0 0 1 0 1\n0 1\n2 0.5 0.5 3 0 1 2\n";
    let mesh = good(&ascii(&header, rows), "a.ply");
    assert_eq!(mesh.normals(), Some(&[[0.0, 0.0, 1.0]; 3][..]));
    assert_eq!(mesh.uvs(), Some(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]][..]));
}

#[test]
fn corners_with_other_normals_become_vertices_of_their_own() {
    let text = "mtllib a.mtl\r\no thing\r\nv 0 0 0\r\nv 1 0 0 1 0 0\r\nv 0 1 0\r\nv 0 0 1\r\nvn 0 0 1\r\nvn 1 0 0\r\n\
                usemtl red\r\nf 1//1 2//1 3//1\r\nf 1//2 3//2 4//2\r\n";
    let mesh = good(text.as_bytes(), "a.obj");
    assert_eq!(mesh.positions().len(), 6);
    assert_eq!(mesh.triangles(), [[0, 1, 2], [3, 4, 5]]);
    assert_eq!(mesh.normals().map(|n| n[3]), Some([1.0, 0.0, 0.0]));
    assert_eq!(mesh.uvs(), None);
    // A corner without a normal has that of its face.
    let mesh = good(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0.6 0.8\nf 1//1 2//1 3", "a.obj");
    assert_eq!(mesh.normals(), Some(&[[0.0, 0.6, 0.8], [0.0, 0.6, 0.8], [0.0, 0.0, 1.0]][..]));
}

#[test]
fn what_is_no_mesh_file_is_refused_by_its_name() {
    for name in ["/no/such.ply", "/etc/passwd", "/no/such.stl", "/"] {
        let error = read_mesh(Path::new(name)).unwrap_err();
        assert!(error.to_string().starts_with(name), "{error}");
        assert_eq!((error.line(), error.file()), (None, Path::new(name)));
    }
}
