//! What does a node show itself: its mesh, its light, its camera?
//!
//! Names are those that would be good: the caller makes them unique.

use std::sync::Arc;

use catoptra_core::geometry::Mesh;
use catoptra_core::glam::{DAffine3, DVec3};
use catoptra_core::{MeshSource, Node, TriangleMesh};

use super::frame::{Frame, Rest};
use super::{Outer, Tree, cameras, instances, lights};
use crate::model::gltf::geometry::{Pose, Which, is_skinned, joints, topology};
use crate::model::gltf::json::{self, Mesh as MeshJson, Whole, entry};
use crate::model::gltf::names::unique;
use crate::model::gltf::refusal::{Refusal, Within};

impl Tree<'_, '_> {
    /// The mesh of a node.
    pub(super) fn shapes(&mut self, node: usize, owner: &str, outer: Outer) -> Result<Vec<Node>, Refusal> {
        let given = &self.source.document.nodes[node];
        let path = || format!("nodes[{node}]");
        let Some(index) = given.mesh else { return Ok(Vec::new()) };
        let mesh = entry(&self.source.document.meshes, index, "meshes").within(path)?;
        let mesh = (index.index(), mesh);
        let mut pose = Pose { weights: &given.weights, skin: None, rest: outer.rest };
        if let Some(skin) = given.skin.filter(|_| self.can_be_skinned(mesh.1)) {
            let joints = self.joints_of(skin).referred().within(path)?;
            pose = Pose { skin: Some((skin.0, &joints)), rest: Rest::NONE, ..pose };
            let mut shapes = self.primitives(mesh, &pose, owner)?;
            let is_all = shapes.len() == 1 && given.children.is_empty() && !has_others(given);
            for shape in &mut shapes {
                shape.name =
                    if is_all { owner.to_owned() } else { unique(&mut self.names, Some(owner), "mesh") };
            }
            self.free.append(&mut shapes);
            return Ok(Vec::new());
        }
        let instances = given.extensions.as_deref().and_then(|found| found.instances.as_ref());
        let Some(instances) = instances else { return self.primitives(mesh, &pose, owner) };
        let locals = instances::locals(instances, self.source)
            .within(|| "EXT_mesh_gpu_instancing".to_owned())
            .within(path)?;
        let mut shapes = Vec::new();
        for local in &locals {
            let Some(frame) = Frame::within(outer.rest, local).within(path)? else { continue };
            outer.holding(&frame).within(path)?;
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
            self.source
                .warnings
                .add_of_file("a mesh with a skin names no joints: it stands where its node does");
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
            shapes.push(Node::shape(owner, shape_of(mesh), look.material));
        }
        Ok(shapes)
    }

    /// The light and the camera of a node.
    pub(super) fn others(
        &mut self,
        given: &json::Node,
        owner: &str,
        outer: Outer,
    ) -> Result<Vec<Node>, Refusal> {
        let source = self.source;
        let mut parts = Vec::new();
        if let Some(light) = lights::of_node(given) {
            let direction = (outer.rest.matrix() * -DVec3::Z).normalize_or(-DVec3::Z);
            let (name, light) = lights::light(source.document, light, direction, &source.warnings)?;
            parts.push(Node::light(name.unwrap_or(owner), light));
            self.one_more()?;
        }
        if let Some(index) = given.camera
            && let Some((name, camera)) = cameras::camera(source.document, index, outer, &source.warnings)?
        {
            parts.push(Node::camera(name.unwrap_or(owner), camera));
            self.one_more()?;
        }
        Ok(parts)
    }
}

fn has_others(given: &json::Node) -> bool {
    given.camera.is_some() || lights::of_node(given).is_some()
}

fn shape_of(mesh: Arc<TriangleMesh>) -> Mesh {
    Mesh::new(MeshSource { path: String::new(), mesh })
}
