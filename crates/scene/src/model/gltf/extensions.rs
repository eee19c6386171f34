//! Which extensions does a file need, and what becomes of those that are not known here?

use super::json::Document;
use crate::model::error::{Fault, Place};
use crate::model::warnings::Warnings;

/// What is understood, or shows nothing.
const UNDERSTOOD: &[&str] = &[
    "EXT_mesh_gpu_instancing",
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
    "KHR_xmp_json_ld",
];

/// What is known and left out, with what that means for the picture. A file that needs it is read all the same.
const LEFT_OUT: &[(&str, &str)] = &[
    ("KHR_animation_pointer", "things stand as the file has them"),
    ("KHR_materials_diffuse_transmission", "such surfaces let no light through"),
    ("KHR_materials_dispersion", "glass bends all colours alike"),
    ("KHR_materials_iridescence", "such surfaces have no rainbow"),
    ("KHR_materials_variants", "shapes wear their usual materials"),
    ("KHR_materials_volume_scatter", "light is not scattered inside"),
    ("KHR_node_hoverability", "there is nothing to point at"),
    ("KHR_node_selectability", "there is nothing to select"),
];

/// How a file is packed that cannot be unpacked here, and what to do about it. Where a file has a copy that is not packed
/// it does not need the extension, and that copy is read.
const PACKED: &[(&str, &str)] = &[
    ("EXT_meshopt_compression", "gltf-transform copy IN.glb OUT.glb"),
    ("KHR_draco_mesh_compression", "gltf-transform copy IN.glb OUT.glb"),
    ("KHR_meshopt_compression", "gltf-transform copy IN.glb OUT.glb"),
    ("KHR_texture_basisu", "gltf-transform ktxdecompress IN.glb OUT.glb"),
];

/// Refuses what cannot be shown without an extension that is not known, and warns of the others.
pub(super) fn check(document: &Document, warnings: &Warnings) -> Result<(), Fault> {
    for name in &document.extensions_required {
        if UNDERSTOOD.contains(&&**name) || left_out(name).is_some() {
            continue;
        }
        return Err(Fault::new(
            Place::File,
            match hint(name) {
                Some(command) => {
                    format!("needs {name}, which cannot be unpacked here: unpack it first, as by {command}")
                }
                None => format!("needs the extension {name}, which is not known here"),
            },
        ));
    }
    for name in &document.extensions_used {
        if let Some(meaning) = left_out(name) {
            warnings.add_of_file(format!("{name} is left out: {meaning}"));
        } else if !UNDERSTOOD.contains(&&**name) && hint(name).is_none() {
            warnings.add_of_file(format!("the extension {name} is not known here: what it says is left out"));
        }
    }
    Ok(())
}

/// How to unpack what an extension has packed.
pub(super) fn hint(extension: &str) -> Option<&'static str> {
    PACKED.iter().find(|(name, _)| *name == extension).map(|(_, command)| *command)
}

fn left_out(extension: &str) -> Option<&'static str> {
    LEFT_OUT.iter().find(|(name, _)| *name == extension).map(|(_, meaning)| *meaning)
}
