//! STL files, binary and as text.

use std::fmt::Write;

use catoptra_core::{TriangleMesh, srgb_decoded};
use catoptra_scene::model::read_mesh_bytes;

use crate::{CORNERS, Case, ROOF, assert_all_are_the_roof, mesh, model, shape, warnings};

/// A binary file: a header, what each facet says in its last two bytes, and what follows.
fn binary(header: &[u8], said: impl Fn(usize) -> u16) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((ROOF.len() as u32).to_le_bytes());
    for (number, triangle) in ROOF.iter().enumerate() {
        bytes.extend([0xff; 12]);
        for v in triangle.iter().flat_map(|&corner| CORNERS[corner]) {
            bytes.extend((v as f32).to_le_bytes());
        }
        bytes.extend(said(number).to_le_bytes());
    }
    bytes
}

fn facets(triangles: &[[usize; 3]]) -> String {
    let mut text = String::new();
    for triangle in triangles {
        text.push_str("  facet normal 0 0 nan\n    outer loop\n");
        for [x, y, z] in triangle.map(|corner| CORNERS[corner]) {
            writeln!(text, "      vertex {x:e} {y:e} {z:e}").unwrap();
        }
        text.push_str("    endloop\n  endfacet\n");
    }
    text
}

fn case(what: &'static str, bytes: impl Into<Vec<u8>>, warnings: &'static [&'static str]) -> Case {
    Case { what, bytes: bytes.into(), warnings }
}

#[test]
fn the_roof_is_read_whoever_wrote_it() {
    let text = format!("solid roof\n{}endsolid roof\n", facets(&ROOF));
    let none = |_| 0;
    let mut uncounted = binary(b"", none);
    uncounted[80..84].fill(0);
    let cases = vec![
        case("a binary file", binary(b"by hand", none), &[]),
        case("a binary file that begins as text does", binary(b"solid facet vertex", none), &[]),
        case(
            "a binary file with something behind",
            [binary(b"solid", none), vec![7; 9]].concat(),
            &["what follows"],
        ),
        case("a binary file that was not finished", uncounted, &["announces no facets"]),
        case("text", text.clone(), &[]),
        case("text in capitals", text.to_uppercase(), &[]),
        case("text with CR alone", text.replace('\n', "\r"), &[]),
        case("text with a mark", format!("\u{feff}\n{text}"), &[]),
        case(
            "all on one line behind the name",
            text.replace('\n', " ").replace("solid roof   ", "solid roof\n"),
            &[],
        ),
        case("a name in Latin-1", [b"solid gr\xfcn\n", facets(&ROOF).as_bytes()].concat(), &[]),
        case("words of extensions", text.replace("endfacet", "endfacet\ncolor 1 0 0"), &["\"color\""]),
        case(
            "a facet of two corners",
            text.replace("endsolid", "facet outer loop vertex 0 0 0 vertex 1 0 0 endloop endfacet endsolid"),
            &["fewer than three"],
        ),
    ];
    assert_all_are_the_roof(cases, "a.stl");
}

#[test]
fn corners_in_one_place_are_one() {
    for bytes in
        [binary(b"", |_| 0), facets(&ROOF).replace("0e0", "-0e0").replacen("-0e0", "0e0", 5).into_bytes()]
    {
        let mesh = mesh(&bytes, "a.stl");
        assert_eq!((mesh.positions().len(), mesh.triangles().len(), mesh.normals()), (6, 8, None));
    }
}

#[test]
fn solids_are_shapes_with_their_names() {
    let text = format!(
        "solid first one\n{}endsolid\nsolid\n{}endsolid\nsolid empty\nendsolid\nsolid first one\n{}",
        facets(&ROOF[..2]),
        facets(&ROOF[2..3]),
        facets(&ROOF[3..])
    );
    let model = model(text.as_bytes(), "a.STL");
    let found: Vec<(&str, usize)> =
        model.nodes.iter().map(|node| (node.name.as_str(), shape(node).0.triangles().len())).collect();
    assert_eq!(found, [("first one", 2), ("mesh", 1), ("first one 2", 5)]);
    assert_eq!(warnings(&model), Vec::<&str>::new());
}

/// The colour of each triangle, which is that of all its corners.
fn colors(mesh: &TriangleMesh) -> Vec<[f32; 3]> {
    let colors = mesh.colors().unwrap();
    let of = |triangle: &[u32; 3]| {
        let all = triangle.map(|corner| colors[corner as usize]);
        assert_eq!(all, [all[0]; 3]);
        all[0]
    };
    mesh.triangles().iter().map(of).collect()
}

#[test]
fn facets_have_colours() {
    let some = |number: usize| [0x8000 | 31 << 10, 0x8000 | 31, 0, 0x7fff][number % 4];
    let (red, green, blue, white) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0; 3]);
    let viscam = mesh(&binary(b"", some), "a.stl");
    assert_eq!(colors(&viscam)[..4], [red, blue, white, white]);
    let said = |number: usize| [31, 31 << 5, 0x8000, 31 << 10][number % 4];
    let magics = mesh(&binary(b"COLOR=\x80\x00\x00\xff,MATERIAL=", said), "a.stl");
    let own = [srgb_decoded(128.0 / 255.0) as f32, 0.0, 0.0];
    assert_eq!(colors(&magics)[..4], [red, green, own, blue]);
    assert_eq!(mesh(&binary(b"", |_| 0x1234), "a.stl").colors(), None);
    let model = model(&binary(b"", some), "a.stl");
    assert_eq!(model.textures[0].1.kind_name(), "vertex-color-texture");
    assert!(model.materials[0].material.is_textured());
}

#[test]
fn bad_files_are_refused_with_their_place() {
    let whole = binary(b"", |_| 0);
    let mut nan = whole.clone();
    nan[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let facet = facets(&ROOF[..1]);
    for (bytes, message) in [
        (Vec::new(), "a.stl: the file is empty"),
        (b"short".to_vec(), "a.stl: is no STL file: a binary one has at least 84 bytes"),
        (
            whole[..whole.len() - 1].to_vec(),
            "a.stl, byte 80: the header announces 8 facets, the file has room for at most 7",
        ),
        (whole[..84].iter().map(|_| 0).collect(), "a.stl: holds no facets"),
        (nan, "a.stl, byte 134: coordinates must be finite numbers"),
        (b"solid a\nendsolid a\n".to_vec(), "a.stl: holds no facets"),
        (
            format!("solid\n{}", facet.replace("vertex 3e0 0e0 0e0", "vertex 3e0 0e0")).into_bytes(),
            "a.stl:5: a vertex needs three numbers",
        ),
        (
            format!("solid\n{}", facet.replace("vertex 3e0", "vertex x")).into_bytes(),
            "a.stl:5: \"x\" is no number",
        ),
        (
            format!("solid\n{}", facet.replace("vertex 3e0", "vertex inf")).into_bytes(),
            "a.stl:5: coordinates must be finite",
        ),
        (
            format!("solid\n{}", facet.replace("endloop", "")).into_bytes(),
            "a.stl:8: the file ends in the middle of a facet",
        ),
    ] {
        let error = read_mesh_bytes(&bytes, "a.stl".as_ref()).unwrap_err().to_string();
        assert!(error.starts_with(message), "expected {message}, got {error}");
    }
}

#[test]
fn a_few_bytes_do_not_ask_for_gigabytes() {
    for count in [u32::MAX, 1 << 30, 9] {
        let mut bytes = binary(b"", |_| 0);
        bytes[80..84].copy_from_slice(&count.to_le_bytes());
        let error = read_mesh_bytes(&bytes, "a.stl".as_ref()).unwrap_err().to_string();
        assert!(error.contains("room for at most 8"), "{error}");
    }
}
