//! How do pictures that an MTL file names become textures: each once, and heights as normals?

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::texture::{Channel, Encoding, TextureUse};
use catoptra_core::{Image, TextureId, Value, Values, srgb_encoded};

use super::mtl::Map;
use crate::image;
use crate::model::names::Names;
use crate::model::warnings::Warnings;
use crate::model::{Folder, Model, paint};

/// What a picture stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Use {
    Color,
    Number,
    /// Its alpha, where it has some, else its brightness.
    Opacity,
    Normals,
    /// Heights, unless it looks like normals.
    Bumps,
}

/// Textures by the picture, how it is laid, and what it stands for.
pub(super) struct Pictures<'a> {
    folder: &'a Folder,
    known: HashMap<Key, Option<TextureUse>>,
    names: Names,
}

/// A file, the bits of how it is laid, and what for.
type Key = (String, [u64; 5], Use);

/// How many pixels a height of white is high: what common pictures of bricks and stone come to, some hundred pixels to the
/// metre and a relief of a centimetre.
const HEIGHT: f64 = 8.0;

/// Pictures of more pixels are not made normals of.
const MOST_HEIGHTS: u64 = 1 << 24;

impl<'a> Pictures<'a> {
    pub(super) fn new(folder: &'a Folder) -> Self {
        Self { folder, known: HashMap::new(), names: Names::default() }
    }

    /// The texture of a picture; `None`, and a warning, where it cannot be had.
    pub(super) fn texture(
        &mut self,
        map: &Map,
        what: Use,
        model: &mut Model,
        warnings: &Warnings,
    ) -> Option<TextureUse> {
        let sign = if what == Use::Bumps { map.strength.signum() } else { 1.0 };
        let laid =
            [map.scale.x, map.scale.y, map.offset.x, map.offset.y, if map.clamp { -sign } else { sign }];
        let key = (map.file.clone(), laid.map(f64::to_bits), what);
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let found = self.read(map, what, model);
        if let Err(cause) = &found {
            warnings.add(map.place, format!("the picture {} is not shown: {cause}", map.file));
        }
        let found = found.ok();
        self.known.insert(key, found);
        found
    }

    fn read(&mut self, map: &Map, what: Use, model: &mut Model) -> Result<TextureUse, String> {
        let path = self.folder.find(&map.file)?;
        let mut picture = image::load(&path).map_err(|e| e.message().to_owned())?;
        let channel = match what {
            Use::Opacity if map.channel.is_some() => map.channel,
            Use::Opacity if picture.channels().is_multiple_of(2) && has_holes(&picture) => {
                Some(Channel::Alpha)
            }
            Use::Opacity => Some(Channel::Luminance),
            _ => None,
        };
        if what == Use::Bumps && !looks_like_normals(&picture) {
            picture = Arc::new(normals_of_heights(&picture, map.strength.signum())?);
        }
        let mut values = Values::new();
        if map.scale != DVec2::ONE {
            values.set("scale", Value::Pair(map.scale));
        }
        if map.offset != DVec2::ZERO {
            values.set("offset", Value::Pair(map.offset));
        }
        if map.clamp {
            values.set("wrap", Value::Word("clamp".to_owned()));
        }
        if what != Use::Color {
            values.set("color-space", Value::Word("linear".to_owned()));
        }
        let texture = paint::image_texture(&map.file, picture, values).map_err(|e| e.to_string())?;
        let name = map.file.rsplit(['/', '\\']).next().unwrap_or_default();
        let id: Option<TextureId> = paint::add_texture(model, self.names.unique(name), texture);
        let texture = id.ok_or("there are too many pictures")?;
        Ok(TextureUse { texture, channel })
    }
}

/// Pixels all over a picture, 64 x 64 at most.
fn spread(picture: &Image) -> impl Iterator<Item = [u32; 2]> {
    let [width, height] = [picture.width(), picture.height()];
    let (across, down) = (width.div_ceil(64) as usize, height.div_ceil(64) as usize);
    (0..height).step_by(down).flat_map(move |y| (0..width).step_by(across).map(move |x| [x, y]))
}

/// Whether any of its pixels is not opaque.
fn has_holes(picture: &Image) -> bool {
    (0..picture.height()).any(|y| (0..picture.width()).any(|x| picture.pixel(x, y).alpha < 1.0))
}

/// Numbers of a pixel as the file has them.
fn raw(picture: &Image, [x, y]: [u32; 2]) -> DVec3 {
    let color = picture.pixel(x, y).color;
    let color = if picture.natural_encoding() == Encoding::Srgb { color.map(srgb_encoded) } else { color };
    DVec3::from(color.to_array())
}

/// Whether its mean is the bluish colour of normals that look outwards.
fn looks_like_normals(picture: &Image) -> bool {
    if picture.channels() < 3 {
        return false;
    }
    let (sum, count) =
        spread(picture).fold((DVec3::ZERO, 0.0), |(sum, count), at| (sum + raw(picture, at), count + 1.0));
    let mean = sum / count;
    mean.z > 0.7 && (mean.x - 0.5).abs() < 0.15 && (mean.y - 0.5).abs() < 0.15
}

/// Normals of a surface whose heights are the brightness of a picture that repeats.
fn normals_of_heights(picture: &Image, sign: f64) -> Result<Image, String> {
    let size @ [width, height] = [picture.width(), picture.height()];
    if u64::from(width) * u64::from(height) > MOST_HEIGHTS {
        return Err(format!("{width} x {height} heights are more than 2^24"));
    }
    let heights: Vec<f32> = (0..height)
        .flat_map(|y| (0..width).map(move |x| [x, y]))
        .map(|at| (raw(picture, at).element_sum() / 3.0) as f32)
        .collect();
    let at = |x: u32, y: u32| f64::from(heights[(y % height * width + x % width) as usize]);
    let mut normals = Vec::with_capacity(3 * heights.len());
    for y in 0..height {
        for x in 0..width {
            // Rows go down, v goes up.
            let right = at(x + 1, y) - at(x + width - 1, y);
            let up = at(x, y + height - 1) - at(x, y + 1);
            let slope = DVec2::new(right, up) * (0.5 * HEIGHT * sign);
            let normal = (-slope).extend(1.0).normalize() * 0.5 + 0.5;
            normals.extend(normal.to_array().map(|v| v as f32));
        }
    }
    Image::from_floats(size, 3, normals, Encoding::Linear).map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(size: [u32; 2], height: impl Fn(u32, u32) -> u8) -> Image {
        let bytes =
            (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y])).map(|[x, y]| height(x, y)).collect();
        Image::from_bytes(size, 1, bytes).unwrap()
    }

    fn normal(picture: &Image, x: u32, y: u32) -> DVec3 {
        DVec3::from(picture.pixel(x, y).color.to_array()) * 2.0 - 1.0
    }

    #[test]
    fn normals_lean_away_from_what_is_higher() {
        let flat = normals_of_heights(&grey([3, 2], |_, _| 77), 1.0).unwrap();
        assert!((normal(&flat, 1, 1) - DVec3::Z).length() < 1e-6);
        // Higher to the right by a 255th each pixel: 8 pixels to 255.
        let ramp = grey([64, 1], |x, _| x as u8);
        let slope = HEIGHT / 255.0;
        let expected = DVec3::new(-slope, 0.0, 1.0).normalize();
        assert!((normal(&normals_of_heights(&ramp, 1.0).unwrap(), 30, 0) - expected).length() < 1e-5);
        let down = normals_of_heights(&grey([1, 64], |_, y| y as u8), -1.0).unwrap();
        // Lower upwards, and turned over.
        let expected = DVec3::new(0.0, -slope, 1.0).normalize();
        assert!((normal(&down, 0, 30) - expected).length() < 1e-5, "{}", normal(&down, 0, 30));
    }

    #[test]
    fn pictures_of_normals_are_told_by_their_colour() {
        let filled = |pixel: [u8; 3]| Image::from_bytes([4, 4], 3, pixel.repeat(16)).unwrap();
        assert!(looks_like_normals(&filled([128, 128, 255])));
        assert!(looks_like_normals(&filled([110, 140, 240])));
        assert!(!looks_like_normals(&filled([128, 128, 128])));
        assert!(!looks_like_normals(&grey([4, 4], |_, _| 200)));
    }
}
