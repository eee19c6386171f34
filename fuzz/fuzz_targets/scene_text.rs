//! Is any text a scene or refused, and does what is read come back as it was written?
#![no_main]

use catoptra_scene::{SceneFile, parse};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok((scene, file)) = parse(text, "fuzz", None) else { return };
    assert_eq!(file.text(), text, "what is not edited stays as it is");
    let written = SceneFile::new(&scene).text();
    let (again, _) = parse(&written, "written", None).expect("what is written can be read");
    assert_eq!(again.entities().count(), scene.entities().count());
});
