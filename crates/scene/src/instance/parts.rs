//! What have the things in a model become, and can `part` nodes say it?

use std::collections::{HashMap, HashSet};

use catoptra_core::Placement;
use catoptra_core::scene::{Content, EntityId, Flags, MaterialId, Node, Scene};

use super::{Instance, ModelSource, full_name};
use crate::build::Id;
use crate::outline::Part;
use crate::state::State;

/// One thing in a model file, by the file alone.
#[derive(Debug, Clone)]
pub(crate) struct FilePart {
    name: String,
    /// Unless the text leaves it out.
    pub(super) entity: Option<EntityId>,
    /// The group that it lies in, by its place in the list.
    parent: Option<usize>,
    placement: Placement,
    material: Option<MaterialId>,
    content: Option<Part>,
}

/// What a `part` node has to say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Wish {
    /// What it says already: the scene has never had this part, or its group is gone.
    Whatever,
    /// That the part is left out.
    Removed,
    /// Where it stands, what it wears, and whether it is hidden or locked.
    There { placement: Placement, material: Option<MaterialId>, flags: Flags },
}

/// One thing in a model as the scene has it.
#[derive(Debug, Clone)]
pub(crate) struct PartNow<'a> {
    /// In the file.
    pub(crate) name: &'a str,
    pub(crate) entity: Option<EntityId>,
    /// By the file.
    pub(crate) placement: Placement,
    pub(crate) material: Option<MaterialId>,
    pub(crate) wish: Wish,
    /// Whether something lies in it that the file does not have.
    pub(crate) has_guests: bool,
}

impl PartNow<'_> {
    /// Whether no node need tell of it.
    pub(crate) fn is_as_in_file(&self) -> bool {
        let (placement, material) = (self.placement, self.material);
        let there = Wish::There { placement, material, flags: Flags::default() };
        self.wish == there && !self.has_guests
    }
}

impl Instance {
    /// Finds the entities that came of it, when nothing else lies in it yet.
    pub(crate) fn settle(&mut self, scene: &Scene, source: &ModelSource, root: EntityId) {
        self.root = Some(root);
        let mut entities = HashMap::new();
        let mut groups = vec![root];
        while let Some(group) = groups.pop() {
            for member in scene.children(Some(group)) {
                entities.extend(scene.name(member).map(|name| (name, member)));
                groups.push(member);
            }
        }
        let mut rest: Vec<(&Node, Option<usize>)> =
            source.model.nodes.iter().rev().map(|node| (node, None)).collect();
        while let Some((node, parent)) = rest.pop() {
            let place = self.parts.len();
            let entity = entities.get(&full_name(&self.name, &node.name)).copied();
            let state = entity.and_then(|id| State::of(scene, Id::Entity(id)));
            let material = match &node.content {
                Content::Shape(_, worn) => Some(self.material(*worn)),
                _ => None,
            };
            self.parts.push(FilePart {
                name: node.name.clone(),
                entity,
                parent,
                placement: node.placement,
                material,
                content: state.map(|state| state.part),
            });
            rest.extend(node.members().iter().rev().map(|member| (member, Some(place))));
        }
    }

    /// What a thing in the file has become, unless the text leaves it out.
    pub(crate) fn entity(&self, name: &str) -> Option<EntityId> {
        self.parts.iter().find(|part| part.name == name)?.entity
    }

    /// What has become of everything in the file, in its order; nothing where the model's node and `part` nodes in it cannot say
    /// it. Textures and materials may have changed, but for their names: they can have nodes of their own.
    pub(crate) fn now(&self, scene: &Scene) -> Option<Vec<PartNow<'_>>> {
        let root = self.root.filter(|root| scene.name(*root).as_ref() == Some(&self.name))?;
        if !self.has_its_looks(scene) || !self.is_in_order(scene, root) {
            return None;
        }
        let own: HashSet<EntityId> = self.parts.iter().filter_map(|part| part.entity).collect();
        self.parts
            .iter()
            .map(|part| {
                let wish = self.wish(scene, root, part)?;
                let guests =
                    part.entity.is_some_and(|id| scene.children(Some(id)).iter().any(|m| !own.contains(m)));
                Some(PartNow {
                    name: &part.name,
                    entity: part.entity,
                    placement: part.placement,
                    material: part.material,
                    wish,
                    has_guests: guests,
                })
            })
            .collect()
    }

    fn wish(&self, scene: &Scene, root: EntityId, part: &FilePart) -> Option<Wish> {
        let group = match part.parent {
            Some(parent) => self.parts[parent].entity,
            None => Some(root),
        };
        let Some(id) = part.entity else { return Some(Wish::Whatever) };
        let Some(now) = State::of(scene, Id::Entity(id)) else {
            let is_there = group.is_some_and(|group| scene.contains(group));
            return Some(if is_there { Wish::Removed } else { Wish::Whatever });
        };
        let same = scene.parent(id) == group
            && now.name == full_name(&self.name, &part.name)
            && Some(&now.part) == part.content.as_ref();
        let material = scene.material_of(id);
        same.then_some(Wish::There { placement: now.placement, material, flags: now.flags })
    }

    /// Whether in every group the members of the file come first and in the file's order: so they will when the text is read.
    fn is_in_order(&self, scene: &Scene, root: EntityId) -> bool {
        let places: HashMap<EntityId, usize> =
            self.parts.iter().enumerate().filter_map(|(at, part)| Some((part.entity?, at))).collect();
        let groups = self.parts.iter().filter_map(|part| part.entity).filter(|id| scene.contains(*id));
        std::iter::once(root).chain(groups).all(|group| {
            let place = |id: &EntityId| places.get(id).copied().unwrap_or(usize::MAX);
            scene.children(Some(group)).iter().map(place).is_sorted()
        })
    }
}
