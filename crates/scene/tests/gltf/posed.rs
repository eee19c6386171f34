//! Skins and morph targets in the pose that the file stands in.

use catoptra_core::glam::{DQuat, DVec3};
use serde_json::json;

use crate::builder::{Builder, CORNERS, only, shapes, warnings};

/// A strip of three corners on the x axis' side, carried by two joints: the first one at 0, the second at 1 0 0.
fn skinned() -> Builder {
    let mut file = Builder::new();
    let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 1.0, 0.0]);
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    let joints = file.shorts("VEC4", &[0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0]);
    // The weights of the last corner sum up to 1/2 only.
    let weights = file.floats("VEC4", &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.25, 0.25, 0.0, 0.0]);
    let attributes =
        json!({ "POSITION": positions, "NORMAL": normals, "JOINTS_0": joints, "WEIGHTS_0": weights });
    file.mesh(json!({ "attributes": attributes }));
    let one = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let mut other = one;
    other[12] = -1.0;
    let bind = file.floats("MAT4", &[one, other].concat());
    file.push("skins", json!({ "joints": [1, 2], "inverseBindMatrices": bind }));
    // The node that shows it counts for nothing; the root of the joints does.
    file.push("nodes", json!({ "name": "skin", "mesh": 0, "skin": 0, "translation": [9.0, 9.0, 9.0] }));
    file.push("nodes", json!({ "children": [2], "translation": [0.0, 5.0, 0.0] }));
    file.push("nodes", json!({ "translation": [1.0, 0.0, 0.0] }));
    file
}

#[test]
fn an_unmoved_skeleton_leaves_corners_in_its_own_space() {
    let model = skinned().read();
    let shapes = shapes(&model);
    assert_eq!((shapes.len(), &*shapes[0].node.name), (1, "skin"));
    let wanted = [DVec3::new(0.0, 5.0, 0.0), DVec3::new(2.0, 5.0, 0.0), DVec3::new(1.0, 6.0, 0.0)];
    for (found, wanted) in shapes[0].corners().into_iter().zip(wanted) {
        assert!((found - wanted).length() < 1e-6, "{found}");
    }
}

#[test]
fn joints_carry_what_they_hold() {
    let mut file = skinned();
    // A quarter turn of the second joint about the x axis' normal z, and twice the size along z.
    let turn = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
    file.json["nodes"][2]["rotation"] = json!(turn.to_array());
    file.json["nodes"][2]["scale"] = json!([1.0, 1.0, 2.0]);
    let model = file.read();
    let found = shapes(&model)[0].corners();
    // 2 0 0 lies 1 beyond the joint: carried to 1 above it. 1 1 0 by halves: where it is, and 1 0 0 + (−1, 0, 0) = 0.
    let wanted = [DVec3::new(0.0, 5.0, 0.0), DVec3::new(1.0, 6.0, 0.0), DVec3::new(0.5, 5.5, 0.0)];
    for (found, wanted) in found.into_iter().zip(wanted) {
        assert!((found - wanted).length() < 1e-6, "{found} for {wanted}");
    }
    let normals = only(&model).normals().unwrap();
    assert!(normals.iter().all(|n| (n[2] - 1.0).abs() < 1e-6), "{normals:?}");
}

#[test]
fn far_from_the_origin_corners_keep_their_digits() {
    let mut file = skinned();
    file.json["nodes"][1]["translation"] = json!([1e7, 0.0, 0.0]);
    file.json["nodes"][2]["translation"] = json!([1.001, 0.0, 0.0]);
    let model = file.read();
    let found = shapes(&model)[0].corners();
    assert!((found[1].x - found[0].x - 2.001).abs() < 1e-6, "{found:?}");
}

#[test]
fn a_mirrored_skeleton_keeps_the_outside_outside() {
    let mut file = skinned();
    file.json["nodes"][1]["scale"] = json!([-1.0, 1.0, 1.0]);
    let model = file.read();
    assert!(shapes(&model)[0].winding(0).z > 0.0);
    assert!(only(&model).normals().unwrap().iter().all(|n| (n[2] - 1.0).abs() < 1e-6));
}

#[test]
fn a_skin_without_joints_in_the_mesh_stands_where_its_node_does() {
    let mut file = skinned();
    file.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("JOINTS_0");
    let model = file.read();
    assert_eq!(shapes(&model)[0].corners()[0], DVec3::splat(9.0));
    assert!(warnings(&model)[0].contains("names no joints"));
}

#[test]
fn morph_targets_move_corners_by_their_weights() {
    let mut file = Builder::new();
    let positions = file.floats("VEC3", CORNERS.as_flattened());
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    let up = file.floats("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 4.0]);
    let aside = file.floats("VEC3", &[1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    let attributes = json!({ "POSITION": positions, "NORMAL": normals });
    let targets = json!([{ "POSITION": up }, { "POSITION": aside, "NORMAL": aside }]);
    file.push(
        "meshes",
        json!({ "primitives": [{ "attributes": attributes, "targets": targets }], "weights": [0.5, 0.0] }),
    );
    file.push("nodes", json!({ "mesh": 0 }));
    file.push("nodes", json!({ "mesh": 0, "weights": [0.0, 2.0] }));
    file.push("nodes", json!({ "mesh": 0, "weights": [0.0, 0.0] }));
    file.push("nodes", json!({ "mesh": 0, "weights": [1.0], "scale": [1.0, 1.0, -1.0] }));
    let model = file.read();
    let shapes = shapes(&model);
    let heights = |i: usize| shapes[i].corners().iter().map(|p| p.z).collect::<Vec<_>>();
    assert_eq!(heights(0), [0.5, 1.0, 2.0], "the mesh's own weights");
    assert_eq!(shapes[1].corners()[0], DVec3::X * 2.0, "the node's weights");
    assert_eq!(shapes[1].mesh.normals().unwrap()[0], [2.0, 0.0, 1.0]);
    assert_eq!(shapes[2].mesh.positions(), CORNERS);
    assert!(heights(3).iter().zip([-1.0, -2.0, -4.0]).all(|(a, b)| (a - b).abs() < 1e-6), "{:?}", heights(3));
}

#[test]
fn animations_are_warned_of() {
    let mut file = Builder::with_node();
    file.json["animations"] = json!([{ "channels": [], "samplers": [] }]);
    assert!(warnings(&file.read())[0].contains("animations are left out"));
}
