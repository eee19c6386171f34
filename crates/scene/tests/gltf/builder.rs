//! Small glTF files, made part by part.

use std::path::Path;

use catoptra_core::glam::DVec3;
use catoptra_core::scene::Content;
use catoptra_core::{Edit, Node, Placement, Scene, Shape, TriangleMesh};
use catoptra_scene::model::{Folder, Model, ModelError, read_bytes};
use serde_json::{Value, json};

/// A file in the making: its JSON, and the bytes of its one buffer.
pub(crate) struct Builder {
    pub(crate) json: Value,
    pub(crate) bytes: Vec<u8>,
}

pub(crate) const BYTE: u32 = 5120;
pub(crate) const UNSIGNED_BYTE: u32 = 5121;
pub(crate) const SHORT: u32 = 5122;
pub(crate) const UNSIGNED_SHORT: u32 = 5123;
pub(crate) const UNSIGNED_INT: u32 = 5125;
pub(crate) const FLOAT: u32 = 5126;

/// The corners of a triangle in the plane z = 0, anticlockwise as seen from +z.
pub(crate) const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

impl Builder {
    pub(crate) fn new() -> Self {
        Self { json: json!({ "asset": { "version": "2.0" } }), bytes: Vec::new() }
    }

    /// A file with one mesh of one triangle, of which nothing is shown yet.
    pub(crate) fn with_triangle() -> Self {
        let mut file = Self::new();
        let positions = file.floats("VEC3", CORNERS.as_flattened());
        file.mesh(json!({ "attributes": { "POSITION": positions } }));
        file
    }

    /// A file that shows such a mesh in a node.
    pub(crate) fn with_node() -> Self {
        let mut file = Self::with_triangle();
        file.push("nodes", json!({ "mesh": 0 }));
        file
    }

    /// Adds to a list, and tells the place.
    pub(crate) fn push(&mut self, list: &str, entry: Value) -> usize {
        if self.json[list].is_null() {
            self.json[list] = json!([]);
        }
        let list = self.json[list].as_array_mut().unwrap();
        list.push(entry);
        list.len() - 1
    }

    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let start = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        self.push("bufferViews", json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len() }))
    }

    /// An accessor of numbers in a view of their own.
    pub(crate) fn accessor(&mut self, kind: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.push(
            "accessors",
            json!({ "bufferView": view, "componentType": component, "count": count, "type": kind }),
        )
    }

    pub(crate) fn floats(&mut self, kind: &str, floats: &[f32]) -> usize {
        let lanes = match kind {
            "SCALAR" => 1,
            "MAT4" => 16,
            _ => usize::from(kind.as_bytes()[3] - b'0'),
        };
        let bytes: Vec<u8> = floats.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.accessor(kind, FLOAT, floats.len() / lanes, &bytes)
    }

    pub(crate) fn shorts(&mut self, kind: &str, shorts: &[u16]) -> usize {
        let lanes = if kind == "SCALAR" { 1 } else { usize::from(kind.as_bytes()[3] - b'0') };
        let bytes: Vec<u8> = shorts.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.accessor(kind, UNSIGNED_SHORT, shorts.len() / lanes, &bytes)
    }

    #[allow(clippy::needless_pass_by_value, reason = "values are made where they are given")]
    pub(crate) fn mesh(&mut self, primitive: Value) -> usize {
        self.push("meshes", json!({ "primitives": [primitive] }))
    }

    /// Says that an extension is used, and gives what the file as a whole says by it.
    pub(crate) fn extension(&mut self, name: &str, value: Value) {
        self.push("extensionsUsed", json!(name));
        self.json["extensions"][name] = value;
    }

    pub(crate) fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if !self.bytes.is_empty() {
            json["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        }
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut binary = self.bytes.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let mut chunks = vec![(b"JSON", text)];
        if !binary.is_empty() {
            chunks.push((b"BIN\0", binary));
        }
        glb(&chunks)
    }

    pub(crate) fn text(&self, uri: &str) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bytes.len(), "uri": uri }]);
        serde_json::to_vec_pretty(&json).unwrap()
    }

    pub(crate) fn try_read(&self) -> Result<Model, ModelError> {
        read_bytes(&self.glb(), Path::new("made.glb"), &Folder::none())
    }

    pub(crate) fn read(&self) -> Model {
        self.try_read().unwrap_or_else(|refused| panic!("{refused}"))
    }

    /// What is said of a file that is refused, after its name.
    pub(crate) fn refusal(&self) -> String {
        let refused = self.try_read().unwrap_err().to_string();
        refused.strip_prefix("made.glb").unwrap().to_owned()
    }
}

/// A binary file of these chunks.
pub(crate) fn glb(chunks: &[(&[u8; 4], Vec<u8>)]) -> Vec<u8> {
    let length = 12 + chunks.iter().map(|(_, bytes)| 8 + bytes.len()).sum::<usize>();
    let mut out = b"glTF".to_vec();
    out.extend(2_u32.to_le_bytes());
    out.extend((length as u32).to_le_bytes());
    for (kind, bytes) in chunks {
        out.extend((bytes.len() as u32).to_le_bytes());
        out.extend(*kind);
        out.extend(bytes);
    }
    out
}

/// Base64 as RFC 4648 has it.
pub(crate) fn base64(bytes: &[u8]) -> String {
    const SIGNS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::new();
    for group in bytes.chunks(3) {
        let bits = group.iter().fold(0_u32, |bits, b| bits << 8 | u32::from(*b)) << (8 * (3 - group.len()));
        for i in 0..4 {
            let sign = SIGNS[(bits >> (18 - 6 * i) & 63) as usize];
            out.push(if i <= group.len() { char::from(sign) } else { '=' });
        }
    }
    out
}

/// A shape of a model, and where the world has it.
pub(crate) struct Stands<'m> {
    pub(crate) node: &'m Node,
    pub(crate) mesh: &'m TriangleMesh,
    pub(crate) placement: Placement,
}

impl Stands<'_> {
    /// Corners in the world.
    pub(crate) fn corners(&self) -> Vec<DVec3> {
        let place = |p: &[f32; 3]| self.placement.point(DVec3::from(p.map(f64::from)) + self.mesh.offset());
        self.mesh.positions().iter().map(place).collect()
    }

    /// The normal of a triangle by the order of its corners, of any length.
    pub(crate) fn winding(&self, triangle: usize) -> DVec3 {
        let corners = self.corners();
        let [a, b, c] = self.mesh.triangles()[triangle].map(|i| corners[i as usize]);
        (b - a).cross(c - a)
    }
}

/// All shapes of a model.
pub(crate) fn shapes(model: &Model) -> Vec<Stands<'_>> {
    let mut found = Vec::new();
    for node in &model.nodes {
        gather(node, Placement::IDENTITY, &mut found);
    }
    found
}

fn gather<'m>(node: &'m Node, outer: Placement, found: &mut Vec<Stands<'m>>) {
    let placement = node.placement.then(&outer);
    match &node.content {
        Content::Shape(Shape::Mesh(mesh), _) => {
            found.push(Stands { node, mesh: mesh.triangles(), placement });
        }
        Content::Group(members) => members.iter().for_each(|member| gather(member, placement, found)),
        _ => {}
    }
}

/// The only mesh of a model.
pub(crate) fn only(model: &Model) -> &TriangleMesh {
    let shapes = shapes(model);
    assert_eq!(shapes.len(), 1, "{model:?}");
    shapes[0].mesh
}

/// The words of all warnings.
pub(crate) fn warnings(model: &Model) -> Vec<&str> {
    model.warnings.iter().map(|warning| &*warning.message).collect()
}

/// Holds a model to what a scene takes.
pub(crate) fn fits(model: &Model) {
    let mut scene = Scene::new();
    for (name, texture) in &model.textures {
        scene.add_texture(name, texture.clone()).unwrap();
    }
    for worn in &model.materials {
        let id = scene.add_material(&worn.name, worn.material.clone()).unwrap();
        scene.apply(Edit::Finish(id, worn.finish)).unwrap();
    }
    for node in &model.nodes {
        scene.apply(Edit::Insert(Box::new(node.clone().into()))).unwrap();
    }
}
