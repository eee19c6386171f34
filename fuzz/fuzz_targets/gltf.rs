//! Is any glTF file a model that a scene takes, or refused?
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for name in ["fuzz.glb", "fuzz.gltf"] {
        catoptra_fuzz::model::read(bytes, name);
    }
});
