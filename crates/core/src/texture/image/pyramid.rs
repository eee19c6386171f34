//! How are the smaller copies of a picture made? Each pixel of a copy is the mean, in linear light, of the stretch of the
//! copy before that it covers: two by two pixels, or parts of three where a size is odd.

use std::sync::LazyLock;
use std::thread;

use super::levels::table;
use super::{Encoding, Plane, Samples};
use crate::{srgb_decoded, srgb_encoded};

/// A picture's smaller copies, ever half as wide and high, down to one pixel.
#[derive(Debug)]
pub(super) struct Pyramid {
    /// The picture itself, where it had to be decoded.
    pub(super) finest: Option<Plane>,
    pub(super) coarser: Vec<Plane>,
}

impl Pyramid {
    pub(super) fn of(plane: &Plane, finest: Option<Plane>, encoding: Encoding) -> Self {
        let mut coarser: Vec<Plane> = Vec::new();
        loop {
            let last = coarser.last().or(finest.as_ref()).unwrap_or(plane);
            if last.width == 1 && last.height == 1 {
                break;
            }
            let next = halved(last, encoding);
            coarser.push(next);
        }
        Self { finest, coarser }
    }

    pub(super) fn bytes(&self) -> usize {
        self.finest.iter().chain(&self.coarser).map(|plane| plane.samples.bytes()).sum()
    }
}

/// A copy of floating-point numbers that stand for sRGB, as light; none of bytes, which are decoded when they are read.
pub(super) fn linear_copy(plane: &Plane) -> Option<Plane> {
    let Samples::Floats(floats) = &plane.samples else { return None };
    let channels = usize::from(plane.channels);
    let colors = channels - usize::from(plane.has_alpha());
    let mut light = floats.clone();
    for pixel in light.chunks_exact_mut(channels) {
        for v in &mut pixel[..colors] {
            *v = srgb_decoded(f64::from(*v)) as f32;
        }
    }
    Some(Plane { samples: Samples::Floats(light), ..*plane })
}

/// The pixels along one axis that a pixel of the smaller copy covers, and their shares.
struct Stretch {
    first: usize,
    shares: [f32; 3],
    count: usize,
}

fn stretches(from: u32, to: u32) -> Vec<Stretch> {
    let ratio = f64::from(from) / f64::from(to);
    let stretch = |i: u32| {
        let (low, high) = (f64::from(i) * ratio, f64::from(i + 1) * ratio);
        let first = low.floor();
        let share = |k: usize| {
            let at = first + k as f64;
            ((high.min(at + 1.0) - low.max(at)).max(0.0) / ratio) as f32
        };
        let shares = [share(0), share(1), share(2)];
        let inside = from as usize - first as usize;
        let count = shares.iter().rposition(|share| *share > 0.0).map_or(1, |last| last + 1).min(inside);
        Stretch { first: first as usize, shares, count }
    };
    (0..to).map(stretch).collect()
}

/// Numbers of an encoded sample for 2¹⁶ steps of light: twenty steps and more for each byte.
static ENCODED: LazyLock<Vec<u8>> =
    LazyLock::new(|| (0..=u16::MAX).map(|i| to_byte(srgb_encoded(f64::from(i) / 65535.0))).collect());

fn to_byte(share: f64) -> u8 {
    (share * 255.0).round() as u8
}

fn encode(encoding: Encoding, light: f32) -> u8 {
    match encoding {
        Encoding::Srgb => ENCODED[usize::from((light * 65535.0 + 0.5) as u16)],
        Encoding::Linear => (light * 255.0 + 0.5) as u8,
    }
}

fn halved(plane: &Plane, encoding: Encoding) -> Plane {
    let (width, height) = ((plane.width / 2).max(1), (plane.height / 2).max(1));
    let axes = [stretches(plane.width, width), stretches(plane.height, height)];
    let channels = usize::from(plane.channels);
    let colors = channels - usize::from(plane.has_alpha());
    let stride = plane.width as usize * channels;
    let samples = match &plane.samples {
        Samples::Bytes(bytes) => {
            let (light, share) = (table(encoding), table(Encoding::Linear));
            let decode = |channel, byte: u8| {
                if channel < colors { light[byte as usize] } else { share[byte as usize] }
            };
            let encode = |channel, v| encode(if channel < colors { encoding } else { Encoding::Linear }, v);
            Samples::Bytes(reduced(&axes, (bytes, stride, channels), decode, encode))
        }
        Samples::Floats(floats) => {
            Samples::Floats(reduced(&axes, (floats, stride, channels), |_, v| v, |_, v| v))
        }
    };
    Plane { width, height, channels: plane.channels, samples }
}

/// The means over all stretches of both axes, row by row, on all threads.
fn reduced<T: Copy + Default + Send + Sync>(
    [columns, rows]: &[Vec<Stretch>; 2],
    (samples, stride, channels): (&[T], usize, usize),
    decode: impl Fn(usize, T) -> f32 + Sync,
    encode: impl Fn(usize, f32) -> T + Sync,
) -> Vec<T> {
    let width = columns.len() * channels;
    let mut out = vec![T::default(); width * rows.len()];
    let fill = |rows: &[Stretch], out: &mut [T]| {
        for (row, out) in rows.iter().zip(out.chunks_exact_mut(width)) {
            for (column, out) in columns.iter().zip(out.chunks_exact_mut(channels)) {
                for (channel, out) in out.iter_mut().enumerate() {
                    let mut sum = 0.0;
                    for (y, down) in row.shares[..row.count].iter().enumerate() {
                        let start = (row.first + y) * stride + column.first * channels + channel;
                        for (x, along) in column.shares[..column.count].iter().enumerate() {
                            sum += down * along * decode(channel, samples[start + x * channels]);
                        }
                    }
                    *out = encode(channel, sum);
                }
            }
        }
    };
    let threads =
        if out.len() < 1 << 16 { 1 } else { thread::available_parallelism().map_or(1, usize::from) };
    let share = rows.len().div_ceil(threads);
    thread::scope(|scope| {
        for (rows, out) in rows.chunks(share).zip(out.chunks_mut(share * width)) {
            scope.spawn(|| fill(rows, out));
        }
    });
    out
}
