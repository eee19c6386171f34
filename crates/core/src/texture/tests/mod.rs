//! Are textures right at a point and on average over a pixel?

mod paint;
mod patterns;
mod pictures;
mod places;

use super::{Image, Texture};
use crate::{Value, Values};

/// Numbers that look random, in 0..1 (xorshift, Marsaglia 2003).
pub(super) fn random(state: &mut u64) -> f64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

pub(super) fn texture(kind: &str, values: &Values) -> Texture {
    (Texture::kind_named(kind).unwrap().make)(values).unwrap()
}

pub(super) fn word(word: &str) -> Value {
    Value::Word(word.into())
}

/// A picture of bytes by column and row.
pub(super) fn picture(width: u32, height: u32, byte: impl Fn(u32, u32) -> u8) -> Image {
    let bytes = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| byte(x, y)).collect();
    Image::from_bytes([width, height], 1, bytes).unwrap()
}
