//! What does the JSON of a glTF file say, of what is read here? (Khronos, glTF 2.0 specification, revision 2.0.1.)
//!
//! Fields are those of the specification, with its defaults; what is not read has no field.

mod data;
mod material;
mod number;

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;

pub(crate) use data::{Accessor, Attributes, Buffer, BufferView, Mesh, Primitive, Skin, Sparse};
pub(crate) use material::{
    Image, Material, MaterialExtensions, MetallicRoughness, Sampler, SpecularGlossiness, TextureInfo,
    TextureSource, TextureTransform,
};
pub(crate) use number::Whole;

use super::refusal::Refusal;
use crate::model::error::{Fault, Place};

/// A whole file.
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(crate) struct Document {
    pub(crate) asset: Asset,
    pub(crate) scene: Option<Whole>,
    pub(crate) scenes: Vec<Scene>,
    pub(crate) nodes: Vec<Node>,
    pub(crate) meshes: Vec<Mesh>,
    pub(crate) accessors: Vec<Accessor>,
    pub(crate) buffer_views: Vec<BufferView>,
    pub(crate) buffers: Vec<Buffer>,
    pub(crate) materials: Vec<Material>,
    pub(crate) textures: Vec<TextureSource>,
    pub(crate) images: Vec<Image>,
    pub(crate) samplers: Vec<Sampler>,
    pub(crate) cameras: Vec<Camera>,
    pub(crate) skins: Vec<Skin>,
    pub(crate) animations: Vec<IgnoredAny>,
    pub(crate) extensions_used: Vec<String>,
    pub(crate) extensions_required: Vec<String>,
    pub(crate) extensions: DocumentExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(crate) struct Asset {
    pub(crate) version: String,
    pub(crate) min_version: Option<String>,
}

/// All that a file says of itself, whatever else it holds.
#[derive(Debug, Deserialize)]
#[serde(expecting = "an object")]
struct AssetAlone {
    asset: Asset,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub(crate) struct DocumentExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub(crate) lights: Option<Lights>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub(crate) struct Lights {
    pub(crate) lights: Vec<Light>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub(crate) struct Scene {
    pub(crate) nodes: Vec<Whole>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub(crate) struct Node {
    pub(crate) name: Option<String>,
    pub(crate) children: Vec<Whole>,
    pub(crate) mesh: Option<Whole>,
    pub(crate) skin: Option<Whole>,
    pub(crate) camera: Option<Whole>,
    pub(crate) weights: Vec<f64>,
    /// Column-major.
    pub(crate) matrix: Option<Box<[f64; 16]>>,
    pub(crate) translation: Option<[f64; 3]>,
    /// A quaternion: x, y, z, w.
    pub(crate) rotation: Option<[f64; 4]>,
    pub(crate) scale: Option<[f64; 3]>,
    pub(crate) extensions: Option<Box<NodeExtensions>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub(crate) struct NodeExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub(crate) light: Option<LightUse>,
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub(crate) instances: Option<Instances>,
    #[serde(rename = "KHR_node_visibility")]
    pub(crate) visibility: Option<Visibility>,
}

#[derive(Debug, Deserialize)]
#[serde(expecting = "an object")]
pub(crate) struct LightUse {
    pub(crate) light: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub(crate) struct Instances {
    pub(crate) attributes: BTreeMap<String, Whole>,
}

#[derive(Debug, Deserialize)]
#[serde(expecting = "an object")]
pub(crate) struct Visibility {
    #[serde(default = "yes")]
    pub(crate) visible: bool,
}

fn yes() -> bool {
    true
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub(crate) struct Camera {
    pub(crate) name: Option<String>,
    pub(crate) perspective: Option<Perspective>,
    pub(crate) orthographic: Option<Orthographic>,
}

#[derive(Debug, Deserialize)]
#[serde(expecting = "an object")]
pub(crate) struct Perspective {
    pub(crate) yfov: f64,
}

#[derive(Debug, Deserialize)]
#[serde(expecting = "an object")]
pub(crate) struct Orthographic {
    pub(crate) ymag: f64,
}

#[derive(Debug, Deserialize)]
#[serde(expecting = "an object")]
pub(crate) struct Light {
    pub(crate) name: Option<String>,
    pub(crate) color: Option<[f64; 3]>,
    pub(crate) intensity: Option<f64>,
    #[serde(rename = "type")]
    pub(crate) kind: String,
    pub(crate) range: Option<f64>,
    #[serde(default)]
    pub(crate) spot: Spot,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(crate) struct Spot {
    /// Half angles, radians.
    pub(crate) inner_cone_angle: Option<f64>,
    pub(crate) outer_cone_angle: Option<f64>,
}

impl Document {
    /// Reads JSON that begins at byte `start` of its file; only text files have lines.
    pub(crate) fn read(json: &[u8], start: Option<usize>) -> Result<Self, Fault> {
        let document =
            serde_json::from_slice::<Self>(json).map_err(|error| (refused(json, start, &error), error));
        match document {
            Ok(document) => Self::check_version(&document.asset).map(|()| document),
            Err((fault, error)) => {
                // What an older version has in the place of something else is no slip.
                let asset =
                    Some(json).filter(|_| error.is_data()).and_then(|json| serde_json::from_slice(json).ok());
                asset.map_or(Ok(()), |AssetAlone { asset }| Self::check_version(&asset)).and(Err(fault))
            }
        }
    }

    fn check_version(asset: &Asset) -> Result<(), Fault> {
        let version = asset.min_version.as_deref().unwrap_or(&asset.version);
        let refused = |message: String| Err(Fault::new(Place::File, message));
        match version {
            "2.0" => Ok(()),
            // A later version, unless it says that it must be known.
            later if later.starts_with("2.") && asset.min_version.is_none() => Ok(()),
            "" => refused("asset.version is missing: this is no glTF file".to_owned()),
            old if old.starts_with("1.") => refused(format!(
                "is glTF {version}: convert it to 2.0, as by gltf-pipeline -i IN.gltf -o OUT.glb"
            )),
            other => refused(format!("is glTF {other}: only 2.0 can be read")),
        }
    }
}

/// What a list has at a place.
pub(crate) fn entry<'d, T>(list: &'d [T], index: Whole, name: &str) -> Result<&'d T, Refusal> {
    list.get(index.index())
        .ok_or_else(|| Refusal::new(format!("names {name}[{index}], but the file has {} {name}", list.len())))
}

/// Reads once more to find the path to what is wrong, which is not kept while all goes well.
fn refused(json: &[u8], start: Option<usize>, error: &serde_json::Error) -> Fault {
    let place = match start {
        None => Place::Line(error.line().max(1)),
        Some(start) => Place::Byte(start + byte_of(json, error)),
    };
    let mut deserializer = serde_json::Deserializer::from_slice(json);
    let path = match serde_path_to_error::deserialize::<_, Document>(&mut deserializer) {
        Err(again) if again.inner().is_data() => format!("{}: ", again.path()),
        _ => "is no valid JSON: ".to_owned(),
    };
    let message = error.to_string();
    // The place is told already.
    let message = message.split(" at line ").next().unwrap_or_default();
    Fault::new(place, format!("{path}{message}"))
}

/// The byte that an error stands at.
fn byte_of(json: &[u8], error: &serde_json::Error) -> usize {
    let lines = json.split_inclusive(|&b| b == b'\n').take(error.line().saturating_sub(1));
    let before: usize = lines.map(<[u8]>::len).sum();
    (before + error.column().saturating_sub(1)).min(json.len())
}
