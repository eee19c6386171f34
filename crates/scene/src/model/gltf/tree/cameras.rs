//! What does a node look at? Along its −z, with its y upwards.

use std::f64::consts::PI;

use catoptra_core::glam::DVec3;
use catoptra_core::{Camera, Extent};

use super::Outer;
use crate::model::gltf::json::{self, Document, Whole, entry};
use crate::model::gltf::refusal::{Refusal, Within};
use crate::model::warnings::Warnings;

/// The camera of that number, at the origin, and its name; `None` for one of no projection. What stands within `outer` will be
/// scaled by its scale, which sizes of cameras do not know of.
///
/// # Errors
/// None is there, or its extent is none.
pub(crate) fn camera<'d>(
    document: &'d Document,
    index: Whole,
    outer: Outer,
    warnings: &Warnings,
) -> Result<Option<(Option<&'d str>, Camera)>, Refusal> {
    let given = entry(&document.cameras, index, "cameras")?;
    let made = of(given, outer, warnings).within(|| format!("cameras[{index}]"))?;
    Ok(made.map(|camera| (given.name.as_deref(), camera)))
}

fn of(given: &json::Camera, outer: Outer, warnings: &Warnings) -> Result<Option<Camera>, Refusal> {
    let rest = outer.rest.matrix();
    let (forward, up) = (rest * -DVec3::Z, rest * DVec3::Y);
    if let Some(perspective) = &given.perspective {
        let fov = perspective.yfov;
        if !(fov > 0.0 && fov < PI) {
            return Err(Refusal::new(format!("must lie between 0 and π, not {fov}")))
                .within(|| "perspective.yfov".to_owned());
        }
        return Ok(Some(Camera::looking(DVec3::ZERO, forward, up, fov)?));
    }
    let Some(orthographic) = &given.orthographic else {
        warnings.add_of_file("a camera of neither projection is left out");
        return Ok(None);
    };
    // Half of what is seen; some programs write it below 0.
    let height = 2.0 * orthographic.ymag.abs() / outer.world.scale();
    let camera = Camera::looking(DVec3::ZERO, forward, up, PI / 2.0)?.with_extent(Extent::Height(height));
    camera.map(Some).map_err(Refusal::new).within(|| "orthographic.ymag".to_owned())
}
