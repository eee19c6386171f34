//! What `principled` is a material of diffuse and specular colour? `KHR_materials_pbrSpecularGlossiness`, which is archived but
//! common: turned into metal and roughness pixel by pixel, as the extension's own example does.

use catoptra_core::texture::{Channel, Encoding};
use catoptra_core::{Image, ImageSource, Rgb, TextureUse, Value, Values, srgb_encoded};

use super::painter::Painter;
use super::pictures::made;
use crate::model::gltf::json::SpecularGlossiness;
use crate::model::gltf::refusal::Refusal;

/// What a dielectric reflects at normal incidence, of an index of refraction of 1.5.
const DIELECTRIC: f64 = 0.04;

/// One place of such a material.
#[derive(Debug, Clone, Copy)]
struct Place {
    diffuse: Rgb,
    specular: Rgb,
    glossiness: f64,
}

/// The same as metal and roughness.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Metal {
    color: Rgb,
    metallic: f64,
    roughness: f64,
}

/// Colour, metal and roughness.
pub(super) fn base(given: &SpecularGlossiness, painter: &mut Painter<'_, '_>) -> Result<Values, Refusal> {
    painter.source.warnings.add_of_file(
        "materials of specular colour and glossiness are shown as much the same of metal and roughness",
    );
    let [r, g, b, _] = given.diffuse_factor.unwrap_or([1.0; 4]);
    let [sr, sg, sb] = given.specular_factor.unwrap_or([1.0; 3]);
    let factors = Place {
        diffuse: Rgb::new(r, g, b),
        specular: Rgb::new(sr, sg, sb),
        glossiness: given.glossiness_factor.unwrap_or(1.0),
    };
    let textures = [given.diffuse_texture.as_ref(), given.specular_glossiness_texture.as_ref()];
    let mut pictures = [None, None];
    for (picture, by) in pictures.iter_mut().zip(textures) {
        *picture = by.map(|by| painter.picture(by)).transpose()?.flatten();
    }
    let laid = match textures.into_iter().flatten().next_back() {
        Some(by) => painter.laid(by)?,
        None => None,
    };
    let (Some((_, laid)), true) = (laid, pictures.iter().any(Option::is_some)) else {
        return Ok(plain(factors.to_metal()));
    };
    let [color, rest] = baked(factors, &pictures)?;
    painter.source.limits.take_pixels(&color)?;
    painter.source.limits.take_pixels(&rest)?;
    let color = painter.add(Some("diffuse"), made(color), laid, Encoding::Srgb)?;
    let rest = painter.add(Some("metal and roughness"), made(rest), laid, Encoding::Linear)?;
    let share = |channel| Value::Number(1.0).textured(TextureUse { texture: rest, channel: Some(channel) });
    Ok(Values::new()
        .with("base-color", Value::Color(Rgb::WHITE).textured(TextureUse::of(color)))
        .with("metallic", share(Channel::Blue))
        .with("roughness", share(Channel::Green)))
}

fn plain(metal: Metal) -> Values {
    Values::new()
        .with("base-color", Value::Color(metal.color))
        .with("metallic", Value::Number(metal.metallic))
        .with("roughness", Value::Number(metal.roughness))
}

/// A picture of the colour, and one of roughness (green) and metal (blue).
fn baked(factors: Place, pictures: &[Option<ImageSource>; 2]) -> Result<[Image; 2], Refusal> {
    let sizes = pictures.iter().flatten().map(|picture| [picture.image.width(), picture.image.height()]);
    let [width, height] = sizes.fold([1, 1], |[w, h], [other_w, other_h]| [w.max(other_w), h.max(other_h)]);
    let pixel = |picture: &Option<ImageSource>, x: u32, y: u32| {
        picture.as_ref().map(|picture| {
            let at = |i: u32, of: u32, own: u32| (u64::from(i) * u64::from(own) / u64::from(of)) as u32;
            picture.image.pixel(at(x, width, picture.image.width()), at(y, height, picture.image.height()))
        })
    };
    let byte = |share: f64| (share.clamp(0.0, 1.0) * 255.0).round() as u8;
    let (mut colors, mut rest) = (Vec::new(), Vec::new());
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let [diffuse, specular] = [&pictures[0], &pictures[1]].map(|picture| pixel(picture, x, y));
        let place = Place {
            diffuse: diffuse.map_or(factors.diffuse, |texel| factors.diffuse * texel.color),
            specular: specular.map_or(factors.specular, |texel| factors.specular * texel.color),
            glossiness: specular.map_or(factors.glossiness, |texel| factors.glossiness * texel.alpha),
        };
        let metal = place.to_metal();
        colors.extend(metal.color.to_array().map(|v| byte(srgb_encoded(v))));
        rest.extend([0, byte(metal.roughness), byte(metal.metallic)]);
    }
    let size = [width, height];
    Ok([Image::from_bytes(size, 3, colors)?, Image::from_bytes(size, 3, rest)?])
}

impl Place {
    fn to_metal(self) -> Metal {
        /// Below this share of metal or of the rest its colour cannot be told.
        const LEAST: f64 = 1e-6;
        let dimmed = 1.0 - self.specular.max_channel();
        let metallic = metallic(brightness(self.diffuse), brightness(self.specular), dimmed);
        let of_rest = self.diffuse * (dimmed / (1.0 - DIELECTRIC) / (1.0 - metallic).max(LEAST));
        let of_metal =
            (self.specular - Rgb::grey(DIELECTRIC * (1.0 - metallic))) * (1.0 / metallic.max(LEAST));
        let share = metallic * metallic;
        let color = (of_rest * (1.0 - share) + of_metal * share).map(|v| v.clamp(0.0, 1.0));
        Metal { color, metallic, roughness: (1.0 - self.glossiness).clamp(0.0, 1.0) }
    }
}

/// How bright a colour looks (Finley, "HSP color model", 2006).
fn brightness(c: Rgb) -> f64 {
    (0.299 * c.r * c.r + 0.587 * c.g * c.g + 0.114 * c.b * c.b).sqrt()
}

/// How much metal shows that much of both: the root of the quadratic that equal light on both sides gives.
fn metallic(diffuse: f64, specular: f64, dimmed: f64) -> f64 {
    if specular < DIELECTRIC {
        return 0.0;
    }
    let b = diffuse * dimmed / (1.0 - DIELECTRIC) + specular - 2.0 * DIELECTRIC;
    let c = DIELECTRIC - specular;
    ((-b + (b * b - 4.0 * DIELECTRIC * c).max(0.0).sqrt()) / (2.0 * DIELECTRIC)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn metal(diffuse: Rgb, specular: Rgb) -> Metal {
        Place { diffuse, specular, glossiness: 0.75 }.to_metal()
    }

    #[test]
    fn plastic_and_gold_stay_what_they_are() {
        let red = Rgb::new(0.8, 0.1, 0.05);
        let plastic = metal(red, Rgb::grey(DIELECTRIC));
        assert!(plastic.metallic < 1e-9 && plastic.roughness == 0.25, "{plastic:?}");
        assert!((plastic.color - red).to_array().iter().all(|v| v.abs() < 1e-9));
        let yellow = Rgb::new(1.0, 0.77, 0.34);
        let gold = metal(Rgb::BLACK, yellow);
        assert!(gold.metallic > 0.999, "{gold:?}");
        assert!((gold.color - yellow).to_array().iter().all(|v| v.abs() < 1e-3));
    }
}
