//! What is gradient noise, and what do octaves of it add up to?
//!
//! Perlin, "Improving Noise", SIGGRAPH 2002, with a hash of whole numbers in place of a table. Octaves finer than a pixel are
//! faded out, as in Ebert et al., *Texturing and Modeling* (3rd ed., 2003), ch. 2.

use std::f64::consts::PI;

use glam::DVec3;

use super::transform::Solid;

/// Each octave weighs half of the one before, and is twice as fine.
const GAIN: f64 = 0.5;

/// The mean of the magnitude of gradient noise, over all space: measured over 10⁷ points.
pub(super) const MEAN_MAGNITUDE: f64 = 0.2202;

/// Gradient noise: about −1..1, 0 on average and on whole coordinates.
pub(super) fn noise(p: DVec3) -> f64 {
    let corner = p.floor();
    let inside = p - corner;
    if !inside.is_finite() {
        return 0.0;
    }
    let [x, y, z] = corner.to_array().map(|v| v as i64);
    let ease = inside * inside * inside * (inside * (inside * 6.0 - DVec3::splat(15.0)) + DVec3::splat(10.0));
    let at = |i: i64, j: i64, k: i64| {
        let from_corner = inside - DVec3::new(i as f64, j as f64, k as f64);
        slope(hash(x.wrapping_add(i), y.wrapping_add(j), z.wrapping_add(k)), from_corner)
    };
    let between = |a: f64, b: f64, share: f64| a + (b - a) * share;
    let row = |j, k| between(at(0, j, k), at(1, j, k), ease.x);
    let face = |k| between(row(0, k), row(1, k), ease.y);
    between(face(0), face(1), ease.z)
}

/// Mixes three whole numbers (the finaliser of MurmurHash3, Appleby 2011).
fn hash(x: i64, y: i64, z: i64) -> u64 {
    let mut h = (x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        ^ (y as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f).rotate_left(21)
        ^ (z as u64).wrapping_mul(0x1656_67b1_9e37_79f9).rotate_left(42);
    h ^= h >> 33;
    h = h.wrapping_mul(0xff51_afd7_ed55_8ccd);
    h ^= h >> 33;
    h = h.wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    h ^ (h >> 33)
}

/// The scalar product with one of the twelve directions to the edges of a cube.
fn slope(hash: u64, p: DVec3) -> f64 {
    let (a, b) = match hash % 3 {
        0 => (p.x, p.y),
        1 => (p.y, p.z),
        _ => (p.z, p.x),
    };
    let signed = |v: f64, bit: u64| if hash >> bit & 1 == 0 { v } else { -v };
    signed(a, 32) + signed(b, 33)
}

/// A weighted mean of octaves of `shape` of the noise, of which `mean` stands for those that a pixel is too wide to show.
pub(super) fn octaves(at: &Solid, octaves: u32, mean: f64, shape: impl Fn(f64) -> f64) -> f64 {
    let width = at.spread[0].length().max(at.spread[1].length());
    let (mut sum, mut weights) = (0.0, 0.0);
    let (mut weight, mut frequency) = (1.0, 1.0);
    for octave in 0..octaves {
        let shown = shown(width * frequency);
        // Octaves lie apart, so that their corners, where each is 0, do not meet.
        let apart = DVec3::splat(17.37 * f64::from(octave));
        let value = if shown > 0.0 { shape(noise(at.position * frequency + apart)) } else { mean };
        sum += weight * (mean + (value - mean) * shown);
        weights += weight;
        (weight, frequency) = (weight * GAIN, frequency * 2.0);
    }
    sum / weights
}

/// How much of an octave is shown by a pixel so many of its cells wide: what the box of the pixel leaves of a wave of 4/3
/// cells, which is about the middle of the noise's spectrum; nothing from 4/3 cells on.
fn shown(width: f64) -> f64 {
    let phase = 0.75 * PI * width;
    match () {
        () if phase < 1e-9 => 1.0,
        () if phase < PI => phase.sin() / phase,
        // Also where the width is no number.
        () => 0.0,
    }
}
