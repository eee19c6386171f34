//! How are 8-bit colours weighed and added, four channels in a word?

use crate::tint::Tint;

/// Every channel of a pixel times `part` / 255, rounded to nearest; `part` from 0 to 255. Two channels share one
/// multiplication, and the division by 255 is the one of Blinn 1995 (exact for these products).
#[inline(always)]
pub(crate) fn times(pixel: u32, part: u32) -> u32 {
    let pair = |channels: u32| {
        let product = channels * part + 0x0080_0080;
        ((product + ((product >> 8) & 0x00ff_00ff)) >> 8) & 0x00ff_00ff
    };
    pair(pixel & 0x00ff_00ff) | (pair((pixel >> 8) & 0x00ff_00ff) << 8)
}

/// An opaque tint as the four bytes of a pixmap, red first in memory.
#[inline(always)]
pub(crate) fn opaque(tint: Tint) -> u32 {
    u32::from_le_bytes([tint.0, tint.1, tint.2, 255])
}

/// Changes the pixel in four bytes of a pixmap.
#[inline(always)]
pub(crate) fn update(bytes: &mut [u8], change: impl FnOnce(u32) -> u32) {
    if let Some((bytes, _)) = bytes.split_first_chunk_mut::<4>() {
        *bytes = change(u32::from_le_bytes(*bytes)).to_le_bytes();
    }
}

/// A share of 0 to 1 as a whole number of 255ths.
#[inline(always)]
pub(crate) fn whole(share: f32) -> u32 {
    // Through i32: one instruction, where the way to u32 takes several.
    (share * 255.0 + 0.5) as i32 as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_channel_is_rounded_to_nearest() {
        for part in 0..=255 {
            for value in 0..=255_u32 {
                let exact = (value * part + 127) / 255;
                assert_eq!(times(value * 0x0101_0101, part), exact * 0x0101_0101, "{value} * {part}");
            }
        }
    }

    #[test]
    fn a_tint_lies_in_memory_as_a_pixmap_wants_it() {
        let mut bytes = [0; 4];
        update(&mut bytes, |_| opaque(Tint(1, 2, 3)));
        assert_eq!(bytes, [1, 2, 3, 255]);
    }
}
