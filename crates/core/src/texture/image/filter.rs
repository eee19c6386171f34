//! How is a picture averaged over what a pixel shows of it?
//!
//! A pixel's footprint is an ellipse. Up to sixteen probes lie along its longer axis, weighted by a Gaussian, each as wide as
//! the shorter axis and taken between two of the picture's smaller copies: McCormack, Perry, Farkas and Jouppi, "Feline: Fast
//! Elliptical Lines for Anisotropic Texture Mapping", SIGGRAPH 1999, after Heckbert's elliptical weighted average (1989).

use glam::{DVec2, Vec4};

use super::levels::{Levels, Light, Wrap, reduced};
use crate::texture::Texel;

/// How a picture is averaged over a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Filter {
    /// Not at all: the pixel of the picture that lies there.
    Nearest,
    /// Linear between pixels and between copies, as wide as the footprint is long.
    Linear,
    /// Over the footprint's ellipse.
    Ewa,
}

/// The most probes along an ellipse: a longer one is widened to fit them.
const MOST_PROBES: u32 = 16;

/// Where a picture is probed, and how wide: copies number `level` and the next one, of which `rest` is shown.
struct Probes {
    center: DVec2,
    step: DVec2,
    count: u32,
    /// The exponent of a probe one step from the centre.
    decay: f64,
    level: usize,
    rest: f64,
}

impl Levels<'_> {
    /// The mean over a footprint round a place, or one pixel of it that is chosen by two numbers: both as in
    /// [`TexturePoint`](crate::texture::TexturePoint). `wrap` is for left and right, and for bottom and top.
    #[must_use]
    pub fn filtered(
        &self,
        wrap: [Wrap; 2],
        filter: Filter,
        uv: DVec2,
        footprint: Option<[DVec2; 2]>,
        stochastic: Option<[f64; 2]>,
    ) -> Texel {
        let center = reduced(wrap, uv);
        if filter == Filter::Nearest {
            let ([x, y], [along, down]) = self.between(0, center);
            let nearer = |first: i64, share: f64| first + i64::from(share >= 0.5);
            return self.light(0, wrap, nearer(x, along), nearer(y, down)).texel();
        }
        let sides = footprint.unwrap_or_default().map(|side| side * self.size(0));
        let probes = match filter {
            Filter::Ewa => self.along_ellipse(center, sides),
            _ => self.round(center, sides.map(DVec2::length).into_iter().fold(0.0, f64::max)),
        };
        match stochastic {
            None => Light(self.mean(wrap, &probes)).texel(),
            Some(numbers) => self.chosen(wrap, &probes, numbers).texel(),
        }
    }

    /// One probe, as wide as so many of the picture's pixels.
    fn round(&self, center: DVec2, width: f64) -> Probes {
        let last = (self.count() - 1) as f64;
        let level = width.max(1.0).log2().min(last);
        let whole = level.floor();
        Probes { center, step: DVec2::ZERO, count: 1, decay: 0.0, level: whole as usize, rest: level - whole }
    }

    /// Probes along the ellipse that these two vectors, in pixels of the picture, are conjugate radii of.
    fn along_ellipse(&self, center: DVec2, [a, b]: [DVec2; 2]) -> Probes {
        let (xx, xy, yy) = (a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y);
        let (mean, half) = ((xx + yy) / 2.0, (xx - yy) / 2.0);
        let spread = half.hypot(xy);
        let major = (mean + spread).sqrt().max(1.0);
        let minor = (mean - spread).max(0.0).sqrt().max(1.0);
        if !major.is_finite() {
            return self.round(center, f64::MAX);
        }
        let wanted = (2.0 * major / minor - 0.5).floor();
        if wanted <= 1.0 {
            return self.round(center, minor);
        }
        let count = wanted.min(f64::from(MOST_PROBES));
        let minor = minor.max(2.0 * major / (count + 1.0));
        // Of two vectors along the longer axis the one that has not lost its digits.
        let axis = if half >= 0.0 { DVec2::new(half + spread, xy) } else { DVec2::new(xy, spread - half) };
        let step = axis.normalize_or_zero() * (2.0 * (major - minor) / (count - 1.0));
        let decay = 2.0 * step.length_squared() / (major * major);
        Probes { step: step / self.size(0), count: count as u32, decay, ..self.round(center, minor) }
    }

    fn mean(&self, wrap: [Wrap; 2], probes: &Probes) -> Vec4 {
        let (mut sum, mut weights) = (Vec4::ZERO, 0.0);
        for i in 0..probes.count {
            let (place, weight) = probes.probe(i);
            let mut light = self.bilinear(probes.level, wrap, place);
            if probes.rest > 0.0 {
                light = light.lerp(self.bilinear(probes.level + 1, wrap, place), probes.rest as f32);
            }
            sum += light * weight as f32;
            weights += weight;
        }
        sum / weights as f32
    }

    /// One pixel, each chosen as often as it weighs in the mean.
    fn chosen(&self, wrap: [Wrap; 2], probes: &Probes, [first, second]: [f64; 2]) -> Light {
        let weights = |i| probes.probe(i).1;
        let total: f64 = (0..probes.count).map(weights).sum();
        let mut left = first.clamp(0.0, 1.0) * total;
        let mut i = 0;
        while i + 1 < probes.count && left >= weights(i) {
            left -= weights(i);
            i += 1;
        }
        let (place, weight) = probes.probe(i);
        // What is left of a number that has decided something decides the next.
        let (coarser, left) = decided((left / weight).min(1.0), probes.rest);
        let level = probes.level + usize::from(coarser);
        let ([x, y], [along, down]) = self.between(level, place);
        let (right, _) = decided(left, along);
        let (below, _) = decided(second, down);
        self.light(level, wrap, x + i64::from(right), y + i64::from(below))
    }
}

impl Probes {
    /// Where a probe lies, and what it weighs.
    fn probe(&self, i: u32) -> (DVec2, f64) {
        let steps = f64::from(i) - f64::from(self.count - 1) / 2.0;
        (self.center + self.step * steps, (-self.decay * steps * steps).exp())
    }
}

/// Whether a number in 0..1 lies below a share, and where it lies within its side, in 0..1 again.
fn decided(number: f64, share: f64) -> (bool, f64) {
    if number < share {
        (true, number / share)
    } else {
        (false, (number - share) / (1.0 - share).max(f64::MIN_POSITIVE))
    }
}
