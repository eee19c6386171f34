//! Are textures made, named and changed by clicks?

use catoptra_core::Value;

use super::*;
use crate::naming::Named;

#[test]
fn a_name_that_is_typed_for_a_texture_becomes_its_name() {
    let mut bench = Bench::new("ball");
    let wood = bench.texture("wood");
    bench.viewer.texture = Some(wood);
    bench.viewer.typed_name = Some((Named::Texture(wood), "oak".to_owned()));
    bench.frames(2);
    assert_eq!(bench.viewer.document.scene().texture_name(wood), Some("oak"));
    bench.undo();
    bench.viewer.typed_name = Some((Named::Texture(wood), "noise".to_owned()));
    bench.frames(2);
    assert_eq!(bench.viewer.document.scene().texture_name(wood), Some("wood"), "that name is taken");
    assert!(bench.viewer.notice.is_some());
}

#[test]
fn a_texture_is_selected_and_its_wrapping_changed() {
    let mut bench = Bench::new("ball");
    bench.click("wood");
    assert_eq!(bench.viewer.texture, Some(bench.texture("wood")));
    bench.click("repeat");
    bench.click("mirror");
    let wood = bench.texture("wood");
    let values = |bench: &Bench| bench.viewer.document.scene().find_texture(wood).unwrap().values();
    assert_eq!(values(&bench).get("wrap"), Some(&Value::Word("mirror".to_owned())));
    bench.undo();
    assert_eq!(values(&bench).get("wrap"), Some(&Value::Word("repeat".to_owned())));
    bench.click("×");
    assert_eq!(values(&bench).get("wrap-v"), None);
    bench.undo();
}

#[test]
fn a_new_texture_comes_and_goes() {
    let mut bench = Bench::new("ball");
    bench.click("Add");
    bench.click("marble-texture");
    let id = bench.texture("marble-texture");
    assert_eq!(bench.viewer.texture, Some(id));
    bench.click("Remove");
    assert_eq!(bench.viewer.document.scene().find_texture(id), None);
    assert_eq!(bench.viewer.texture, None);
}
