//! Does an EXR hold the channels, windows and texts that are asked for?

use std::collections::HashMap;
use std::path::Path;

use exr::prelude::{AttributeValue, FlatImage, FlatSamples, ReadChannels, ReadLayers, Text};
use serde_json::Value;

use crate::program::{assert_refused, catoptra, folder};

/// Renders the small scene into `a.exr` and reads all of it.
fn rendered(folder: &Path, line: &str) -> FlatImage {
    let line = format!("render scene.kdl -o a.exr {line}");
    let ran = catoptra(folder, &line.split(' ').collect::<Vec<_>>());
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{line}");
    let read = exr::prelude::read().no_deep_data().largest_resolution_level().all_channels();
    read.all_layers().all_attributes().from_file(folder.join("a.exr")).expect("an EXR")
}

/// The bits of every channel, row by row.
fn channels(image: &FlatImage) -> HashMap<String, Vec<u32>> {
    let bits = |samples: &FlatSamples| match samples {
        FlatSamples::F32(numbers) => numbers.iter().map(|number| number.to_bits()).collect(),
        FlatSamples::U32(numbers) => numbers.clone(),
        FlatSamples::F16(_) => panic!("no channel is so coarse"),
    };
    let list = &image.layer_data[0].channel_data.list;
    list.iter().map(|channel| (channel.name.to_string(), bits(&channel.sample_data))).collect()
}

fn text(attributes: &HashMap<Text, AttributeValue>, name: &str) -> String {
    match &attributes[&Text::from(name)] {
        AttributeValue::Text(text) => String::from_utf8(text.as_slice().to_vec()).expect("UTF-8"),
        other => panic!("{name} is {other:?}"),
    }
}

const ALL: &str = "--size 60x40 --samples 4 --layers color,depth,normal,albedo,uv,id,samples,error";

#[test]
fn every_layer_has_its_channels_and_numbers_their_names() {
    let folder = folder();
    let image = rendered(folder.path(), ALL);
    assert_eq!(image.layer_data.len(), 1);
    let layer = &image.layer_data[0];
    let names: Vec<String> = layer.channel_data.list.iter().map(|c| c.name.to_string()).collect();
    let wanted = [
        "B",
        "G",
        "R",
        "Z",
        "albedo.B",
        "albedo.G",
        "albedo.R",
        "error.B",
        "error.G",
        "error.R",
        "id.entity",
        "id.material",
        "normal.X",
        "normal.Y",
        "normal.Z",
        "samples",
        "uv.U",
        "uv.V",
    ];
    assert_eq!(names, wanted);
    let all = channels(&image);
    let middle = 20 * 60 + 30;
    let float = |name: &str, at: usize| f32::from_bits(all[name][at]);
    // The ball's nearest point is 3 m from the eye, and its middle looks at it.
    assert!((float("Z", middle) - 3.0).abs() < 1e-2 && float("Z", 0).is_infinite());
    assert!(float("normal.Z", middle) > 0.999 && float("normal.X", middle).abs() < 0.05);
    assert!(float("albedo.R", middle) > float("albedo.G", middle) && all["samples"][middle] == 4);
    let largest = |name: &str| all[name].iter().map(|bits| f32::from_bits(*bits)).fold(0.0, f32::max);
    assert!(largest("error.G") > 0.0 && largest("error.R") > 1.1 * largest("error.G"), "the ball is reddish");
    let manifest: Value = serde_json::from_str(&text(&layer.attributes.other, "manifest")).unwrap();
    let name = |channel: &str, at: usize| manifest[channel][all[channel][at].to_string()].clone();
    assert_eq!((name("id.entity", middle), name("id.material", middle)), ("ball".into(), "shiny".into()));
    let low = 39 * 60 + 30;
    assert_eq!((name("id.entity", low), name("id.material", low)), ("floor".into(), "grey".into()));
    assert_eq!((all["id.entity"][0], all["id.material"][0]), (0, 0));
    let about: Value = serde_json::from_str(&text(&layer.attributes.other, "catoptra")).unwrap();
    assert_eq!((&about["scene"], &about["camera"]), (&"scene.kdl".into(), &"front".into()));
    assert_eq!(about["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(about["scene_hash"].as_str().unwrap().len(), 8);
    assert!(about["seconds"].as_f64().unwrap() > 0.0);
    assert_eq!(about["command"], format!("catoptra render scene.kdl -o a.exr {ALL}"));
}

#[test]
fn crops_put_together_by_their_windows_are_the_whole() {
    let folder = folder();
    let layers = "--size 60x40 --samples 4 --layers color,depth,normal,albedo,uv,id,samples,error";
    let whole = rendered(folder.path(), layers);
    let wanted = channels(&whole);
    let mut found: HashMap<String, Vec<u32>> =
        wanted.iter().map(|(name, bits)| (name.clone(), vec![u32::MAX; bits.len()])).collect();
    for crop in ["0,0,23,40", "23,0,37,17", "23,17,37,23"] {
        let part = rendered(folder.path(), &format!("{layers} --crop {crop} --tile 8 --compression piz"));
        let window = part.attributes.display_window;
        assert_eq!((window.position.0, window.size.0, window.size.1), (0, 60, 40));
        let layer = &part.layer_data[0];
        let (corner, width) = (layer.attributes.layer_position, layer.size.0);
        for (name, bits) in channels(&part) {
            let into = found.get_mut(&name).expect("the whole has that channel");
            for (at, bits) in bits.into_iter().enumerate() {
                let (x, y) = (corner.0 as usize + at % width, corner.1 as usize + at / width);
                into[y * 60 + x] = bits;
            }
        }
    }
    assert!(found == wanted);
}

#[test]
fn an_exr_is_small_unless_it_is_told_not_to_be() {
    let folder = folder();
    let size = |line: &str| {
        rendered(folder.path(), line);
        std::fs::metadata(folder.path().join("a.exr")).unwrap().len()
    };
    let [usual, zip, none] = [
        "--size 64x64 --reproducible",
        "--size 64x64 --reproducible --compression zip",
        "--size 64x64 --compression none",
    ]
    .map(size);
    assert!(usual == zip && 2 * usual < none && none > 64 * 64 * 12, "{usual} {zip} {none}");
}

#[test]
fn layers_that_cannot_be_are_refused() {
    let folder = folder();
    let refused = |line: &str, words: &[&str]| {
        assert_refused(
            folder.path(),
            &format!("render scene.kdl {line}").split(' ').collect::<Vec<_>>(),
            words,
        );
    };
    refused("-o a.exr --layers colour", &["colour", "did you mean `color`?"]);
    refused("-o a.png --layers color,id", &["--layers are channels of an .exr", ".exr"]);
    refused("-o a.exr --layers error", &["two samples", "--samples"]);
    refused("-o a.exr --layers error --samples 4 --film a.film", &["--film"]);
    refused("-o a.exr --compression lzw", &["lzw", "zip"]);
}
