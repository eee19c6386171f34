//! Does any MTL file leave the triangles that wear it?
#![no_main]

use std::path::PathBuf;
use std::sync::LazyLock;

use catoptra_scene::model::read;
use libfuzzer_sys::fuzz_target;

/// A folder with a model of three materials.
static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = std::env::temp_dir().join(format!("catoptra-fuzz-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the folder for temporary files can be written");
    let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1 2 3\nusemtl\nf 1 2 3\n";
    std::fs::write(folder.join("a.obj"), obj).expect("the folder can be written");
    catoptra_scene::image::write_png(&folder.join("a.png"), 2, 1, &[9, 8, 7, 6, 5, 4])
        .expect("the folder can be written");
    folder
});

fuzz_target!(|bytes: &[u8]| {
    std::fs::write(FOLDER.join("a.mtl"), bytes).expect("the folder can be written");
    let model = read(&FOLDER.join("a.obj")).expect("whatever a library holds, the triangles are there");
    assert_eq!((model.nodes.len(), model.materials.len()), (3, 3));
});
