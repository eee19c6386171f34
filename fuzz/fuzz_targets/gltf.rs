//! Is any file a model that a scene takes, or refused?
#![no_main]

use std::path::Path;

use catoptra_core::{Edit, Scene};
use catoptra_scene::model::{Folder, Model, read_bytes};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for name in ["fuzz.glb", "fuzz.gltf"] {
        if let Ok(model) = read_bytes(bytes, Path::new(name), &Folder::none()) {
            insert(model);
        }
    }
});

/// Whatever was read, names, numbers and depths are those that a scene takes.
fn insert(model: Model) {
    let mut scene = Scene::new();
    for (name, texture) in model.textures {
        scene.add_texture(&name, texture).expect("textures have names of their own");
    }
    for worn in model.materials {
        let id = scene.add_material(&worn.name, worn.material).expect("materials have names of their own");
        scene.apply(Edit::Finish(id, worn.finish)).expect("finishes name textures that are there");
    }
    for node in model.nodes {
        scene.apply(Edit::Insert(Box::new(node.into()))).expect("nodes fit a scene");
    }
}
