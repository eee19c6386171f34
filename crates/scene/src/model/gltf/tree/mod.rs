//! Which shapes, lights, cameras and groups do the nodes of a file become?
//!
//! A node becomes a group of what it shows and of its children; a node that shows one thing becomes that thing, and one that
//! shows nothing is left out.

mod cameras;
mod frame;
mod instances;
mod lights;
mod skeleton;

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::geometry::Mesh;
use catoptra_core::glam::{DAffine3, DVec3};
use catoptra_core::{MeshSource, Node, TriangleMesh};

pub(super) use frame::Rest;

use super::geometry::{Meshes, Pose, Which, is_skinned, joints, topology};
use super::json::{self, Mesh as MeshJson, Whole, entry};
use super::limits::{MOST_GROUPS, MOST_NODES};
use super::look::Looks;
use super::names::Names;
use super::refusal::{Refusal, Within};
use super::source::Source;
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
            nodes.extend(self.node(index, Rest::NONE, 0)?);
        }
        nodes.append(&mut self.free);
        Ok((nodes, self.looks))
    }

    /// What a node becomes, within a group at that depth.
    fn node(&mut self, index: usize, outer: Rest, depth: usize) -> Result<Vec<Node>, Refusal> {
        let given = &self.source.document.nodes[index];
        let extensions = given.extensions.as_deref();
        if extensions.and_then(|found| found.visibility.as_ref()).is_some_and(|found| !found.visible) {
            return Ok(Vec::new());
        }
        let path = || format!("nodes[{index}]");
        let local = Local::of(given).within(path)?;
        let Some(frame) = Frame::within(outer, &local).within(path)? else {
            if local.linear.matrix() != catoptra_core::glam::DMat3::ZERO {
                self.source.warnings.add("nodes whose matrix flattens them are left out");
            }
            return Ok(Vec::new());
        };
        let name = self.names.unique(given.name.as_deref(), "node");
        let mut parts = self.shapes(index, &name, frame.rest)?;
        parts.extend(self.others(given, &name, frame.rest).within(path)?);
        let is_alone = parts.len() == 1 && given.children.is_empty();
        for child in &given.children {
            parts.extend(self.node(child.index(), frame.rest, depth + 1)?);
        }
        if is_alone || depth >= MOST_GROUPS {
            let rename = |part: Node| if is_alone { Node { name: name.clone(), ..part } } else { part };
            let place = |part: Node| {
                let placement = part.placement.then(&frame.placement);
                part.placed(placement)
            };
            return Ok(parts.into_iter().map(rename).map(place).collect());
        }
        if parts.is_empty() {
            return Ok(parts);
        }
        self.one_more()?;
        Ok(vec![Node::group(name, parts).placed(frame.placement)])
    }

    /// The mesh of a node.
    fn shapes(&mut self, node: usize, owner: &str, rest: Rest) -> Result<Vec<Node>, Refusal> {
        let given = &self.source.document.nodes[node];
        let path = || format!("nodes[{node}]");
        let Some(index) = given.mesh else { return Ok(Vec::new()) };
        let mesh = entry(&self.source.document.meshes, index, "meshes").within(path)?;
        let mesh = (index.index(), mesh);
        let mut pose = Pose { weights: &given.weights, skin: None, rest };
        if let Some(skin) = given.skin.filter(|_| self.can_be_skinned(mesh.1)) {
            let joints = self.joints_of(skin).referred().within(path)?;
            pose = Pose { skin: Some((skin.0, &joints)), rest: Rest::NONE, ..pose };
            let shapes = self.primitives(mesh, &pose, owner)?;
            self.free.extend(shapes);
            return Ok(Vec::new());
        }
        let instances = given.extensions.as_deref().and_then(|found| found.instances.as_ref());
        let Some(instances) = instances else { return self.primitives(mesh, &pose, owner) };
        let locals = instances::locals(instances, self.source)
            .within(|| "EXT_mesh_gpu_instancing".to_owned())
            .within(path)?;
        let mut shapes = Vec::new();
        for local in &locals {
            let Some(frame) = Frame::within(rest, local).within(path)? else { continue };
            let pose = Pose { rest: frame.rest, ..pose };
            for shape in self.primitives(mesh, &pose, owner)? {
                let placement = shape.placement.then(&frame.placement);
                shapes.push(shape.placed(placement));
            }
        }
        Ok(shapes)
    }

    fn can_be_skinned(&self, mesh: &MeshJson) -> bool {
        let can = mesh.primitives.iter().all(|primitive| is_skinned(&primitive.attributes));
        if !can {
            self.source.warnings.add("a mesh with a skin names no joints: it stands where its node does");
        }
        can
    }

    fn joints_of(&mut self, index: Whole) -> Result<Arc<[DAffine3]>, Refusal> {
        if let Some(known) = self.joints.get(&index) {
            return Ok(Arc::clone(known));
        }
        let document = self.source.document;
        let skin = entry(&document.skins, index, "skins")?;
        let globals = match &mut self.globals {
            Some(globals) => globals,
            unknown => unknown.insert(self.skeleton.globals(&document.nodes)?),
        };
        let joints = joints(skin, globals, self.source).within(|| format!("skins[{index}]"))?;
        let joints: Arc<[DAffine3]> = joints.into();
        self.joints.insert(index, Arc::clone(&joints));
        Ok(joints)
    }

    /// A shape for each primitive that has triangles.
    fn primitives(
        &mut self,
        (number, mesh): (usize, &MeshJson),
        pose: &Pose<'_>,
        owner: &str,
    ) -> Result<Vec<Node>, Refusal> {
        let mut shapes = Vec::new();
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            let path = || format!("meshes[{number}].primitives[{i}]");
            let has_colors = primitive.attributes.contains_key("COLOR_0");
            let topology = topology(primitive, &self.source.warnings).within(path)?;
            let Some(topology) = topology else { continue };
            let look = self.looks.of(primitive.material, has_colors)?;
            let (mesh, uv_set) = ((number, mesh), look.uv_set);
            let which = Which { mesh, primitive: (i, primitive), topology, uv_set };
            let Some(mesh) = self.meshes.get(which, pose, self.source).within(path)? else { continue };
            self.one_more()?;
            let name = self.names.unique(Some(owner), "mesh");
            shapes.push(Node::shape(name, shape_of(mesh), look.material));
        }
        Ok(shapes)
    }

    /// The light and the camera of a node.
    fn others(&mut self, given: &json::Node, owner: &str, rest: Rest) -> Result<Vec<Node>, Refusal> {
        let source = self.source;
        let mut parts = Vec::new();
        let light = given.extensions.as_deref().and_then(|found| found.light.as_ref());
        if let Some(light) = light {
            let direction = (rest.matrix() * -DVec3::Z).normalize_or(-DVec3::Z);
            let (name, light) = lights::light(source.document, light.light, direction, &source.warnings)?;
            parts.push(Node::light(self.names.unique(name.or(Some(owner)), "light"), light));
            self.one_more()?;
        }
        if let Some(index) = given.camera
            && let Some((name, camera)) =
                cameras::camera(source.document, index, rest.matrix(), &source.warnings)?
        {
            parts.push(Node::camera(self.names.unique(name.or(Some(owner)), "camera"), camera));
            self.one_more()?;
        }
        Ok(parts)
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

fn shape_of(mesh: Arc<TriangleMesh>) -> Mesh {
    Mesh::new(MeshSource { path: String::new(), mesh })
}
