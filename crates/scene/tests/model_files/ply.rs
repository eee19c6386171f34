//! PLY files, most of them with something that one program or another writes.

use catoptra_core::{TextureId, TriangleMesh, srgb_decoded};
use catoptra_scene::image::write_png;
use catoptra_scene::model::{read, read_mesh_bytes};

use crate::{CORNERS, Case, ROOF, area, assert_all_are_the_roof, mesh, model, shape, triangles_of, warnings};

const XYZ: &str = "property float x\nproperty float y\nproperty float z\n";
const LIST: &str = "property list uchar int vertex_indices\n";
const ROWS: &str = "0 0 0\n3 0 0\n3 0 2\n0 0 2\n0 1 1\n3 1 1\n";
const FACES: &str = "4 0 1 2 3\n3 0 3 4\n3 1 5 2\n4 3 2 5 4\n4 0 4 5 1\n";

fn ascii(header: &str, rows: &str) -> Vec<u8> {
    format!("ply\nformat ascii 1.0\n{header}end_header\n{rows}").into_bytes()
}

fn plain() -> String {
    format!("element vertex 6\n{XYZ}element face 5\n{LIST}")
}

fn case(what: &'static str, bytes: Vec<u8>, warnings: &'static [&'static str]) -> Case {
    Case { what, bytes, warnings }
}

/// Numbers of a binary body.
#[derive(Clone, Copy)]
enum Item {
    F(f32),
    D(f64),
    I(i32),
    L(i64),
    B(u8),
}

fn binary(big: bool, header: &str, items: &[Item]) -> Vec<u8> {
    let format = if big { "binary_big_endian" } else { "binary_little_endian" };
    let mut out = format!("ply\nformat {format} 1.0\n{header}end_header\n").into_bytes();
    for item in items {
        let mut bytes = match *item {
            Item::F(v) => v.to_le_bytes().to_vec(),
            Item::D(v) => v.to_le_bytes().to_vec(),
            Item::I(v) => v.to_le_bytes().to_vec(),
            Item::L(v) => v.to_le_bytes().to_vec(),
            Item::B(v) => vec![v],
        };
        if big {
            bytes.reverse();
        }
        out.append(&mut bytes);
    }
    out
}

fn places() -> Vec<Item> {
    CORNERS.iter().flatten().map(|&v| Item::F(v as f32)).collect()
}

fn strip(corners: &[i32]) -> Vec<Item> {
    [&[Item::I(corners.len() as i32)][..], &corners.iter().map(|&i| Item::I(i)).collect::<Vec<_>>()].concat()
}

#[test]
#[allow(clippy::too_many_lines, reason = "a table")]
fn the_roof_is_read_whoever_wrote_it() {
    let header = plain();
    let text = format!("{ROWS}{FACES}");
    let strips =
        format!("element vertex 6\n{XYZ}element tristrips 1\nproperty list int int vertex_indices\n");
    // The roof in two strips, the second of which begins with the other winding, and one without area.
    let corners = [2, 5, 3, 4, 0, 5, -1, 0, 5, 1, 2, 0, 3, -1, 2, 2, 2];
    let whole: Vec<Item> =
        ROOF.iter().flat_map(|t| [&[Item::B(3)][..], &t.map(|i| Item::L(i as i64))].concat()).collect();
    let long = header.replace("uchar int", "uchar int64").replace("face 5", "face 8");
    let nowhere = header
        .replace("vertex 6", "vertex 7")
        .replace("uchar int", "uchar int64")
        .replace("face 5", "face 8");
    let double =
        header.replace("float", "double").replace("uchar int", "uchar int64").replace("face 5", "face 8");
    let doubles: Vec<Item> = CORNERS.iter().flatten().map(|&v| Item::D(v)).collect();
    let cr = String::from_utf8(ascii(&header, &text)).unwrap().replace('\n', "\r").into_bytes();
    let crlf = String::from_utf8(ascii(&header, &text)).unwrap().replace('\n', "\r\n").into_bytes();
    let quality = header.replace("float z\n", "float z\nproperty float quality\nproperty float quality\n");
    let swapped = format!("element face 5\n{LIST}element vertex 6\n{XYZ}");
    let cases = vec![
        case("a plain file", ascii(&header, &text), &[]),
        case("CR alone", cr, &[]),
        case("CR LF", crlf, &[]),
        case("a byte order mark", [b"\xef\xbb\xbf", &ascii(&header, &text)[..]].concat(), &[]),
        case("strips", binary(false, &strips, &[places(), strip(&corners)].concat()), &[]),
        case(
            "strips before vertices",
            {
                let (head, tail) = strips.split_once("element tristrips").unwrap();
                binary(true, &format!("element tristrips{tail}{head}"), &[strip(&corners), places()].concat())
            },
            &[],
        ),
        case(
            "rows over two lines",
            ascii(&header, &format!("{}{FACES}", ROWS.replace("0 1 1", "0\n1 1"))),
            &[],
        ),
        case("all on one line", ascii(&header, &text.replace('\n', " ")), &[]),
        case("faces before vertices", ascii(&swapped, &format!("{FACES}{ROWS}")), &[]),
        case(
            "a face without corners",
            ascii(&header.replace("face 5", "face 7"), &format!("{ROWS}0\n{FACES}2 0 1\n")),
            &["fewer than three"],
        ),
        case(
            "numbers that nobody announced",
            ascii(&header, &format!("{ROWS}{}", FACES.replace("3 1 5 2", "3 1 5 2 255 0 0 255"))),
            &["does not announce"],
        ),
        case(
            "a property that comes twice",
            ascii(&quality, &format!("{}{FACES}", ROWS.replace('\n', " 1 nan\n"))),
            &[],
        ),
        case(
            "words where nobody looks",
            ascii(&quality, &format!("{}{FACES}", ROWS.replace('\n', " none -\n"))),
            &[],
        ),
        case(
            "free text",
            ascii(&format!("Made with a tool 2.4\n{header}"), &text),
            &["\"Made with a tool 2.4\" is no line"],
        ),
        case(
            "an unused vertex that is none",
            ascii(&header.replace("vertex 6", "vertex 7"), &format!("{ROWS}nan nan nan\n{FACES}")),
            &[],
        ),
        case("long indices", binary(true, &long, &[places(), whole.clone()].concat()), &[]),
        case(
            "an unused vertex that is none, in bytes",
            {
                binary(
                    false,
                    &nowhere,
                    &[places(), vec![Item::F(f32::NAN), Item::F(0.0), Item::F(f32::INFINITY)], whole.clone()]
                        .concat(),
                )
            },
            &[],
        ),
        case("double precision", binary(false, &double, &[doubles, whole].concat()), &[]),
        case(
            "an element without properties",
            ascii(&format!("element nothing 1000000000000\n{header}"), &text),
            &[],
        ),
        case(
            "elements that nobody knows",
            ascii(
                &header.replace(
                    "element face",
                    "element edge 1\nproperty list uchar int ends\nproperty float w\nelement face",
                ),
                &format!("{ROWS}2 0 1 0.5\n{FACES}"),
            ),
            &[],
        ),
        case(
            "another word for corners",
            ascii(&header.replace("vertex_indices", "vertex_index"), &text),
            &[],
        ),
    ];
    assert_all_are_the_roof(cases, "a.ply");
}

#[test]
fn concave_faces_keep_their_outline() {
    let header = format!("element vertex 8\n{XYZ}element face 1\n{LIST}");
    let rows = "0 0 0\n3 0 0\n3 2 0\n2 2 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n8 2 3 4 5 6 7 0 1\n";
    assert!((area(&mesh(&ascii(&header, rows), "a.ply")) - 5.0).abs() < 1e-6);
}

#[test]
fn far_coordinates_keep_their_millimetres() {
    let header = format!("element vertex 3\n{}element face 1\n{LIST}", XYZ.replace("float", "double"));
    let rows = "408201.587 4080928.021 0\n408203.589 4080928.021 0\n408201.587 4080929.024 1.5\n3 0 1 2\n";
    let far = mesh(&ascii(&header, rows), "a.ply");
    let expected = [
        [408_201_587_000, 4_080_928_021_000, 0],
        [408_203_589_000, 4_080_928_021_000, 0],
        [408_201_587_000, 4_080_929_024_000, 1_500_000],
    ];
    let found = triangles_of(&far)[0];
    let off = |k: usize| (0..3).map(|i| (found[k][i] - expected[k][i]).abs()).max();
    assert!((0..3).all(|k| off(k) <= Some(1)), "{found:?}");
}

/// Three vertices, each with more than its place, and one face.
fn triangle(properties: &str, more: [&str; 3]) -> TriangleMesh {
    let [a, b, c] = more;
    let header = format!("element vertex 3\n{XYZ}{properties}element face 1\n{LIST}");
    mesh(&ascii(&header, &format!("0 0 0 {a}\n1 0 0 {b}\n0 1 0 {c}\n3 0 1 2\n")), "a.ply")
}

#[test]
fn vertices_have_colours_in_all_spellings() {
    let half = srgb_decoded(0.5) as f32;
    let expected = Some(vec![[1.0, 0.0, 0.0], [half; 3], [0.0, 0.0, 1.0]]);
    let bytes = ["255 0 0", "127.5 127.5 127.5", "0 0 255"];
    let shares = ["1 0 0", "0.5 0.5 0.5", "0 0 1"];
    let long = ["65535 0 0", "32767.5 32767.5 32767.5", "0 0 65535"];
    let names = |sort: &str, [r, g, b]: [&str; 3]| {
        format!("property {sort} {r}\nproperty {sort} {g}\nproperty {sort} {b}\n")
    };
    let rgb = ["red", "green", "blue"];
    for (sort, names_of, rows) in [
        ("float", rgb, shares),
        ("double", ["r", "g", "b"], shares),
        ("float", ["diffuse_red", "diffuse_green", "diffuse_blue"], bytes),
        ("float", rgb, bytes),
    ] {
        let mesh = triangle(&names(sort, names_of), rows);
        assert_eq!(mesh.colors().map(<[_]>::to_vec), expected, "{sort} {names_of:?}");
    }
    let whole = |rows: [&'static str; 3]| rows.map(|row| row.replace(".5", ""));
    for (sort, rows) in [("uchar", whole(bytes)), ("ushort", whole(long))] {
        let alpha = format!("{}property {sort} alpha\n", names(sort, rgb));
        let mesh = triangle(
            &alpha,
            [&format!("{} 9", rows[0]), &format!("{} 9", rows[1]), &format!("{} 9", rows[2])],
        );
        let colors = mesh.colors().unwrap();
        assert_eq!([colors[0], colors[2]], [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
        assert!((colors[1][0] - half).abs() < 2e-3, "{colors:?}");
    }
    assert_eq!(triangle("property uchar red\nproperty uchar blue\n", ["1 1"; 3]).colors(), None);
}

#[test]
fn coloured_meshes_wear_their_colours() {
    let header = format!(
        "element vertex 3\n{XYZ}property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n{LIST}"
    );
    let model = model(&ascii(&header, "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2\n"), "a.ply");
    let material = &model.materials[shape(&model.nodes[0]).1.index() as usize - 1].material;
    assert_eq!(model.textures[0].1.kind_name(), "vertex-color-texture");
    assert_eq!(
        material.values().get("color").and_then(catoptra_core::Value::texture).map(TextureId::index),
        Some(1)
    );
}

#[test]
fn texture_coordinates_have_many_names() {
    for [u, v] in [["u", "v"], ["s", "t"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]] {
        let mesh = triangle(&format!("property float {u}\nproperty float {v}\n"), ["0 0.25", "1 0", "nan 1"]);
        assert_eq!(mesh.uvs(), Some(&[[0.0, 0.25], [1.0, 0.0], [0.0, 0.0]][..]), "{u} {v}");
    }
}

#[test]
fn normals_that_are_none_count_as_none() {
    let names = "property float nx\nproperty float ny\nproperty float nz\n";
    let mesh = triangle(names, ["0 0 1", "nan nan nan", "0 0 1"]);
    assert_eq!(mesh.normals(), Some(&[[0.0, 0.0, 1.0], [0.0; 3], [0.0, 0.0, 1.0]][..]));
}

/// Two triangles on a square, whose faces have things of their own.
fn square(properties: &str, [a, b]: [&str; 2]) -> Vec<u8> {
    let header = format!(
        "comment TextureFile a b.png\ncomment TextureFile b.png\nelement vertex 4\n{XYZ}element face 2\n{LIST}{properties}"
    );
    ascii(&header, &format!("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 {a}\n3 0 2 3 {b}\n"))
}

#[test]
fn faces_have_texture_coordinates_and_colours_of_their_own() {
    let own = "property list uchar float texcoord\n";
    let mesh_of = |properties: &str, rows: [&str; 2]| mesh(&square(properties, rows), "a.ply");
    let found = mesh_of(own, ["6 0 0 1 0 1 1", "6 0.5 0 1 1 0 1"]);
    let uvs = |mesh: &TriangleMesh, triangle: usize| {
        mesh.triangles()[triangle].map(|corner| mesh.uvs().unwrap()[corner as usize])
    };
    assert_eq!(uvs(&found, 0), [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
    assert_eq!(uvs(&found, 1), [[0.5, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    let lacking = mesh_of(own, ["6 0 0 1 0 1 1", "0"]);
    assert_eq!(uvs(&lacking, 1), [[0.0; 2]; 3]);
    let colored =
        mesh_of("property uchar red\nproperty uchar green\nproperty uchar blue\n", ["255 0 0", "0 255 0"]);
    let colors = |triangle: usize| {
        colored.triangles()[triangle].map(|corner| colored.colors().unwrap()[corner as usize])
    };
    assert_eq!([colors(0), colors(1)], [[[1.0, 0.0, 0.0]; 3], [[0.0, 1.0, 0.0]; 3]]);
}

#[test]
fn pictures_of_meshlab_are_shown() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ply");
    let own = "property list uchar float texcoord\nproperty int texnumber\n";
    std::fs::write(&path, square(own, ["6 0 0 1 0 1 1 1", "6 0 0 1 1 0 1 0"])).unwrap();
    write_png(&folder.path().join("a b.png"), 1, 1, &[255, 0, 0]).unwrap();
    let model = read(&path).unwrap();
    assert_eq!(model.nodes.len(), 2);
    let pictures: Vec<&str> = model.textures.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(pictures, ["a b.png"]);
    assert!(warnings(&model)[0].contains("b.png is not there"));
    let painted = &model.materials[shape(&model.nodes[0]).1.index() as usize - 1];
    assert!(painted.material.is_textured());
    assert!(!model.materials[shape(&model.nodes[1]).1.index() as usize - 1].material.is_textured());
}

#[test]
fn a_few_bytes_do_not_ask_for_gigabytes() {
    let huge = 1 << 30;
    let many = |count: &str| plain().replace(count, &format!("{} {huge}", count.split_once(' ').unwrap().0));
    let list = binary(
        false,
        &format!("element vertex 6\n{XYZ}element face 1\nproperty list int int vertex_indices\n"),
        &[places(), vec![Item::I(huge), Item::I(1)]].concat(),
    );
    let strips = binary(
        false,
        &format!("element vertex 6\n{XYZ}element tristrips {huge}\nproperty list int int vertex_indices\n"),
        &places(),
    );
    for bytes in [
        ascii(&many("vertex 6"), &format!("{ROWS}{FACES}")),
        ascii(&many("face 5"), &format!("{ROWS}{FACES}")),
        ascii(&plain().replace("uchar int", "uint int"), &format!("{ROWS}{huge} 0 1 2\n")),
        binary(true, &many("vertex 6"), &places()),
        binary(false, &many("face 5"), &places()),
        binary(false, &many("vertex 6").replace("float", "double"), &places()),
        list,
        strips,
    ] {
        let error = read_mesh_bytes(&bytes, "a.ply".as_ref()).unwrap_err().to_string();
        assert!(error.contains("room for at most") || error.contains("than the rest of the file"), "{error}");
    }
}
