//! Writes `scenes/gallery/models/dining.glb`: a table and four stools, whose seats and legs are instances.
//!
//! `dining FILE`

use std::f32::consts::TAU;

use serde_json::{Value, json};

/// Corners round an axis.
const ROUND: usize = 40;

/// Radius and height of every ring of a turned piece, from below.
type Profile<'a> = &'a [[f32; 2]];

const TOP: Profile<'_> =
    &[[0.0, 0.70], [0.52, 0.70], [0.585, 0.712], [0.6, 0.725], [0.585, 0.738], [0.55, 0.75], [0.0, 0.75]];
const PILLAR: Profile<'_> = &[
    [0.0, 0.0],
    [0.28, 0.0],
    [0.27, 0.02],
    [0.08, 0.06],
    [0.05, 0.2],
    [0.07, 0.35],
    [0.045, 0.5],
    [0.1, 0.70],
];
const SEAT: Profile<'_> = &[[0.0, 0.44], [0.17, 0.44], [0.185, 0.455], [0.17, 0.47], [0.0, 0.475]];
const CUSHION: Profile<'_> =
    &[[0.0, 0.475], [0.15, 0.475], [0.175, 0.495], [0.15, 0.52], [0.08, 0.53], [0.0, 0.532]];
const LEG: Profile<'_> = &[[0.0, 0.0], [0.016, 0.0], [0.012, 0.1], [0.022, 0.3], [0.016, 0.44], [0.0, 0.44]];

fn main() -> std::io::Result<()> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "dining.glb".to_owned());
    let mut file = Glb::default();
    let wood = file.material("Wood", [0.42, 0.23, 0.1], 0.35, 0.0);
    let cloth = file.material("Cloth", [0.12, 0.28, 0.42], 0.9, 0.0);
    let brass = file.material("Brass", [0.85, 0.6, 0.25], 0.25, 1.0);
    let [top, pillar] = [(TOP, wood), (PILLAR, brass)].map(|(profile, worn)| file.turned(profile, worn));
    let [seat, cushion, leg] =
        [(SEAT, wood), (CUSHION, cloth), (LEG, wood)].map(|(profile, worn)| file.turned(profile, worn));
    let parts = vec![file.node("Top", top, [0.0; 3]), file.node("Pillar", pillar, [0.0; 3])];
    let mut all = vec![file.group("Table", &parts, [0.0; 3])];
    for number in 0..4 {
        let mut parts = vec![file.node("Seat", seat, [0.0; 3]), file.node("Cushion", cushion, [0.0; 3])];
        for third in 0..3 {
            let angle = TAU * third as f32 / 3.0;
            parts.push(file.node("Leg", leg, [0.13 * angle.cos(), 0.0, 0.13 * angle.sin()]));
        }
        let angle = TAU * (number as f32 / 4.0 + 0.1);
        let name = format!("Stool {}", number + 1);
        all.push(file.group(&name, &parts, [0.85 * angle.cos(), 0.0, 0.85 * angle.sin()]));
    }
    std::fs::write(path, file.bytes(&all))
}

/// A glTF file that grows.
#[derive(Default)]
struct Glb {
    binary: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    nodes: Vec<Value>,
}

impl Glb {
    fn material(&mut self, name: &str, color: [f32; 3], roughness: f32, metallic: f32) -> usize {
        let [r, g, b] = color;
        self.materials.push(json!({ "name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1], "roughnessFactor": roughness, "metallicFactor": metallic } }));
        self.materials.len() - 1
    }

    /// A mesh round the y axis, with an edge at every ring of the profile.
    fn turned(&mut self, profile: Profile<'_>, material: usize) -> usize {
        let (mut positions, mut normals, mut indices) = (Vec::new(), Vec::new(), Vec::new());
        for piece in profile.windows(2) {
            let [[r0, y0], [r1, y1]] = [piece[0], piece[1]];
            let length = (r1 - r0).hypot(y1 - y0);
            let (out, up) = ((y1 - y0) / length, (r0 - r1) / length);
            let start = positions.len() as u16;
            for corner in 0..=ROUND {
                let (sin, cos) = (TAU * corner as f32 / ROUND as f32).sin_cos();
                for [r, y] in [[r0, y0], [r1, y1]] {
                    positions.push([r * cos, y, r * sin]);
                    normals.push([out * cos, up, out * sin]);
                }
            }
            for corner in (0..ROUND as u16).map(|corner| start + 2 * corner) {
                indices.extend([[0, 1, 2], [2, 1, 3]].map(|three| three.map(|i: u16| corner + i)));
            }
        }
        let least = |axis: usize| positions.iter().map(|p| p[axis]).fold(f32::INFINITY, f32::min);
        let most = |axis: usize| positions.iter().map(|p| p[axis]).fold(f32::NEG_INFINITY, f32::max);
        let bounds = json!({ "min": [least(0), least(1), least(2)], "max": [most(0), most(1), most(2)] });
        let floats =
            |all: &[[f32; 3]]| all.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
        let position = self.accessor(&floats(&positions), 5126, "VEC3", positions.len(), bounds);
        let normal = self.accessor(&floats(&normals), 5126, "VEC3", normals.len(), json!({}));
        let bytes: Vec<u8> = indices.as_flattened().iter().flat_map(|i| i.to_le_bytes()).collect();
        let corners = self.accessor(&bytes, 5123, "SCALAR", 3 * indices.len(), json!({}));
        self.meshes.push(json!({ "primitives": [{
            "attributes": { "POSITION": position, "NORMAL": normal }, "indices": corners, "material": material }] }));
        self.meshes.len() - 1
    }

    fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize, bounds: Value) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len() }));
        self.binary.extend(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let mut accessor = bounds;
        accessor["bufferView"] = json!(self.views.len() - 1);
        accessor["componentType"] = json!(component);
        accessor["count"] = json!(count);
        accessor["type"] = json!(kind);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn node(&mut self, name: &str, mesh: usize, at: [f32; 3]) -> usize {
        self.nodes.push(json!({ "name": name, "mesh": mesh, "translation": at }));
        self.nodes.len() - 1
    }

    fn group(&mut self, name: &str, children: &[usize], at: [f32; 3]) -> usize {
        self.nodes.push(json!({ "name": name, "children": children, "translation": at }));
        self.nodes.len() - 1
    }

    fn bytes(&self, roots: &[usize]) -> Vec<u8> {
        let text = json!({
            "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": roots }], "nodes": self.nodes,
            "meshes": self.meshes, "materials": self.materials, "accessors": self.accessors,
            "bufferViews": self.views, "buffers": [{ "byteLength": self.binary.len() }],
        });
        let mut text = text.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = |bytes: &[u8]| (bytes.len() as u32).to_le_bytes();
        let total = (28 + text.len() + self.binary.len()) as u32;
        let head = [b"glTF".as_slice(), &2_u32.to_le_bytes(), &total.to_le_bytes()].concat();
        let binary = [length(&self.binary).as_slice(), b"BIN\0", &self.binary].concat();
        [head, length(&text).to_vec(), b"JSON".to_vec(), text, binary].concat()
    }
}
