//! On how many pixels do two films disagree, and is that rare enough?

use std::fmt::Write;
use std::path::{Path, PathBuf};

use catoptra_lab::Picture;
use catoptra_scene::image::write_png;
use catoptra_tracer::{Film, Size};

/// Largest relative difference of two colours that count as equal.
const RELATIVE: f64 = 1e-4;

/// Radiance below which differences are no longer taken relative to it.
///
/// A colour is a sum of `f32` contributions of order 1, each rounded to 6e-8 of itself; where a sum is near black, 1e-4 of it
/// would ask for more than these roundings leave. 1e-2 makes the smallest difference that counts 1e-6: sixteen roundings of a
/// contribution of 1, and a 4,000th of the least step of an 8-bit display.
const DARK: f64 = 1e-2;

/// How many disagreements are put into words.
const LISTED: usize = 12;

/// How often two films may disagree.
#[derive(Clone, Copy, Debug)]
pub struct Rates {
    /// Share of pixels that may see another surface.
    pub surfaces: f64,
    /// Share of pixels that may see the same surface in another colour.
    pub colors: f64,
}

/// Two films of one size side by side.
pub struct Comparison<'a> {
    name: String,
    reference: &'a Film,
    test: &'a Film,
    surfaces: Vec<(u32, u32)>,
    colors: Vec<(u32, u32)>,
}

impl<'a> Comparison<'a> {
    /// Compares every pixel; the name is used for the files of a failure.
    ///
    /// # Panics
    /// When the films differ in size.
    pub fn new(name: impl Into<String>, reference: &'a Film, test: &'a Film) -> Self {
        let Size { width, height } = reference.size();
        assert_eq!((width, height), (test.size().width, test.size().height), "films of one size");
        let (mut surfaces, mut colors) = (Vec::new(), Vec::new());
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            if reference.surface(x, y) != test.surface(x, y) {
                surfaces.push((x, y));
            } else if !alike(reference.radiance(x, y), test.radiance(x, y)) {
                colors.push((x, y));
            }
        }
        Self { name: name.into(), reference, test, surfaces, colors }
    }

    /// Pixels on which another surface is seen, and pixels on which only the colour differs.
    pub fn counts(&self) -> (usize, usize) {
        (self.surfaces.len(), self.colors.len())
    }

    /// `Ok` where the same surfaces are seen, as often as they must be, and the means of all channels differ by so small a share.
    ///
    /// # Errors
    /// The count, or the means.
    pub fn agrees_in_the_mean(&self, rates: Rates, apart: f64) -> Result<(), String> {
        let Size { width, height } = self.reference.size();
        if self.surfaces.len() > (rates.surfaces * f64::from(width) * f64::from(height)) as usize {
            return Err(format!("{}: another surface on {} pixels", self.name, self.surfaces.len()));
        }
        let mean = |film: &Film| {
            let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
            pixels.flat_map(|(x, y)| film.radiance(x, y)).map(f64::from).sum::<f64>()
        };
        let (right, found) = (mean(self.reference), mean(self.test));
        if (found / right - 1.0).abs() <= apart {
            Ok(())
        } else {
            Err(format!("{}: a mean of {found} for {right}", self.name))
        }
    }

    /// `Ok` where disagreements are as rare as they must be; else what they are, with both pictures and their difference
    /// written as PNG into the folder.
    ///
    /// # Errors
    /// The counts, the first disagreements, and where the pictures are.
    pub fn within(&self, rates: Rates, folder: &Path) -> Result<(), String> {
        let Size { width, height } = self.reference.size();
        let allowed = |rate: f64| (rate * f64::from(width) * f64::from(height)) as usize;
        if self.surfaces.len() <= allowed(rates.surfaces) && self.colors.len() <= allowed(rates.colors) {
            return Ok(());
        }
        let mut message = format!("{} at {width}x{height}:", self.name);
        self.list(&mut message, "another surface", &self.surfaces, allowed(rates.surfaces));
        self.list(&mut message, "another colour", &self.colors, allowed(rates.colors));
        for file in self.write_pictures(folder) {
            let _ = write!(message, "\n  see {}", file.display());
        }
        Err(message)
    }

    fn list(&self, message: &mut String, what: &str, places: &[(u32, u32)], allowed: usize) {
        let _ = write!(message, "\n  {what} on {} pixels, {allowed} allowed", places.len());
        for &(x, y) in places.iter().take(LISTED) {
            let side = |film: &Film| {
                let surface = film.surface(x, y).map_or("nothing".to_owned(), |id| id.to_string());
                format!("{surface} {:?}", film.radiance(x, y))
            };
            let _ = write!(message, "\n    {x},{y}: {} became {}", side(self.reference), side(self.test));
        }
    }

    /// Writes both pictures and their difference; what cannot be written is left out, since a failure is being told already.
    fn write_pictures(&self, folder: &Path) -> Vec<PathBuf> {
        let Size { width, height } = self.reference.size();
        let name = self.name.replace(['/', ' '], "-");
        let painted = |kind: &str, paint: &dyn Fn(u32, u32) -> [f32; 3]| {
            let path = folder.join(format!("{name}-{kind}.png"));
            let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
            let bytes: Vec<u8> = places.flat_map(|(x, y)| paint(x, y).map(to_byte)).collect();
            write_png(&path, width, height, &bytes).ok().map(|()| path)
        };
        let difference = |x, y| {
            let (a, b) = (self.reference.radiance(x, y), self.test.radiance(x, y));
            let other = self.reference.surface(x, y) != self.test.surface(x, y);
            std::array::from_fn(|i| if other { 1.0 } else { MAGNIFIED * (a[i] - b[i]).abs() })
        };
        let files = [
            painted("reference", &|x, y| self.reference.radiance(x, y)),
            painted("test", &|x, y| self.test.radiance(x, y)),
            painted("difference", &difference),
        ];
        files.into_iter().flatten().collect()
    }
}

/// How much larger the difference picture shows a difference of colour.
const MAGNIFIED: f32 = 100.0;

/// A linear value as an encoded byte, gamma 2.2, to be looked at.
fn to_byte(linear: f32) -> u8 {
    (255.0 * linear.clamp(0.0, 1.0).powf(1.0 / 2.2)).round() as u8
}

fn alike(a: [f32; 3], b: [f32; 3]) -> bool {
    (0..3).all(|channel| {
        let (a, b) = (f64::from(a[channel]), f64::from(b[channel]));
        (a - b).abs() <= RELATIVE * a.abs().max(b.abs()).max(DARK)
    })
}

/// The radiance of a film.
///
/// # Panics
/// When it is not finite somewhere.
pub fn picture(film: &Film) -> Picture {
    let Size { width, height } = film.size();
    Picture::painted(width, height, |x, y| film.radiance(x, y)).expect("finite radiance")
}
