//! Random numbers for sampling: a pure function of seed, pixel, sample and dimension: nothing is drawn one
//! after another, so crops, tiles, threads and resuming cannot matter.
//!
//! Sobol's first two dimensions, scrambled by Owen's method with a hash and used again for every pair of dimensions, with
//! the samples in another order each time (Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020).

use crate::lanes::{HALVES, Word};

/// The pairs of dimensions, by what is chosen with them: every kind of choice has one of its own.
pub(crate) mod pairs {
    /// The direction in which a surface looks for the sky.
    pub(crate) const DIRECTION: u32 = 0;
    /// Where in a pixel a sample lies.
    pub(crate) const PLACE: u32 = 1;
    /// Where on the lens a camera ray starts.
    pub(crate) const LENS: u32 = 2;
    /// What a path chooses at each point: from here on four for every bounce.
    const BOUNCES: u32 = 1 << 30;
    /// Where from all around light comes: from here on one for every bounce.
    const SURROUNDINGS: u32 = 3 << 29;

    /// Whether a path passes a surface that is not opaque: from here on one for every surface after a bounce.
    const PASSAGES: u32 = 7 << 28;

    /// Whether a path passes the surface that it comes to after so many bounces and surfaces passed since.
    pub(crate) const fn passage(depth: u32, passed: u32) -> u32 {
        PASSAGES.wrapping_add(depth.wrapping_mul(1 << 12)).wrapping_add(passed)
    }

    /// One of the choices of a path after so many bounces, of four at most.
    pub(crate) const fn bounce(depth: u32, choice: u32) -> u32 {
        BOUNCES.wrapping_add(depth.wrapping_mul(4)).wrapping_add(choice)
    }

    /// Where light from all around comes from, after so many bounces.
    pub(crate) const fn surroundings(depth: u32) -> u32 {
        SURROUNDINGS.wrapping_add(depth)
    }

    /// Where on a lamp rays end: from here on one for every lamp and every reflection.
    pub(crate) const LAMPS: u32 = 64;
}

/// The numbers of one pixel, or of a register of pixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sampler<W> {
    pixel: W,
}

impl<W: Word> Sampler<W> {
    /// Those of the pixel in column `x` and row `y` of the whole picture.
    #[inline(always)]
    pub(crate) fn new(seed: u32, x: W, y: W) -> Self {
        let columns = mixed(seed);
        let rows = mixed(columns ^ GOLDEN);
        // Hashed separately, so that no column holds what another one holds some rows further down.
        Self { pixel: mixed(mixed(x.plus_number(columns)).plus(mixed(y.plus_number(rows)))) }
    }

    /// Dimensions 2 `pair` and 2 `pair` + 1 of a sample, as shares of 2³². Of the first 2ᵐ samples of a pixel (and of
    /// every 2ᵐ after them) one lies in each cell of every grid of 2ᵏ x 2ᵐ⁻ᵏ cells; pairs know nothing of each other.
    #[inline(always)]
    pub(crate) fn pair(self, sample: W, pair: u32) -> [W; 2] {
        let key = mixed(self.pixel.plus_number(pair.wrapping_mul(GOLDEN)));
        let shuffled = scrambled_reversed(sample.reversed(), key).reversed();
        sobol(shuffled, [mixed(key.plus_number(1)), mixed(key.plus_number(2))])
    }
}

/// A share of 2³² as a share of 1: an exact multiple of 2⁻³², below 1.
#[inline(always)]
pub(crate) fn share(bits: u32) -> f64 {
    f64::from(bits) / (1_u64 << 32) as f64
}

/// The seed of one of several sequences that know nothing of each other; of the first it is `seed` itself.
#[inline(always)]
pub(crate) fn seed_of_sequence(seed: u32, sequence: u32) -> u32 {
    // Odd, so that no two of a seed's sequences are alike; far from any seed that is counted up.
    seed.wrapping_add(sequence.wrapping_mul(GOLDEN))
}

/// Point number `index` of Sobol's first two dimensions, each scrambled with its own seed, as shares of 2³².
#[inline(always)]
pub(crate) fn sobol<W: Word>(index: W, [first, second]: [W; 2]) -> [W; 2] {
    // The first dimension is the index from its lowest bit on. Bit i of the second, from its highest one on, is the sum
    // of C(j, i) times bit j of the index: Pascal's triangle modulo 2, which falls into one step a halving.
    let mut triangle = index;
    for (places, lower) in HALVES {
        triangle = triangle.xor(triangle.shift_down(places).and(triangle.of(lower)));
    }
    [scrambled_reversed(index, first).reversed(), scrambled_reversed(triangle, second).reversed()]
}

/// A nested uniform scramble of bits that stand in reverse: every bit is flipped or not by a hash of those below it
/// (Laine and Karras 2011, with Burley's constants).
#[inline(always)]
fn scrambled_reversed<W: Word>(bits: W, seed: W) -> W {
    let mut x = bits.plus(seed);
    for factor in [0x6c50_b47c_u32, 0xb82f_1e52, 0xc7af_e638, 0x8d22_f6e6] {
        x = x.xor(x.times_number(factor));
    }
    x
}

/// An integer hash (`lowbias32`, Wellons, "Prospecting for Hash Functions", 2018, with the constants found since).
#[inline(always)]
fn mixed<W: Word>(bits: W) -> W {
    let x = bits.xor(bits.shift_down(16)).times_number(0x21f0_aaad);
    let x = x.xor(x.shift_down(15)).times_number(0x735a_2d97);
    x.xor(x.shift_down(15))
}

/// 2³² over the golden ratio, odd: multiples of it lie far apart.
const GOLDEN: u32 = 0x9e37_79b9;

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use fearless_simd::{Simd, dispatch};

    use super::*;
    use crate::Instructions;
    use crate::lanes::{F, U};
    use crate::random::Random;

    fn shares(pixel: [u32; 2], sample: u32, pair: u32) -> [f64; 2] {
        Sampler::new(7, pixel[0], pixel[1]).pair(sample, pair).map(share)
    }

    /// Means over the first `samples` samples of many pixels: the root mean square of their errors.
    fn error(samples: u32, exact: f64, value: impl Fn([u32; 2], u32) -> f64) -> f64 {
        let pixels = (0..400).map(|i| [i % 20, i / 20]);
        let mean = |pixel| (0..samples).map(|k| value(pixel, k)).sum::<f64>() / f64::from(samples);
        (pixels.map(|pixel| (mean(pixel) - exact).powi(2)).sum::<f64>() / 400.0).sqrt()
    }

    #[test]
    fn every_block_of_samples_is_even_in_cells_of_every_shape() {
        for (pixel, pair) in [([0, 0], 0), ([1, 0], 1), ([4000, 3000], 2), ([u32::MAX, 0], 77)] {
            for (power, block) in [(4, 0), (4, 3), (6, 1), (10, 0)] {
                let samples = (block << power)..((block + 1) << power);
                let points: Vec<[f64; 2]> = samples.map(|k| shares(pixel, k, pair)).collect();
                for across in 0..=power {
                    let cells = [f64::from(1 << across), f64::from(1 << (power - across))];
                    let taken: HashSet<_> =
                        points.iter().map(|[x, y]| ((x * cells[0]) as u32, (y * cells[1]) as u32)).collect();
                    assert_eq!(taken.len(), 1 << power, "{pixel:?} pair {pair}, {cells:?}");
                }
            }
        }
    }

    #[test]
    fn the_second_dimension_is_that_of_its_direction_numbers() {
        let mut random = Random(3);
        for _ in 0..1000 {
            let [index, seed] = [(); 2].map(|()| random.bits() as u32);
            let (mut second, mut direction) = (0, 1_u32 << 31);
            for bit in 0..32 {
                second ^= if index >> bit & 1 == 1 { direction } else { 0 };
                direction ^= direction >> 1;
            }
            let scrambled = scrambled_reversed(second.reverse_bits(), seed).reverse_bits();
            assert_eq!(sobol(index, [0, seed])[1], scrambled, "{index:x}");
        }
    }

    #[test]
    fn shares_are_exact_and_below_one() {
        assert_eq!([0, 1, u32::MAX].map(share), [0.0, 2.0_f64.powi(-32), 1.0 - 2.0_f64.powi(-32)]);
    }

    #[test]
    fn a_number_depends_on_neither_order_nor_neighbours() {
        let all = |samples: &mut dyn Iterator<Item = u32>| {
            let mut found: Vec<_> = samples.map(|k| (k, Sampler::new(3, 5, 9).pair(k, 1))).collect();
            found.sort_unstable();
            found
        };
        assert_eq!(all(&mut (0..64)), all(&mut (0..64).rev()));
    }

    #[test]
    fn seeds_pixels_samples_and_pairs_all_count() {
        let here = Sampler::new(1, 10, 20).pair(3, 0);
        let others = [
            Sampler::new(2, 10, 20).pair(3, 0),
            Sampler::new(1, 11, 20).pair(3, 0),
            Sampler::new(1, 10, 21).pair(3, 0),
            Sampler::new(1, 20, 10).pair(3, 0),
            Sampler::new(1, 10, 20).pair(4, 0),
            Sampler::new(1, 10, 20).pair(3, 1),
        ];
        for other in others {
            assert!(here[0] != other[0] && here[1] != other[1], "{here:?} {other:?}");
        }
    }

    #[test]
    fn pixels_and_pairs_know_nothing_of_each_other() {
        type Other = fn([u32; 2]) -> f64;
        let others: [(&str, Other); 5] = [
            ("to the right", |[x, y]| shares([x + 1, y], 0, 0)[0]),
            ("below", |[x, y]| shares([x, y + 1], 0, 0)[0]),
            ("aslant", |[x, y]| shares([x + 1, y + 1], 0, 0)[0]),
            ("of the other dimension", |pixel| shares(pixel, 0, 0)[1]),
            ("of the next pair", |pixel| shares(pixel, 0, 1)[0]),
        ];
        let edge = 200_u32;
        for (what, other) in others {
            let pixels = (0..edge * edge).map(|i| [i % edge, i / edge]);
            let sum: f64 = pixels.map(|pixel| (shares(pixel, 0, 0)[0] - 0.5) * (other(pixel) - 0.5)).sum();
            // Of independent numbers the sum has a standard deviation of 1/12 for each root of their count.
            let deviations = sum * 12.0 / f64::from(edge);
            assert!(deviations.abs() < 4.0, "{what}: {deviations}");
        }
    }

    #[test]
    fn means_of_a_smooth_function_converge_faster_than_random_ones() {
        let smooth = |[x, y]: [f64; 2]| x * y;
        // The standard deviation of xy is √(7/144).
        let random = |samples: u32| (7.0 / 144.0 / f64::from(samples)).sqrt();
        for (samples, times) in [(16, 6.0), (64, 20.0), (256, 80.0)] {
            let error = error(samples, 0.25, |pixel, k| smooth(shares(pixel, k, 0)));
            assert!(error * times < random(samples), "{samples}: {error} against {}", random(samples));
        }
    }

    #[test]
    fn dimensions_of_different_pairs_are_padded_without_harm() {
        let random = |samples: u32| (7.0 / 144.0 / f64::from(samples)).sqrt();
        let error = error(64, 0.25, |pixel, k| shares(pixel, k, 0)[0] * shares(pixel, k, 1)[0]);
        assert!(error < random(64), "{error} against {}", random(64));
    }

    fn lanes_agree<S: Simd>(s: S, random: &mut Random) {
        let lanes = F::<S>::LANES;
        let [x, y, sample] = [(); 3].map(|()| (0..lanes).map(|_| random.bits() as u32).collect::<Vec<_>>());
        let (seed, pair) = (random.bits() as u32, random.bits() as u32 % 9);
        let of = |numbers: &[u32]| U::load(s, numbers);
        let found = Sampler::new(seed, of(&x), of(&y)).pair(of(&sample), pair);
        for lane in 0..lanes {
            let alone = Sampler::new(seed, x[lane], y[lane]).pair(sample[lane], pair);
            assert_eq!(found.map(|numbers| numbers.lane(lane)), alone);
        }
    }

    #[test]
    fn lanes_hold_the_bits_of_single_numbers_at_every_width() {
        let mut random = Random(11);
        for instructions in Instructions::all() {
            for _ in 0..200 {
                dispatch!(instructions.level(), s => lanes_agree(s, &mut random));
            }
        }
    }
}
