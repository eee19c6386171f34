//! Numbers of every type and layout.

use catoptra_core::TriangleMesh;
use serde_json::{Value, json};

use crate::builder::{
    BYTE, Builder, CORNERS, FLOAT, SHORT, UNSIGNED_BYTE, UNSIGNED_INT, UNSIGNED_SHORT, only, shapes, warnings,
};

/// The mesh of a primitive.
fn mesh(mut file: Builder, primitive: Value) -> TriangleMesh {
    let mesh = file.mesh(primitive);
    file.push("nodes", json!({ "mesh": mesh }));
    only(&file.read()).clone()
}

/// Positions of a triangle whose nine numbers are kept so.
fn positions(component: u32, normalized: bool, bytes: &[u8]) -> Vec<[f32; 3]> {
    let mut file = Builder::new();
    let accessor = file.accessor("VEC3", component, 3, bytes);
    file.json["accessors"][accessor]["normalized"] = json!(normalized);
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    mesh(file, json!({ "attributes": { "POSITION": accessor } })).positions().to_vec()
}

#[test]
fn numbers_of_every_type_are_read_as_the_specification_says() {
    let flat = |rows: Vec<[f32; 3]>| rows.into_flattened();
    let signed = [0, 127, -127, -128, 1, -1, 64, 0, 5_i8];
    let bytes = signed.map(|v| v as u8);
    assert_eq!(flat(positions(BYTE, false, &bytes)), signed.map(f32::from));
    let share = flat(positions(BYTE, true, &bytes));
    assert_eq!(share[..5], [0.0, 1.0, -1.0, -1.0, 1.0 / 127.0]);
    let unsigned = [0, 255, 51, 1, 2, 3, 4, 5, 6_u8];
    assert_eq!(flat(positions(UNSIGNED_BYTE, false, &unsigned)), unsigned.map(f32::from));
    assert_eq!(flat(positions(UNSIGNED_BYTE, true, &unsigned))[..3], [0.0, 1.0, 0.2]);
    let shorts = [0, 32767, -32768, 1, 2, 3, 4, 5, 6_i16];
    let bytes: Vec<u8> = shorts.iter().flat_map(|v| v.to_le_bytes()).collect();
    assert_eq!(flat(positions(SHORT, false, &bytes)), shorts.map(f32::from));
    assert_eq!(flat(positions(SHORT, true, &bytes))[..3], [0.0, 1.0, -1.0]);
    let words = [0, 65535, 13107, 1, 2, 3, 4, 5, 6_u16];
    let bytes: Vec<u8> = words.iter().flat_map(|v| v.to_le_bytes()).collect();
    assert_eq!(flat(positions(UNSIGNED_SHORT, false, &bytes)), words.map(f32::from));
    assert_eq!(flat(positions(UNSIGNED_SHORT, true, &bytes))[..3], [0.0, 1.0, 0.2]);
}

#[test]
fn rows_may_lie_apart() {
    let mut file = Builder::new();
    // A position and texture coordinates of 16 bits in each row.
    let mut bytes = Vec::new();
    for (corner, uv) in CORNERS.iter().zip([[0_u16, 65535], [65535, 0], [0, 0]]) {
        bytes.extend(corner.iter().flat_map(|v| v.to_le_bytes()));
        bytes.extend(uv.iter().flat_map(|v| v.to_le_bytes()));
    }
    let view = file.view(&bytes);
    file.json["bufferViews"][view]["byteStride"] = json!(16);
    let mut accessor = |offset: usize, kind: &str, component: u32| {
        file.push(
            "accessors",
            json!({ "bufferView": view, "byteOffset": offset, "componentType": component, "count": 3.0,
                    "type": kind, "normalized": component == UNSIGNED_SHORT }),
        )
    };
    let (positions, uvs) = (accessor(0, "VEC3", FLOAT), accessor(12, "VEC2", UNSIGNED_SHORT));
    let mesh = mesh(file, json!({ "attributes": { "POSITION": positions, "TEXCOORD_0": uvs } }));
    assert_eq!(mesh.positions(), CORNERS);
    // The origin of texture coordinates is the lower left here, and the upper left there.
    assert_eq!(mesh.uvs().unwrap(), [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
}

#[test]
fn sparse_rows_take_the_place_of_others_and_of_zeros() {
    let sparse = |base: bool| {
        let mut file = Builder::new();
        let accessor = if base {
            file.floats("VEC3", CORNERS.as_flattened())
        } else {
            file.push("accessors", json!({ "componentType": FLOAT, "count": 3, "type": "VEC3" }))
        };
        let places = file.view(&[1, 0, 2, 0]);
        let values: Vec<u8> =
            [5.0_f32, 6.0, 7.0, 8.0, 9.0, 10.0].iter().flat_map(|v| v.to_le_bytes()).collect();
        let values = file.view(&values);
        file.json["accessors"][accessor]["sparse"] = json!({
            "count": 2,
            "indices": { "bufferView": places, "componentType": UNSIGNED_SHORT },
            "values": { "bufferView": values },
        });
        mesh(file, json!({ "attributes": { "POSITION": accessor } })).positions().to_vec()
    };
    assert_eq!(sparse(true), [CORNERS[0], [5.0, 6.0, 7.0], [8.0, 9.0, 10.0]]);
    assert_eq!(sparse(false), [[0.0; 3], [5.0, 6.0, 7.0], [8.0, 9.0, 10.0]]);
}

/// A strip of four corners, a square in the plane z = 0.
const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];

#[test]
fn strips_fans_and_lists_face_the_same_way() {
    let with = |mode: u32, indices: &[u8]| {
        let mut file = Builder::new();
        let positions = file.floats("VEC3", SQUARE.as_flattened());
        let indices = file.accessor("SCALAR", UNSIGNED_BYTE, indices.len(), indices);
        let mesh =
            file.mesh(json!({ "attributes": { "POSITION": positions }, "indices": indices, "mode": mode }));
        file.push("nodes", json!({ "mesh": mesh }));
        let model = file.read();
        let shapes = shapes(&model);
        let count = shapes[0].mesh.triangles().len();
        let areas: Vec<f64> = (0..count).map(|i| shapes[0].winding(i).z / 2.0).collect();
        areas
    };
    // Each covers the square once, seen from +z.
    assert_eq!(with(4, &[0, 1, 2, 2, 1, 3]), [0.5, 0.5]);
    assert_eq!(with(5, &[0, 1, 2, 3]), [0.5, 0.5]);
    assert_eq!(with(6, &[0, 1, 3, 2]), [0.5, 0.5]);
    // Corners that are left over make no triangle.
    assert_eq!(with(4, &[0, 1, 2, 2, 1]), [0.5]);
}

#[test]
fn indices_may_have_any_width() {
    for (component, bytes) in [
        (UNSIGNED_BYTE, vec![2, 0, 1]),
        (UNSIGNED_SHORT, vec![2, 0, 0, 0, 1, 0]),
        (UNSIGNED_INT, vec![2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]),
    ] {
        let mut file = Builder::new();
        let positions = file.floats("VEC3", CORNERS.as_flattened());
        let indices = file.accessor("SCALAR", component, 3, &bytes);
        let mesh = mesh(file, json!({ "attributes": { "POSITION": positions }, "indices": indices }));
        assert_eq!(mesh.triangles(), [[2, 0, 1]]);
    }
}

#[test]
fn of_shared_corners_each_primitive_keeps_its_own() {
    let mut file = Builder::new();
    let many: Vec<f32> = (0..3000).map(|i| i as f32).collect();
    let positions = file.floats("VEC3", &many);
    let normals = file.floats("VEC3", &many);
    let indices = file.shorts("SCALAR", &[900, 500, 700, 700, 500, 501]);
    let attributes = json!({ "POSITION": positions, "NORMAL": normals });
    let mesh = mesh(file, json!({ "attributes": attributes, "indices": indices }));
    assert_eq!(mesh.triangles(), [[3, 0, 2], [2, 0, 1]]);
    let row = |i: f32| [3.0 * i, 3.0 * i + 1.0, 3.0 * i + 2.0];
    assert_eq!(mesh.positions(), [row(500.0), row(501.0), row(700.0), row(900.0)]);
    assert_eq!(mesh.normals().unwrap(), mesh.positions());
}

#[test]
fn colours_and_other_texture_coordinates_come_along() {
    let mut file = Builder::new();
    let positions = file.floats("VEC3", CORNERS.as_flattened());
    let colors = file.accessor("VEC4", UNSIGNED_BYTE, 3, &[255, 0, 51, 9, 0, 0, 0, 0, 51, 51, 51, 255]);
    file.json["accessors"][colors]["normalized"] = json!(true);
    let attributes = json!({ "POSITION": positions, "COLOR_0": colors });
    let mesh = mesh(file, json!({ "attributes": attributes }));
    assert_eq!(mesh.colors().unwrap(), [[1.0, 0.0, 0.2], [0.0; 3], [0.2; 3]]);
    assert!(mesh.normals().is_none() && mesh.uvs().is_none());
}

#[test]
fn what_has_no_surface_is_left_out_with_a_warning() {
    let mut file = Builder::with_node();
    let positions = file.json["meshes"][0]["primitives"][0]["attributes"].clone();
    for mode in 0..4 {
        let mesh = file.mesh(json!({ "attributes": positions, "mode": mode, "material": 99 }));
        file.push("nodes", json!({ "mesh": mesh }));
    }
    let empty = file.mesh(json!({ "attributes": {} }));
    file.push("nodes", json!({ "mesh": empty }));
    let model = file.read();
    assert_eq!(model.nodes.len(), 1);
    let warnings = warnings(&model);
    assert_eq!(warnings.len(), 2, "each kind once: {warnings:?}");
    assert!(warnings[0].contains("points and lines") && warnings[1].contains("without positions"));
}

#[test]
fn normals_that_are_no_numbers_are_taken_for_none() {
    let mut file = Builder::new();
    let positions = file.floats("VEC3", CORNERS.as_flattened());
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0, f32::NAN, 0.0, 1.0, 0.0, f32::INFINITY, 0.0]);
    let mesh = file.mesh(json!({ "attributes": { "POSITION": positions, "NORMAL": normals } }));
    file.push("nodes", json!({ "mesh": mesh }));
    let model = file.read();
    assert_eq!(only(&model).normals().unwrap(), [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0; 3]]);
    assert!(warnings(&model)[0].contains("NORMAL"));
}
