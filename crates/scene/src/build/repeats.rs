//! How does a repeat become a group of copies?
//!
//! The repeat "posts" is a group of groups "posts/1", "posts/2" and so on, in which what stands in the repeat has that name before
//! its own: "posts/2/ball". What is large, as meshes are, all copies share.

use catoptra_core::Placement;
use catoptra_core::scene::{Content, Node, Role};

use super::{Builder, Id};
use crate::instance::{self, full_name};
use crate::outline::{Item, Outline, Sort};
use crate::read::next;
use crate::repeated::Repeated;

/// The most entities that all repeats of a text make together.
const MOST: u64 = 200_000;

impl Builder<'_> {
    /// Adds a repeat and all of its copies.
    pub(super) fn add_repeat(&mut self, place: usize, outline: &Outline) {
        let item = &outline.items[place];
        let complaints = self.complaints.count();
        let models = self.claim(place, outline);
        if self.complaints.count() > complaints {
            return;
        }
        self.copied = self.copied.saturating_add(size(place, outline));
        if self.copied > MOST {
            let message = format!("repeats make {} things up to here, more than {MOST}", self.copied);
            return self.complaints.add_with(item.word.clone(), message, "give a smaller count");
        }
        let Some(members) = self.pattern(place, outline) else { return };
        let Some(content) = self.copies(item, &members) else { return };
        if self.complaints.count() == complaints {
            self.insert(place, item, content);
        }
        if let Some(Id::Entity(root)) = self.ids[place] {
            self.repeats.push(Repeated::new(&self.scene, root, models));
        }
    }

    /// Takes what stands in a repeat as its own; answers with the names of models there.
    fn claim(&mut self, place: usize, outline: &Outline) -> Vec<String> {
        let mut models = Vec::new();
        for i in outline.inside(place) {
            let inner = &outline.items[i];
            let material = self.check_material(inner);
            let is_part = matches!(inner.sort, Sort::Part);
            self.ids[i] = Some(if is_part { Id::Part(None, material) } else { Id::Repeated(material) });
            if let (Sort::Model, Some(name)) = (inner.sort, &inner.name) {
                models.push(name.value.clone());
            }
        }
        models
    }

    /// The members of a node as they stand in a repeat, once; nothing if any was complained about.
    fn pattern(&mut self, place: usize, outline: &Outline) -> Option<Vec<Node>> {
        let mut nodes = Vec::new();
        for i in outline.inside(place) {
            let item = &outline.items[i];
            if item.parent != Some(place) || matches!(item.sort, Sort::Part) {
                continue;
            }
            let members = self.pattern(i, outline)?;
            let content = match item.sort {
                Sort::Repeat => self.copies(item, &members)?,
                Sort::Model => Content::Group(self.model_in_repeat(i, outline, members)?),
                _ => self.content(item, members)?,
            };
            let name = item.name.as_ref().map(|name| name.value.clone()).unwrap_or_default();
            nodes.push(Node::new(name, content).placed(item.placement).flagged(item.flags));
        }
        Some(nodes)
    }

    /// What a model holds, and its other members behind that.
    fn model_in_repeat(&mut self, place: usize, outline: &Outline, others: Vec<Node>) -> Option<Vec<Node>> {
        let item = &outline.items[place];
        let (source, name) = (item.model.as_ref()?, item.name.as_ref()?);
        let parts = self.overrides(place, outline, &source.model);
        let instance = self.models.iter().find(|model| model.name() == name.value)?;
        let mut members = match instance.members(source, &parts) {
            Ok(members) => members,
            Err(error) => {
                self.complaints.add(name.span.clone(), error.to_string());
                return None;
            }
        };
        for (i, part) in outline.items.iter().enumerate() {
            let (Sort::Part, Some(named), true) = (part.sort, &part.name, part.parent == Some(place)) else {
                continue;
            };
            let guests = self.pattern(i, outline)?;
            let full = full_name(&name.value, &named.value);
            match instance::find_mut(&mut members, &full) {
                Some(group) if group.role() == Role::Group => {
                    if let Content::Group(inner) = &mut group.content {
                        inner.extend(guests);
                    }
                }
                _ => self.refuse_members(i, outline),
            }
        }
        members.extend(others);
        Some(members)
    }

    /// The copies of a repeat, each a group.
    fn copies(&mut self, item: &Item, members: &[Node]) -> Option<Content> {
        let (count, step, name) = (item.count?, item.step?, item.name.as_ref()?);
        let mut at = Placement::IDENTITY;
        let mut copies = Vec::new();
        for number in 1..=count {
            let copy = full_name(&name.value, &number.to_string());
            let renamed = members.iter().map(|member| under(member.clone(), &copy)).collect();
            copies.push(Node::group(copy, renamed).placed(at));
            if number == count {
                break;
            }
            let Some(after) = next(&at, &step) else {
                let message = format!("numbers end at copy {} of this repeat", number + 1);
                self.complaints.add_with(
                    item.word.clone(),
                    message,
                    "give a smaller count, or a smaller step",
                );
                return None;
            };
            at = after;
        }
        Some(Content::Group(copies))
    }
}

/// The same with a name before its own and those of all that lies in it.
fn under(mut node: Node, name: &str) -> Node {
    node.name = full_name(name, &node.name);
    node.content = match node.content {
        Content::Group(members) => Content::Group(all_under(members, name)),
        Content::Solid(operation, members) => Content::Solid(operation, all_under(members, name)),
        other => other,
    };
    node
}

fn all_under(members: Vec<Node>, name: &str) -> Vec<Node> {
    members.into_iter().map(|member| under(member, name)).collect()
}

/// How many entities lie in what an item makes.
fn size(place: usize, outline: &Outline) -> u64 {
    let item = &outline.items[place];
    let mut size = item.model.as_ref().map_or(0, |source| instance::names(&source.model).len() as u64);
    for i in outline.inside(place).filter(|i| outline.items[*i].parent == Some(place)) {
        let own = u64::from(!matches!(outline.items[i].sort, Sort::Part));
        size = size.saturating_add(own).saturating_add(self::size(i, outline));
    }
    match item.count {
        Some(count) => u64::from(count).saturating_mul(size.saturating_add(1)),
        None => size,
    }
}
