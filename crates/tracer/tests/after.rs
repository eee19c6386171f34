//! Is a snapshot that takes over from an earlier one the same as one made anew, and does it tell all that differs?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::collections::BTreeSet;
use std::sync::{Arc, LazyLock};

use catoptra_core::geometry::{Cuboid, Mesh, Plane, Sphere, Triangle};
use catoptra_core::glam::DVec3;
use catoptra_core::light::{AmbientLight, PointLight};
use catoptra_core::material::{Checker, Matte};
use catoptra_core::{
    Aabb, Camera, Edit, EntityId, Light, Material, MaterialId, MeshSource, Node, Placement, Rgb, Scene,
    Settings, Shape, Subtree, TriangleMesh,
};
use catoptra_tracer::{Changed, Pool, Presence, Snapshot, SnapshotDiff};
use proptest::prelude::*;

static POOL: LazyLock<Pool> = LazyLock::new(|| Pool::new(1).unwrap());

/// Two meshes, each shared by all shapes that are one.
static MESHES: LazyLock<[Arc<TriangleMesh>; 2]> = LazyLock::new(|| {
    [1.0, 2.0].map(|size| {
        let positions = vec![[0.0; 3], [size, 0.0, 0.0], [0.0, size, 0.0], [0.0, 0.0, size]];
        Arc::new(TriangleMesh::new(positions, vec![[0, 1, 2], [0, 1, 3], [0, 2, 3]], None, None).unwrap())
    })
});

/// An edit in numbers, so that it can be drawn before the scene that it is for is known.
#[derive(Debug, Clone)]
struct Draw {
    kind: u8,
    /// Which entity, material, group ... it is about.
    picks: [u8; 3],
    value: f64,
}

fn draws(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Draw>> {
    // Few values, so that some edits change nothing and others take back what was done.
    let value = prop::sample::select(vec![0.25, 0.5, 0.75, -0.0]);
    let draw =
        (0..18_u8, any::<[u8; 3]>(), value).prop_map(|(kind, picks, value)| Draw { kind, picks, value });
    prop::collection::vec(draw, count)
}

fn shape(kind: u8, v: f64) -> Shape {
    let at = DVec3::new(v, 1.0, -v);
    match kind % 6 {
        0 => Sphere::new(at, 0.5 + v).unwrap().into(),
        1 => Plane::new(at, DVec3::new(v, 1.0, 0.0)).unwrap().into(),
        2 => Cuboid::new(at, at + DVec3::splat(1.0 + v)).unwrap().into(),
        3 => Triangle::new(at, at + DVec3::X, at + DVec3::Y).unwrap().into(),
        kind => {
            let mesh = Arc::clone(&MESHES[usize::from(kind) % 2]);
            Mesh::new(MeshSource { path: "mesh.ply".into(), mesh }).into()
        }
    }
}

fn light(kind: u8, v: f64) -> Light {
    if kind.is_multiple_of(3) {
        return AmbientLight::new(Rgb::grey(v.abs())).unwrap().into();
    }
    PointLight::new(DVec3::splat(v), Rgb::grey(1.0 + v)).unwrap().into()
}

fn material(kind: u8, v: f64) -> Material {
    if kind.is_multiple_of(2) {
        return Matte::new(Rgb::grey(v.abs())).unwrap().into();
    }
    Checker::new(Rgb::WHITE, Rgb::BLACK, 0.5 + v).unwrap().into()
}

fn camera(v: f64) -> Camera {
    Camera::look_at(DVec3::new(v, 2.0, 5.0), DVec3::ZERO, DVec3::Y, 0.5 + v).unwrap()
}

/// Moved, turned as well, or as far away as makes the origin follow a camera.
fn placement(kind: u8, v: f64) -> Placement {
    let moved = Placement::IDENTITY.moved(DVec3::new(v, 0.0, 1.0)).unwrap();
    match kind % 4 {
        0 => moved.turned(DVec3::ZERO, DVec3::ONE, v).unwrap(),
        1 => moved.moved(DVec3::splat(1024.0 * 1024.0 * 16.0)).unwrap(),
        2 => Placement::IDENTITY,
        _ => moved,
    }
}

impl Draw {
    fn entity(&self, scene: &Scene) -> EntityId {
        let all: Vec<_> = scene.entities().collect();
        all.get(usize::from(self.picks[0]) % all.len().max(1)).copied().unwrap_or(scene.next_entity_id())
    }

    fn material(&self, scene: &Scene) -> MaterialId {
        let all: Vec<_> = scene.materials().map(|(id, ..)| id).collect();
        all[usize::from(self.picks[1]) % all.len()]
    }

    fn group(&self, scene: &Scene) -> Option<EntityId> {
        ["inner", "outer"].get(usize::from(self.picks[2]) % 3).and_then(|name| scene.entity_named(name))
    }

    fn node(&self, scene: &Scene) -> Node {
        let name = scene.free_name("new");
        match self.picks[1] % 4 {
            0 => Node::light(name, light(self.picks[0], self.value)),
            1 => Node::camera(name, camera(self.value)),
            _ => Node::shape(name, shape(self.picks[0], self.value), self.material(scene)),
        }
    }

    fn edit(&self, scene: &Scene) -> Edit {
        let (v, id) = (self.value, self.entity(scene));
        match self.kind {
            0..3 => Edit::insert(Subtree { parent: self.group(scene), ..self.node(scene).into() }),
            3 => Edit::Remove(id),
            4 => Edit::Shape(id, shape(self.picks[1], v)),
            5 => Edit::Light(id, light(self.picks[1], v)),
            6 => Edit::Camera(id, camera(v)),
            7..10 => Edit::Placement(id, placement(self.picks[1], v)),
            10 => Edit::Placement(self.group(scene).unwrap_or(id), placement(self.picks[1], v)),
            11 => Edit::MaterialOf(id, self.material(scene)),
            12 => Edit::Material(self.material(scene), material(self.picks[2], v)),
            13 => Edit::AddMaterial {
                name: scene.free_material_name("new"),
                material: material(self.picks[2], v),
                id: None,
            },
            14 => Edit::RemoveMaterial(self.material(scene)),
            15 => Edit::Parent(id, self.group(scene)),
            16 => Edit::Order(id, usize::from(self.picks[1]) % 4),
            _ => Edit::Settings(Settings::new(Rgb::grey(v.abs()), u32::from(self.picks[1] % 3)).unwrap()),
        }
    }
}

/// A group in a group, one of each kind of shape and light, and a camera.
fn room() -> Scene {
    let mut scene = Scene::new();
    let materials = [0, 1].map(|k| scene.add_material(&format!("m{k}"), material(k, 0.5)).unwrap());
    let outer = scene.add_group("outer", None).unwrap();
    let inner = scene.add_group("inner", Some(outer)).unwrap();
    for kind in 0..6 {
        let parent = [None, Some(outer), Some(inner)][usize::from(kind) % 3];
        let material = materials[usize::from(kind) % 2];
        scene.add_shape(&format!("s{kind}"), shape(kind, 0.25), material, parent).unwrap();
    }
    scene.add_light("sky", light(0, 0.25), None).unwrap();
    scene.add_light("lamp", light(1, 0.25), Some(inner)).unwrap();
    scene.add_camera("eye", camera(0.25), Some(outer)).unwrap();
    scene
}

/// Does edits; every other refused one aside, one in four is taken back at once.
fn edit(scene: &mut Scene, draws: &[Draw]) {
    for draw in draws {
        if let Ok(inverse) = scene.apply(draw.edit(scene))
            && draw.picks[0].is_multiple_of(4)
        {
            scene.apply(inverse).unwrap();
        }
    }
}

/// By both scenes' own answers: what is not the same under an id.
fn differing<I: Ord + Copy, T: PartialEq>(ids: BTreeSet<I>, of: impl Fn(I) -> [Option<T>; 2]) -> Vec<I> {
    ids.into_iter().filter(|&id| of(id)[0] != of(id)[1]).collect()
}

fn bounds_of(scene: &Scene, id: EntityId) -> Option<Aabb> {
    scene.world_shape(id).and_then(|shape| shape.bounds())
}

fn assert_tells_all(diff: &SnapshotDiff, old: &Scene, new: &Scene) {
    let scenes = [old, new];
    let ids: BTreeSet<EntityId> = scenes.iter().flat_map(|scene| scene.entities()).collect();
    let look = |scene: &Scene, id| scene.material_of(id).map(|material| scene.material(material).clone());
    let seen = |id| scenes.map(|scene| scene.world_shape(id).map(|shape| (shape, look(scene, id))));
    assert_eq!(diff.shapes.iter().map(|s| s.entity).collect::<Vec<_>>(), differing(ids.clone(), seen));
    for shape in &diff.shapes {
        let [was, is] = scenes.map(|scene| scene.world_shape(shape.entity));
        let [wore, wears] = scenes.map(|scene| look(scene, shape.entity));
        assert_eq!((shape.shape, shape.material), (was != is, wore != wears), "{shape:?}");
        let boxes = scenes.map(|scene| bounds_of(scene, shape.entity));
        assert_eq!([shape.before, shape.after], boxes, "{shape:?}");
        let expected = match (was.is_some(), is.is_some()) {
            (false, _) => Presence::Appeared,
            (_, false) => Presence::Disappeared,
            _ => Presence::Stayed,
        };
        assert_eq!(shape.presence, expected, "{shape:?}");
    }
    let lit = |id| scenes.map(|scene| scene.world_light(id));
    assert_eq!(diff.lights.iter().map(|l| l.id).collect::<Vec<_>>(), differing(ids.clone(), lit));
    assert!(diff.lights.iter().all(|l| [l.before.clone(), l.after.clone()] == lit(l.id)));
    let looks = |id| scenes.map(|scene| scene.world_camera(id));
    assert_eq!(diff.cameras.iter().map(|c| c.id).collect::<Vec<_>>(), differing(ids, looks));
    let ids: BTreeSet<MaterialId> =
        scenes.iter().flat_map(|scene| scene.materials().map(|(id, ..)| id)).collect();
    let values = |id| scenes.map(|scene| scene.find_material(id).cloned());
    assert_eq!(diff.materials.iter().map(|m| m.id).collect::<Vec<_>>(), differing(ids, values));
    let [before, after] = scenes.map(Scene::settings);
    let [a, b] = [before.background(), after.background()];
    assert_eq!(diff.background, (a != b).then_some(Changed { before: a, after: b }));
    let [a, b] = [before.max_depth(), after.max_depth()];
    assert_eq!(diff.max_depth, (a != b).then_some(Changed { before: a, after: b }));
}

/// Everything in it: numbers are written so that they read back bit for bit.
fn all_of(snapshot: &Snapshot) -> String {
    format!("{snapshot:?}")
}

proptest! {
    #[test]
    fn taking_over_changes_no_bit_and_the_difference_is_told(steps in prop::collection::vec(draws(1..5), 1..6)) {
        let mut scene = room();
        let mut earlier = Snapshot::extract(&scene, &POOL);
        for draws in &steps {
            let old = scene.clone();
            edit(&mut scene, draws);
            let (snapshot, diff) = Snapshot::after(&scene, &earlier, &POOL);
            prop_assert_eq!(all_of(&snapshot), all_of(&Snapshot::extract(&scene, &POOL)));
            assert_tells_all(&diff, &old, &scene);
            let moved = |a, b| (a != b).then_some(Changed { before: a, after: b });
            prop_assert_eq!(diff.origin, moved(earlier.origin(), snapshot.origin()));
            prop_assert_eq!(diff.frame, moved(earlier.frame(), snapshot.frame()));
            prop_assert_eq!(diff.ambient.is_some(), earlier.ambient() != snapshot.ambient());
            earlier = snapshot;
        }
    }

    #[test]
    fn scenes_that_went_different_ways_are_told_apart(ours in draws(1..6), theirs in draws(1..6)) {
        let (mut mine, mut other) = (room(), room());
        other.clone_from(&mine);
        edit(&mut mine, &ours);
        edit(&mut other, &theirs);
        let earlier = Snapshot::extract(&mine, &POOL);
        let (snapshot, diff) = Snapshot::after(&other, &earlier, &POOL);
        prop_assert_eq!(all_of(&snapshot), all_of(&Snapshot::extract(&other, &POOL)));
        assert_tells_all(&diff, &mine, &other);
    }
}

/// The property above means little if the origin never moves.
#[test]
fn the_origin_moves_with_what_is_seen() {
    let mut scene = room();
    let earlier = Snapshot::extract(&scene, &POOL);
    let outer = scene.entity_named("outer").unwrap();
    scene.apply(Edit::Placement(outer, placement(1, 0.25))).unwrap();
    let (snapshot, diff) = Snapshot::after(&scene, &earlier, &POOL);
    assert_eq!(diff.origin, Some(Changed { before: DVec3::ZERO, after: snapshot.origin() }));
    assert!(snapshot.origin() != DVec3::ZERO);
}

#[test]
fn nothing_done_is_no_difference() {
    let mut scene = room();
    let earlier = Snapshot::extract(&scene, &POOL);
    let ball = scene.entity_named("s0").unwrap();
    scene.apply(Edit::Name(ball, "ball".into())).unwrap();
    let inverse = scene.apply(Edit::Shape(ball, shape(0, 0.75))).unwrap();
    scene.apply(inverse).unwrap();
    let (snapshot, diff) = Snapshot::after(&scene, &earlier, &POOL);
    assert!(diff.is_empty(), "{diff:?}");
    assert_eq!(snapshot.revision(), scene.revision());
}
