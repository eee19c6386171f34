//! What light does a picture, or a smaller copy of it, have at a place?

use std::sync::LazyLock;

use glam::{DVec2, Vec3, Vec4};

use super::pyramid::Pyramid;
use super::{Encoding, Plane, Samples};
use crate::texture::Texel;
use crate::{Rgb, srgb_decoded};

/// What lies beyond the borders of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The picture again.
    Repeat,
    /// The picture again, mirrored every other time.
    Mirror,
    /// The pixels of its border.
    Clamp,
}

/// Linear red, green, blue and alpha.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Light(pub(super) Vec4);

impl Light {
    pub(super) fn texel(self) -> Texel {
        let [r, g, b, alpha] = self.0.to_array().map(f64::from);
        Texel { color: Rgb::new(r, g, b), alpha }
    }
}

/// The light of each byte.
static SRGB: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|i| srgb_decoded(i as f64 / 255.0) as f32));

/// Each byte as a share of 255.
static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| std::array::from_fn(|i| i as f32 / 255.0));

/// The light that bytes stand for.
pub(super) fn table(encoding: Encoding) -> &'static [f32; 256] {
    match encoding {
        Encoding::Srgb => &SRGB,
        Encoding::Linear => &LINEAR,
    }
}

/// The light of one pixel, which must lie on the plane.
pub(super) fn light_of(plane: &Plane, encoding: Encoding, x: u32, y: u32) -> Light {
    let at = (y as usize * plane.width as usize + x as usize) * usize::from(plane.channels);
    match (&plane.samples, encoding) {
        (Samples::Bytes(bytes), _) => {
            let (light, share) = (table(encoding), table(Encoding::Linear));
            grouped(plane.channels, &bytes[at..], |v| light[usize::from(v)], |v| share[usize::from(v)])
        }
        (Samples::Floats(floats), Encoding::Linear) => grouped(plane.channels, &floats[at..], |v| v, |v| v),
        (Samples::Floats(floats), Encoding::Srgb) => {
            grouped(plane.channels, &floats[at..], |v| srgb_decoded(f64::from(v)) as f32, |v| v)
        }
    }
}

/// The light of the pixel that samples begin with.
#[inline(always)]
fn grouped<T: Copy>(
    channels: u8,
    samples: &[T],
    color: impl Fn(T) -> f32,
    alpha: impl Fn(T) -> f32,
) -> Light {
    Light(match (channels, samples) {
        (1, &[v, ..]) => Vec3::splat(color(v)).extend(1.0),
        (2, &[v, a, ..]) => Vec3::splat(color(v)).extend(alpha(a)),
        (3, &[r, g, b, ..]) => Vec4::new(color(r), color(g), color(b), 1.0),
        (_, &[r, g, b, a, ..]) => Vec4::new(color(r), color(g), color(b), alpha(a)),
        // No plane ends within a pixel.
        _ => Vec4::W,
    })
}

/// A picture as light, at its own size and in ever smaller copies.
#[derive(Debug, Clone, Copy)]
pub struct Levels<'a> {
    finest: &'a Plane,
    coarser: &'a [Plane],
    encoding: Encoding,
}

impl<'a> Levels<'a> {
    pub(super) fn new(plane: &'a Plane, pyramid: &'a Pyramid, encoding: Encoding) -> Self {
        // Copies in floating point hold light already.
        let encoding = match plane.samples {
            Samples::Bytes(_) => encoding,
            Samples::Floats(_) => Encoding::Linear,
        };
        Self { finest: pyramid.finest.as_ref().unwrap_or(plane), coarser: &pyramid.coarser, encoding }
    }

    /// How many copies there are, the picture itself included; the last is one pixel.
    #[must_use]
    pub fn count(&self) -> usize {
        1 + self.coarser.len()
    }

    /// Width and height of a copy, from 0 for the picture; those of the last one beyond.
    #[must_use]
    pub fn size(&self, level: usize) -> DVec2 {
        let plane = self.plane(level);
        DVec2::new(f64::from(plane.width), f64::from(plane.height))
    }

    fn plane(&self, level: usize) -> &'a Plane {
        match level {
            0 => self.finest,
            _ => self.coarser.get(level - 1).or(self.coarser.last()).unwrap_or(self.finest),
        }
    }

    /// A pixel of a copy by its column and row from the top left, which may lie beyond the borders.
    #[inline]
    pub(super) fn light(&self, level: usize, wrap: [Wrap; 2], x: i64, y: i64) -> Light {
        let plane = self.plane(level);
        light_of(plane, self.encoding, wrapped(wrap[0], x, plane.width), wrapped(wrap[1], y, plane.height))
    }

    /// The four pixels of a copy round a place: the first one's column and row, and the place's share of the way to the
    /// others.
    #[inline]
    pub(super) fn between(&self, level: usize, uv: DVec2) -> ([i64; 2], [f64; 2]) {
        let size = self.size(level);
        let place = DVec2::new(uv.x * size.x, (1.0 - uv.y) * size.y) - DVec2::splat(0.5);
        let first = place.floor();
        ([first.x as i64, first.y as i64], (place - first).to_array())
    }

    /// The light of a copy at a place, linear between its pixels.
    #[inline]
    pub(super) fn bilinear(&self, level: usize, wrap: [Wrap; 2], uv: DVec2) -> Vec4 {
        let ([x, y], [along, down]) = self.between(level, uv);
        let (along, down) = (along as f32, down as f32);
        let row = |y: i64| self.light(level, wrap, x, y).0.lerp(self.light(level, wrap, x + 1, y).0, along);
        row(y).lerp(row(y + 1), down)
    }
}

/// A column or row within the picture for one that may lie beyond.
#[inline]
fn wrapped(wrap: Wrap, i: i64, count: u32) -> u32 {
    let count = i64::from(count);
    if (0..count).contains(&i) {
        return i as u32;
    }
    let within = match wrap {
        Wrap::Repeat => i.rem_euclid(count),
        Wrap::Clamp => i.clamp(0, count - 1),
        Wrap::Mirror => {
            let both = i.rem_euclid(2 * count);
            both.min(2 * count - 1 - both)
        }
    };
    within as u32
}

/// Texture coordinates near 0 that show the same as these; the middle for none.
pub(super) fn reduced(wrap: [Wrap; 2], uv: DVec2) -> DVec2 {
    if !uv.is_finite() {
        return DVec2::splat(0.5);
    }
    let along = |wrap, v: f64| match wrap {
        Wrap::Repeat => v - v.floor(),
        Wrap::Mirror => v - 2.0 * (v / 2.0).floor(),
        Wrap::Clamp => v.clamp(-1.0, 2.0),
    };
    DVec2::new(along(wrap[0], uv.x), along(wrap[1], uv.y))
}
