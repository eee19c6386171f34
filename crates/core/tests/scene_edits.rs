//! Does a scene hold together under any sequence of edits, is each taken back exactly, and does the log tell all?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::collections::{BTreeMap, BTreeSet};

use catoptra_core::geometry::{Plane, Sphere};
use catoptra_core::glam::DVec3;
use catoptra_core::{
    Camera, ChangeKind, Content, Edit, EntityId, Finish, History, Light, Material, MaterialId, Node, Part,
    Placement, Rgb, Role, Scene, Settings, Shape, Subject, Subtree, Texture, TextureId, TextureUse, Value,
    Values,
};
use proptest::prelude::*;

/// An edit in numbers, so that it can be drawn before the scene that it is for is known.
#[derive(Debug, Clone)]
struct Draw {
    kind: u8,
    /// Which entity, material, name, place ... it is about.
    picks: [u8; 4],
    value: f64,
}

fn draws(longest: usize) -> impl Strategy<Value = Vec<Draw>> {
    let draw =
        (0..31_u8, any::<[u8; 4]>(), 0.1..2.0).prop_map(|(kind, picks, value)| Draw { kind, picks, value });
    prop::collection::vec(draw, 1..longest)
}

fn shape(value: f64) -> Shape {
    if value > 1.5 {
        return Plane::new(DVec3::splat(value), DVec3::Y).unwrap().into();
    }
    Sphere::new(DVec3::X, value).unwrap().into()
}

fn light(value: f64) -> Light {
    let values = Values::new()
        .with("position", Value::Vector(DVec3::splat(value)))
        .with("intensity", Value::Color(Rgb::grey(value)));
    (Light::kind_named("point-light").unwrap().make)(&values).unwrap()
}

fn texture(value: f64) -> Texture {
    let values = Values::new().with("color", Value::Color(Rgb::grey(value / 2.0)));
    (Texture::kind_named("noise-texture").unwrap().make)(&values).unwrap()
}

fn material(value: f64) -> Material {
    let values = Values::new().with("color", Value::Color(Rgb::grey(value / 2.0)));
    (Material::kind_named("matte").unwrap().make)(&values).unwrap()
}

fn camera(value: f64) -> Camera {
    Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, value).unwrap()
}

fn placement(value: f64) -> Placement {
    Placement::IDENTITY.turned(DVec3::X, DVec3::ONE, value).unwrap().moved(DVec3::splat(value)).unwrap()
}

/// What an edit is about. One in eight entities and materials is not there; few names, so that they often clash.
impl Draw {
    fn entity(&self, scene: &Scene, pick: usize) -> EntityId {
        let all: Vec<_> = scene.entities().collect();
        let unknown = scene.next_entity_id();
        if self.picks[pick] % 8 == 7 {
            return unknown;
        }
        all.get(usize::from(self.picks[pick]) % all.len().max(1)).copied().unwrap_or(unknown)
    }

    /// An entity of that role, if there is one and the draw does not want another.
    fn entity_of(&self, scene: &Scene, role: Role) -> EntityId {
        let all: Vec<_> = scene.entities_of(role).collect();
        if all.is_empty() || self.picks[1] % 8 == 7 {
            return self.entity(scene, 0);
        }
        all[usize::from(self.picks[0]) % all.len()]
    }

    fn parent(&self, scene: &Scene) -> Option<EntityId> {
        let groups: Vec<_> = scene.entities_of(Role::Group).collect();
        match self.picks[2] % 8 {
            0 | 1 => None,
            2 => Some(self.entity(scene, 3)),
            _ => groups.get(usize::from(self.picks[2]) % groups.len().max(1)).copied(),
        }
    }

    fn texture(&self, scene: &Scene) -> TextureId {
        let all: Vec<_> = scene.textures().map(|(id, ..)| id).collect();
        if all.is_empty() || self.picks[2] % 8 == 7 {
            return scene.next_texture_id();
        }
        all[usize::from(self.picks[2]) % all.len()]
    }

    fn material(&self, scene: &Scene) -> MaterialId {
        let all: Vec<_> = scene.materials().map(|(id, ..)| id).collect();
        if all.is_empty() || self.picks[3] % 8 == 7 {
            return scene.next_material_id();
        }
        all[usize::from(self.picks[3]) % all.len()]
    }

    fn name(&self, pick: usize) -> String {
        match self.picks[pick] % 32 {
            0 => String::new(),
            letter => char::from(b'`' + letter % 26 + 1).to_string(),
        }
    }

    fn node(&self, scene: &Scene) -> Node {
        let members = || {
            vec![
                Node::light(self.name(1), light(self.value)),
                Node::shape(self.name(2), shape(self.value), self.material(scene)),
                Node::group(self.name(3), vec![Node::camera(self.name(3) + "!", camera(self.value))]),
            ]
        };
        let content = match self.picks[1] % 4 {
            0 => Content::Shape(shape(self.value), self.material(scene)),
            1 => Content::Light(light(self.value)),
            2 => Content::Camera(camera(self.value)),
            _ if self.picks[3].is_multiple_of(2) => Content::Group(members()),
            _ => Content::Group(Vec::new()),
        };
        Node::new(self.name(0), content).placed(placement(self.value))
    }

    fn edit(&self, scene: &Scene) -> Edit {
        let v = self.value;
        match self.kind {
            0..4 => {
                let index = (!self.picks[1].is_multiple_of(3)).then_some(usize::from(self.picks[1] % 5));
                Edit::insert(Subtree { node: self.node(scene), parent: self.parent(scene), index })
            }
            4 => Edit::Remove(self.entity(scene, 0)),
            5 => Edit::Shape(self.entity_of(scene, Role::Shape), shape(v)),
            6 => Edit::Light(self.entity_of(scene, Role::Light), light(v)),
            7 => Edit::Camera(self.entity_of(scene, Role::Camera), camera(v)),
            8 => Edit::Placement(self.entity(scene, 0), placement(v)),
            9 => Edit::MaterialOf(self.entity_of(scene, Role::Shape), self.material(scene)),
            10..14 => Edit::Parent(self.entity(scene, 0), self.parent(scene)),
            14 => Edit::Order(self.entity(scene, 0), usize::from(self.picks[1] % 6)),
            15 => Edit::Name(self.entity(scene, 0), self.name(1)),
            16 => Edit::Material(self.material(scene), material(v)),
            17 | 18 => Edit::AddMaterial { name: self.name(0), material: material(v), id: None },
            19 => Edit::RemoveMaterial(self.material(scene)),
            20 => Edit::RenameMaterial(self.material(scene), self.name(0)),
            21 | 22 => Edit::AddTexture { name: self.name(0), texture: texture(v), id: None },
            23 => Edit::Texture(self.texture(scene), texture(v)),
            24 => Edit::RemoveTexture(self.texture(scene)),
            25 => Edit::RenameTexture(self.texture(scene), self.name(0)),
            26 => {
                let color = Value::Color(Rgb::grey(v / 2.0)).textured(TextureUse::of(self.texture(scene)));
                Edit::Material(self.material(scene), material(v).with("color", color).unwrap())
            }
            27 => {
                let map = Value::Texture(self.texture(scene));
                Edit::Finish(self.material(scene), Finish::default().with("normal-map", map).unwrap())
            }
            28 => {
                let opacity = Value::Number(v / 2.0);
                Edit::Finish(self.material(scene), Finish::default().with("opacity", opacity).unwrap())
            }
            _ => Edit::Settings(Settings::new(Rgb::grey(v), u32::from(self.picks[0])).unwrap()),
        }
    }
}

/// All that there is to know of a scene through its own questions, part by part.
#[derive(Debug, Clone, PartialEq)]
struct Dump {
    parts: Vec<(Subject, String)>,
    trees: Vec<(Option<EntityId>, Vec<EntityId>)>,
    order: String,
}

fn dump(scene: &Scene) -> Dump {
    let entity = |id: EntityId| {
        let of = (scene.name(id), scene.role(id), scene.parent(id), scene.placement(id));
        let is = (scene.shape(id), scene.material_of(id), scene.light(id), scene.camera(id));
        (Subject::Entity(id), format!("{of:?} {is:?}"))
    };
    let material = |(id, name, material): (MaterialId, &str, &Material)| {
        (Subject::Material(id), format!("{name} {material:?} {:?}", scene.finish(id)))
    };
    let texture = |(id, name, texture): (TextureId, &str, &Texture)| {
        (Subject::Texture(id), format!("{name} {texture:?}"))
    };
    let settings = (Subject::Settings, format!("{:?}", scene.settings()));
    let groups = scene.entities_of(Role::Group).map(Some).chain([None]);
    Dump {
        parts: scene
            .entities()
            .map(entity)
            .chain(scene.materials().map(material))
            .chain(scene.textures().map(texture))
            .chain([settings])
            .collect(),
        trees: groups.map(|group| (group, scene.children(group))).collect(),
        order: format!("{:?} {:?}", scene.walk(), scene.main_camera()),
    }
}

/// The parts that are not the same in both, and those that are in one only.
fn differing(a: &Dump, b: &Dump) -> BTreeSet<Subject> {
    let only = |a: &Dump, b: &Dump| -> Vec<Subject> {
        a.parts.iter().filter(|part| !b.parts.contains(part)).map(|(subject, _)| *subject).collect()
    };
    only(a, b).into_iter().chain(only(b, a)).collect()
}

/// Names find what they name, members and parents agree, every entity is in the tree and in the world once, and
/// every worn material is there.
fn holds_together(scene: &Scene) {
    let mut walked = scene.walk();
    walked.sort_unstable();
    assert_eq!(walked, scene.entities().collect::<Vec<_>>());
    let of = |role| scene.entities_of(role).collect::<Vec<_>>();
    assert_eq!(scene.shapes().into_iter().map(|s| s.0).collect::<Vec<_>>(), of(Role::Shape));
    assert_eq!(scene.lights().into_iter().map(|l| l.0).collect::<Vec<_>>(), of(Role::Light));
    assert_eq!(scene.cameras().into_iter().map(|c| c.0).collect::<Vec<_>>(), of(Role::Camera));
    for id in scene.entities() {
        assert_eq!(scene.entity_named(&scene.name(id).unwrap()), Some(id));
        assert!(scene.children(scene.parent(id)).contains(&id));
        assert!(scene.children(Some(id)).iter().all(|&member| scene.parent(member) == Some(id)));
        assert!(scene.ancestors(id).count() <= Scene::MAX_DEPTH);
        assert!(scene.material_of(id).is_none_or(|material| scene.find_material(material).is_some()));
    }
    for (id, name, _) in scene.textures() {
        assert_eq!((scene.texture_named(name), scene.texture_name(id)), (Some(id), Some(name)));
    }
    for (id, _, material) in scene.materials() {
        let finish = Part::values(&scene.finish(id));
        for texture in material.values().textures().chain(finish.textures()) {
            assert!(scene.find_texture(texture).is_some() && scene.painted_with(texture).contains(&id));
        }
    }
    for (id, name, _) in scene.materials() {
        assert_eq!(scene.material_named(name), Some(id));
    }
}

/// The log without the numbers of edits, which are different in every scene.
fn changed(scene: &Scene) -> Vec<(Subject, ChangeKind)> {
    scene.changes_since(0).iter().map(|change| (change.subject, change.what)).collect()
}

/// Every part in world space under its entity and the number of the edit that touched it last.
fn touched(scene: &Scene) -> BTreeMap<(EntityId, u64), String> {
    let shapes =
        scene.world_shapes().into_iter().map(|(s, m)| ((s.id, s.touched), format!("{:?} {m}", s.part)));
    let lights = scene.world_lights().into_iter().map(|l| ((l.id, l.touched), format!("{:?}", l.part)));
    let cameras = scene.world_cameras().into_iter().map(|c| ((c.id, c.touched), format!("{:?}", c.part)));
    shapes.chain(lights).chain(cameras).collect()
}

proptest! {
    #[test]
    fn what_no_edit_touched_is_the_same(before in draws(40), draws in draws(10), others in draws(10)) {
        let mut scene = Scene::new();
        for draw in &before {
            let _ = scene.apply(draw.edit(&scene));
        }
        let mut states = vec![touched(&scene)];
        for draws in [draws, others] {
            let mut clone = scene.clone();
            for draw in &draws {
                let _ = clone.apply(draw.edit(&clone));
                states.push(touched(&clone));
            }
        }
        let mut known = BTreeMap::new();
        for (key, part) in states.into_iter().flatten() {
            prop_assert_eq!(known.entry(key).or_insert_with(|| part.clone()), &part, "{:?}", key);
        }
    }

    #[test]
    fn undoing_all_restores_every_state_on_the_way(draws in draws(60)) {
        let mut scene = Scene::new();
        let mut history = History::new();
        let mut states = vec![dump(&scene)];
        for draw in &draws {
            let edit = draw.edit(&scene);
            let accepted = history.apply(&mut scene, edit).is_ok();
            holds_together(&scene);
            if accepted {
                states.push(dump(&scene));
            } else {
                prop_assert_eq!(&dump(&scene), states.last().unwrap());
            }
        }
        let last = states.clone();
        while let Some(state) = states.pop() {
            prop_assert_eq!(dump(&scene), state);
            prop_assert_eq!(history.undo(&mut scene), !states.is_empty());
            holds_together(&scene);
        }
        for state in last.into_iter().skip(1) {
            prop_assert!(history.redo(&mut scene));
            prop_assert_eq!(dump(&scene), state);
        }
    }

    #[test]
    fn a_batch_is_all_or_nothing_and_inverts(before in draws(30), draws in draws(6)) {
        let mut scene = Scene::new();
        for draw in &before {
            let _ = scene.apply(draw.edit(&scene));
        }
        // Drawn on a scene that has seen the first ones, so that batches are not all refused.
        let mut ahead = scene.clone();
        let mut edits = Vec::new();
        for draw in &draws {
            edits.push(draw.edit(&ahead));
            let _ = ahead.apply(edits[edits.len() - 1].clone());
        }
        let (old, log) = (dump(&scene), scene.changes_since(0).len());
        match scene.apply(Edit::Batch(edits)) {
            Ok(inverse) => {
                prop_assert_eq!(dump(&scene), dump(&ahead));
                scene.apply(inverse).unwrap();
            }
            Err(_) => prop_assert_eq!(scene.changes_since(0).len(), log),
        }
        holds_together(&scene);
        prop_assert_eq!(dump(&scene), old);
    }

    #[test]
    fn the_log_names_every_changed_part(draws in draws(60), from in 0..60_usize) {
        let mut scene = Scene::new();
        let mut since = (scene.revision(), dump(&scene));
        for (i, draw) in draws.iter().enumerate() {
            if i == from {
                since = (scene.revision(), dump(&scene));
            }
            let _ = scene.apply(draw.edit(&scene));
        }
        let now = dump(&scene);
        let named: BTreeSet<_> = scene.changes_since(since.0).iter().map(|change| change.subject).collect();
        for subject in differing(&since.1, &now) {
            prop_assert!(named.contains(&subject), "{subject:?} changed, and the log names {named:?}");
        }
        let moves = [ChangeKind::Added, ChangeKind::Removed, ChangeKind::Parent, ChangeKind::Order];
        if since.1.trees != now.trees {
            prop_assert!(scene.changes_since(since.0).iter().any(|change| moves.contains(&change.what)));
        }
    }

    #[test]
    fn a_drag_is_taken_back_in_one_step(before in draws(30), draws in draws(20)) {
        let mut scene = Scene::new();
        for draw in &before {
            let _ = scene.apply(draw.edit(&scene));
        }
        let old = dump(&scene);
        let mut history = History::new();
        for draw in &draws {
            let edit = draw.edit(&scene);
            let _ = history.apply_continuing(&mut scene, edit, 1);
        }
        let dragged = dump(&scene);
        if history.undo(&mut scene) {
            prop_assert_eq!(dump(&scene), old);
            prop_assert!(!history.can_undo());
            prop_assert!(history.redo(&mut scene));
        }
        prop_assert_eq!(dump(&scene), dragged);
    }

    #[test]
    fn a_clone_goes_its_own_way_with_the_same_outcome(before in draws(30), draws in draws(10)) {
        let mut scene = Scene::new();
        for draw in &before {
            let _ = scene.apply(draw.edit(&scene));
        }
        let mut clone = scene.clone();
        prop_assert_eq!(&clone, &scene);
        for draw in &draws {
            let edit = draw.edit(&scene);
            prop_assert_eq!(clone.apply(edit.clone()).is_ok(), scene.apply(edit).is_ok());
        }
        prop_assert_eq!(dump(&clone), dump(&scene));
        prop_assert_eq!(changed(&clone), changed(&scene));
        prop_assert_eq!(clone.next_entity_id(), scene.next_entity_id());
    }
}
