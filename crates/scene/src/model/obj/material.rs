//! What material comes nearest to what an MTL file describes?
//!
//! Colours are linear. The exponent n of a highlight is the roughness √α with α = √(2 / (n + 2)) (Walter and others, "Microfacet
//! models for refraction through rough surfaces", EGSR 2007); a specular colour of a half is that of a surface of the index of
//! refraction that the file names. Of the models of lighting, 3, 5 and 8 are polished by as much as the specular colour says,
//! and 6 and 7 are solid and clear; all others are opaque or, where they dissolve, veils.

use std::f64::consts::TAU;

use catoptra_core::texture::{Channel, TextureUse};
use catoptra_core::{Finish, InvalidPart, Kind, Material, Rgb, Value, Values};

use super::mtl::{Described, Map, Slot};
use super::pictures::{Pictures, Use};
use crate::model::warnings::Warnings;
use crate::model::{Model, ModelMaterial, Place};

/// What is scattered where a file does not say.
const GREY: f64 = 0.8;

/// What materials need beside their descriptions.
pub(super) struct Maker<'a> {
    pub(super) model: &'a mut Model,
    pub(super) pictures: Pictures<'a>,
    pub(super) warnings: &'a Warnings,
    /// What shows the colours of corners, where the file has some.
    pub(super) colors: Option<TextureUse>,
}

/// What a description comes to.
struct Look {
    diffuse: Rgb,
    /// Share that is mirrored as metal does it.
    metallic: f64,
    /// Share of the rest that goes through.
    transmission: f64,
    opacity: f64,
}

impl Maker<'_> {
    /// The material of a description, called `name`.
    ///
    /// # Errors
    /// A value that the material refuses.
    pub(super) fn make(&mut self, name: String, given: &Described) -> Result<ModelMaterial, InvalidPart> {
        let look = self.look(&name, given);
        let diffuse_map = self.map(given, Slot::Diffuse, Use::Color).or(self.colors);
        let base = textured(Value::Color(look.diffuse), diffuse_map);
        let emission_map = self.map(given, Slot::Emission, Use::Color);
        let emission = given.emission.unwrap_or(Rgb::BLACK);
        let emission = if emission_map.is_some() && emission == Rgb::BLACK { Rgb::WHITE } else { emission };
        let emission = emission * gain(given, Slot::Emission);
        let glow = (emission != Rgb::BLACK).then(|| textured(Value::Color(emission), emission_map));
        let values = Values::new();
        let material = match glow {
            // A lamp shines to both sides: files do not say which is the front.
            Some(glow) if emission.luminance() > look.diffuse.luminance() => {
                made("emissive", &values.with("radiance", glow).with("two-sided", Value::Flag(true)))?
            }
            None if is_matte(given, &look) => made("matte", &values.with("color", base))?,
            glow => {
                let values = self.principled(given, &look, values.with("base-color", base));
                made(
                    "principled",
                    &glow.into_iter().fold(values, |values, glow| values.with("emission", glow)),
                )?
            }
        };
        let finish = self.finish(given, look.opacity)?;
        Ok(ModelMaterial { name, material, finish })
    }

    fn look(&mut self, name: &str, given: &Described) -> Look {
        let has_picture = given.maps.contains_key(&Slot::Diffuse);
        let unsaid = if has_picture { Rgb::WHITE } else { Rgb::grey(GREY) };
        // Some programs write black where a picture says it all.
        let diffuse =
            given.diffuse.filter(|&diffuse| !(has_picture && diffuse == Rgb::BLACK)).unwrap_or(unsaid);
        let diffuse = diffuse * gain(given, Slot::Diffuse);
        let specular = given.specular.unwrap_or(Rgb::BLACK).map(|v| v.min(1.0));
        let illumination = given.illumination.unwrap_or(2);
        let opacity = self.opacity(name, given);
        let limited = |color: Rgb| color.map(|v| v.min(1.0));
        let share = |part: Rgb, of: Rgb| {
            if of.luminance() > 0.0 { (part.luminance() / of.luminance()).min(1.0) } else { 0.0 }
        };
        match illumination {
            3 | 5 | 8 if given.metallic.is_none() && specular != Rgb::BLACK => {
                // Greys come out as they are written: this much scattered, that much mirrored.
                let all = limited(diffuse + specular);
                Look { diffuse: all, metallic: share(specular, all), transmission: 0.0, opacity }
            }
            6 | 7 if opacity < 1.0 || given.filter.is_some_and(|filter| filter != Rgb::BLACK) => {
                let filter = given.filter.filter(|&filter| filter != Rgb::BLACK).unwrap_or(Rgb::WHITE);
                let passed =
                    if opacity < 1.0 { 1.0 - opacity } else { (1.0 - diffuse.max_channel()).max(0.0) };
                let all = limited(diffuse * (1.0 - passed) + limited(filter) * passed);
                Look { diffuse: all, metallic: 0.0, transmission: passed, opacity: 1.0 }
            }
            _ => Look {
                diffuse: limited(diffuse),
                metallic: fraction(given.metallic),
                transmission: 0.0,
                opacity,
            },
        }
    }

    fn opacity(&mut self, name: &str, given: &Described) -> f64 {
        let has_picture = given.maps.contains_key(&Slot::Opacity);
        match (given.dissolve, given.transparency) {
            (Some(dissolve), _) if !(has_picture && dissolve == 0.0) => dissolve.clamp(0.0, 1.0),
            (None, Some(clear)) if clear >= 1.0 && !has_picture => {
                let message = format!("the material {name} would not be seen at all (Tr 1): taken as opaque");
                self.warnings.add(Place::File, message);
                1.0
            }
            (None, Some(clear)) if clear < 1.0 => 1.0 - clear.clamp(0.0, 1.0),
            _ => 1.0,
        }
    }

    /// Adds all but colour and light.
    fn principled(&mut self, given: &Described, look: &Look, values: Values) -> Values {
        let specular = given.specular.filter(|_| given.illumination.is_none_or(|model| model >= 2));
        let strength = specular.map_or(if has_pbr(given) { 0.5 } else { 0.0 }, Rgb::max_channel);
        let mirrored = look.metallic > 0.0 || look.transmission > 0.0;
        let unsaid = if mirrored && !has_pbr(given) { 0.0 } else { 0.5 };
        let blurred = given.exponent.map(|n| (2.0 / (n.clamp(0.0, 1e12) + 2.0)).sqrt().sqrt());
        let roughness = given.roughness.or(blurred).unwrap_or(unsaid);
        let ior = given.ior.filter(|ior| *ior != 1.0 && (0.1..=10.0).contains(ior)).unwrap_or(1.5);
        let mut values = values
            .with("ior", Value::Number(ior))
            .with("specular", Value::Number((2.0 * strength).min(1.0)))
            .with("transmission", Value::Number(look.transmission));
        let tint = specular.filter(|_| strength > 0.0).map(|color| color.map(|v| v / strength));
        let tint_map = self.map(given, Slot::Specular, Use::Color);
        if tint.is_some_and(|tint| tint != Rgb::WHITE) || tint_map.is_some() {
            values.set("specular-color", textured(Value::Color(tint.unwrap_or(Rgb::WHITE)), tint_map));
        }
        let mut level = |field: &'static str, slot: Slot, given_value: Option<f64>, value: f64| {
            let map = self.map(given, slot, Use::Number);
            // Where nothing but a picture says how much, it says it all.
            let value = if map.is_some() { given_value.unwrap_or(1.0) } else { value };
            values.set(field, textured(Value::Number(value.clamp(0.0, 1.0)), map));
        };
        level("roughness", Slot::Roughness, given.roughness, roughness);
        level("metallic", Slot::Metallic, given.metallic, look.metallic);
        level("sheen", Slot::Sheen, given.sheen, fraction(given.sheen));
        values
            .with("coat", Value::Number(fraction(given.coat)))
            .with("coat-roughness", Value::Number(fraction(given.coat_roughness)))
            .with("anisotropy", Value::Number(fraction(given.anisotropy)))
            .with("anisotropy-rotation", Value::Number(fraction(given.anisotropy_rotation) * TAU))
    }

    fn finish(&mut self, given: &Described, opacity: f64) -> Result<Finish, InvalidPart> {
        let opacity_map = self.map(given, Slot::Opacity, Use::Opacity);
        let mut values = Values::new().with("opacity", textured(Value::Number(opacity), opacity_map));
        let normals = [(Slot::Normal, Use::Normals), (Slot::Bump, Use::Bumps)]
            .into_iter()
            .find_map(|(slot, what)| self.map(given, slot, what).map(|by| (by, given.maps.get(&slot))));
        if let Some((by, map)) = normals {
            values.set("normal-map", Value::Texture(by.texture));
            values.set("normal-strength", Value::Number(map.map_or(1.0, |map: &Map| map.strength.abs())));
        }
        catoptra_core::part::make(&values)
    }

    fn map(&mut self, given: &Described, slot: Slot, what: Use) -> Option<TextureUse> {
        let map = given.maps.get(&slot)?;
        let mut by = self.pictures.texture(map, what, self.model, self.warnings)?;
        if by.channel.is_none() && what == Use::Number {
            by.channel = Some(map.channel.unwrap_or(Channel::Red));
        }
        Some(by)
    }
}

/// What a picture is multiplied by beside the colour over it.
fn gain(given: &Described, slot: Slot) -> f64 {
    given.maps.get(&slot).map_or(1.0, |map| map.gain.max(0.0))
}

/// Whether it uses the words for physically based materials.
fn has_pbr(given: &Described) -> bool {
    let numbers = [given.roughness, given.metallic, given.sheen, given.coat, given.anisotropy];
    let maps = [Slot::Roughness, Slot::Metallic, Slot::Sheen];
    numbers.iter().any(Option::is_some) || maps.iter().any(|slot| given.maps.contains_key(slot))
}

/// Whether it scatters and does nothing else.
fn is_matte(given: &Described, look: &Look) -> bool {
    let shines = given.specular.is_some_and(|specular| specular != Rgb::BLACK)
        && given.illumination.is_none_or(|model| model >= 2);
    let has_map = given.maps.contains_key(&Slot::Specular);
    !shines && !has_map && !has_pbr(given) && look.metallic == 0.0 && look.transmission == 0.0
}

fn fraction(value: Option<f64>) -> f64 {
    value.unwrap_or(0.0).clamp(0.0, 1.0)
}

fn textured(value: Value, by: Option<TextureUse>) -> Value {
    match by {
        Some(by) => value.textured(by),
        None => value,
    }
}

fn made(kind: &str, values: &Values) -> Result<Material, InvalidPart> {
    let kind: Option<&Kind<Material>> = Material::kind_named(kind);
    kind.map_or_else(
        || Err(InvalidPart::new("material", "must be a kind of material", "none")),
        |kind| (kind.make)(values),
    )
}
