//! Pictures: found wherever they lie, shown at the right place, each kept once.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;
use std::sync::Arc;

use catoptra_core::glam::DVec2;
use catoptra_core::texture::{ImageTexture, TexturePoint};
use catoptra_core::{Image, Rgb, Texture, TextureId, Value, srgb_decoded};
use catoptra_scene::model::{Folder, Model, read, read_bytes, read_mesh_bytes};
use serde_json::{Value as Json, json};

use crate::builder::{Builder, base64, only, warnings};

/// A PNG of these bytes: three or four a pixel.
pub(crate) fn png([width, height]: [u32; 2], bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    let has_alpha = bytes.len() as u32 == 4 * width * height;
    encoder.set_color(if has_alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(bytes).unwrap();
    writer.finish().unwrap();
    out
}

/// The red of a pixel tells its column, the green its row.
fn map([width, height]: [u32; 2]) -> Vec<u8> {
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x as u8 * 16, y as u8 * 16, 0]));
    png([width, height], pixels.collect::<Vec<_>>().as_flattened())
}

const UVS: [[f32; 2]; 3] = [[0.1, 0.3], [0.9, 0.2], [0.6, 0.8]];

/// A triangle with texture coordinates and a material of one texture, with the picture in a view.
fn painted(picture: &[u8], info: Json, sampler: Json) -> Builder {
    let mut file = Builder::new();
    let positions = file.floats("VEC3", crate::builder::CORNERS.as_flattened());
    let uvs = file.floats("VEC2", UVS.as_flattened());
    let view = file.view(picture);
    file.push("images", json!({ "bufferView": view, "mimeType": "image/png" }));
    file.push("samplers", sampler);
    file.push("textures", json!({ "source": 0, "sampler": 0 }));
    let mut texture = info;
    texture["index"] = json!(0);
    file.push("materials", json!({ "pbrMetallicRoughness": { "baseColorTexture": texture } }));
    file.mesh(json!({ "attributes": { "POSITION": positions, "TEXCOORD_0": uvs }, "material": 0 }));
    file.push("nodes", json!({ "mesh": 0 }));
    file
}

/// The only texture of a model.
fn texture(model: &Model) -> &ImageTexture {
    let [(_, Texture::ImageTexture(texture))] = &model.textures[..] else { panic!("{:?}", model.textures) };
    texture
}

/// Column and row of the picture that a texture shows at glTF's coordinates.
fn place(model: &Model, [u, v]: [f64; 2]) -> [u32; 2] {
    let at = TexturePoint::at_uv(DVec2::new(u, 1.0 - v));
    let color = Texture::from(texture(model).clone()).color(&at);
    let byte = |light: f64| {
        (0..=255_u8).min_by(|a, b| {
            let off = |v: u8| (srgb_decoded(f64::from(v) / 255.0) - light).abs();
            off(*a).total_cmp(&off(*b))
        })
    };
    [color.r, color.g].map(|light| u32::from(byte(light).unwrap()) / 16)
}

const NEAREST: u32 = 9728;

#[test]
fn the_upper_left_corner_of_a_picture_lies_at_0_0() {
    let model = painted(&map([4, 8]), json!({}), json!({ "magFilter": NEAREST })).read();
    for (uv, pixel) in
        [([0.01, 0.01], [0, 0]), ([0.99, 0.01], [3, 0]), ([0.01, 0.99], [0, 7]), ([0.6, 0.4], [2, 3])]
    {
        assert_eq!(place(&model, uv), pixel, "{uv:?}");
    }
    // The mesh's coordinates are turned with it.
    let found = only(&model).uvs().unwrap();
    for (found, given) in found.iter().zip(UVS) {
        assert!((found[0] - given[0]).abs() < 1e-6 && (found[1] - (1.0 - given[1])).abs() < 1e-6);
    }
}

#[test]
fn the_first_example_of_texture_transforms_shows_what_it_says() {
    // "Only the lower left quadrant of the source image, rotated clockwise 90°."
    let transform = json!({ "offset": [0, 1], "rotation": FRAC_PI_2, "scale": [0.5, 0.5] });
    let info = json!({ "extensions": { "KHR_texture_transform": transform } });
    let model = painted(&map([8, 8]), info, json!({ "magFilter": NEAREST })).read();
    // Of the quadrant the lower left pixel comes to the upper left, its upper left one to the upper right.
    let corners = [([0.1, 0.1], [0, 7]), ([0.9, 0.1], [0, 4]), ([0.9, 0.9], [3, 4]), ([0.1, 0.9], [3, 7])];
    for (uv, pixel) in corners {
        assert_eq!(place(&model, uv), pixel, "{uv:?}");
    }
}

#[test]
fn the_second_example_turns_a_picture_upside_down() {
    let info = json!({ "extensions": { "KHR_texture_transform": { "offset": [0, 1], "scale": [1, -1] } } });
    let model = painted(&map([4, 4]), info, json!({ "magFilter": NEAREST })).read();
    assert_eq!((place(&model, [0.1, 0.1]), place(&model, [0.9, 0.6])), ([0, 3], [3, 1]));
}

/// Any transform, against the formula with v downwards: scaled, turned anticlockwise as seen, moved.
#[test]
fn texture_transforms_follow_their_formula() {
    let [width, height] = [8.0, 4.0];
    let numbers = [[0.3, -0.2, 0.7, 1.3, 0.8], [-1.1, 2.3, 2.9, -0.7, 0.4], [0.0, 0.5, -1.2, 2.0, -3.0]];
    for [right, down, turn, x, y] in numbers {
        let transform = json!({ "offset": [right, down], "rotation": turn, "scale": [x, y] });
        let info = json!({ "extensions": { "KHR_texture_transform": transform } });
        let model = painted(&map([8, 4]), info, json!({ "magFilter": NEAREST })).read();
        for i in 0..200 {
            let (u, v) = (f64::from(i % 17) / 17.0, f64::from(i % 13) / 13.0);
            let (sine, cosine) = f64::sin_cos(turn);
            let (along, below) = (x * u, y * v);
            let moved = [cosine * along + sine * below + right, cosine * below - sine * along + down];
            let scaled = [moved[0].rem_euclid(1.0) * width, moved[1].rem_euclid(1.0) * height];
            // Not where rounding decides.
            if scaled.iter().all(|v| (v - v.round()).abs() > 1e-3) {
                assert_eq!(place(&model, [u, v]), scaled.map(|v| v as u32), "{u} {v}: {numbers:?}");
            }
        }
    }
}

#[test]
fn beyond_its_borders_a_picture_goes_on_as_the_sampler_says() {
    let with = |s: u32, t: u32| {
        let sampler = json!({ "magFilter": NEAREST, "wrapS": s, "wrapT": t });
        place(&painted(&map([4, 4]), json!({}), sampler).read(), [1.1, -0.4])
    };
    let [repeat, mirror, clamp] = [10497, 33648, 33071];
    assert_eq!(with(repeat, repeat), [0, 2]);
    assert_eq!(with(mirror, clamp), [3, 0]);
    assert_eq!(with(clamp, mirror), [3, 1]);
}

#[test]
fn pictures_are_found_in_views_in_uris_and_beside_the_file() {
    let bytes = map([2, 3]);
    let mut file = painted(&bytes, json!({}), json!({}));
    let size = |model: &Model| {
        let image = &texture(model).source().image;
        (image.width(), image.height())
    };
    assert_eq!(size(&file.read()), (2, 3));
    file.json["images"][0] = json!({ "uri": format!("data:image/png;base64,{}", base64(&bytes)) });
    assert_eq!(size(&file.read()), (2, 3));

    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("oak tree.png"), &bytes).unwrap();
    file.json["images"][0] = json!({ "uri": "oak%20tree.png" });
    let path = folder.path().join("a.glb");
    std::fs::write(&path, file.glb()).unwrap();
    let model = read(&path).unwrap();
    assert_eq!((size(&model), &*model.textures[0].0), ((2, 3), "oak tree"));
    assert_eq!(texture(&model).source().path, "oak tree.png");
    // A picture that is missing does not keep the rest from being shown.
    std::fs::remove_file(folder.path().join("oak tree.png")).unwrap();
    drop(model);
    let model = read_bytes(&file.glb(), &path, &Folder::of(&path)).unwrap();
    assert!(model.textures.is_empty());
    assert_eq!(warnings(&model).len(), 1);
    assert!(warnings(&model)[0].starts_with("images[0] is left out:"), "{:?}", warnings(&model));
    let base = model.materials[0].material.values().get("base-color").cloned();
    assert_eq!(base, Some(Value::Color(Rgb::WHITE)));
}

#[test]
fn webp_takes_the_place_of_what_others_read() {
    let mut file = painted(&map([2, 2]), json!({}), json!({}));
    let mut webp = Vec::new();
    image_webp::WebPEncoder::new(&mut webp).encode(&[7; 9], 3, 1, image_webp::ColorType::Rgb8).unwrap();
    let view = file.view(&webp);
    file.push("images", json!({ "bufferView": view, "mimeType": "image/webp" }));
    file.json["textures"][0]["extensions"] = json!({ "EXT_texture_webp": { "source": 1 } });
    assert_eq!(texture(&file.read()).source().image.width(), 3);
}

#[test]
fn a_texture_without_a_picture_is_warned_of() {
    let mut file = painted(&map([2, 2]), json!({}), json!({}));
    file.json["textures"][0] = json!({ "extensions": { "KHR_texture_basisu": { "source": 0 } } });
    let model = file.read();
    assert!(warnings(&model)[0].contains("textures[0] is left out"), "{:?}", warnings(&model));
}

#[test]
fn a_picture_is_kept_once_however_it_is_used() {
    let mut file = painted(&map([4, 4]), json!({}), json!({}));
    file.push("textures", json!({ "source": 0, "sampler": 0, "name": "the same" }));
    file.push(
        "materials",
        json!({ "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 1 }, "metallicRoughnessTexture": { "index": 0 } } }),
    );
    let mut primitive = file.json["meshes"][0]["primitives"][0].clone();
    primitive["material"] = json!(1);
    file.mesh(primitive);
    file.push("nodes", json!({ "mesh": 1 }));
    let model = file.read();
    let images: Vec<&Arc<Image>> = model
        .textures
        .iter()
        .map(|(_, texture)| match texture {
            Texture::ImageTexture(texture) => &texture.source().image,
            other => panic!("{other:?}"),
        })
        .collect();
    // As a colour, and as numbers.
    assert_eq!(images.len(), 2);
    assert!(Arc::ptr_eq(images[0], images[1]));
    let used = |i: usize, field: &str| model.materials[i].material.values().get(field).unwrap().texture();
    assert_eq!(used(0, "base-color"), TextureId::from_index(1));
    assert_eq!(used(1, "base-color"), TextureId::from_index(1));
    assert_eq!(used(1, "metallic"), TextureId::from_index(2));
    assert_eq!(used(1, "roughness"), used(1, "metallic"));
}

#[test]
fn another_set_of_coordinates_becomes_the_meshs_own() {
    let mut file = painted(&map([2, 2]), json!({ "texCoord": 1 }), json!({}));
    let other = file.floats("VEC2", &[0.5, 0.25, 0.0, 0.0, 1.0, 1.0]);
    file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = json!(other);
    let model = file.read();
    assert_eq!(only(&model).uvs().unwrap()[0], [0.5, 0.75]);
    assert!(warnings(&model).is_empty());
    // Who wants the mesh alone has the same, without a look at the picture.
    let mesh = read_mesh_bytes(&file.glb(), Path::new("made.glb")).unwrap();
    assert_eq!(mesh, *only(&model));
    // A transform has the last word; of two sets in one material the colour's is taken.
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] =
        json!({ "KHR_texture_transform": { "texCoord": 0 } });
    file.json["materials"][0]["normalTexture"] = json!({ "index": 0, "texCoord": 1 });
    let model = file.read();
    assert!((only(&model).uvs().unwrap()[0][1] - 0.7).abs() < 1e-6);
    assert!(warnings(&model)[0].contains("all are laid by TEXCOORD_0"));
    // Occlusion is a path tracer's own work.
    file.json["materials"][0].as_object_mut().unwrap().remove("normalTexture");
    file.json["materials"][0]["occlusionTexture"] = json!({ "index": 0, "texCoord": 1 });
    assert!(warnings(&file.read()).is_empty());
}

#[test]
fn pictures_that_are_none_are_left_out_with_a_reason() {
    for (bytes, said) in
        [(&b"GIF89a"[..], "is a GIF picture"), (b"", "is empty"), (b"\x89PNG", "cannot be read")]
    {
        let model = painted(bytes, json!({}), json!({})).read();
        assert!(warnings(&model)[0].contains(said), "{:?}", warnings(&model));
    }
    let mut file = painted(b"", json!({}), json!({}));
    file.json["images"][0] = json!({ "uri": "https://example.com/a.png" });
    assert!(warnings(&file.read())[0].contains("is not read from the network"));
    file.json["images"][0] = json!({});
    assert!(warnings(&file.read())[0].contains("neither a uri nor a bufferView"));
    let text = file.text("data:,");
    assert!(read_bytes(&text, Path::new("a.gltf"), &Folder::none()).is_err());
}
