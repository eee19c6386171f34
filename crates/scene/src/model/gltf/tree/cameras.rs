//! What does a node look at? Along its −z, with its y upwards.

use std::f64::consts::PI;

use catoptra_core::Camera;
use catoptra_core::glam::{DMat3, DVec3};

use crate::model::gltf::json::{self, Document, Whole, entry};
use crate::model::gltf::refusal::{Refusal, Within};
use crate::model::gltf::warnings::Warnings;

/// The camera of that number, at the origin, and its name; `None` for a projection that cannot be shown.
///
/// # Errors
/// None is there, or its angle of view is none.
pub(crate) fn camera<'d>(
    document: &'d Document,
    index: Whole,
    rest: DMat3,
    warnings: &Warnings,
) -> Result<Option<(Option<&'d str>, Camera)>, Refusal> {
    let given = entry(&document.cameras, index, "cameras")?;
    let made = of(given, rest, warnings).within(|| format!("cameras[{index}]"))?;
    Ok(made.map(|camera| (given.name.as_deref(), camera)))
}

fn of(given: &json::Camera, rest: DMat3, warnings: &Warnings) -> Result<Option<Camera>, Refusal> {
    let (forward, up) = (rest * -DVec3::Z, rest * DVec3::Y);
    if let Some(perspective) = &given.perspective {
        let fov = perspective.yfov;
        if !(fov > 0.0 && fov < PI) {
            return Err(Refusal::new(format!("must lie between 0 and π, not {fov}")))
                .within(|| "perspective.yfov".to_owned());
        }
        return Ok(Some(Camera::looking(DVec3::ZERO, forward, up, fov)?));
    }
    warnings.add(if given.orthographic.is_some() {
        "orthographic cameras are left out"
    } else {
        "a camera of neither projection is left out"
    });
    Ok(None)
}
