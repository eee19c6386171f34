//! Does any damaged file end in a model or in an error, never in a panic? Changed bytes of good files, always the same.

use std::path::Path;

use catoptra_scene::model::{Folder, Model, read_bytes};
use serde_json::json;

use crate::builder::{Builder, base64, fits, shapes};
use crate::textures::png;

/// A file with something of everything.
#[allow(clippy::too_many_lines, reason = "a table")]
fn rich() -> Builder {
    let mut file = Builder::with_triangle();
    let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0];
    let positions = file.floats("VEC3", &corners);
    let normals = file.floats("VEC3", &corners);
    let uvs = file.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    let colors = file.shorts("VEC3", &[0, 9, 65535, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
    let indices = file.shorts("SCALAR", &[0, 1, 2, 2, 1, 3]);
    let joints = file.shorts("VEC4", &[0, 1, 0, 1, 1, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 1]);
    let weights = file.floats("VEC4", &[0.25; 16]);
    let target = file.floats("VEC3", &corners);
    let places = file.view(&[1, 0, 3, 0]);
    let values = file.view(&[7; 24]);
    file.json["accessors"][target]["sparse"] = json!({ "count": 2,
        "indices": { "bufferView": places, "componentType": 5123 }, "values": { "bufferView": values } });
    let bind = file.floats("MAT4", &[0.5; 32]);
    let picture = file.view(&png([2, 2], &[9; 16]));
    file.push("images", json!({ "bufferView": picture }));
    file.push("samplers", json!({ "wrapS": 33071, "wrapT": 33648, "magFilter": 9728 }));
    file.push("textures", json!({ "source": 0, "sampler": 0 }));
    let by = json!({ "index": 0, "extensions": { "KHR_texture_transform": { "rotation": 1.0, "scale": [2, 3] } } });
    file.push("materials", json!({ "name": "paint", "alphaMode": "MASK", "doubleSided": true, "normalTexture": by,
        "emissiveFactor": [1, 2, 3], "emissiveTexture": by,
        "pbrMetallicRoughness": { "baseColorTexture": by, "metallicRoughnessTexture": by },
        "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1, "transmissionTexture": by },
            "KHR_materials_volume": { "thicknessFactor": 1, "attenuationDistance": 2 },
            "KHR_materials_clearcoat": { "clearcoatFactor": 1 }, "KHR_materials_sheen": { "sheenColorFactor": [1, 1, 1] } } }));
    file.push(
        "materials",
        json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": { "diffuseTexture": by,
        "specularGlossinessTexture": by } } }),
    );
    let attributes = json!({ "POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs, "COLOR_0": colors,
        "JOINTS_0": joints, "WEIGHTS_0": weights });
    let targets = json!([{ "POSITION": target, "NORMAL": target }]);
    file.push(
        "meshes",
        json!({ "primitives": [
        { "attributes": attributes, "indices": indices, "material": 0, "mode": 5, "targets": targets },
        { "attributes": attributes, "material": 1, "targets": targets }], "weights": [0.5] }),
    );
    file.push("skins", json!({ "joints": [2, 3], "inverseBindMatrices": bind }));
    file.push("cameras", json!({ "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } }));
    file.push(
        "cameras",
        json!({ "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 2, "zfar": 9, "znear": 0 } }),
    );
    file.extension(
        "KHR_lights_punctual",
        json!({ "lights": [{ "type": "spot", "spot": {} }, { "type": "point" }] }),
    );
    file.push("nodes", json!({ "name": "root", "children": [1, 2, 4], "scale": [1, 2, 3] }));
    file.push("nodes", json!({ "mesh": 1, "rotation": [0, 0.6, 0, 0.8], "camera": 0 }));
    file.push(
        "nodes",
        json!({ "children": [3], "matrix": [1, 0, 0, 0, 0, 2, 0, 0, 0, 1, 1, 0, 5, 6, 7, 1] }),
    );
    file.push(
        "nodes",
        json!({ "mesh": 1, "skin": 0, "extensions": { "KHR_lights_punctual": { "light": 0 } } }),
    );
    let instances = json!({ "attributes": { "TRANSLATION": positions, "SCALE": normals } });
    file.push(
        "nodes",
        json!({ "mesh": 0, "camera": 1, "extensions": { "EXT_mesh_gpu_instancing": instances,
        "KHR_lights_punctual": { "light": 1 } } }),
    );
    file.json["scenes"] = json!([{ "nodes": [0] }]);
    file
}

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % end.max(1) as u64) as usize
    }
}

/// Text that means something in the JSON of a file.
const TELLING: &[&[u8]] = &[
    b"0",
    b"9",
    b"-",
    b"e9",
    b"1e300",
    b".",
    b"[",
    b"]",
    b"{",
    b"}",
    b",",
    b"\"",
    b"null",
    b"4294967295",
    b"18446744073709551615",
    b"[]",
    b"{}",
    b"true",
    b"5121",
    b"5126",
    b"\xff",
    b"\0",
];

fn check(model: &Model) {
    fits(model);
    for shape in shapes(model) {
        let count = shape.mesh.positions().len();
        assert!(shape.mesh.triangles().as_flattened().iter().all(|&i| (i as usize) < count));
        assert!(shape.mesh.positions().as_flattened().iter().all(|v| v.is_finite()));
        assert!(shape.placement.scale() > 0.0);
    }
}

#[test]
fn a_file_with_something_of_everything_is_read() {
    let model = rich().read();
    // Two each of a plain and a skinned mesh of two primitives, and of four copies of a triangle the one that has extent.
    assert_eq!(shapes(&model).len(), 5);
    check(&model);
}

#[test]
fn no_damaged_file_panics() {
    let file = rich();
    let binary = file.glb();
    let json_length = u32::from_le_bytes(*binary[12..].first_chunk().unwrap()) as usize;
    let text = file.text(&format!("data:;base64,{}", base64(&file.bytes)));
    let mut random = Random(5);
    let (mut read, mut refused) = (0, 0);
    for round in 0..4_000 {
        let is_binary = round % 3 != 0;
        let mut bytes = if is_binary { binary.clone() } else { text.clone() };
        for _ in 0..=random.below(3) {
            // Half of the damage to the JSON, half to all of the file.
            let within = if is_binary && random.below(2) == 0 { 20 + json_length } else { bytes.len() };
            let at = random.below(within.min(bytes.len()));
            let telling = TELLING[random.below(TELLING.len())];
            match random.below(6) {
                0 => bytes[at] ^= 1 << random.below(8),
                1 if !is_binary => bytes.truncate(at.max(1)),
                2 | 3 if !is_binary => drop(bytes.splice(at..at, telling.iter().copied())),
                _ => {
                    let end = (at + telling.len()).min(bytes.len());
                    bytes[at..end].copy_from_slice(&telling[..end - at]);
                }
            }
            if bytes.is_empty() {
                break;
            }
        }
        let name = if is_binary { "damaged.glb" } else { "damaged.gltf" };
        match read_bytes(&bytes, Path::new(name), &Folder::none()) {
            Ok(model) => {
                read += 1;
                check(&model);
            }
            Err(error) => {
                refused += 1;
                assert!(error.to_string().starts_with(name), "{error}");
            }
        }
    }
    assert!(read > 500 && refused > 500, "{read} were read, {refused} refused");
}
