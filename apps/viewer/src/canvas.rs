//! What is in the window below egui? The traced picture, scaled to its place, and the overlays over it: a frame of
//! 0x00RRGGBB pixels that is kept, so that showing egui again costs a copy and no drawing. Rows are shared out among threads.

use catoptra_tracer::Pool;
use rayon::prelude::*;

use crate::fit::{Fit, Tap};

/// What surrounds the picture while there is none.
pub(crate) const BACKDROP: u32 = 0x0014_161a;

/// How many times the memory that it needs what is drawn on may hold before it is made anew.
pub(crate) const WASTE: usize = 4;

/// A rectangle of pixels, half open; empty where it does not have both sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Region {
    /// First column.
    pub(crate) left: u32,
    /// First row.
    pub(crate) top: u32,
    /// Column after the last.
    pub(crate) right: u32,
    /// Row after the last.
    pub(crate) bottom: u32,
}

impl Region {
    /// No pixel.
    pub(crate) const NOTHING: Self = Self { left: u32::MAX, top: u32::MAX, right: 0, bottom: 0 };

    /// All of a frame.
    pub(crate) fn whole((width, height): (u32, u32)) -> Self {
        Self { left: 0, top: 0, right: width, bottom: height }
    }

    /// Whether it holds no pixel.
    pub(crate) fn is_empty(self) -> bool {
        self.left >= self.right || self.top >= self.bottom
    }

    /// The smallest that holds both.
    #[must_use]
    pub(crate) fn union(self, other: Self) -> Self {
        if self.is_empty() {
            return other;
        }
        if other.is_empty() {
            return self;
        }
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// Width and height in pixels.
    pub(crate) fn size(self) -> (u32, u32) {
        (self.right.saturating_sub(self.left), self.bottom.saturating_sub(self.top))
    }
}

/// Gives a row of pixels another length, and memory back that is more than twice what they need.
pub(crate) fn resize(pixels: &mut Vec<u32>, length: usize, filled: u32) {
    pixels.resize(length, filled);
    if pixels.capacity() > 2 * length {
        pixels.shrink_to_fit();
    }
}

/// Pixels with their size, row-major from the top left, 0x00RRGGBB.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Pixels {
    /// Width in pixels.
    pub(crate) width: u32,
    /// Height in pixels.
    pub(crate) height: u32,
    /// `width * height` of them.
    pub(crate) data: Vec<u32>,
}

/// The picture with all that is drawn over it, below egui.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    picture: Pixels,
}

/// Rows that a thread takes at a time.
const BAND: usize = 16;

impl Canvas {
    /// Lays a traced picture out to a size in pixels, smoothly where it is coarser. Without one there is backdrop.
    pub(crate) fn lay(&mut self, traced: &Pixels, (width, height): (u32, u32), pool: &Pool) {
        self.picture.width = width;
        self.picture.height = height;
        resize(&mut self.picture.data, width as usize * height as usize, BACKDROP);
        if traced.data.is_empty() || width == 0 {
            self.picture.data.fill(BACKDROP);
        } else if (traced.width, traced.height) == (width, height) {
            self.picture.data.copy_from_slice(&traced.data);
        } else {
            self.stretch(traced, Fit::new((traced.width, traced.height), (width, height)), pool);
        }
    }

    fn stretch(&mut self, traced: &Pixels, fit: Fit, pool: &Pool) {
        let (columns, rows) = (fit.columns(), fit.rows());
        let (wide, width) = (traced.width as usize, self.picture.width as usize);
        let stretch_band = |(band, taps): (&mut [u32], &[Tap])| {
            // A row of the film between two of its rows.
            let mut between = Vec::with_capacity(wide);
            for (row, tap) in band.chunks_exact_mut(width).zip(taps) {
                let upper = &traced.data[tap.first * wide..][..wide];
                let lower = &traced.data[tap.second * wide..][..wide];
                between.clear();
                between.extend(upper.iter().zip(lower).map(|(a, b)| mixed(*a, *b, tap.share)));
                for (pixel, tap) in row.iter_mut().zip(&columns) {
                    *pixel = mixed(between[tap.first], between[tap.second], tap.share);
                }
            }
        };
        let picture = &mut self.picture.data;
        pool.run(|| picture.par_chunks_mut(BAND * width).zip(rows.par_chunks(BAND)).for_each(stretch_band));
    }

    /// The picture's pixels, to draw over.
    pub(crate) fn picture_mut(&mut self) -> &mut Pixels {
        &mut self.picture
    }

    /// Width and height of the picture in pixels.
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.picture.width, self.picture.height)
    }

    /// Fills a frame `width` pixels wide: the picture in the top left corner, backdrop round it.
    pub(crate) fn copy_to(&self, frame: &mut [u32], width: u32, pool: &Pool) {
        let (wide, frame_wide) = (self.picture.width as usize, (width as usize).max(1));
        let covered = wide.min(frame_wide);
        let copy_row = |(y, row): (usize, &mut [u32])| {
            let from = if covered > 0 { self.picture.data.get(y * wide..(y + 1) * wide) } else { None };
            let covered = if let Some(from) = from {
                row[..covered].copy_from_slice(&from[..covered]);
                covered
            } else {
                0
            };
            row[covered..].fill(BACKDROP);
        };
        pool.run(|| {
            frame.par_chunks_exact_mut(frame_wide).enumerate().with_min_len(BAND).for_each(copy_row);
        });
    }
}

/// Between two colours: `share` of 256 of the second.
#[inline]
fn mixed(a: u32, b: u32, share: u32) -> u32 {
    const RED_BLUE: u32 = 0x00ff_00ff;
    const GREEN: u32 = 0x0000_ff00;
    let blend = |mask: u32| (((a & mask) >> 8) * (256 - share) + ((b & mask) >> 8) * share) & mask;
    let red_blue = (((a & RED_BLUE) * (256 - share) + (b & RED_BLUE) * share) >> 8) & RED_BLUE;
    red_blue | blend(GREEN)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pool() -> Pool {
        Pool::new(2).unwrap()
    }

    fn traced() -> Pixels {
        Pixels { width: 2, height: 2, data: vec![1, 2, 3, 4] }
    }

    #[test]
    fn a_picture_of_its_size_is_copied() {
        let mut canvas = Canvas::default();
        canvas.lay(&traced(), (2, 2), &pool());
        assert_eq!(canvas.picture_mut(), &traced());
    }

    #[test]
    fn a_coarse_picture_is_laid_out_smoothly() {
        let mut canvas = Canvas::default();
        canvas.lay(&Pixels { width: 2, height: 1, data: vec![0x0000_0000, 0x0040_8020] }, (4, 2), &pool());
        let row = [0x0000_0000, 0x0010_2008, 0x0030_6018, 0x0040_8020];
        assert_eq!(canvas.picture_mut().data, [row, row].concat());
    }

    #[test]
    fn every_row_is_stretched_from_its_own() {
        let mut canvas = Canvas::default();
        let rows = Pixels { width: 1, height: 50, data: (0..50).collect() };
        canvas.lay(&rows, (3, 150), &pool());
        // The middle of three rows has the middle of that of the film.
        let middles: Vec<u32> = canvas.picture_mut().data.chunks(9).map(|rows| rows[4]).collect();
        assert_eq!(middles, rows.data);
        let mut frame = vec![7; 4 * 160];
        canvas.copy_to(&mut frame, 4, &pool());
        let copied: Vec<u32> = frame.chunks(12).take(50).map(|rows| rows[5]).collect();
        assert_eq!((copied, &frame[600..]), (rows.data, &[BACKDROP; 40][..]));
    }

    #[test]
    fn colours_between_equal_colours_are_equal() {
        for color in [0, 0x00ff_ffff, 0x0012_3456] {
            assert!((0..=256).all(|share| mixed(color, color, share) == color));
        }
        assert_eq!(mixed(0x00ff_0080, 0x0000_ff00, 128), 0x007f_7f40);
    }

    #[test]
    fn without_a_picture_there_is_backdrop() {
        let mut canvas = Canvas::default();
        canvas.lay(&traced(), (2, 2), &pool());
        canvas.lay(&Pixels::default(), (2, 1), &pool());
        assert_eq!(canvas.picture_mut().data, [BACKDROP; 2]);
    }

    #[test]
    fn a_smaller_picture_gives_memory_back() {
        let mut canvas = Canvas::default();
        canvas.lay(&traced(), (700, 500), &pool());
        canvas.lay(&traced(), (128, 72), &pool());
        assert!(canvas.picture.data.capacity() <= 2 * 128 * 72);
    }

    #[test]
    fn an_empty_place_takes_anything() {
        let mut canvas = Canvas::default();
        canvas.lay(&traced(), (0, 2), &pool());
        let mut frame = [7; 2];
        canvas.copy_to(&mut frame, 2, &pool());
        assert_eq!(frame, [BACKDROP; 2]);
    }

    #[test]
    fn a_frame_holds_the_picture_and_backdrop_round_it() {
        let mut canvas = Canvas::default();
        canvas.lay(&traced(), (2, 2), &pool());
        let mut frame = [7; 9];
        canvas.copy_to(&mut frame, 3, &pool());
        let b = BACKDROP;
        assert_eq!(frame, [1, 2, b, 3, 4, b, b, b, b]);
        canvas.copy_to(&mut frame[..3], 1, &pool());
        assert_eq!(frame[..3], [1, 3, b]);
    }

    #[test]
    fn an_empty_region_adds_nothing_to_a_union() {
        let some = Region { left: 1, top: 2, right: 3, bottom: 4 };
        assert_eq!(Region::NOTHING.union(some), some);
        assert_eq!(some.union(Region::NOTHING), some);
        assert_eq!(some.size(), (2, 2));
    }
}
