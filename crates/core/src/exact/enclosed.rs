//! Roots of a polynomial whose coefficients are known to within errors, in `f64`: each with a bound, or no answer.
//!
//! On a stretch the polynomial is written in Bernstein's form, where it has at most as many roots as its coefficients change
//! signs, and one where they change once (Mourrain, Rouillier and Roy, "The Bernstein basis and real root isolation", 2005).
//! Stretches are split until one of that holds whatever the errors are.

use super::{Bounded, Number, Undecided, Verdict};
use crate::numeric::{UNIT_ROUNDOFF_F64 as U, gamma_f64};

/// Coefficients, from the constant one upwards, of a polynomial of degree four at most.
pub(super) type Quartic = [Bounded; 5];

/// Binary digits of the ends of stretches that are not split any further: `f64` holds as many, and roots that cannot be told
/// apart there are as good as double.
const DEPTH: u32 = 45;

/// A stretch and the polynomial's coefficients there, each off by at most so much.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    low: f64,
    high: f64,
    bernstein: [f64; 5],
    error: f64,
    depth: u32,
}

/// What signs tell of the roots on a stretch.
enum Count {
    None,
    One,
    Unknown,
}

/// Passes on the roots between −`reach` and `reach`, a power of two, in order, until one is taken.
///
/// # Errors
/// Where roots cannot be told from each other, or from none.
pub(super) fn find_root<T>(
    coefficients: &Quartic,
    reach: f64,
    mut take: impl FnMut(Bounded) -> Verdict<Option<T>>,
) -> Verdict<Option<T>> {
    // In parts of the reach, which rounds nothing.
    let mut power = 1.0;
    let scaled = coefficients.map(|c| {
        let scaled = c.times(&Bounded::of(power));
        power *= reach;
        scaled
    });
    let (whole, most) = whole(&scaled);
    if !most.is_finite() {
        return Err(Undecided);
    }
    let mut waiting = vec![whole];
    while let Some(stretch) = waiting.pop() {
        match stretch.count() {
            Count::None => {}
            Count::One => {
                let root = refined(&scaled, &stretch)?.times(&Bounded::of(reach));
                if let Some(taken) = take(root)? {
                    return Ok(Some(taken));
                }
            }
            Count::Unknown if stretch.depth >= DEPTH => return Err(Undecided),
            Count::Unknown => {
                let [low, high] = stretch.split(most);
                waiting.extend([high, low]);
            }
        }
    }
    Ok(None)
}

/// The stretch from −1 to 1, and the largest coefficient there.
fn whole(c: &Quartic) -> (Stretch, f64) {
    // The powers of 2u − 1, in Bernstein's form: rows of coefficients from the constant one upwards.
    const POWERS: [[f64; 5]; 5] = [
        [1.0, 1.0, 1.0, 1.0, 1.0],
        [-1.0, -0.5, 0.0, 0.5, 1.0],
        [1.0, 0.0, -1.0 / 3.0, 0.0, 1.0],
        [-1.0, 0.5, 0.0, -0.5, 1.0],
        [1.0, -1.0, 1.0, -1.0, 1.0],
    ];
    let (mut sums, mut error, mut most) = ([0.0; 5], 0.0_f64, 0.0_f64);
    for (i, sum) in sums.iter_mut().enumerate() {
        let (mut size, mut off) = (0.0, 0.0);
        for (coefficient, power) in c.iter().zip(&POWERS) {
            let (value, known) = coefficient.parts();
            *sum += value * power[i];
            size += (value * power[i]).abs();
            off += known * power[i].abs();
        }
        // A product, a third, and four sums; the sums of sizes and errors are themselves rounded.
        error = error.max((off + gamma_f64(6) * size) * (1.0 + 16.0 * U) + f64::MIN_POSITIVE);
        most = most.max(sum.abs());
    }
    (Stretch { low: -1.0, high: 1.0, bernstein: sums, error, depth: 0 }, most + error)
}

impl Stretch {
    fn count(&self) -> Count {
        let sign = |v: f64| i32::from(v > self.error) - i32::from(v < -self.error);
        let signs = self.bernstein.map(sign);
        let [first, .., last] = signs;
        if first != 0 && signs.iter().all(|&sign| sign == first) {
            return Count::None;
        }
        // The first sign as far as it goes, at most one that is not known, and the last sign from there on.
        let start = signs.iter().take_while(|&&sign| sign == first).count();
        let end = signs.iter().rev().take_while(|&&sign| sign == last).count();
        if first != 0 && last == -first && start + end >= 4 { Count::One } else { Count::Unknown }
    }

    /// Both parts, by de Casteljau's scheme: in the middle, or beside it where the polynomial may be 0 there.
    fn split(&self, most: f64) -> [Self; 2] {
        for (share, digits) in [(0.5, 1), (0.375, 3), (0.625, 3)] {
            let mut rows = self.bernstein;
            let (mut low, mut high) = (self.bernstein, self.bernstein);
            for step in 1..5 {
                for i in 0..5 - step {
                    rows[i] = rows[i] * (1.0 - share) + rows[i + 1] * share;
                }
                low[step] = rows[0];
                high[4 - step] = rows[4 - step];
            }
            // Two products and a sum in each of four steps, of numbers below the largest coefficient.
            let error = self.error + gamma_f64(12) * most;
            let middle = self.low + (self.high - self.low) * share;
            let of = |low, high, bernstein| Self { low, high, bernstein, error, depth: self.depth + digits };
            if rows[0].abs() > error || share > 0.5 {
                return [of(self.low, middle, low), of(middle, self.high, high)];
            }
        }
        [*self, *self]
    }
}

/// The one root on a stretch.
fn refined(c: &Quartic, stretch: &Stretch) -> Verdict<Bounded> {
    let values = c.map(|c| c.parts().0);
    let at = |x: f64| values.iter().rev().fold(0.0, |sum, v| sum * x + v);
    let slope = |x: f64| (1..5_usize).rev().fold(0.0, |sum, i| sum * x + values[i] * i as f64);
    // On −1 to 1: what coefficients may be off, and eight roundings of each.
    let size: f64 = values.iter().map(|v| v.abs()).sum();
    let known: f64 = c.iter().map(|c| c.parts().1).sum();
    let error = (known + gamma_f64(8) * size) * (1.0 + 16.0 * U) + f64::MIN_POSITIVE;
    let rises = stretch.bernstein[4] > 0.0;
    let (mut low, mut high) = (stretch.low, stretch.high);
    let mut x = f64::midpoint(low, high);
    for _ in 0..64 {
        let value = at(x);
        if (value > 0.0) == rises {
            high = x;
        } else {
            low = x;
        }
        let newton = x - value / slope(x);
        let next = if low < newton && newton < high { newton } else { f64::midpoint(low, high) };
        if next == x || value == 0.0 {
            break;
        }
        x = next;
    }
    let mut off = 2.0 * error / slope(x).abs() + 4.0 * U * x.abs();
    for _ in 0..4 {
        let ends = [x - off, x + off].map(|end| end.clamp(stretch.low, stretch.high));
        // The ends of the stretch are known to lie on both sides of the root.
        let is_certain = |end: f64, above: bool| {
            let value = at(end);
            let is_end = end == if above == rises { stretch.high } else { stretch.low };
            is_end || if above { value > error } else { value < -error }
        };
        if is_certain(ends[0], !rises) && is_certain(ends[1], rises) {
            return Ok(Bounded::within(x, off * (1.0 + 16.0 * U) + U * x.abs()));
        }
        off *= 4.0;
    }
    Err(Undecided)
}

#[cfg(test)]
mod tests {
    use super::super::{Dyadic, Isolated};
    use super::*;

    fn all(coefficients: [f64; 5], reach: f64) -> Verdict<Vec<Bounded>> {
        let mut found = Vec::new();
        find_root::<()>(&coefficients.map(Bounded::of), reach, |root| {
            found.push(root);
            Ok(None)
        })?;
        Ok(found)
    }

    /// Of roots, times a number.
    fn product(roots: [f64; 4], lead: f64) -> [f64; 5] {
        roots.iter().fold([lead, 0.0, 0.0, 0.0, 0.0], |c, root| {
            std::array::from_fn(|i| (if i > 0 { c[i - 1] } else { 0.0 }) - root * c[i])
        })
    }

    #[test]
    fn every_root_lies_within_its_bound_and_none_is_missed() {
        let (mut decided, mut worst) = (0, 0.0_f64);
        for i in 0..4000_u32 {
            let x = |k: u32| f64::from(i * 4 + k).sin() * 1.5;
            let coefficients = product([x(0), x(1), x(2), x(3)], 1.0 + x(1));
            let exact = Isolated::all_of(&coefficients.map(Dyadic::of));
            let within = exact.iter().map(|root| root.rounded(80)).filter(|root| root.to_f64().abs() <= 1.0);
            let within: Vec<Dyadic> = within.collect();
            let Ok(found) = all(coefficients, 1.0) else { continue };
            decided += 1;
            assert_eq!(found.len(), within.len(), "{coefficients:?}");
            for (found, exact) in found.iter().zip(&within) {
                let (value, error) = found.parts();
                let off = Dyadic::of(value).minus(exact).over(&Dyadic::of(error)).abs();
                worst = worst.max(off);
                assert!(off <= 1.0 && error < 1e-9, "{off} {error}");
            }
        }
        assert!(decided > 3900 && worst > 0.01, "{decided} {worst}");
    }

    #[test]
    fn double_roots_are_not_decided() {
        assert!(all(product([0.3, 0.3, 0.7, 2.0], 1.0), 1.0).is_err());
    }

    #[test]
    fn a_root_in_the_middle_is_found() {
        let found = all(product([0.0, 0.5, 3.0, -4.0], 1.0), 1.0).unwrap();
        assert!(found.len() == 2 && found[0].parts().0.abs() < 1e-15, "{found:?}");
    }
}
