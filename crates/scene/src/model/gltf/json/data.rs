//! The parts of the JSON that say where numbers lie and what triangles are made of.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::Whole;

/// Accessors by what they give: `POSITION`, `TEXCOORD_0` ...
pub(crate) type Attributes = BTreeMap<String, Whole>;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", expecting = "an object")]
pub(crate) struct Accessor {
    pub(crate) buffer_view: Option<Whole>,
    #[serde(default)]
    pub(crate) byte_offset: Whole,
    pub(crate) component_type: Whole,
    #[serde(default)]
    pub(crate) normalized: bool,
    pub(crate) count: Whole,
    #[serde(rename = "type")]
    pub(crate) kind: String,
    pub(crate) sparse: Option<Box<Sparse>>,
}

#[derive(Debug, Deserialize)]
#[serde(expecting = "an object")]
pub(crate) struct Sparse {
    pub(crate) count: Whole,
    pub(crate) indices: SparseIndices,
    pub(crate) values: SparseValues,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", expecting = "an object")]
pub(crate) struct SparseIndices {
    pub(crate) buffer_view: Whole,
    #[serde(default)]
    pub(crate) byte_offset: Whole,
    pub(crate) component_type: Whole,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", expecting = "an object")]
pub(crate) struct SparseValues {
    pub(crate) buffer_view: Whole,
    #[serde(default)]
    pub(crate) byte_offset: Whole,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", expecting = "an object")]
pub(crate) struct BufferView {
    pub(crate) buffer: Whole,
    #[serde(default)]
    pub(crate) byte_offset: Whole,
    pub(crate) byte_length: Whole,
    pub(crate) byte_stride: Option<Whole>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", expecting = "an object")]
pub(crate) struct Buffer {
    pub(crate) uri: Option<String>,
    pub(crate) byte_length: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub(crate) struct Mesh {
    pub(crate) name: Option<String>,
    pub(crate) primitives: Vec<Primitive>,
    pub(crate) weights: Vec<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub(crate) struct Primitive {
    pub(crate) attributes: Attributes,
    pub(crate) indices: Option<Whole>,
    pub(crate) material: Option<Whole>,
    pub(crate) mode: Option<Whole>,
    pub(crate) targets: Vec<Attributes>,
    pub(crate) extensions: PrimitiveExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, expecting = "an object")]
pub(crate) struct PrimitiveExtensions {
    #[serde(rename = "KHR_draco_mesh_compression")]
    pub(crate) draco: Option<IgnoredAny>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(crate) struct Skin {
    pub(crate) joints: Vec<Whole>,
    pub(crate) inverse_bind_matrices: Option<Whole>,
}
