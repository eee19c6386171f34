//! Is what was read of a model one that a scene takes?

use std::path::Path;

use catoptra_core::{Edit, Scene};
use catoptra_scene::model::{Folder, Model, read_bytes, read_mesh_bytes};

/// Reads bytes as the file of that name, as a model and as one mesh. Whatever is read must fit a scene.
pub fn read(bytes: &[u8], name: &str) {
    if let Ok(model) = read_bytes(bytes, Path::new(name), &Folder::none()) {
        insert(model);
    }
    if let Ok(mesh) = read_mesh_bytes(bytes, Path::new(name)) {
        let count = mesh.positions().len() as u32;
        assert!(mesh.triangles().iter().flatten().all(|&corner| corner < count));
        assert!(mesh.positions().iter().flatten().all(|c| c.is_finite()));
        assert!(mesh.offset().is_finite());
    }
}

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
