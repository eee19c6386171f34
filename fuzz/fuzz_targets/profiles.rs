//! Is any file an intensity profile or refused?
#![no_main]

use std::path::Path;

use catoptra_scene::ies::read_bytes;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(profile) = read_bytes(bytes, Path::new("fuzz.ies")) else { return };
    let peak = profile.peak();
    for i in 0..=36 {
        for j in -36..=36 {
            let candela = profile.intensity(f64::from(i * 5).to_radians(), f64::from(j * 5).to_radians());
            assert!((0.0..=peak).contains(&candela), "{candela} of {peak}");
        }
    }
});
