//! Are textures kept as materials are: by name and id, with what names them?

use super::super::fixture::{Room, matte};
use super::super::{ChangeKind, Edit, SceneError, Subject};
use crate::{Finish, Rgb, Texture, TextureId, TextureUse, Value, Values};

fn noise(octaves: f64) -> Texture {
    let values = Values::new().with("octaves", Value::Number(octaves));
    (Texture::kind_named("noise-texture").unwrap().make)(&values).unwrap()
}

fn painted(texture: TextureId) -> crate::Material {
    matte(0.5).with("color", Value::Color(Rgb::grey(0.5)).textured(TextureUse::of(texture))).unwrap()
}

/// A room with a texture that the white material is painted with and the grey one is bumpy with.
fn room() -> (Room, TextureId) {
    let mut r = Room::new();
    let clouds = r.scene.add_texture("clouds", noise(3.0)).unwrap();
    r.scene.apply(Edit::Material(r.white, painted(clouds))).unwrap();
    let bumpy = Finish::default().with("normal-map", Value::Texture(clouds)).unwrap();
    r.scene.apply(Edit::Finish(r.grey, bumpy)).unwrap();
    (r, clouds)
}

#[test]
fn a_texture_in_use_is_not_removed() {
    let (r, clouds) = room();
    assert_eq!(r.scene.painted_with(clouds), [r.white, r.grey]);
    let error = r.refusal(Edit::RemoveTexture(clouds));
    let told = "the texture \"clouds\" is in use by \"white\" and 1 other material";
    assert_eq!(error.to_string(), told);
}

#[test]
fn edits_of_textures_are_taken_back_and_written_down() {
    let (mut r, clouds) = room();
    let renamed = r.there_and_back(Edit::RenameTexture(clouds, "fog".into()));
    assert_eq!((renamed.texture_named("fog"), renamed.texture_named("clouds")), (Some(clouds), None));
    let finer = r.there_and_back(Edit::Texture(clouds, noise(7.0)));
    assert_eq!(finer.find_texture(clouds), Some(&noise(7.0)));
    let free = Edit::Batch(vec![
        Edit::Material(r.white, matte(1.0)),
        Edit::Finish(r.grey, Finish::default()),
        Edit::RemoveTexture(clouds),
    ]);
    let before = r.scene.revision();
    assert_eq!(r.there_and_back(free.clone()).textures().count(), 0);
    r.scene.apply(free).unwrap();
    let changes: Vec<_> = r.scene.changes_since(before).iter().map(|c| (c.subject, c.what)).collect();
    assert_eq!(
        changes[1..],
        [(Subject::Material(r.grey), ChangeKind::Finish), (Subject::Texture(clouds), ChangeKind::Removed),]
    );
}

#[test]
fn a_removed_material_comes_back_with_its_finish() {
    let (mut r, _) = room();
    let gone = r.there_and_back(Edit::RemoveMaterial(r.grey));
    assert!(gone.find_material(r.grey).is_none() && gone.finish(r.grey).is_plain());
    let undo = r.scene.apply(Edit::RemoveMaterial(r.grey)).unwrap();
    r.scene.apply(undo).unwrap();
    assert!(!r.scene.finish(r.grey).is_plain());
}

#[test]
fn what_names_no_texture_of_the_scene_is_refused() {
    let (r, _) = room();
    let unknown = r.scene.next_texture_id();
    let finish = Finish::default().with("normal-map", Value::Texture(unknown)).unwrap();
    let add = Edit::AddMaterial { name: "new".into(), material: painted(unknown), id: None };
    for edit in [Edit::Material(r.white, painted(unknown)), Edit::Finish(r.white, finish), add] {
        assert_eq!(r.refusal(edit), SceneError::UnknownTexture(unknown));
    }
    let taken = Edit::AddTexture { name: "clouds".into(), texture: noise(1.0), id: None };
    assert_eq!(r.refusal(taken), SceneError::TextureNameTaken("clouds".into()));
    assert_eq!(r.refusal(Edit::RenameTexture(unknown, "x".into())), SceneError::UnknownTexture(unknown));
}

#[test]
fn changes_tell_which_materials_they_touch() {
    let (r, clouds) = room();
    let touched = |edit: Edit| {
        let mut scene = r.scene.clone();
        scene.apply(edit).unwrap();
        let changes = scene.changes_since(r.scene.revision());
        let mut ids: Vec<_> = changes.iter().flat_map(|change| scene.materials_touched_by(change)).collect();
        ids.sort_unstable();
        ids.dedup();
        ids
    };
    let both = [r.white, r.grey];
    assert_eq!(touched(Edit::Texture(clouds, noise(7.0))), both);
    assert_eq!(touched(Edit::Material(r.white, matte(0.1))), [r.white]);
    assert_eq!(touched(Edit::Finish(r.grey, Finish::default())), [r.grey]);
    assert_eq!(touched(Edit::RemoveMaterial(r.grey)), [r.grey]);
    // No longer painted with what is then changed, and still touched.
    let bare = Edit::Batch(vec![
        Edit::Texture(clouds, noise(7.0)),
        Edit::Material(r.white, matte(1.0)),
        Edit::Finish(r.grey, Finish::default()),
        Edit::RemoveTexture(clouds),
    ]);
    assert_eq!(touched(bare), both);
    for unseen in [
        Edit::RenameTexture(clouds, "fog".into()),
        Edit::RenameMaterial(r.grey, "ash".into()),
        Edit::Remove(r.ball),
        Edit::AddTexture { name: "dust".into(), texture: noise(1.0), id: None },
    ] {
        assert!(touched(unseen.clone()).is_empty(), "{unseen:?}");
    }
}
