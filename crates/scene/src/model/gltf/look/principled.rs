//! What `principled` is a material of a glTF file?

use catoptra_core::material::Principled;
use catoptra_core::part::{LARGEST, make};
use catoptra_core::texture::{Channel, Encoding};
use catoptra_core::{Material, Rgb, Value, Values};

use super::painter::Painter;
use super::specular_glossiness;
use crate::model::gltf::json::{self, MaterialExtensions, MetallicRoughness};
use crate::model::gltf::refusal::Refusal;

/// The material, without what its finish says.
///
/// # Errors
/// A texture that is not there.
pub(super) fn principled(given: &json::Material, painter: &mut Painter<'_, '_>) -> Result<Material, Refusal> {
    let none = MaterialExtensions::default();
    let extensions = given.extensions.as_deref().unwrap_or(&none);
    let values = base(given, extensions, painter)?;
    let values = match &extensions.unlit {
        Some(_) => values.with("unlit", Value::Flag(true)),
        None => layers(given, extensions, values, painter)?,
    };
    Ok(make::<Principled>(&values)?.into())
}

/// Colour, metal and roughness.
fn base(
    given: &json::Material,
    extensions: &MaterialExtensions,
    painter: &mut Painter<'_, '_>,
) -> Result<Values, Refusal> {
    if let Some(archived) = &extensions.specular_glossiness {
        return specular_glossiness::base(archived, painter);
    }
    let none = MetallicRoughness::default();
    let pbr = given.pbr_metallic_roughness.as_deref().unwrap_or(&none);
    let [r, g, b, _] = pbr.base_color_factor.unwrap_or([1.0; 4]);
    let both = pbr.metallic_roughness_texture.as_ref();
    Ok(Values::new()
        .with("base-color", painter.color([r, g, b], pbr.base_color_texture.as_ref())?)
        .with("metallic", painter.fraction(pbr.metallic_factor.unwrap_or(1.0), both, Channel::Blue)?)
        .with("roughness", painter.fraction(pbr.roughness_factor.unwrap_or(1.0), both, Channel::Green)?))
}

/// What lies over the base, goes through it, or shines.
fn layers(
    given: &json::Material,
    extensions: &MaterialExtensions,
    values: Values,
    painter: &mut Painter<'_, '_>,
) -> Result<Values, Refusal> {
    let values = emission(given, extensions, values, painter)?;
    let values = clear(extensions, values, painter)?;
    let values = specular(extensions, values, painter)?;
    let values = coat(extensions, values, painter)?;
    let values = sheen(extensions, values, painter)?;
    anisotropy(extensions, values, painter)
}

fn emission(
    given: &json::Material,
    extensions: &MaterialExtensions,
    values: Values,
    painter: &mut Painter<'_, '_>,
) -> Result<Values, Refusal> {
    let strength = extensions.emissive_strength.as_ref().and_then(|e| e.emissive_strength).unwrap_or(1.0);
    let light = given.emissive_factor.unwrap_or([0.0; 3]).map(|v| (v * strength).clamp(0.0, LARGEST));
    if light == [0.0; 3] {
        return Ok(values);
    }
    let light = Value::Color(Rgb::new(light[0], light[1], light[2]));
    let light = painter.painted(light, given.emissive_texture.as_deref(), Encoding::Srgb, None)?;
    Ok(values.with("emission", light))
}

/// Refraction. Without a volume, or with one of no thickness, it is a sheet.
fn clear(
    extensions: &MaterialExtensions,
    mut values: Values,
    painter: &mut Painter<'_, '_>,
) -> Result<Values, Refusal> {
    /// Stands for an index of 0, which the extension gives to what reflects all.
    const MIRROR: f64 = 1e4;
    if let Some(ior) = extensions.ior.as_ref().and_then(|given| given.ior) {
        values.set("ior", Value::Number(if ior > 0.0 { ior.min(LARGEST) } else { MIRROR }));
    }
    let Some(transmission) = extensions.transmission.as_ref().filter(|given| given.transmission_factor > 0.0)
    else {
        return Ok(values);
    };
    let by = transmission.transmission_texture.as_ref();
    values.set("transmission", painter.fraction(transmission.transmission_factor, by, Channel::Red)?);
    let volume = extensions.volume.as_ref().filter(|volume| volume.thickness_factor > 0.0);
    let Some(volume) = volume else { return Ok(values.with("thin", Value::Flag(true))) };
    if let Some(distance) =
        volume.attenuation_distance.filter(|&distance| distance > 0.0 && distance <= LARGEST)
    {
        values.set("tint", painter.color(volume.attenuation_color.unwrap_or([1.0; 3]), None)?);
        values.set("tint-distance", Value::Number(distance));
    }
    Ok(values)
}

fn specular(
    extensions: &MaterialExtensions,
    values: Values,
    painter: &mut Painter<'_, '_>,
) -> Result<Values, Refusal> {
    let Some(given) = &extensions.specular else { return Ok(values) };
    let color = given.specular_color_factor.unwrap_or([1.0; 3]);
    if color.iter().any(|&v| v > 1.0) {
        painter.source.warnings.add_of_file("a specularColorFactor over 1 counts as 1");
    }
    let strength = given.specular_factor.unwrap_or(1.0);
    Ok(values
        .with("specular", painter.fraction(strength, given.specular_texture.as_ref(), Channel::Alpha)?)
        .with("specular-color", painter.color(color, given.specular_color_texture.as_ref())?))
}

fn coat(
    extensions: &MaterialExtensions,
    values: Values,
    painter: &mut Painter<'_, '_>,
) -> Result<Values, Refusal> {
    let Some(given) = extensions.clearcoat.as_ref().filter(|given| given.clearcoat_factor > 0.0) else {
        return Ok(values);
    };
    if given.clearcoat_normal_texture.is_some() {
        painter
            .source
            .warnings
            .add_of_file("normal maps of clear coats are left out: coats follow what they lie on");
    }
    let roughness = given.clearcoat_roughness_texture.as_ref();
    Ok(values
        .with(
            "coat",
            painter.fraction(given.clearcoat_factor, given.clearcoat_texture.as_ref(), Channel::Red)?,
        )
        .with(
            "coat-roughness",
            painter.fraction(given.clearcoat_roughness_factor, roughness, Channel::Green)?,
        ))
}

fn sheen(
    extensions: &MaterialExtensions,
    values: Values,
    painter: &mut Painter<'_, '_>,
) -> Result<Values, Refusal> {
    let Some(given) = extensions.sheen.as_ref().filter(|given| given.sheen_color_factor != [0.0; 3]) else {
        return Ok(values);
    };
    let roughness = given.sheen_roughness_texture.as_ref();
    Ok(values
        .with("sheen", Value::Number(1.0))
        .with("sheen-color", painter.color(given.sheen_color_factor, given.sheen_color_texture.as_ref())?)
        .with("sheen-roughness", painter.fraction(given.sheen_roughness_factor, roughness, Channel::Alpha)?))
}

fn anisotropy(
    extensions: &MaterialExtensions,
    values: Values,
    painter: &mut Painter<'_, '_>,
) -> Result<Values, Refusal> {
    let Some(given) = extensions.anisotropy.as_ref().filter(|given| given.anisotropy_strength > 0.0) else {
        return Ok(values);
    };
    let by = given.anisotropy_texture.as_ref();
    if by.is_some() {
        painter
            .source
            .warnings
            .add_of_file("directions in anisotropy textures are left out: the strength alone is taken");
    }
    Ok(values
        .with("anisotropy", painter.fraction(given.anisotropy_strength, by, Channel::Blue)?)
        .with("anisotropy-rotation", Value::Number(given.anisotropy_rotation)))
}
