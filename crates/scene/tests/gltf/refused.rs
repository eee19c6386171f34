//! What contradicts itself, asks for too much or needs what is not known here.

use serde_json::{Value, json};

use crate::builder::{Builder, FLOAT, UNSIGNED_BYTE, UNSIGNED_SHORT, warnings};

/// A file that shows a triangle, changed.
fn changed(change: impl FnOnce(&mut Value)) -> Builder {
    let mut file = Builder::new();
    let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let indices = file.shorts("SCALAR", &[0, 1, 2]);
    file.mesh(json!({ "attributes": { "POSITION": positions }, "indices": indices }));
    file.push("nodes", json!({ "mesh": 0 }));
    change(&mut file.json);
    file
}

const POSITION: &str = ": meshes[0].primitives[0].attributes.POSITION: accessors[0]: ";

#[test]
#[allow(clippy::too_many_lines, reason = "a table")]
fn contradictions_are_told_by_their_path() {
    type Change = fn(&mut Value);
    let cases: Vec<(Change, String)> = vec![
        (|j| j["accessors"][0]["count"] = json!(4), format!("{POSITION}bufferViews[0]: 4 rows of 12 bytes")),
        (|j| j["accessors"][0]["byteOffset"] = json!(4), format!("{POSITION}bufferViews[0]: 3 rows of 12")),
        (|j| j["accessors"][0]["byteOffset"] = json!(u64::MAX), format!("{POSITION}bufferViews[0]: 3 rows")),
        (|j| j["accessors"][0]["type"] = json!("VEC5"), format!("{POSITION}the type \"VEC5\"")),
        (|j| j["accessors"][0]["componentType"] = json!(5124), format!("{POSITION}the componentType 5124")),
        (|j| j["accessors"][0]["bufferView"] = json!(7), format!("{POSITION}names bufferViews[7], but")),
        (|j| j["bufferViews"][0]["byteLength"] = json!(35), format!("{POSITION}bufferViews[0]: 3 rows")),
        (
            |j| j["bufferViews"][0]["byteLength"] = json!(999),
            format!("{POSITION}bufferViews[0]: 999 bytes from 0"),
        ),
        (
            |j| j["bufferViews"][0]["byteOffset"] = json!(u64::MAX),
            format!("{POSITION}bufferViews[0]: 36 bytes"),
        ),
        (|j| j["bufferViews"][0]["buffer"] = json!(1), format!("{POSITION}bufferViews[0]: names buffers[1]")),
        (
            |j| j["bufferViews"][0]["byteStride"] = json!(u64::MAX),
            format!("{POSITION}bufferViews[0]: 3 rows"),
        ),
        (
            |j| j["accessors"][0]["type"] = json!("VEC2"),
            ": meshes[0].primitives[0].attributes.POSITION: has rows of 2 numbers, 3 are needed".to_owned(),
        ),
        (
            |j| j["accessors"][1]["componentType"] = json!(FLOAT),
            ": meshes[0].primitives[0].indices: accessors[1]: bufferViews[1]: 3 rows of 4".to_owned(),
        ),
        (
            |j| j["accessors"][1]["componentType"] = json!(5122),
            ": meshes[0].primitives[0].indices: its numbers must be whole".to_owned(),
        ),
        (
            |j| j["accessors"][0]["count"] = json!(2),
            ": meshes[0].primitives[0].indices: number 2 names corner 2, of which there are 2".to_owned(),
        ),
        (
            |j| j["meshes"][0]["primitives"][0]["mode"] = json!(7),
            ": meshes[0].primitives[0]: the mode 7".to_owned(),
        ),
        (
            |j| j["meshes"][0]["primitives"][0]["material"] = json!(0),
            ": names materials[0], but the file has 0 materials".to_owned(),
        ),
        (
            |j| j["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(1),
            ": meshes[0].primitives[0].attributes.NORMAL: has rows of 1 numbers".to_owned(),
        ),
        (
            |j| j["nodes"][0]["mesh"] = json!(1),
            ": nodes[0]: names meshes[1], but the file has 1 meshes".to_owned(),
        ),
        (|j| j["nodes"][0]["children"] = json!([3]), ": nodes[0].children: names nodes[3]".to_owned()),
        (|j| j["nodes"][0]["children"] = json!([0]), ": nodes[0]: is its own ancestor".to_owned()),
        (
            |j| j["nodes"][0]["rotation"] = json!([0, 0, 0, 0]),
            ": nodes[0].rotation: must be a quaternion".to_owned(),
        ),
        (|j| j["nodes"][0]["skin"] = json!(0), String::new()),
        (|j| j["scene"] = json!(2), ": scene: names scenes[2]".to_owned()),
    ];
    for (i, (change, said)) in cases.into_iter().enumerate() {
        let file = changed(change);
        if said.is_empty() {
            file.read();
        } else {
            let refused = file.refusal();
            assert!(refused.starts_with(&said), "case {i}: {refused}");
        }
    }
}

#[test]
fn nodes_that_are_no_trees_are_refused() {
    let with = |children: &[Value], scenes: Value| {
        let mut file = Builder::with_triangle();
        for children in children {
            file.push("nodes", json!({ "children": children }));
        }
        file.json["scenes"] = scenes;
        file.refusal()
    };
    let twice = with(&[json!([2]), json!([2]), json!([])], json!([]));
    assert!(twice.contains("nodes[1].children: nodes[2] is a child of nodes[0] already"), "{twice}");
    let round = with(&[json!([]), json!([2]), json!([3]), json!([1])], json!([]));
    assert!(round.contains("nodes[1]: is its own ancestor"), "{round}");
    let child = with(&[json!([1]), json!([])], json!([{ "nodes": [0, 1] }]));
    assert!(child.contains("scenes[0].nodes: nodes[1] is a child of nodes[0] already"), "{child}");
    let again = with(&[json!([])], json!([{ "nodes": [0, 0] }]));
    assert!(again.contains("scenes[0].nodes: names nodes[0] twice"), "{again}");
}

/// A few bytes that ask for much are refused before memory is taken.
#[test]
fn what_asks_for_too_much_is_refused_at_once() {
    let billion = 1_000_000_000_u64;
    let file = changed(|j| j["accessors"][0]["count"] = json!(billion));
    assert!(file.refusal().contains("1000000000 rows of 12 bytes"));
    let file = changed(|j| {
        j["accessors"][0] = json!({ "componentType": FLOAT, "count": billion, "type": "VEC3" });
    });
    let refused = file.refusal();
    assert!(refused.contains("a count of 1000000000 without a bufferView is more"), "{refused}");
    let file = changed(|j| j["accessors"][0]["count"] = json!(u64::MAX));
    assert!(file.refusal().contains("is more than can be read"));
    // The same row over and over.
    let file = changed(|j| {
        j["bufferViews"][0]["byteStride"] = json!(0.0);
        j["accessors"][0]["count"] = json!(billion);
    });
    assert!(file.refusal().contains("rows of 12 bytes, 12 bytes apart"));
    let file = changed(|j| {
        j["accessors"][1]["sparse"] = json!({ "count": billion, "indices": { "bufferView": 1, "componentType": 5123 },
            "values": { "bufferView": 1 } });
    });
    assert!(file.refusal().contains("sparse.indices: 1000000000 rows of 2 bytes"), "{}", file.refusal());
}

/// Much of little: meshes, nodes and copies are bounded though each of them fits.
#[test]
fn what_multiplies_is_bounded() {
    // 4 MB of positions in use by thousands of different primitives.
    let mut file = Builder::new();
    let count = 300_000;
    let positions = file.floats("VEC3", &vec![0.5; 3 * count]);
    let attributes = json!({ "POSITION": positions });
    let primitives: Vec<Value> = (0..4000)
        .map(|i| {
            let view = json!({ "bufferView": 0, "componentType": UNSIGNED_BYTE, "count": count - i, "type": "SCALAR" });
            json!({ "attributes": attributes, "indices": file.push("accessors", view) })
        })
        .collect();
    file.push("meshes", json!({ "primitives": primitives }));
    file.push("nodes", json!({ "mesh": 0 }));
    let refused = file.refusal();
    assert!(refused.contains("take more memory than a file of its size may ask for"), "{refused}");

    // A thousand nodes that show a mesh of two thousand primitives.
    let mut file = Builder::with_triangle();
    let primitive = file.json["meshes"][0]["primitives"][0].clone();
    file.json["meshes"][0]["primitives"] = json!(vec![primitive; 2000]);
    for _ in 0..1000 {
        file.push("nodes", json!({ "mesh": 0 }));
    }
    let refused = file.refusal();
    assert!(refused.contains("makes more than 1048576 shapes"), "{refused}");
}

#[test]
fn what_stands_beyond_all_numbers_is_refused() {
    let with = |node: Value| {
        let mut file = Builder::with_triangle();
        let mut outer = node.clone();
        outer["children"] = json!([1]);
        let mut inner = node;
        inner["mesh"] = json!(0);
        file.push("nodes", outer);
        file.push("nodes", inner);
        file.refusal()
    };
    for node in [
        json!({ "scale": [1e30, 1e30, 1e30] }),
        json!({ "scale": [1e-30, 1e-30, 1e-30] }),
        json!({ "scale": [1e300, 1e300, 1e300] }),
        json!({ "translation": [3e38, 0, 0] }),
        json!({ "translation": [1, 0, 1e300] }),
    ] {
        let refused = with(node.clone());
        assert!(refused.contains("numbers do not go so far"), "{node}: {refused}");
    }
}

#[test]
fn sparse_places_must_grow_and_lie_within() {
    for places in [[1_u16, 1], [2, 1], [1, 3]] {
        let mut file = Builder::new();
        let positions = file.floats("VEC3", &[0.0; 9]);
        let bytes: Vec<u8> = places.iter().flat_map(|v| v.to_le_bytes()).collect();
        let (indices, values) = (file.view(&bytes), file.view(&[0; 24]));
        file.json["accessors"][positions]["sparse"] = json!({
            "count": 2, "indices": { "bufferView": indices, "componentType": UNSIGNED_SHORT },
            "values": { "bufferView": values } });
        file.mesh(json!({ "attributes": { "POSITION": positions } }));
        file.push("nodes", json!({ "mesh": 0 }));
        assert!(file.refusal().contains("its indices must grow and lie below the count of 3"), "{places:?}");
    }
}

#[test]
fn positions_in_use_must_be_finite() {
    let mut file = Builder::new();
    let positions = file.floats("VEC3", &[f32::NAN, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    let indices = file.shorts("SCALAR", &[1, 2, 3]);
    file.mesh(json!({ "attributes": { "POSITION": positions }, "indices": indices }));
    file.push("nodes", json!({ "mesh": 0 }));
    file.read();
    file.json["meshes"][0]["primitives"][0].as_object_mut().unwrap().remove("indices");
    let refused = file.refusal();
    assert!(refused.contains("attributes.POSITION: row 0 must be finite, not [NaN, 0.0, 0.0]"), "{refused}");
}

#[test]
fn skins_must_have_what_they_name() {
    let with = |joints: [u16; 4], matrices: usize, nodes: Value| {
        let mut file = Builder::new();
        let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        let joints = file.shorts("VEC4", &[joints; 3].concat());
        let weights = file.floats("VEC4", &[0.25; 12]);
        let bind = file.floats("MAT4", &vec![1.0; 16 * matrices]);
        file.mesh(
            json!({ "attributes": { "POSITION": positions, "JOINTS_0": joints, "WEIGHTS_0": weights } }),
        );
        file.push("skins", json!({ "joints": nodes, "inverseBindMatrices": bind }));
        file.push("nodes", json!({ "mesh": 0, "skin": 0 }));
        file.refusal()
    };
    let past = with([0, 1, 2, 0], 2, json!([0, 0]));
    assert!(past.contains("attributes.JOINTS_0: names joint 2, of which the skin has 2"), "{past}");
    let few = with([0; 4], 1, json!([0, 0]));
    assert!(few.contains("nodes[0]: skins[0]: has 2 joints, but 1 inverseBindMatrices"), "{few}");
    let missing = with([0; 4], 1, json!([5]));
    assert!(missing.contains("nodes[0]: skins[0].joints[0]: names nodes[5]"), "{missing}");
}

#[test]
fn extensions_that_a_file_needs_are_told_by_name() {
    let needing = |name: &str| {
        let mut file = Builder::with_node();
        file.json["extensionsUsed"] = json!([name]);
        file.json["extensionsRequired"] = json!([name]);
        file
    };
    for (name, hint) in [
        ("KHR_draco_mesh_compression", "gltf-transform copy"),
        ("EXT_meshopt_compression", "gltf-transform copy"),
        ("KHR_texture_basisu", "gltf-transform ktxdecompress"),
        ("ACME_teapots", "which is not known here"),
    ] {
        let refused = needing(name).refusal();
        assert!(refused.contains(name) && refused.contains(hint), "{refused}");
    }
    // What is only left out does not keep a file from being shown.
    let model = needing("KHR_materials_iridescence").read();
    assert_eq!(warnings(&model), ["KHR_materials_iridescence is left out: such surfaces have no rainbow"]);
    let mut file = Builder::with_node();
    file.json["extensionsUsed"] = json!(["ACME_teapots", "KHR_texture_basisu", "KHR_materials_ior"]);
    assert_eq!(warnings(&file.read()).len(), 1);
}

#[test]
fn packed_primitives_need_a_copy_that_is_not() {
    let mut file = Builder::with_node();
    file.json["meshes"][0]["primitives"][0]["extensions"] =
        json!({ "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": {} } });
    file.read();
    file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    let refused = file.refusal();
    assert!(
        refused.contains("meshes[0].primitives[0]: is packed by KHR_draco_mesh_compression"),
        "{refused}"
    );
}
