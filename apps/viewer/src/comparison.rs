//! How far is the picture from one on disk? That one is laid over a part of it, up to a line, and the error is a number.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::Image;
use catoptra_core::texture::Encoding;
use catoptra_tracer::{Pool, Tone};

use crate::canvas::{Canvas, Pixels};

/// The colour of the line.
const LINE: u32 = 0x00ff_ffff;

/// A picture to compare with.
struct Reference {
    path: PathBuf,
    image: Arc<Image>,
    /// For display as that says.
    shown: (Tone, Pixels),
    /// Stretched to the size of the window's picture.
    laid: Canvas,
}

/// How much pictures differ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Difference {
    /// The root of the mean square of what channels differ by, from 0 to 1.
    pub(crate) error: f64,
    /// The share of pixels that differ.
    pub(crate) pixels: f64,
}

/// The comparison with a picture on disk, if there is one.
#[derive(Default)]
pub(crate) struct Comparison {
    /// The path that is typed.
    pub(crate) typed: String,
    /// A path to read from, once.
    wanted: Option<PathBuf>,
    reference: Option<Reference>,
    /// Where the line stands: the share of the window's picture to its left.
    pub(crate) line: f64,
    /// How much the picture differs, where that is traced in full and of the same size.
    pub(crate) difference: Option<Difference>,
}

/// What came of reading a picture.
pub(crate) struct Outcome {
    path: PathBuf,
    result: Result<Arc<Image>, String>,
}

/// Reads a picture on a thread of its own and hands it to `done` there.
pub(crate) fn read(path: PathBuf, done: impl FnOnce(Outcome) + Send + 'static) {
    std::thread::spawn(move || {
        let result = catoptra_scene::image::load(&path).map_err(|problem| problem.to_string());
        done(Outcome { path, result });
    });
}

impl Comparison {
    /// Asks for the picture in a file.
    pub(crate) fn want(&mut self, path: PathBuf) {
        self.wanted = Some(path);
    }

    /// The file that is to be read now, once.
    pub(crate) fn take_wanted(&mut self) -> Option<PathBuf> {
        self.wanted.take()
    }

    /// Takes in what was read. Returns what there is to tell.
    pub(crate) fn put(&mut self, outcome: Outcome, tone: Tone) -> String {
        match outcome.result {
            Ok(image) => {
                let shown = (tone, displayed(&image, tone));
                let told = format!("compared with {}: right of the line", outcome.path.display());
                self.reference =
                    Some(Reference { path: outcome.path, image, shown, laid: Canvas::default() });
                self.line = 0.5;
                self.difference = None;
                told
            }
            Err(problem) => problem,
        }
    }

    /// The file that the picture is compared with.
    pub(crate) fn file(&self) -> Option<&Path> {
        self.reference.as_ref().map(|reference| reference.path.as_path())
    }

    /// Width and height of the picture on disk.
    pub(crate) fn size(&self) -> Option<(u32, u32)> {
        self.reference.as_ref().map(|reference| (reference.image.width(), reference.image.height()))
    }

    /// Compares no more.
    pub(crate) fn end(&mut self) {
        self.reference = None;
        self.difference = None;
    }

    /// Measures a picture that is traced in full, and lays the other one over its part right of the line.
    pub(crate) fn lay_over(
        &mut self,
        traced: Option<&Pixels>,
        picture: &mut Pixels,
        (tone, pool): (Tone, &Pool),
    ) {
        let Some(reference) = &mut self.reference else { return };
        let size = (picture.width, picture.height);
        if reference.shown.0 != tone {
            reference.shown = (tone, displayed(&reference.image, tone));
            reference.laid = Canvas::default();
        }
        self.difference = traced.and_then(|traced| Difference::of(&reference.shown.1, traced));
        if reference.laid.size() != size {
            reference.laid.lay(&reference.shown.1, size, pool);
        }
        let width = size.0 as usize;
        let line = ((self.line * f64::from(size.0)) as usize).min(width);
        let other = &reference.laid.picture_mut().data;
        let rows = picture.data.chunks_exact_mut(width.max(1)).zip(other.chunks_exact(width.max(1)));
        for (row, other) in rows {
            row[line..].copy_from_slice(&other[line..]);
            if let Some(pixel) = row.get_mut(line) {
                *pixel = LINE;
            }
        }
    }
}

impl Difference {
    /// Between pictures of one size; `None` for others and for empty ones.
    fn of(a: &Pixels, b: &Pixels) -> Option<Self> {
        if (a.width, a.height) != (b.width, b.height) || a.data.is_empty() {
            return None;
        }
        let (mut squares, mut differing) = (0_u64, 0_usize);
        for (a, b) in a.data.iter().zip(&b.data) {
            differing += usize::from(a != b);
            squares += [16, 8, 0]
                .iter()
                .map(|shift| u64::from((a >> shift & 0xff).abs_diff(b >> shift & 0xff)).pow(2))
                .sum::<u64>();
        }
        let count = a.data.len() as f64;
        let error = (squares as f64 / (3.0 * count)).sqrt() / 255.0;
        Some(Self { error, pixels: differing as f64 / count })
    }
}

/// The picture's bytes as they stand; of one that holds light, what the display shows of that.
fn displayed(image: &Image, tone: Tone) -> Pixels {
    let byte = |x: u32, y: u32| -> [u8; 3] {
        match image.natural_encoding() {
            Encoding::Srgb => image.plain_pixel(x, y).to_array().map(|v| (v * 255.0).round() as u8),
            Encoding::Linear => image.pixel(x, y).color.to_array().map(|v| tone.byte(v as f32)),
        }
    };
    let (width, height) = (image.width(), image.height());
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let packed = |(x, y)| byte(x, y).iter().fold(0, |all, channel| all << 8 | u32::from(*channel));
    Pixels { width, height, data: places.map(packed).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compared(bytes: Vec<u8>) -> Comparison {
        let image = Arc::new(Image::from_bytes([4, 1], 3, bytes).unwrap());
        let mut comparison = Comparison::default();
        comparison.put(Outcome { path: "a.png".into(), result: Ok(image) }, Tone::default());
        comparison
    }

    #[test]
    fn the_other_picture_stands_right_of_the_line_and_the_error_is_told() {
        let mut comparison = compared([[10, 20, 30]; 4].concat());
        let traced =
            Pixels { width: 4, height: 1, data: vec![0x000a_141e, 0x000a_141e, 0x000a_141e, 0x000d_141e] };
        let mut picture = traced.clone();
        comparison.line = 0.25;
        comparison.lay_over(Some(&traced), &mut picture, (Tone::default(), &Pool::new(1).unwrap()));
        assert_eq!(picture.data, [0x000a_141e, LINE, 0x000a_141e, 0x000a_141e]);
        let found = comparison.difference.unwrap();
        assert_eq!(found.pixels, 0.25);
        assert!((found.error - (9.0_f64 / 12.0).sqrt() / 255.0).abs() < 1e-12);
    }

    #[test]
    fn pictures_of_other_sizes_are_laid_over_and_not_measured() {
        let mut comparison = compared([[255, 0, 0]; 4].concat());
        let traced = Pixels { width: 8, height: 2, data: vec![0; 16] };
        let mut picture = traced.clone();
        comparison.line = 0.0;
        comparison.lay_over(Some(&traced), &mut picture, (Tone::default(), &Pool::new(1).unwrap()));
        assert_eq!((comparison.difference, picture.data[9]), (None, 0x00ff_0000));
        comparison.end();
        assert_eq!(comparison.file(), None);
    }

    #[test]
    fn what_is_no_picture_is_told_and_nothing_is_compared() {
        let mut comparison = Comparison::default();
        let outcome = Outcome { path: "x".into(), result: Err("x cannot be read".to_owned()) };
        assert_eq!(comparison.put(outcome, Tone::default()), "x cannot be read");
        assert!(comparison.file().is_none());
    }
}
