//! What is compared: one picture of finite RGB values, and two pictures of one size.

use catoptra_tracer::Film;
use thiserror::Error;

/// RGB values of a picture: row-major from the top left, `width` x `height`, all finite.
///
/// Whether the values are linear or encoded is the caller's choice; a metric that needs linear ones says so. Of a film
/// it is the linear light:
///
/// ```
/// use catoptra_lab::Picture;
/// use catoptra_tracer::{Film, Size};
///
/// let picture = Picture::try_from(&Film::new(Size::new(4, 3)))?;
/// assert_eq!((picture.width(), picture.pixels()[11]), (4, [0.0; 3]));
/// # Ok::<(), catoptra_lab::PictureError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

/// Why a picture or a pair of pictures is refused.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PictureError {
    /// Width or height is zero, or the number of values does not fit them.
    #[error("{pixels} pixels do not make a picture of {width}x{height}")]
    Length {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Pixels given.
        pixels: usize,
    },
    /// A value is infinite or not a number.
    #[error("the pixel at {x},{y} is not finite: {value:?}")]
    NotFinite {
        /// Column, from the left.
        x: u32,
        /// Row, from the top.
        y: u32,
        /// What stands there.
        value: [f32; 3],
    },
    /// Two pictures of different sizes cannot be compared.
    #[error("the sizes differ: {}x{} and {}x{}", .reference.0, .reference.1, .test.0, .test.1)]
    Sizes {
        /// Width and height of the reference.
        reference: (u32, u32),
        /// Width and height of the other picture.
        test: (u32, u32),
    },
}

impl TryFrom<&Film> for Picture {
    type Error = PictureError;

    /// # Errors
    /// [`PictureError::Length`] for a film without pixels.
    fn try_from(film: &Film) -> Result<Self, PictureError> {
        Self::new(film.size().width, film.size().height, film.radiances())
    }
}

impl Picture {
    /// A picture of the given pixels, row-major from the top left.
    ///
    /// # Errors
    /// [`PictureError::Length`] where the pixels do not fit the size or the size is empty, [`PictureError::NotFinite`] for the
    /// first pixel with an infinite or undefined value.
    pub fn new(width: u32, height: u32, pixels: Vec<[f32; 3]>) -> Result<Self, PictureError> {
        if pixels.is_empty() || pixels.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(PictureError::Length { width, height, pixels: pixels.len() });
        }
        if let Some(at) = pixels.iter().position(|pixel| !pixel.iter().all(|value| value.is_finite())) {
            let (x, y) = ((at % width as usize) as u32, (at / width as usize) as u32);
            return Err(PictureError::NotFinite { x, y, value: pixels[at] });
        }
        Ok(Self { width, height, pixels })
    }

    /// A picture of one value.
    ///
    /// # Errors
    /// As for [`Picture::new`].
    pub fn filled(width: u32, height: u32, value: [f32; 3]) -> Result<Self, PictureError> {
        Self::new(width, height, vec![value; width as usize * height as usize])
    }

    /// A picture with the value of `paint(x, y)` at each pixel.
    ///
    /// # Errors
    /// As for [`Picture::new`].
    pub fn painted(
        width: u32,
        height: u32,
        mut paint: impl FnMut(u32, u32) -> [f32; 3],
    ) -> Result<Self, PictureError> {
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            pixels.extend((0..width).map(|x| paint(x, y)));
        }
        Self::new(width, height, pixels)
    }

    /// Pixels across, at least 1.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down, at least 1.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row-major from the top left.
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }
}

/// Two pictures of one size: the reference, and the picture that is judged against it.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    reference: &'a Picture,
    test: &'a Picture,
}

impl<'a> Pair<'a> {
    /// Puts a picture beside its reference.
    ///
    /// # Errors
    /// [`PictureError::Sizes`] where they differ in size.
    pub fn new(reference: &'a Picture, test: &'a Picture) -> Result<Self, PictureError> {
        let (of_reference, of_test) = ((reference.width, reference.height), (test.width, test.height));
        if of_reference != of_test {
            return Err(PictureError::Sizes { reference: of_reference, test: of_test });
        }
        Ok(Self { reference, test })
    }

    /// The picture taken as right.
    pub fn reference(&self) -> &'a Picture {
        self.reference
    }

    /// The picture that is judged.
    pub fn test(&self) -> &'a Picture {
        self.test
    }

    /// Reference and judged pixel side by side, row-major.
    pub fn pixels(&self) -> impl Iterator<Item = (&'a [f32; 3], &'a [f32; 3])> {
        self.reference.pixels.iter().zip(&self.test.pixels)
    }

    /// Reference and judged value side by side: three channels a pixel, row-major.
    pub fn values(&self) -> impl Iterator<Item = (f64, f64)> {
        self.pixels()
            .flat_map(|(a, b)| (0..3).map(move |channel| (f64::from(a[channel]), f64::from(b[channel]))))
    }

    /// The mean of `f(reference, test)` over all values of all channels.
    pub(crate) fn mean(&self, f: impl Fn(f64, f64) -> f64) -> f64 {
        self.values().map(|(a, b)| f(a, b)).sum::<f64>() / (3 * self.reference.pixels.len()) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_that_do_not_fit_the_size_are_refused() {
        let refused = Picture::new(2, 2, vec![[0.0; 3]; 3]);
        assert_eq!(refused, Err(PictureError::Length { width: 2, height: 2, pixels: 3 }));
        assert!(Picture::new(0, 0, Vec::new()).is_err());
    }

    #[test]
    fn the_first_value_that_is_not_finite_is_named_by_place() {
        let mut pixels = vec![[0.0; 3]; 6];
        pixels[4] = [0.0, f32::NAN, 0.0];
        assert!(matches!(Picture::new(3, 2, pixels), Err(PictureError::NotFinite { x: 1, y: 1, .. })));
    }

    #[test]
    fn pictures_of_different_sizes_make_no_pair() {
        let (a, b) = (Picture::filled(2, 3, [0.0; 3]).unwrap(), Picture::filled(3, 2, [0.0; 3]).unwrap());
        assert_eq!(Pair::new(&a, &b).unwrap_err().to_string(), "the sizes differ: 2x3 and 3x2");
    }
}
