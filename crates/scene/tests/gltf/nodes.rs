//! Trees of nodes: where things stand, what is shared, and what they are called.

use std::collections::HashSet;
use std::sync::Arc;

use catoptra_core::glam::{DAffine3, DMat3, DQuat, DVec3};
use catoptra_core::scene::{Content, Role};
use catoptra_core::{Node, Shape, TriangleMesh};
use serde_json::json;

use crate::builder::{Builder, CORNERS, fits, shapes, warnings};

/// SplitMix64 (Steele, Lea, Flood 2014), as numbers in −1..1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }
}

/// A triangle with a normal of its own at each corner, all to the side of +z.
fn with_normals() -> Builder {
    let mut file = Builder::new();
    let positions = file.floats("VEC3", CORNERS.as_flattened());
    let normals = file.floats("VEC3", &[0.1, 0.0, 1.0, 0.0, 0.2, 1.0, -0.3, 0.1, 1.0]);
    file.mesh(json!({ "attributes": { "POSITION": positions, "NORMAL": normals } }));
    file
}

/// Trees of nodes with any scales, against matrices that are multiplied out by hand.
#[test]
fn corners_and_normals_stand_where_matrices_say_and_outside_stays_outside() {
    for file in [with_normals, Builder::with_triangle] {
        try_matrices(file);
    }
}

fn try_matrices(triangle: fn() -> Builder) {
    let mut random = Random(7);
    for round in 0..60 {
        let mut file = triangle();
        let mut globals: Vec<DAffine3> = Vec::new();
        for i in 0..6 {
            let (move_by, turn) = (random.vector() * 3.0, DQuat::from_scaled_axis(random.vector() * 3.0));
            let scale = match (i + round) % 4 {
                0 => DVec3::splat(0.5 + random.next().abs()),
                1 => DVec3::ONE,
                _ => random.vector() + random.vector().signum() * 0.3,
            };
            let local = DAffine3::from_scale_rotation_translation(scale, turn, move_by);
            let mut node = if i % 2 == 0 {
                json!({ "translation": move_by.to_array(), "rotation": turn.to_array(), "scale": scale.to_array() })
            } else {
                let matrix = catoptra_core::glam::DMat4::from(local);
                json!({ "matrix": matrix.to_cols_array() })
            };
            node["mesh"] = json!(0);
            node["name"] = json!(format!("{i}"));
            if i < 5 {
                node["children"] = json!([i + 1]);
            }
            file.push("nodes", node);
            globals.push(globals.last().map_or(local, |outer| *outer * local));
        }
        let model = file.read();
        let shapes = shapes(&model);
        assert_eq!(shapes.len(), 6);
        for (shape, global) in shapes.iter().zip(&globals) {
            let size = global.matrix3.to_cols_array().into_iter().fold(0.0, |a: f64, v| a.max(v.abs())) + 1.0;
            for (found, corner) in shape.corners().into_iter().zip(CORNERS) {
                let wanted = global.transform_point3(DVec3::from(corner.map(f64::from)));
                assert!((found - wanted).length() < 2e-6 * size, "{found} for {wanted}");
            }
            let carry = global.matrix3.inverse().transpose();
            let Some(normals) = shape.mesh.normals() else {
                assert!(shape.winding(0).dot(carry * DVec3::Z) > 0.0, "the triangle is turned inside out");
                continue;
            };
            for (found, given) in normals.iter().zip([[0.1, 0.0, 1.0], [0.0, 0.2, 1.0], [-0.3, 0.1, 1.0]]) {
                let found = shape.placement.direction(DVec3::from(found.map(f64::from))).normalize();
                let wanted = (carry * DVec3::from(given)).normalize();
                assert!((found - wanted).length() < 1e-5, "{found} for {wanted}");
            }
            // Sheared far enough, normals come to lie behind their triangle; they tell the outside then.
            let side: DVec3 =
                normals.iter().map(|n| shape.placement.direction(DVec3::from(n.map(f64::from)))).sum();
            assert!(shape.winding(0).dot(side) > 0.0, "the triangle is turned from its normals");
        }
    }
}

fn mesh_of(node: &Node) -> &Arc<TriangleMesh> {
    match &node.content {
        Content::Shape(Shape::Mesh(mesh), _) => &mesh.source().mesh,
        other => panic!("{other:?}"),
    }
}

#[test]
fn meshes_are_stored_once_and_stretched_copies_too() {
    let mut file = Builder::with_triangle();
    let again = file.json["meshes"][0].clone();
    file.push("meshes", again);
    for (mesh, scale) in
        [(0, [1.0, 1.0, 1.0]), (1, [2.0, 2.0, 2.0]), (0, [1.0, 3.0, 1.0]), (0, [2.0, 6.0, 2.0])]
    {
        file.push("nodes", json!({ "mesh": mesh, "scale": scale, "rotation": [0.6, 0.0, 0.0, 0.8] }));
    }
    let model = file.read();
    let meshes: Vec<_> = model.nodes.iter().map(mesh_of).collect();
    assert!(Arc::ptr_eq(meshes[0], meshes[1]), "equal primitives are one mesh");
    assert!(Arc::ptr_eq(meshes[2], meshes[3]) && !Arc::ptr_eq(meshes[0], meshes[2]));
    assert_eq!(model.nodes[1].placement.scale(), 2.0);
    assert_eq!(model.nodes[1].placement.rotation(), DQuat::from_xyzw(0.6, 0.0, 0.0, 0.8));
}

#[test]
fn a_group_stands_for_a_node_that_shows_more_than_one_thing() {
    let mut file = Builder::with_triangle();
    let primitive = file.json["meshes"][0]["primitives"][0].clone();
    file.push("meshes", json!({ "name": "pair", "primitives": [primitive, primitive] }));
    file.push("nodes", json!({ "name": "room", "children": [1, 2, 3], "translation": [1.0, 2.0, 3.0] }));
    file.push("nodes", json!({ "name": "chair", "mesh": 0, "scale": [2.0, 2.0, 2.0] }));
    file.push("nodes", json!({ "name": "chair", "mesh": 1 }));
    file.push("nodes", json!({ "name": "joint", "children": [] }));
    let model = file.read();
    let [room] = &model.nodes[..] else { panic!("{:?}", model.nodes) };
    assert_eq!((&*room.name, room.role()), ("room", Role::Group));
    assert_eq!(room.placement.translation(), DVec3::new(1.0, 2.0, 3.0));
    let [single, pair] = room.members() else { panic!("{room:?}") };
    assert_eq!((&*single.name, single.role(), single.placement.scale()), ("chair", Role::Shape, 2.0));
    assert_eq!((&*pair.name, pair.role(), pair.members().len()), ("chair 2", Role::Group, 2));
    fits(&model);
}

#[test]
fn names_are_unique_whatever_the_file_says() {
    let mut file = Builder::with_triangle();
    for name in ["a", "a", "a 2", "", " \u{1b} ", "a"] {
        file.push("nodes", json!({ "name": name, "mesh": 0 }));
    }
    let long = "x".repeat(100_000);
    file.push("nodes", json!({ "name": long, "mesh": 0 }));
    file.push("nodes", json!({ "mesh": 0 }));
    let model = file.read();
    let names: HashSet<&str> = model.nodes.iter().map(|node| &*node.name).collect();
    assert_eq!(names.len(), 8, "{names:?}");
    assert!(names.iter().all(|name| name.len() < 200 && !name.trim().is_empty()));
    fits(&model);
}

#[test]
fn deep_trees_are_shown_and_deeper_ones_refused() {
    let chain = |length: usize| {
        let mut file = Builder::with_triangle();
        for i in 0..length {
            let children: Vec<usize> = (i + 1 < length).then_some(i + 1).into_iter().collect();
            file.push(
                "nodes",
                json!({ "mesh": 0, "children": children, "translation": [1.0, 0.0, 0.0], "scale": [1.0, 1.0, 1.0] }),
            );
        }
        file
    };
    let model = chain(120).read();
    let shapes = shapes(&model);
    assert_eq!(shapes.len(), 120);
    let mut along: Vec<f64> = shapes.iter().map(|shape| shape.corners()[0].x).collect();
    along.sort_by(f64::total_cmp);
    assert!(along.iter().zip(1..).all(|(x, i)| (x - f64::from(i)).abs() < 1e-9), "{along:?}");
    fits(&model);
    let refused = chain(200).refusal();
    assert!(refused.contains("lies more than 128 nodes deep"), "{refused}");
}

#[test]
fn the_default_scene_is_shown_alone() {
    let shown = |scenes: serde_json::Value, scene: Option<usize>| {
        let mut file = Builder::with_triangle();
        for i in 0..4 {
            let children = if i == 0 { json!([3]) } else { json!([]) };
            file.push("nodes", json!({ "name": format!("{i}"), "mesh": 0, "children": children }));
        }
        if !scenes.is_null() {
            file.json["scenes"] = scenes;
        }
        if let Some(scene) = scene {
            file.json["scene"] = json!(scene);
        }
        file.read().nodes.iter().map(|node| node.name.clone()).collect::<Vec<_>>().join(" ")
    };
    let scenes = json!([{ "nodes": [1] }, { "nodes": [2, 0] }]);
    assert_eq!(shown(scenes.clone(), Some(1)), "2 0");
    assert_eq!(shown(scenes, None), "1");
    assert_eq!(shown(json!(null), None), "0 1 2");
    assert_eq!(shown(json!([{}]), Some(0)), "");
}

#[test]
fn nodes_without_extent_or_that_are_hidden_are_left_out() {
    let mut file = Builder::with_triangle();
    file.push("nodes", json!({ "mesh": 0, "scale": [0.0, 0.0, 0.0] }));
    let hidden = json!({ "KHR_node_visibility": { "visible": false } });
    file.push("nodes", json!({ "children": [2], "extensions": hidden }));
    file.push("nodes", json!({ "mesh": 0 }));
    file.push("nodes", json!({ "mesh": 0, "extensions": { "KHR_node_visibility": {} } }));
    let model = file.read();
    assert_eq!((model.nodes.len(), warnings(&model).len()), (1, 0));
    let mut file = Builder::with_triangle();
    file.push("nodes", json!({ "mesh": 0, "scale": [0.0, 1.0, 0.0] }));
    // Flat, but there.
    file.push("nodes", json!({ "mesh": 0, "scale": [2.0, 3.0, 0.0] }));
    let model = file.read();
    assert_eq!((model.nodes.len(), warnings(&model).len()), (1, 1));
    let corners = shapes(&model)[0].corners();
    assert!((corners[2] - DVec3::Y * 3.0).length() < 1e-9, "{corners:?}");
    fits(&model);
}

#[test]
fn copies_by_the_list_share_their_mesh() {
    let mut file = Builder::with_triangle();
    let translations = file.floats("VEC3", &[1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0]);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let rotations = file.floats("VEC4", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half, 0.0, 0.0, 0.0, 1.0]);
    let scales = file.floats("VEC3", &[1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 1.0, 1.0, -1.0]);
    let attributes = json!({ "TRANSLATION": translations, "ROTATION": rotations, "SCALE": scales });
    let instances = json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
    file.push(
        "nodes",
        json!({ "name": "trees", "mesh": 0, "scale": [3.0, 3.0, 3.0], "extensions": instances }),
    );
    let model = file.read();
    let shapes = shapes(&model);
    assert_eq!(shapes.len(), 3);
    assert!(Arc::ptr_eq(mesh_of(shapes[0].node), mesh_of(shapes[1].node)));
    // The second corner, 1 0 0: at scale 2 and turned to +y at 0 2 0, all three times larger.
    let wanted = [DVec3::new(6.0, 0.0, 0.0), DVec3::new(0.0, 12.0, 0.0), DVec3::new(3.0, 0.0, 9.0)];
    for (shape, wanted) in shapes.iter().zip(wanted) {
        assert!((shape.corners()[1] - wanted).length() < 1e-5, "{:?}", shape.corners());
    }
    let mirrored = DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0));
    assert!(shapes[2].winding(0).dot(mirrored * DVec3::Z) > 0.0);
    fits(&model);
}
