//! Materials: what each parameter of the format becomes.

use catoptra_core::scene::Content;
use catoptra_core::texture::Channel;
use catoptra_core::{Node, Rgb, Sides, Value};
use catoptra_scene::model::{Model, ModelMaterial};
use serde_json::{Value as Json, json};

use crate::builder::{Builder, warnings};
use crate::textures::png;

/// A triangle of that material; texture 0 has no alpha, texture 1 has one of half.
fn file_of(material: Json) -> Builder {
    let mut file = Builder::with_node();
    for bytes in [&[128, 128, 128][..], &[255, 255, 255, 128]] {
        let view = file.view(&png([1, 1], bytes));
        let image = file.push("images", json!({ "bufferView": view }));
        file.push("textures", json!({ "source": image }));
    }
    file.push("materials", material);
    file.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    file
}

fn model(material: Json) -> Model {
    file_of(material).read()
}

/// A material's value.
fn value(worn: &ModelMaterial, field: &str) -> Value {
    assert_eq!(worn.material.kind_name(), "principled");
    worn.material.values().get(field).unwrap().clone()
}

/// A value as numbers, and which channel of a texture multiplies it.
fn parts(value: &Value) -> (Vec<f64>, Option<Option<Channel>>) {
    match value {
        Value::Number(v) => (vec![*v], None),
        Value::Color(c) => (c.to_array().to_vec(), None),
        Value::Flag(v) => (vec![f64::from(*v)], None),
        Value::Textured(textured) => (parts(&textured.base).0, Some(textured.by.channel)),
        other => panic!("{other:?}"),
    }
}

/// The name of a field, its numbers, and the channel of a texture that multiplies them.
type Field<'a> = (&'a str, &'a [f64], Option<Option<Channel>>);

/// Holds each of these fields of a material against numbers and a channel.
fn holds(material: Json, wanted: &[Field<'_>]) {
    let model = model(material);
    for (field, numbers, channel) in wanted {
        let (found, by) = parts(&value(&model.materials[0], field));
        assert_eq!((&found[..], by), (*numbers, *channel), "{field}");
    }
}

const NO: Option<Option<Channel>> = None;

#[test]
fn metal_and_roughness_take_the_blue_and_the_green() {
    holds(
        json!({ "pbrMetallicRoughness": {
            "baseColorFactor": [0.1, 0.2, 0.3, 1.0], "baseColorTexture": { "index": 0 },
            "metallicFactor": 0.5, "roughnessFactor": 0.25, "metallicRoughnessTexture": { "index": 0 } } }),
        &[
            ("base-color", &[0.1, 0.2, 0.3], Some(None)),
            ("metallic", &[0.5], Some(Some(Channel::Blue))),
            ("roughness", &[0.25], Some(Some(Channel::Green))),
            ("unlit", &[0.0], NO),
        ],
    );
    // By default, rough white metal.
    let plain: [(&str, &[f64], _); 4] = [
        ("base-color", &[1.0; 3], NO),
        ("metallic", &[1.0], NO),
        ("roughness", &[1.0], NO),
        ("transmission", &[0.0], NO),
    ];
    holds(json!({}), &plain);
    holds(json!({ "pbrMetallicRoughness": { "metallicFactor": 7.0, "roughnessFactor": 1.0 } }), &plain);
}

#[test]
fn emission_is_radiance_as_it_stands() {
    let strength = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 20.0 } });
    holds(
        json!({ "emissiveFactor": [1.0, 0.5, 0.0], "emissiveTexture": { "index": 0 }, "extensions": strength }),
        &[("emission", &[20.0, 10.0, 0.0], Some(None))],
    );
    holds(json!({ "emissiveTexture": { "index": 0 } }), &[("emission", &[0.0; 3], NO)]);
}

#[test]
fn what_lets_light_through_is_a_sheet_or_has_an_inside() {
    let transmission = json!({ "transmissionFactor": 0.9, "transmissionTexture": { "index": 0 } });
    let sheet = json!({ "extensions": { "KHR_materials_transmission": transmission, "KHR_materials_ior": { "ior": 1.3 } } });
    holds(
        sheet,
        &[("transmission", &[0.9], Some(Some(Channel::Red))), ("ior", &[1.3], NO), ("thin", &[1.0], NO)],
    );
    let volume =
        json!({ "thicknessFactor": 0.2, "attenuationDistance": 0.5, "attenuationColor": [0.1, 0.9, 1.0] });
    let solid = json!({ "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1.0 }, "KHR_materials_volume": volume } });
    holds(
        solid.clone(),
        &[
            ("thin", &[0.0], NO),
            ("tint", &[0.1, 0.9, 1.0], NO),
            ("tint-distance", &[0.5], NO),
            ("ior", &[1.5], NO),
        ],
    );
    // Light must come out of it again.
    assert_eq!(model(solid).materials[0].finish.sides(), Sides::Double);
    holds(json!({ "extensions": { "KHR_materials_ior": { "ior": 0.0 } } }), &[("ior", &[1e4], NO)]);
}

#[test]
fn coats_sheen_reflection_and_brushes_keep_their_channels() {
    let by = json!({ "index": 1 });
    let coat = json!({ "clearcoatFactor": 0.5, "clearcoatTexture": by, "clearcoatRoughnessFactor": 0.25,
        "clearcoatRoughnessTexture": by });
    let sheen = json!({ "sheenColorFactor": [0.1, 0.2, 0.3], "sheenColorTexture": by, "sheenRoughnessFactor": 0.75,
        "sheenRoughnessTexture": by });
    let specular = json!({ "specularFactor": 0.5, "specularTexture": by, "specularColorFactor": [0.5, 1.0, 0.25],
        "specularColorTexture": by });
    let anisotropy =
        json!({ "anisotropyStrength": 0.5, "anisotropyRotation": 1.25, "anisotropyTexture": by });
    let material = json!({ "extensions": { "KHR_materials_clearcoat": coat, "KHR_materials_sheen": sheen,
        "KHR_materials_specular": specular, "KHR_materials_anisotropy": anisotropy } });
    holds(
        material,
        &[
            ("coat", &[0.5], Some(Some(Channel::Red))),
            ("coat-roughness", &[0.25], Some(Some(Channel::Green))),
            ("sheen", &[1.0], NO),
            ("sheen-color", &[0.1, 0.2, 0.3], Some(None)),
            ("sheen-roughness", &[0.75], Some(Some(Channel::Alpha))),
            ("specular", &[0.5], Some(Some(Channel::Alpha))),
            ("specular-color", &[0.5, 1.0, 0.25], Some(None)),
            ("anisotropy", &[0.5], Some(Some(Channel::Blue))),
            ("anisotropy-rotation", &[1.25], NO),
        ],
    );
}

#[test]
fn what_is_unlit_shows_its_colour() {
    let unlit = json!({ "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.25, 1.0, 1.0] }, "emissiveFactor": [1, 1, 1],
        "extensions": { "KHR_materials_unlit": {} } });
    holds(
        unlit,
        &[("unlit", &[1.0], NO), ("base-color", &[0.5, 0.25, 1.0], NO), ("emission", &[0.0; 3], NO)],
    );
}

#[test]
fn alpha_counts_as_its_mode_says() {
    let with = |mode: Json, texture: u32, alpha: f64| {
        let mut material = mode;
        material["pbrMetallicRoughness"] =
            json!({ "baseColorFactor": [1.0, 1.0, 1.0, alpha], "baseColorTexture": { "index": texture } });
        model(material).materials[0].finish
    };
    let opaque = with(json!({}), 1, 0.5);
    assert_eq!((opaque.opacity().base(), opaque.is_see_through()), (1.0, false));
    let blend = with(json!({ "alphaMode": "BLEND" }), 1, 0.5);
    assert_eq!((blend.opacity().base(), blend.alpha_cutoff()), (0.5, None));
    assert_eq!(blend.opacity().texture().unwrap().channel, Some(Channel::Alpha));
    // A picture without alpha makes nothing see-through.
    let solid = with(json!({ "alphaMode": "BLEND" }), 0, 1.0);
    assert_eq!((solid.opacity().texture(), solid.is_see_through()), (None, false));
    let mask = with(json!({ "alphaMode": "MASK" }), 1, 1.0);
    assert_eq!((mask.alpha_cutoff(), mask.opacity().is_textured()), (Some(0.5), true));
    assert_eq!(with(json!({ "alphaMode": "MASK", "alphaCutoff": 0.25 }), 1, 1.0).alpha_cutoff(), Some(0.25));
    let nothing = with(json!({ "alphaMode": "MASK", "alphaCutoff": 1.5 }), 1, 1.0);
    assert_eq!((nothing.opacity().base(), nothing.opacity().texture()), (0.0, None));
    let refused = file_of(json!({ "alphaMode": "GLASSY" })).refusal();
    assert!(refused.contains("materials[0].alphaMode: is none of OPAQUE"), "{refused}");
}

#[test]
fn sides_and_normal_maps_finish_it() {
    let single = model(json!({ "normalTexture": { "index": 0, "scale": 0.5 } })).materials[0].finish;
    assert_eq!((single.sides(), single.normal_map().unwrap().strength), (Sides::Single, 0.5));
    assert_eq!(model(json!({ "doubleSided": true })).materials[0].finish.sides(), Sides::Double);
}

#[test]
fn specular_colour_and_glossiness_become_metal_and_roughness() {
    let plain = json!({ "diffuseFactor": [0.8, 0.1, 0.05, 1.0], "specularFactor": [0.04, 0.04, 0.04], "glossinessFactor": 0.75 });
    let model_of =
        |given: &Json| model(json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": given } }));
    let found = model_of(&plain);
    assert!(warnings(&found)[0].contains("glossiness"));
    let number = |field: &str| parts(&value(&found.materials[0], field)).0[0];
    assert!(
        number("metallic") < 1e-6 && number("roughness") == 0.25 && (number("base-color") - 0.8).abs() < 1e-6
    );
    // By pictures: the second texture is white with an alpha of half.
    let painted = json!({ "diffuseTexture": { "index": 0 }, "specularFactor": [0.04, 0.04, 0.04],
        "specularGlossinessTexture": { "index": 1 } });
    let found = model_of(&painted);
    assert_eq!(found.textures.len(), 2);
    let texel = |i: usize| found.textures[i].1.color(&Default::default());
    let grey = catoptra_core::srgb_decoded(128.0 / 255.0);
    assert!((texel(0).r - grey).abs() < 0.01, "{:?}", texel(0));
    assert!((texel(1).g - 0.5).abs() < 0.01 && texel(1).b < 0.01, "{:?}", texel(1));
    assert_eq!(parts(&value(&found.materials[0], "roughness")), (vec![1.0], Some(Some(Channel::Green))));
}

#[test]
fn shapes_without_a_material_are_grey() {
    let model = Builder::with_node().read();
    assert_eq!(model.materials.len(), 1);
    assert_eq!(model.materials[0], ModelMaterial::grey().unwrap());
    let Content::Shape(_, id) = &model.nodes[0].content else { panic!() };
    assert_eq!(id.index(), 1);
}

/// A triangle of that material whose corners have colours of their own, and one without.
fn colored(material: Option<&Json>) -> Model {
    let mut file = file_of(material.cloned().unwrap_or(json!({})));
    let colors = file.floats("VEC3", &[0.5; 9]);
    let plain = file.json["meshes"][0]["primitives"][0].clone();
    file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
    file.mesh(plain);
    file.push("nodes", json!({ "mesh": 1 }));
    if material.is_none() {
        for mesh in 0..2 {
            file.json["meshes"][mesh]["primitives"][0].as_object_mut().unwrap().remove("material");
        }
    }
    file.read()
}

#[test]
fn colours_of_corners_paint_what_has_them_and_nothing_else() {
    for (material, field) in [(Some(&json!({})), "base-color"), (None, "color")] {
        let model = colored(material);
        let painted = |i: usize| model.materials[i].material.values().get(field).unwrap().texture();
        assert_eq!(model.materials.len(), 2);
        assert_eq!((painted(0).is_some(), painted(1)), (true, None));
        assert_eq!((model.textures.len(), model.warnings.len()), (1, 0));
    }
    // A texture has the first word.
    let both = colored(Some(&json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } })));
    assert!(warnings(&both)[0].contains("where a texture gives a colour too"), "{:?}", warnings(&both));
    assert_eq!(both.textures.len(), 1);
}

#[test]
fn materials_that_nothing_wears_are_left_out_and_names_are_unique() {
    let mut file = file_of(json!({ "name": "red" }));
    file.push("materials", json!({ "name": "blue", "normalTexture": { "index": 77 } }));
    file.push("materials", json!({ "name": "red", "pbrMetallicRoughness": { "metallicFactor": 0.0 } }));
    let mut primitive = file.json["meshes"][0]["primitives"][0].clone();
    primitive["material"] = json!(2);
    file.mesh(primitive);
    file.push("nodes", json!({ "mesh": 1 }));
    let model = file.read();
    let names: Vec<&str> = model.materials.iter().map(|worn| &*worn.name).collect();
    assert_eq!(names, ["red", "red 2"]);
    let worn = |node: &Node| match node.content {
        Content::Shape(_, id) => id.index(),
        _ => 0,
    };
    assert_eq!(model.nodes.iter().map(worn).collect::<Vec<_>>(), [1, 2]);
    assert_eq!(value(&model.materials[1], "metallic"), Value::Number(0.0));
    assert_eq!(value(&model.materials[1], "base-color"), Value::Color(Rgb::WHITE));
}
