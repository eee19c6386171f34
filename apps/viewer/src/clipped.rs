//! Which pixels are brighter than the display can show? They are marked, and their share is told.

use crate::canvas::Pixels;

/// The colour of marks, 0x00RRGGBB, and the width of their stripes in pixels.
const MARK: u32 = 0x00ff_00c8;
const STRIPE: usize = 4;

/// Whether a channel of a pixel is as bright as it can be.
fn is_clipped(pixel: u32) -> bool {
    [16, 8, 0].iter().any(|shift| (pixel >> shift) & 0xff == 0xff)
}

/// Marks clipped pixels by stripes. Returns their share.
pub(crate) fn mark(picture: &mut Pixels) -> f64 {
    let width = (picture.width as usize).max(1);
    let mut count = 0_usize;
    for (at, pixel) in picture.data.iter_mut().enumerate().filter(|(_, pixel)| is_clipped(**pixel)) {
        count += 1;
        if ((at % width + at / width) / STRIPE).is_multiple_of(2) {
            *pixel = MARK;
        }
    }
    count as f64 / picture.data.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_with_one_full_channel_are_marked_and_counted() {
        let mut data = vec![0x00ff_0000, 0x00fe_fefe, 0x0000_00ff, 0];
        data.resize(16, 0x0000_ff00);
        let mut picture = Pixels { width: 4, height: 4, data };
        assert_eq!(mark(&mut picture), 14.0 / 16.0);
        assert_eq!(picture.data[..4], [MARK, 0x00fe_fefe, MARK, 0]);
        assert!(picture.data.contains(&0x0000_ff00), "between stripes pixels stay as they are");
    }
}
