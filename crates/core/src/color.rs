//! What a colour is: linear Rec. 709 light, three channels.

use std::ops::{Add, AddAssign, Div, Mul, Sub};

use crate::Triple;

/// Linear Rec. 709 red, green and blue; a reflectance (0..=1) or an amount of light (any unit, ≥ 0).
///
/// ```
/// use catoptra_core::Rgb;
///
/// let light = Rgb::new(1.0, 0.5, 0.25) * 2.0 + Rgb::grey(0.1);
/// assert_eq!(light, Rgb::new(2.1, 1.1, 0.6));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rgb {
    /// Red.
    pub r: f64,
    /// Green.
    pub g: f64,
    /// Blue.
    pub b: f64,
}

impl Rgb {
    /// No light.
    pub const BLACK: Self = Self::grey(0.0);
    /// One in every channel.
    pub const WHITE: Self = Self::grey(1.0);

    /// From three channels.
    #[must_use]
    pub const fn new(r: f64, g: f64, b: f64) -> Self {
        Self { r, g, b }
    }

    /// The same value in every channel.
    #[must_use]
    pub const fn grey(v: f64) -> Self {
        Self { r: v, g: v, b: v }
    }

    /// Relative luminance (ITU-R BT.709-6, item 3.2).
    #[must_use]
    pub fn luminance(self) -> f64 {
        0.2126 * self.r + 0.7152 * self.g + 0.0722 * self.b
    }

    /// The largest channel.
    #[must_use]
    pub fn max_channel(self) -> f64 {
        self.r.max(self.g).max(self.b)
    }

    /// Red, green, blue.
    #[inline]
    #[must_use]
    pub const fn to_array(self) -> [f64; 3] {
        [self.r, self.g, self.b]
    }

    /// Applies `f` to every channel.
    #[must_use]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self::new(f(self.r), f(self.g), f(self.b))
    }

    /// Whether `f` holds for every channel.
    #[must_use]
    pub fn all(self, f: impl Fn(f64) -> bool) -> bool {
        f(self.r) && f(self.g) && f(self.b)
    }
}

impl Add for Rgb {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::new(self.r + o.r, self.g + o.g, self.b + o.b)
    }
}

impl Sub for Rgb {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self::new(self.r - o.r, self.g - o.g, self.b - o.b)
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl From<Rgb> for Triple<f64> {
    fn from(c: Rgb) -> Self {
        Self::new(c.r, c.g, c.b)
    }
}

impl Mul for Rgb {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self::new(self.r * o.r, self.g * o.g, self.b * o.b)
    }
}

impl Mul<f64> for Rgb {
    type Output = Self;
    fn mul(self, k: f64) -> Self {
        self.map(|v| v * k)
    }
}

impl Div<f64> for Rgb {
    type Output = Self;
    fn div(self, k: f64) -> Self {
        self.map(|v| v / k)
    }
}

/// The sRGB transfer function (IEC 61966-2-1) from linear light to the encoded value, for 0..=1.
#[must_use]
pub fn srgb_encoded(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// The sRGB transfer function (IEC 61966-2-1) from the encoded value to linear light, for 0..=1.
#[must_use]
pub fn srgb_decoded(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_srgb_curve_keeps_black_and_white_and_is_undone() {
        assert_eq!([0.0, 1.0].map(srgb_decoded), [0.0, 1.0]);
        assert!((srgb_decoded(0.5) - 0.214_041).abs() < 1e-6);
        for i in 0..=1000 {
            let light = f64::from(i) / 1000.0;
            assert!((srgb_decoded(srgb_encoded(light)) - light).abs() < 1e-6, "{light}");
        }
    }
}
