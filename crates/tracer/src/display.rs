//! How linear light becomes the bytes of a screen.

use std::sync::LazyLock;

use rayon::prelude::*;

use crate::film::Tile;
use crate::{Film, Pool};

/// A display transform: from linear Rec. 709 light to 8-bit red, green and blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Display {
    /// `⌊255 · clamp(light)⌋`, no gamma.
    Linear,
    /// The sRGB curve of IEC 61966-2-1, rounded to nearest.
    #[default]
    Srgb,
    /// Narkowicz's fit of the ACES filmic curve (2016), then sRGB: highlights roll off instead of clipping.
    Filmic,
}

impl Display {
    /// Every transform there is.
    pub const ALL: &'static [Self] = &[Self::Linear, Self::Srgb, Self::Filmic];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Srgb => "srgb",
            Self::Filmic => "filmic",
        }
    }

    /// The transform of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|d| d.name() == name)
    }

    /// One channel.
    #[must_use]
    #[inline]
    pub fn byte(self, light: f32) -> u8 {
        match self {
            Self::Linear => (light.clamp(0.0, 1.0) * 255.0) as u8,
            Self::Srgb => srgb_byte(light),
            Self::Filmic => srgb_byte(filmic(light)),
        }
    }

    /// One channel before it is rounded to a byte: 0..=1, and 0 for NaN.
    #[must_use]
    pub fn value(self, light: f32) -> f64 {
        match self {
            Self::Linear => f64::from(within_range(light)),
            Self::Srgb => srgb_curve(light),
            Self::Filmic => srgb_curve(filmic(light)),
        }
    }

    /// The same after light is brightened by so many stops, each a factor of 2.
    #[must_use]
    pub fn exposed(self, stops: f64) -> Tone {
        Tone { display: self, gain: stops.exp2() as f32 }
    }
}

/// How light becomes bytes: an exposure, then a display transform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tone {
    display: Display,
    gain: f32,
}

impl Default for Tone {
    fn default() -> Self {
        Display::default().into()
    }
}

impl From<Display> for Tone {
    /// Light as it is.
    fn from(display: Display) -> Self {
        display.exposed(0.0)
    }
}

impl Tone {
    /// One channel.
    #[must_use]
    #[inline]
    pub fn byte(self, light: f32) -> u8 {
        self.display.byte(light * self.gain)
    }

    /// One channel before it is rounded to a byte: 0..=1.
    #[must_use]
    pub fn value(self, light: f32) -> f64 {
        self.display.value(light * self.gain)
    }

    /// All pixels as `0x00RRGGBB`, row by row.
    ///
    /// # Panics
    /// An `out` that is not as long as the film has pixels.
    pub fn encode(self, film: &Film, pool: &Pool, out: &mut [u32]) {
        assert_eq!(out.len(), film.size().pixels(), "one word a pixel");
        if out.is_empty() {
            return;
        }
        let width = film.size().width as usize;
        let rows: Vec<&[Tile]> = film.tile_rows().collect();
        pool.run(|| {
            let bands = out.par_chunks_mut(width * film.edge() as usize);
            bands.zip(rows).for_each(|(band, tiles)| {
                for tile in tiles {
                    self.encode_tile(tile, film.region().x, width, band);
                }
            });
        });
    }

    /// One row of pixels as red, green, blue bytes.
    ///
    /// # Panics
    /// A row outside the picture.
    pub fn rgb8_row(self, film: &Film, y: u32, out: &mut [u8]) {
        for (x, pixel) in (0..film.size().width).zip(out.chunks_exact_mut(3)) {
            pixel.copy_from_slice(&film.radiance(x, y).map(|v| self.byte(v)));
        }
    }

    /// All pixels as red, green, blue bytes, row by row.
    #[must_use]
    pub fn rgb8(self, film: &Film) -> Vec<u8> {
        film.radiances().into_iter().flat_map(|light| light.map(|v| self.byte(v))).collect()
    }

    fn encode_tile(self, tile: &Tile, left: u32, width: usize, band: &mut [u32]) {
        for y in 0..tile.height {
            let start = y as usize * width + (tile.x - left) as usize;
            for (x, out) in (0..tile.width).zip(&mut band[start..]) {
                let i = tile.index(x, y);
                let [r, g, b] = tile.radiance(i).map(|v| u32::from(self.byte(v)));
                *out = r << 16 | g << 8 | b;
            }
        }
    }
}

fn filmic(x: f32) -> f32 {
    let x = x.max(0.0);
    (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)
}

/// Lights below this show as 0: 0.5 / 255 / 12.92 lies above it.
const DARKEST: f32 = 1.0 / 8192.0;

/// The sRGB byte for every light from [`DARKEST`] to 1, by the upper 20 bits of its representation: steps of 2⁻¹¹
/// relative, where a byte is 2⁻⁸ or more.
static SRGB: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let first = DARKEST.to_bits() >> 12;
    (first..=1.0_f32.to_bits() >> 12).map(|top| srgb_exact(f32::from_bits(top << 12 | 1 << 11))).collect()
});

fn srgb_byte(light: f32) -> u8 {
    if !(light >= DARKEST) {
        return 0;
    }
    let at = (light.min(1.0).to_bits() >> 12) - (DARKEST.to_bits() >> 12);
    SRGB[at as usize]
}

fn srgb_exact(light: f32) -> u8 {
    (255.0 * srgb_curve(light)).round() as u8
}

/// Light that a display can show; none for NaN.
fn within_range(light: f32) -> f32 {
    if light > 0.0 { light.min(1.0) } else { 0.0 }
}

fn srgb_curve(light: f32) -> f64 {
    let light = f64::from(within_range(light));
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_truncates_and_clamps() {
        let bytes = [-1.0, 0.0, 0.5, 1.0, 7.0, f32::NAN].map(|v| Display::Linear.byte(v));
        assert_eq!(bytes, [0, 0, 127, 255, 255, 0]);
    }

    #[test]
    fn the_srgb_table_is_the_srgb_curve() {
        for i in 0..=100_000 {
            let light = i as f32 / 100_000.0;
            let off = i16::from(srgb_byte(light)) - i16::from(srgb_exact(light));
            assert!(off.abs() <= 1, "{light}");
        }
        assert_eq!([0.0, 0.216, 1.0, 9.0].map(srgb_byte), [0, 128, 255, 255]);
    }

    #[test]
    fn every_transform_rises_from_black_and_refuses_nonsense() {
        for display in Display::ALL {
            let bytes: Vec<u8> = (0..200).map(|i| display.byte(i as f32 / 100.0)).collect();
            assert!(bytes.is_sorted() && bytes[0] == 0, "{display:?}");
            assert_eq!((display.byte(f32::NAN), display.value(f32::NAN)), (0, 0.0));
        }
    }

    #[test]
    fn bytes_are_values_rounded() {
        for (display, i) in Display::ALL.iter().flat_map(|display| (-5..300).map(move |i| (display, i))) {
            let light = i as f32 / 200.0;
            let off = display.value(light) * 255.0 - f64::from(display.byte(light));
            assert!(off.abs() < 1.0 + 1e-6, "{display:?} {light}: {off}");
        }
    }

    #[test]
    fn a_stop_is_a_factor_of_two() {
        for display in Display::ALL {
            let (plain, brighter) = (display.exposed(0.0), display.exposed(1.0));
            assert!((0..100).all(|i| {
                let light = i as f32 / 100.0;
                plain.byte(light) == display.byte(light) && brighter.byte(light) == display.byte(2.0 * light)
            }));
        }
    }
}
