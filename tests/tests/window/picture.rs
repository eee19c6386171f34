//! What is on the screen? A screenshot, read from the frame buffer file that Xvfb keeps (X window dump, version 7).

use std::path::Path;

/// Words in the fixed part of the header.
const HEADER_WORDS: usize = 25;

/// Bytes of one colour map entry.
const COLOR_BYTES: usize = 12;

/// A screenshot: 0x00RRGGBB, row-major from the top left.
#[derive(Clone, PartialEq, Eq)]
pub(crate) struct Picture {
    /// Width in pixels.
    pub(crate) width: usize,
    /// Height in pixels.
    pub(crate) height: usize,
    pixels: Vec<u32>,
}

impl Picture {
    /// Reads the frame buffer; `None` while it is not there or not whole.
    pub(crate) fn read(file: &Path) -> Option<Self> {
        let bytes = std::fs::read(file).ok()?;
        let word = |i: usize| {
            bytes.get(4 * i..4 * i + 4).map(|w| u32::from_be_bytes([w[0], w[1], w[2], w[3]]) as usize)
        };
        let header: Vec<usize> = (0..HEADER_WORDS).map_while(word).collect();
        let &[size, 7, 2, 24, width, height, _, byte_order, ..] = header.as_slice() else { return None };
        let (bits, row_bytes, colors) = (*header.get(11)?, *header.get(12)?, *header.get(19)?);
        if bits != 32 {
            return None;
        }
        let data = bytes.get(size + colors * COLOR_BYTES..)?;
        let pixel = |p: &[u8]| {
            let p = [p[0], p[1], p[2], p[3]];
            (if byte_order == 0 { u32::from_le_bytes(p) } else { u32::from_be_bytes(p) }) & 0x00ff_ffff
        };
        let rows = data.chunks(row_bytes).take(height);
        let pixels: Vec<u32> = rows.flat_map(|row| row.chunks_exact(4).take(width).map(pixel)).collect();
        (pixels.len() == width * height).then_some(Self { width, height, pixels })
    }

    /// The pixel in that column and row.
    pub(crate) fn at(&self, x: usize, y: usize) -> u32 {
        self.pixels[y * self.width + x]
    }

    /// Red, green and blue of that pixel.
    pub(crate) fn rgb(&self, x: usize, y: usize) -> [u8; 3] {
        let [_, r, g, b] = self.at(x, y).to_be_bytes();
        [r, g, b]
    }

    /// How many pixels of the left upper `width` x `height` fit.
    pub(crate) fn count(&self, (width, height): (usize, usize), fits: impl Fn([u8; 3]) -> bool) -> usize {
        let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        all.filter(|(x, y)| fits(self.rgb(*x, *y))).count()
    }

    /// Where the middle of all fitting pixels of the left upper `width` x `height` lies.
    pub(crate) fn middle(
        &self,
        (width, height): (usize, usize),
        fits: impl Fn([u8; 3]) -> bool,
    ) -> Option<(f64, f64)> {
        let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let found: Vec<(usize, usize)> = all.filter(|(x, y)| fits(self.rgb(*x, *y))).collect();
        let n = found.len() as f64;
        let sum = found.iter().fold((0.0, 0.0), |s, (x, y)| (s.0 + *x as f64, s.1 + *y as f64));
        (n > 0.0).then(|| (sum.0 / n, sum.1 / n))
    }

    /// How many different colours the left upper `width` x `height` has.
    pub(crate) fn colors(&self, (width, height): (usize, usize)) -> usize {
        let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        all.map(|(x, y)| self.at(x, y)).collect::<std::collections::HashSet<_>>().len()
    }
}
