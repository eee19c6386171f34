//! Is any OBJ file a model that a scene takes, or refused?
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| catoptra_fuzz::model::read(bytes, "fuzz.obj"));
