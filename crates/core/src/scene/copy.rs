//! How is a part of a scene, or all of it, taken out as a copy?

use std::collections::HashSet;

use super::component::Touched;
use super::{Content, EntityId, Node, Scene, Subtree};

impl Scene {
    /// A copy of an entity with its members, under the ids and names they have here.
    #[must_use]
    pub fn node(&self, id: EntityId) -> Option<Node> {
        let content = if let Some((shape, material)) = self.shape(id).zip(self.material_of(id)) {
            Content::Shape(shape, material)
        } else if let Some(light) = self.light(id) {
            Content::Light(light)
        } else if let Some(camera) = self.camera(id) {
            Content::Camera(camera)
        } else {
            let members =
                self.children(Some(id)).into_iter().filter_map(|member| self.node(member)).collect();
            match self.operation(id) {
                Some(operation) => Content::Solid(operation, members),
                None => Content::Group(members),
            }
        };
        Some(Node {
            id: Some(id),
            name: self.name(id)?,
            placement: self.placement(id)?,
            flags: self.flags(id),
            content,
        })
    }

    /// A copy of an entity with its members that can be inserted beside it, as its next sibling: with new ids,
    /// and with names that are free.
    #[must_use]
    pub fn duplicate(&self, id: EntityId) -> Option<Subtree> {
        let node = self.fresh(self.node(id)?, &mut HashSet::new());
        Some(Subtree { node, parent: self.parent(id), index: Some(self.index_of(id) + 1) })
    }

    /// A node that can be inserted beside all that is there: with new ids, and with names that are free and not among
    /// `taken`. They join `taken`, so that several nodes can be made ready for one edit.
    #[must_use]
    pub fn fresh(&self, mut node: Node, taken: &mut HashSet<String>) -> Node {
        node.each_mut(&mut |copy| {
            copy.id = None;
            copy.name = free_name(&copy.name, |name| taken.contains(name) || self.by_name.contains_key(name));
            taken.insert(copy.name.clone());
        });
        node
    }

    /// `wish`, or where an entity has that name already, `wish` with the first free number from 2 behind it. An
    /// empty wish stays empty, and will be refused.
    #[must_use]
    pub fn free_name(&self, wish: &str) -> String {
        free_name(wish, |name| self.by_name.contains_key(name))
    }

    /// The same for materials.
    #[must_use]
    pub fn free_material_name(&self, wish: &str) -> String {
        free_name(wish, |name| self.material_named(name).is_some())
    }

    /// The same for textures.
    #[must_use]
    pub fn free_texture_name(&self, wish: &str) -> String {
        free_name(wish, |name| self.texture_named(name).is_some())
    }
}

/// "ball", "ball 2", "ball 3" ...: the first that is free. A wish that ends in such a number counts on from it.
fn free_name(wish: &str, is_taken: impl Fn(&str) -> bool) -> String {
    if !is_taken(wish) {
        return wish.to_owned();
    }
    let numbered = wish.rsplit_once(' ').and_then(|(stem, number)| Some((stem, number.parse::<u32>().ok()?)));
    let (stem, number) = numbered.unwrap_or((wish, 1));
    // As many names as a scene can have entities, and one more: one of them is free.
    (u64::from(number) + 1..)
        .map(|number| format!("{stem} {number}"))
        .find(|name| !is_taken(name))
        .unwrap_or_default()
}

/// A scene of its own with the same ids, names, materials, textures, settings, revision and log.
impl Clone for Scene {
    fn clone(&self) -> Self {
        let mut copy = Self {
            materials: self.materials.clone(),
            textures: self.textures.clone(),
            settings: self.settings,
            ..Self::new()
        };
        for root in &self.roots {
            if let Some(node) = self.node(*root) {
                copy.spawn(node, None);
            }
        }
        for (id, entity) in &copy.entities {
            if let (Some(touched), Ok(copied)) =
                (self.component::<Touched>(*id), copy.world.query_one_mut::<&mut Touched>(*entity))
            {
                *copied = touched;
            }
        }
        copy.roots.clone_from(&self.roots);
        copy.ids = self.ids;
        copy.log.clone_from(&self.log);
        copy.revision = self.revision;
        copy
    }
}

/// Scenes are equal if they have the same parts, under the same ids and names and in the same order, and the same
/// settings, by whatever edits they got there.
impl PartialEq for Scene {
    fn eq(&self, other: &Self) -> bool {
        self.roots == other.roots
            && self.settings == other.settings
            && self.materials.iter().eq(other.materials.iter())
            && self.textures().eq(other.textures())
            && self.roots.iter().all(|&root| self.node(root) == other.node(root))
    }
}

impl std::fmt::Debug for Scene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let roots: Vec<Node> = self.roots.iter().filter_map(|&id| self.node(id)).collect();
        f.debug_struct("Scene")
            .field("roots", &roots)
            .field("materials", &self.materials.iter().collect::<Vec<_>>())
            .field("textures", &self.textures().collect::<Vec<_>>())
            .field("settings", &self.settings)
            .field("revision", &self.revision)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{Room, light, matte};
    use super::super::{Edit, Subtree};

    #[test]
    fn a_duplicate_stands_beside_its_original_under_free_names() {
        let mut r = Room::new();
        let copy = r.scene.duplicate(r.things).unwrap();
        r.scene.apply(Edit::insert(copy)).unwrap();
        let names: Vec<_> = r.scene.walk().into_iter().filter_map(|id| r.scene.name(id)).collect();
        let expected = "floor, things, ball, lamps, lamp, things 2, ball 2, lamps 2, lamp 2, eye";
        assert_eq!(names.join(", "), expected);
    }

    #[test]
    fn a_duplicate_has_the_parts_of_its_original() {
        let mut r = Room::new();
        let copy = r.scene.duplicate(r.ball).unwrap();
        assert_eq!(copy, Subtree { node: copy.node.clone(), parent: Some(r.things), index: Some(1) });
        r.scene.apply(Edit::insert(copy)).unwrap();
        let twin = r.scene.entity_named("ball 2").unwrap();
        assert_eq!(r.scene.shape(twin), r.scene.shape(r.ball));
        assert_eq!(r.scene.material_of(twin), Some(r.white));
    }

    #[test]
    fn free_names_count_on() {
        let mut r = Room::new();
        assert_eq!(r.scene.free_name("cup"), "cup");
        for expected in ["lamp 2", "lamp 3", "lamp 4"] {
            let name = r.scene.free_name(if expected == "lamp 4" { "lamp 2" } else { "lamp" });
            assert_eq!(name, expected);
            r.scene.add_light(&name, light(1.0), None).unwrap();
        }
        assert_eq!(r.scene.free_material_name("white"), "white 2");
    }

    #[test]
    fn a_clone_is_equal_and_apart() {
        let mut r = Room::new();
        let clone = r.scene.clone();
        assert_eq!(clone, r.scene);
        assert_eq!(clone.changes_since(0), r.scene.changes_since(0));
        r.scene.apply(Edit::Material(r.grey, matte(0.1))).unwrap();
        assert_ne!(clone, r.scene);
    }

    #[test]
    fn what_it_prints_names_every_part() {
        let r = Room::new();
        let text = format!("{:?}", r.scene);
        for name in ["floor", "things", "ball", "lamps", "lamp", "eye", "white", "grey"] {
            assert!(text.contains(&format!("\"{name}\"")), "{name} in {text}");
        }
    }
}
