//! OBJ files, most of them with something that one program or another writes.

use std::fmt::Write;

use catoptra_core::TextureId;
use catoptra_core::glam::DVec3;

use crate::{Case, area, assert_all_are_the_roof, mesh, model, shape, triangles_of, warnings};

const V: &str = "v 0 0 0\nv 3 0 0\nv 3 0 2\nv 0 0 2\nv 0 1 1\nv 3 1 1\n";
const F: &str = "f 1 2 3 4\nf 1 4 5\nf 2 6 3\nf 4 3 6 5\nf 1 5 6 2\n";

fn case(what: &'static str, text: impl AsRef<[u8]>, warnings: &'static [&'static str]) -> Case {
    Case { what, bytes: text.as_ref().to_vec(), warnings }
}

#[test]
#[allow(clippy::too_many_lines, reason = "a table")]
fn the_roof_is_read_whoever_wrote_it() {
    let plain = format!("{V}{F}");
    let latin1 = |text: String| text.chars().map(|c| u8::try_from(c).unwrap()).collect::<Vec<u8>>();
    let wide: Vec<u8> = format!("\u{feff}{plain}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    let normals = "vn 0 -1 0\nvn nan nan nan\nvn 0 0 0\n";
    let cases = vec![
        case("a plain file", &plain, &[]),
        case("lines that go on", format!("{V}{}", F.replace("3 4\n", "\\\r\n 3 \\\n4\n")), &[]),
        case("a byte order mark", format!("\u{feff}{plain}"), &[]),
        case("a mark before a comment", format!("\u{feff}# by hand\n{plain}"), &[]),
        case("sixteen bits", wide, &[]),
        case("a material in Latin-1", latin1(format!("{V}usemtl grün\n{F}")), &["grün is not described"]),
        case("a group in Latin-1", latin1(format!("{V}g dächer\n{F}")), &[]),
        case("a degree behind a face", latin1(plain.replace("f 2 6 3", "f 2 6 3 # 45°")), &[]),
        case("a comment in Latin-1", latin1(format!("# 45°\n{plain}")), &[]),
        case("CR alone", plain.replace('\n', "\r"), &[]),
        case("CR LF", plain.replace('\n', "\r\n"), &[]),
        case("control-Z at the end", format!("{plain}\x1a"), &[]),
        case("zeros at the end", format!("{plain}\0\0\0\0"), &[]),
        case("no line end at the end", plain.trim_end(), &[]),
        case("faces before vertices", format!("{F}{V}"), &[]),
        case("indices from the end", format!("{V}{}", F.replace("f 2 6 3", "f -5 -1 -4")), &[]),
        case(
            "an unused vertex that is none",
            format!("{V}v nan nan nan\nv 1e999 -nan(ind) 1.#INF\n{F}"),
            &[],
        ),
        case(
            "normals that are none",
            format!("{V}{normals}{}", F.replace("f 2 6 3", "f 2//2 6//3 3//2")),
            &[],
        ),
        case("normals 0", format!("{V}vn 0 -1 0\n{}", F.replace("f 2 6 3", "f 2//0 6//0 3")), &[]),
        case(
            "no normals",
            format!("{V}{}", F.replace("f 2 6 3", "f 2//1 6//2 3//3")),
            &["normals that are not there"],
        ),
        case(
            "no texture coordinates",
            format!("{V}{}", F.replace("f 2 6 3", "f 2/1 6/2 3/9")),
            &["coordinates that are not there"],
        ),
        case("texture coordinates 0", format!("{V}vt 0 0\n{}", F.replace("f 2 6 3", "f 2/0 6/1 3/1")), &[]),
        case(
            "texture coordinates that are none",
            format!("{V}vt nan 1\nvt 1\n{}", F.replace("f 2 6 3", "f 2/1/ 6/2/ 3/1")),
            &[],
        ),
        case("loose edges", format!("{plain}f 1 6\nf 2\nf\n"), &["fewer than three corners"]),
        case("lines and points", format!("{plain}l 1 2\np 1\n"), &["lines and points"]),
        case(
            "a curve",
            format!("{plain}cstype bspline\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\n"),
            &["free-form curves"],
        ),
        case("words of extensions", format!("vw 0 1\n{plain}vw 0 2\nxyz\n"), &["\"vw\"", "\"xyz\""]),
        case(
            "a missing library",
            format!("mtllib a b.mtl\n{plain}"),
            &["materials are missing: a ", "missing: b.mtl"],
        ),
        case(
            "colours and weights",
            format!("{V}{F}").replace("v 3 0 0", "v 3 0 0 1").replace("v 0 1 1", "v 0 1 1 1 0 0"),
            &[],
        ),
    ];
    assert_all_are_the_roof(cases, "a.obj");
}

#[test]
fn warnings_say_where_things_stand_first() {
    let model = model(format!("# a\nvw 1\n{V}{F}f 1 2\nvw 2\nf 3\n").as_bytes(), "a.obj");
    let places: Vec<String> = model.warnings.iter().map(|warning| format!("{:?}", warning.place)).collect();
    assert_eq!(places, ["Line(2)", "Line(14)"]);
}

#[test]
fn concave_faces_and_rings_keep_their_outline() {
    // A U begun at a corner from which no fan covers it.
    let u = mesh(
        b"v 0 0 0\nv 3 0 0\nv 3 2 0\nv 2 2 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 3 4 5 6 7 8 1 2",
        "a.obj",
    );
    assert!((area(&u) - 5.0).abs() < 1e-6, "{}", area(&u));
    let (mut text, count) = (String::new(), 60);
    for radius in [3.0, 1.0] {
        for i in 0..count {
            let angle = f64::from(i) / f64::from(count) * std::f64::consts::TAU;
            writeln!(text, "v {} 0 {}", radius * angle.cos(), radius * angle.sin()).unwrap();
        }
    }
    text.push('f');
    let inner = (1..=count).rev().map(|i| count + i);
    for corner in (1..=count).chain([1]).chain([count + 1]).chain(inner) {
        write!(text, " {corner}").unwrap();
    }
    let ring = mesh(text.as_bytes(), "a.obj");
    let polygon = f64::from(count) / 2.0 * (std::f64::consts::TAU / f64::from(count)).sin();
    assert!((area(&ring) - 8.0 * polygon).abs() < 1e-5, "{} is not {}", area(&ring), 8.0 * polygon);
}

#[test]
fn far_coordinates_keep_their_millimetres() {
    let far = DVec3::new(408_201.587, 4_080_928.021, 12.345);
    let corners = [[0.0, 0.0, 0.0], [2.001, 0.0, 0.0], [0.0, 1.003, 0.0], [0.0, 0.0, 1.007]]
        .map(|p| DVec3::from(p) + far);
    let mut text = String::new();
    corners.iter().for_each(|p| writeln!(text, "v {:.3} {:.3} {:.3}", p.x, p.y, p.z).unwrap());
    let read = mesh(format!("{text}o a\nf 1 3 2\nusemtl b\nf 1 2 4\nf 2 3 4\nf 1 4 3\n").as_bytes(), "a.obj");
    for triangle in 0..4 {
        for corner in read.corners(triangle).map(|corner| corner + read.offset()) {
            let off = corners.iter().map(|p| (*p - corner).length()).fold(f64::INFINITY, f64::min);
            assert!(off < 1e-6, "{corner} is off by {off}");
        }
    }
    assert!(read.offset().distance(far) < 3.0);
}

#[test]
fn objects_groups_and_materials_are_shapes_of_their_own() {
    let names = |text: &str| -> Vec<String> {
        model(text.as_bytes(), "a.obj").nodes.iter().map(|node| node.name.clone()).collect()
    };
    assert_eq!(names(&format!("{V}{F}")), ["mesh"]);
    assert_eq!(names(&format!("{V}o a b\nf 1 2 3\no c\nf 1 2 4\no a b\nf 1 2 5\n")), ["a b", "c"]);
    assert_eq!(names(&format!("{V}g a\nf 1 2 3\ng c d\nf 1 2 4\n")), ["a", "c d"]);
    // One object around groups tells nothing apart.
    assert_eq!(names(&format!("{V}o all\ng a\nf 1 2 3\ng b\nf 1 2 4\n")), ["a", "b"]);
    assert_eq!(names(&format!("{V}o all\nf 1 2 3\n")), ["all"]);
    assert_eq!(
        names(&format!("{V}o a\nusemtl x\nf 1 2 3\nusemtl y\nf 1 2 4\nusemtl x\nf 1 2 5\no b\nf 1 3 4\n")),
        ["a x", "a y", "b"]
    );
    assert_eq!(names(&format!("{V}usemtl x\nf 1 2 3\nusemtl\nf 1 2 4\n")), ["x", "mesh"]);
    assert_eq!(
        names(&format!("{V}o a x\nf 1 2 3\no a\nusemtl x\nf 1 2 4\nusemtl y\nf 1 2 5\n")),
        ["a x", "a x 2", "a y"]
    );
    let parts = model(format!("{V}o a\nusemtl x\nf 1 2 3\no b\nf 1 2 4\n").as_bytes(), "a.obj");
    assert_eq!(shape(&parts.nodes[0]).1, shape(&parts.nodes[1]).1, "one material for both");
    assert_eq!((parts.materials.len(), parts.materials[0].name.as_str()), (1, "x"));
}

#[test]
fn parts_without_end_are_one_for_each_material() {
    let mut text = V.to_owned();
    (0..20_000).for_each(|i| writeln!(text, "g {i}\nf 1 2 3").unwrap());
    let model = model(text.as_bytes(), "a.obj");
    assert_eq!((model.nodes.len(), shape(&model.nodes[0]).0.triangles().len()), (1, 20_000));
    assert!(warnings(&model)[0].contains("20000 parts"));
}

#[test]
fn a_mesh_is_all_of_the_parts() {
    let parted = mesh(format!("{V}{}", F.replace("f 2", "o x\nusemtl y\nf 2")).as_bytes(), "a.obj");
    assert_eq!(triangles_of(&parted), crate::roof());
}

#[test]
fn corners_have_colours() {
    let text = "v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\nv 0 1 0\nv 9 9 9 0 0 1\nf 1 2 3\n";
    let painted = model(text.as_bytes(), "a.obj");
    let (mesh, material) = shape(&painted.nodes[0]);
    let half = catoptra_core::srgb_decoded(0.5) as f32;
    assert_eq!(mesh.colors(), Some(&[[1.0, 0.0, 0.0], [0.0, half, 0.0], [1.0; 3]][..]));
    assert_eq!(painted.textures[0].1.kind_name(), "vertex-color-texture");
    let worn = &painted.materials[material.index() as usize - 1].material;
    assert_eq!(
        worn.values().get("color").and_then(catoptra_core::Value::texture).map(TextureId::index),
        Some(1)
    );
    // Bytes, and a weight before them.
    let bytes = model(b"v 0 0 0 1 255 0 0\nv 1 0 0 1 0 255 0\nv 0 1 0 1 0 0 255\nf 1 2 3\n", "a.obj");
    assert_eq!(shape(&bytes.nodes[0]).0.colors().map(|colors| colors[2]), Some([0.0, 0.0, 1.0]));
}

#[test]
fn a_few_bytes_do_not_ask_for_gigabytes() {
    for (text, message) in [
        ("f 1 2 1000000000\n", "vertex 1000000000, but there are 3"),
        ("f 1 2 4294967295\n", "vertex 4294967295, but there are 3"),
        ("f 1 2 4294967296\n", "vertex 4294967296, but there are 3"),
        ("f 1//4000000000 2//1000000000 3\ns 4000000000\nf 1 2 4\n", "vertex 4, but there are 3"),
    ] {
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{text}");
        let error = catoptra_scene::model::read_mesh_bytes(text.as_bytes(), "a.obj".as_ref()).unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
    }
}
