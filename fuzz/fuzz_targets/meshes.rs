//! Is any file a mesh or refused?
#![no_main]

use std::path::Path;

use catoptra_scene::model::read_mesh_bytes;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for name in ["fuzz.obj", "fuzz.ply", "fuzz.stl"] {
        if let Ok(mesh) = read_mesh_bytes(bytes, Path::new(name)) {
            let count = mesh.positions().len() as u32;
            assert!(mesh.triangles().iter().flatten().all(|&corner| corner < count));
            assert!(mesh.positions().iter().flatten().all(|c| c.is_finite()));
            assert!(mesh.offset().is_finite());
        }
    }
});
