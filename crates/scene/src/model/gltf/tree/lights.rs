//! What light does a node give? `KHR_lights_punctual`: along its −z, in the units of the scene.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use catoptra_core::glam::DVec3;
use catoptra_core::light::{DirectionalLight, PointLight, SpotLight};
use catoptra_core::part::{LARGEST, make};
use catoptra_core::{Light, Rgb, Value, Values};

use crate::model::gltf::json::{self, Document, Whole, entry};
use crate::model::gltf::refusal::{Refusal, Within};
use crate::model::warnings::Warnings;

/// The number of a node's light.
pub(crate) fn of_node(given: &json::Node) -> Option<Whole> {
    Some(given.extensions.as_deref()?.light.as_ref()?.light)
}

/// All lights of a file.
pub(crate) fn all(document: &Document) -> &[json::Light] {
    document.extensions.lights.as_ref().map_or(&[][..], |found| &found.lights)
}

/// The light of that number, at the origin and shining along `direction`, and its name.
///
/// # Errors
/// None is there, or one of a kind that is not known.
pub(crate) fn light<'d>(
    document: &'d Document,
    index: Whole,
    direction: DVec3,
    warnings: &Warnings,
) -> Result<(Option<&'d str>, Light), Refusal> {
    let given = entry(all(document), index, "KHR_lights_punctual.lights")?;
    let made = of(given, direction, warnings).within(|| format!("KHR_lights_punctual.lights[{index}]"))?;
    Ok((given.name.as_deref(), made))
}

fn of(given: &json::Light, direction: DVec3, warnings: &Warnings) -> Result<Light, Refusal> {
    if given.range.is_some() {
        warnings.add_of_file("the range of lights is left out: light falls with the square of the distance");
    }
    let intensity = given.intensity.unwrap_or(1.0);
    let channel = |v: f64| (v * intensity).clamp(0.0, LARGEST);
    let color = given.color.unwrap_or([1.0; 3]).map(channel);
    let color = Rgb::new(color[0], color[1], color[2]);
    let light = match &*given.kind {
        "directional" => DirectionalLight::new(direction, color).map(Light::from),
        "point" => PointLight::new(DVec3::ZERO, color).map(Light::from),
        "spot" => make::<SpotLight>(&spot(&given.spot, direction, color)).map(Light::from),
        other => return Err(Refusal::new(format!("the type \"{other}\" is not known"))),
    };
    Ok(light?)
}

/// The extension gives half angles, and squares a share that is linear in cosines.
fn spot(given: &json::Spot, direction: DVec3, color: Rgb) -> Values {
    let outer = given.outer_cone_angle.unwrap_or(FRAC_PI_4);
    let outer = if outer > 0.0 { outer.min(FRAC_PI_2) } else { FRAC_PI_4 };
    let inner = given.inner_cone_angle.unwrap_or(0.0).clamp(0.0, outer);
    Values::new()
        .with("direction", Value::Vector(direction))
        .with("intensity", Value::Color(color))
        .with("inner", Value::Number(2.0 * inner))
        .with("outer", Value::Number(2.0 * outer))
        .with("falloff", Value::Number(2.0))
}
