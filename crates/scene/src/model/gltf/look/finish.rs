//! How opaque, how bumpy and how many-sided is a material of a glTF file?

use catoptra_core::part::make;
use catoptra_core::texture::{Channel, Encoding};
use catoptra_core::{Finish, Value, Values};

use super::painter::Painter;
use crate::model::gltf::json::{self, TextureInfo};
use crate::model::gltf::refusal::{Refusal, Within};

/// # Errors
/// A texture or an alpha mode that is not there.
pub(super) fn finish(given: &json::Material, painter: &mut Painter<'_, '_>) -> Result<Finish, Refusal> {
    let mut values = opacity(given, painter)?;
    // Glass has an inside, whose surface light leaves through.
    let sides = if given.double_sided || lets_light_through(given) { "double" } else { "single" };
    values.set("sides", Value::Word(sides.to_owned()));
    if let Some(by) = given.normal_texture.as_deref()
        && let Some(texture) = painter.texture(by, Encoding::Linear)?
    {
        values.set("normal-map", Value::Texture(texture));
        values.set("normal-strength", Value::Number(by.scale.unwrap_or(1.0).max(0.0)));
    }
    Ok(make::<Finish>(&values)?)
}

fn lets_light_through(given: &json::Material) -> bool {
    let transmission = given.extensions.as_deref().and_then(|found| found.transmission.as_ref());
    transmission.is_some_and(|found| found.transmission_factor > 0.0)
}

fn opacity(given: &json::Material, painter: &mut Painter<'_, '_>) -> Result<Values, Refusal> {
    let values = Values::new();
    let cutoff = match given.alpha_mode.as_deref().unwrap_or("OPAQUE") {
        "OPAQUE" => return Ok(values),
        "MASK" => Some(given.alpha_cutoff.unwrap_or(0.5)),
        "BLEND" => None,
        other => {
            return Err(Refusal::new(format!("is none of OPAQUE, MASK and BLEND, but \"{other}\"")))
                .within(|| "alphaMode".to_owned());
        }
    };
    let (factor, by) = alpha(given);
    let picture = by.map(|by| painter.picture(by)).transpose()?.flatten();
    let by = by.filter(|_| picture.is_some_and(|picture| picture.image.channels().is_multiple_of(2)));
    let opacity = painter.fraction(factor, by, Channel::Alpha)?;
    Ok(match cutoff {
        // Beyond all opacities: nothing is there.
        Some(cutoff) if cutoff > 1.0 => values.with("opacity", Value::Number(0.0)),
        Some(cutoff) => {
            values.with("opacity", opacity).with("alpha-cutoff", Value::Number(cutoff.clamp(0.0, 1.0)))
        }
        None => values.with("opacity", opacity),
    })
}

/// What opacity is made of: a factor, and the alpha of the texture that gives the colour.
fn alpha(given: &json::Material) -> (f64, Option<&TextureInfo>) {
    let archived = given.extensions.as_deref().and_then(|found| found.specular_glossiness.as_ref());
    if let Some(found) = archived {
        return (found.diffuse_factor.map_or(1.0, |factor| factor[3]), found.diffuse_texture.as_ref());
    }
    let Some(found) = given.pbr_metallic_roughness.as_deref() else { return (1.0, None) };
    (found.base_color_factor.map_or(1.0, |factor| factor[3]), found.base_color_texture.as_ref())
}
