//! Is what is made where it should be, in one step, and gone without a trace when that is undone?

use std::path::Path;

use catoptra_core::scene::{EntityId, Role};
use catoptra_core::{Aabb, Operation};
use catoptra_tracer::Pool;

use super::starters::Addable;
use super::*;
use crate::document::Document;
use crate::loader::Opened;

const TEXT: &str = "camera \"eye\" { eye 0 5 25; target 0 0 0 }
matte \"m\" { color 0.5 } // shared
plane \"floor\" material=\"m\"
group \"things\" {
    turn 30 0 1 0
    move 1 0 0
    sphere \"ball\" material=\"m\" { center 0 1 0; radius 1 }
    box \"block\" material=\"m\" { min 2 0 0; max 3 1 1 }
}
point-light \"lamp\" { position 0 5 0; intensity 9 }
";

struct Bench {
    viewer: Viewer,
    folder: tempfile::TempDir,
}

impl Bench {
    fn new(selected: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("room.kdl");
        std::fs::write(&path, TEXT).unwrap();
        let mut viewer = Viewer::new(Opened::new(Document::open(&path).unwrap(), &Pool::new(1).unwrap()));
        viewer.size = (200, 100);
        let mut bench = Self { viewer, folder };
        bench.select(selected);
        bench
    }

    fn select(&mut self, names: &[&str]) {
        let ids = names.iter().map(|name| self.id(name)).collect();
        self.viewer.select_all(ids);
    }

    fn id(&self, name: &str) -> EntityId {
        self.viewer.document.scene().entity_named(name).unwrap_or_else(|| panic!("{name} is not there"))
    }

    fn bounds(&self, name: &str) -> Aabb {
        self.viewer.document.scene().world_bounds(self.id(name)).unwrap()
    }

    fn selected(&self) -> Vec<String> {
        let scene = self.viewer.document.scene();
        self.viewer.selection.ids().iter().filter_map(|id| scene.name(*id)).collect()
    }

    fn saved(&mut self) -> String {
        let path = self.viewer.document.save().unwrap();
        std::fs::read_to_string(path).unwrap()
    }

    /// What was done is one step, is saved and read again as it is, and leaves nothing behind when it is undone.
    fn assert_one_step(mut self) {
        let text = self.saved();
        let again = Document::open(&self.folder.path().join("room.kdl")).unwrap();
        let scene = self.viewer.document.scene();
        for id in scene.entities() {
            let name = scene.name(id).unwrap();
            let read = again.scene().entity_named(&name).unwrap_or_else(|| panic!("{name} is not in {text}"));
            assert_eq!(again.scene().shape(read), scene.shape(id), "{text}");
            assert_eq!(again.scene().light(read), scene.light(id), "{text}");
        }
        assert!(self.viewer.document.undo().is_some(), "{:?}", self.viewer.notice);
        assert_eq!(self.saved(), TEXT);
    }
}

fn near(a: &Aabb, b: &Aabb) -> bool {
    a.min.distance(b.min) < 1e-9 && a.max.distance(b.max) < 1e-9
}

#[test]
fn whatever_is_added_is_selected_and_one_step() {
    for (section, all) in Addable::sections() {
        for what in all.into_iter().filter(|what| *what != Addable::Model) {
            let mut bench = Bench::new(&[]);
            let before = bench.viewer.document.scene().entities().len();
            add::add(&mut bench.viewer, what, None);
            let scene = bench.viewer.document.scene();
            if section == "Materials" {
                assert_eq!(scene.materials().count(), 2, "{what:?}");
            } else {
                assert_eq!(scene.entities().len(), before + 1, "{what:?}: {:?}", bench.viewer.notice);
                assert_eq!(bench.selected(), [what.name()]);
            }
            bench.assert_one_step();
        }
    }
}

#[test]
fn a_shape_is_added_on_the_surface_that_is_seen() {
    let mut bench = Bench::new(&[]);
    let (x, y) = (20.0, 90.0);
    let seen = bench.viewer.pick(x, y).unwrap();
    assert_eq!(seen.entity, bench.id("floor"));
    add::add(&mut bench.viewer, Addable::Shape("box"), Some((x, y)));
    let bounds = bench.bounds("box");
    assert!(bounds.min.y.abs() < 1e-6, "it stands on the floor: {bounds:?}");
    assert!(bounds.centre().with_y(0.0).distance(seen.point) < 0.01, "{bounds:?} at {}", seen.point);
    let size = bounds.size().y;
    assert!((0.9..6.0).contains(&size), "{size} m");
}

#[test]
fn a_material_is_added_to_what_is_selected() {
    let mut bench = Bench::new(&["ball", "block"]);
    add::add(&mut bench.viewer, Addable::Material("glass"), None);
    let scene = bench.viewer.document.scene();
    let glass = scene.material_named("glass").unwrap();
    assert_eq!(scene.wearers(glass), [bench.id("ball"), bench.id("block")]);
    bench.assert_one_step();
}

#[test]
fn duplicates_stand_beside_their_originals_and_are_selected() {
    let mut bench = Bench::new(&["ball", "lamp"]);
    duplicate(&mut bench.viewer);
    assert_eq!(bench.selected(), ["ball 2", "lamp 2"]);
    let (old, new) = (bench.bounds("ball"), bench.bounds("ball 2"));
    assert!(new.min.x >= old.max.x && (new.min.y - old.min.y).abs() < 1e-6, "{old:?} and {new:?}");
    let scene = bench.viewer.document.scene();
    assert_eq!(scene.parent(bench.id("ball 2")), Some(bench.id("things")));
    bench.assert_one_step();
}

#[test]
fn a_group_that_is_duplicated_has_members_of_its_own() {
    let mut bench = Bench::new(&["ball", "things"]);
    duplicate(&mut bench.viewer);
    assert_eq!(bench.selected(), ["things 2"], "its member is in it");
    let scene = bench.viewer.document.scene();
    assert_eq!(scene.parent(bench.id("ball 2")), Some(bench.id("things 2")));
    bench.assert_one_step();
}

#[test]
fn grouping_and_ungrouping_leave_things_where_they_stand() {
    let mut bench = Bench::new(&["ball", "lamp"]);
    let ball = bench.bounds("ball");
    group(&mut bench.viewer);
    assert_eq!(bench.selected(), ["group"]);
    let scene = bench.viewer.document.scene();
    assert_eq!(scene.children(Some(bench.id("group"))), [bench.id("ball"), bench.id("lamp")]);
    assert!(near(&bench.bounds("ball"), &ball));
    bench.assert_one_step();
    let mut bench = Bench::new(&["things"]);
    let (ball, block) = (bench.bounds("ball"), bench.bounds("block"));
    ungroup(&mut bench.viewer);
    assert_eq!(bench.selected(), ["ball", "block"]);
    assert!(near(&bench.bounds("ball"), &ball) && near(&bench.bounds("block"), &block));
    assert_eq!(bench.viewer.document.scene().parent(bench.id("ball")), None);
    assert!(bench.viewer.document.undo().is_some());
    assert!(near(&bench.bounds("ball"), &ball));
}

#[test]
fn a_solid_is_made_of_what_is_selected() {
    let mut bench = Bench::new(&["ball", "block"]);
    add::add(&mut bench.viewer, Addable::Solid(Operation::Difference), None);
    let scene = bench.viewer.document.scene();
    let solid = bench.viewer.selection.active().unwrap();
    assert_eq!((scene.operation(solid), scene.role(solid)), (Some(Operation::Difference), Some(Role::Group)));
    assert_eq!(scene.children(Some(solid)).len(), 2);
}

#[test]
fn what_is_copied_can_be_pasted_here_and_elsewhere() {
    let mut bench = Bench::new(&["things"]);
    assert!(copy(&mut bench.viewer));
    let Some(Wanted::Copy(text)) = bench.viewer.wanted.take() else { panic!("nothing was copied") };
    assert!(text.contains("sphere \"ball\"") && text.contains("matte \"m\""), "{text}");
    let mut other = Bench::new(&[]);
    other.select(&["things"]);
    delete(&mut other.viewer);
    paste(&mut other.viewer, &text);
    assert!(near(&other.bounds("ball"), &bench.bounds("ball")), "where it stood");
    paste(&mut bench.viewer, &text);
    assert_eq!(bench.selected(), ["things 2"]);
    assert!(bench.bounds("things 2").min.x > bench.bounds("things").min.x, "beside the one that is there");
    assert_eq!(bench.viewer.document.scene().materials().count(), 1);
    bench.assert_one_step();
    let mut bench = Bench::new(&[]);
    paste(&mut bench.viewer, "no scene { at all");
    assert!(bench.viewer.document.is_saved());
    assert!(bench.viewer.notice.as_ref().unwrap().0.starts_with("nothing was pasted"));
}

#[test]
fn what_is_hidden_is_not_picked_and_comes_back() {
    let mut bench = Bench::new(&["ball"]);
    hide(&mut bench.viewer);
    assert!(bench.viewer.document.scene().is_hidden(bench.id("ball")));
    hide(&mut bench.viewer);
    assert!(!bench.viewer.document.scene().is_hidden(bench.id("ball")));
    hide(&mut bench.viewer);
    bench.select(&[]);
    show_all(&mut bench.viewer);
    assert_eq!(bench.selected(), ["ball"]);
    assert!(!bench.viewer.document.scene().is_hidden(bench.id("ball")));
}

#[test]
fn a_shared_material_is_made_single() {
    let mut bench = Bench::new(&["ball"]);
    let shared = bench.viewer.document.scene().material_of(bench.id("ball")).unwrap();
    make_single(&mut bench.viewer, shared);
    let scene = bench.viewer.document.scene();
    let own = scene.material_of(bench.id("ball")).unwrap();
    assert_eq!((scene.wearers(own).len(), scene.wearers(shared).len()), (1, 2));
    assert_eq!(scene.material(own), scene.material(shared));
    bench.assert_one_step();
}

#[test]
fn a_scene_without_a_thing_takes_new_ones() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("none.kdl");
    std::fs::write(Path::new(&path), "").unwrap();
    let mut viewer = Viewer::new(Opened::new(Document::open(&path).unwrap(), &Pool::new(1).unwrap()));
    viewer.size = (100, 100);
    add::add(&mut viewer, Addable::Shape("sphere"), Some((50.0, 50.0)));
    add::add(&mut viewer, Addable::Light("point-light"), Some((50.0, 50.0)));
    assert_eq!(viewer.document.scene().entities().len(), 2);
    viewer.document.save().unwrap();
    assert_eq!(Document::open(&path).unwrap().scene().entities().len(), 2);
}
