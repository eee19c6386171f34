//! Which shapes, lights, cameras and groups do the nodes of a file become?
//!
//! A node becomes a group of what it shows and of its children; a node that shows one thing becomes that thing, and one that
//! shows nothing is left out.

mod cameras;
mod frame;
mod instances;
mod lights;
mod parts;
mod skeleton;

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::glam::{DAffine3, DMat3};
use catoptra_core::part::LARGEST;
use catoptra_core::{Node, Placement};

pub(super) use frame::Rest;

use super::geometry::Meshes;
use super::json::{self, Whole};
use super::limits::{MOST_GROUPS, MOST_NODES};
use super::look::Looks;
use super::names::unique;
use super::refusal::{Refusal, Within};
use super::source::Source;
use crate::model::names::Names;
use frame::{Frame, Local};
use skeleton::Skeleton;

/// What nodes become, and what they share.
pub(super) struct Tree<'a, 's> {
    source: &'s Source<'a>,
    skeleton: Skeleton,
    globals: Option<Vec<DAffine3>>,
    /// Where the joints of skins carry things.
    joints: HashMap<Whole, Arc<[DAffine3]>>,
    meshes: Meshes,
    looks: Looks<'a, 's>,
    names: Names,
    /// How many nodes have been made.
    count: usize,
    /// Shapes that stand where their joints carry them, in no node.
    free: Vec<Node>,
}

/// What a node stands in.
#[derive(Debug, Clone, Copy)]
struct Outer {
    /// What is left of the matrices round it beside their placements.
    rest: Rest,
    /// What those make of its own.
    world: Placement,
    /// In how many nodes it lies.
    depth: usize,
}

impl Outer {
    const WORLD: Self = Self { rest: Rest::NONE, world: Placement::IDENTITY, depth: 0 };

    /// What stands in a node that itself stands so.
    ///
    /// # Errors
    /// It stands too far away for numbers, or is too large or small for them.
    fn holding(self, frame: &Frame) -> Result<Self, Refusal> {
        let world = frame.placement.then(&self.world);
        let far = world.translation().abs().max_element();
        if !(far <= LARGEST && (1.0 / LARGEST..=LARGEST).contains(&world.scale())) {
            let [x, y, z] = world.translation().to_array();
            let message = format!(
                "stands at {x:e} {y:e} {z:e}, scaled by {:e}: numbers do not go so far",
                world.scale()
            );
            return Err(Refusal::new(message));
        }
        Ok(Self { rest: frame.rest, world, depth: self.depth + 1 })
    }
}

impl<'a, 's> Tree<'a, 's> {
    pub(super) fn new(source: &'s Source<'a>, looks: Looks<'a, 's>) -> Result<Self, Refusal> {
        let skeleton = Skeleton::of(&source.document.nodes)?;
        Ok(Self {
            source,
            skeleton,
            globals: None,
            joints: HashMap::new(),
            meshes: Meshes::default(),
            looks,
            names: Names::default(),
            count: 0,
            free: Vec::new(),
        })
    }

    /// All nodes that are shown, and what they look like.
    pub(super) fn build(mut self) -> Result<(Vec<Node>, Looks<'a, 's>), Refusal> {
        let mut nodes = Vec::new();
        for index in self.skeleton.shown(self.source.document)? {
            nodes.extend(self.node(index, Outer::WORLD)?);
        }
        nodes.append(&mut self.free);
        Ok((nodes, self.looks))
    }

    /// What a node becomes.
    fn node(&mut self, index: usize, outer: Outer) -> Result<Vec<Node>, Refusal> {
        let given = &self.source.document.nodes[index];
        let extensions = given.extensions.as_deref();
        if extensions.and_then(|found| found.visibility.as_ref()).is_some_and(|found| !found.visible) {
            return Ok(Vec::new());
        }
        let path = || format!("nodes[{index}]");
        let local = Local::of(given).within(path)?;
        let Some(frame) = Frame::within(outer.rest, &local).within(path)? else {
            if local.linear.matrix() != DMat3::ZERO {
                self.source.warnings.add_of_file("nodes whose matrix flattens them are left out");
            }
            return Ok(Vec::new());
        };
        let (of_content, kind) = self.naming(given);
        let own = given.name.as_deref().filter(|name| !name.trim().is_empty());
        let name = unique(&mut self.names, own.or(of_content), kind);
        let inner = outer.holding(&frame).within(path)?;
        let mut parts = self.shapes(index, &name, inner)?;
        parts.extend(self.others(given, &name, inner).within(path)?);
        let is_alone = parts.len() == 1 && given.children.is_empty();
        for part in &mut parts {
            let own = if is_alone { name.clone() } else { unique(&mut self.names, Some(&part.name), "part") };
            part.name = own;
        }
        for child in &given.children {
            parts.extend(self.node(child.index(), inner)?);
        }
        if is_alone || outer.depth >= MOST_GROUPS {
            let place = |part: Node| {
                let placement = part.placement.then(&frame.placement);
                part.placed(placement)
            };
            return Ok(parts.into_iter().map(place).collect());
        }
        if parts.is_empty() {
            return Ok(parts);
        }
        self.one_more()?;
        Ok(vec![Node::group(name, parts).placed(frame.placement)])
    }

    /// What a node would be called: by its own name or by that of what it shows, or else by its kind.
    fn naming(&self, given: &json::Node) -> (Option<&'a str>, &'static str) {
        let document = self.source.document;
        let own = |name: &'a Option<String>| name.as_deref().filter(|name| !name.trim().is_empty());
        let mesh = given.mesh.and_then(|mesh| document.meshes.get(mesh.index()));
        let camera = given.camera.and_then(|camera| document.cameras.get(camera.index()));
        let light = lights::of_node(given).and_then(|light| lights::all(document).get(light.index()));
        if let Some(mesh) = mesh {
            (own(&mesh.name), "mesh")
        } else if let Some(light) = light {
            (own(&light.name), "light")
        } else if let Some(camera) = camera {
            (own(&camera.name), "camera")
        } else {
            (None, "group")
        }
    }

    /// Counts a node that is made.
    fn one_more(&mut self) -> Result<(), Refusal> {
        self.count += 1;
        if self.count > MOST_NODES {
            return Err(Refusal::new(format!(
                "the file makes more than {MOST_NODES} shapes, lights and groups"
            )));
        }
        Ok(())
    }
}
