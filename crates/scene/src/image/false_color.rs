//! By which colours are numbers shown in a picture, and where do lines of equal numbers lie?

/// Colours from dark to light that keep their order for all eyes and in grey: nine stops of viridis (Smith and van der Walt,
/// 2015, CC0).
const COLORS: [[f64; 3]; 9] = [
    [68.0, 1.0, 84.0],
    [71.0, 44.0, 122.0],
    [59.0, 81.0, 139.0],
    [44.0, 113.0, 142.0],
    [33.0, 144.0, 141.0],
    [39.0, 173.0, 129.0],
    [92.0, 200.0, 99.0],
    [170.0, 220.0, 50.0],
    [253.0, 231.0, 37.0],
];

/// Lines of equal numbers are at most so many.
const MOST_LINES: f64 = 10.0;

/// The colour of a share; what is less than 0 counts as 0, what is more than 1 as 1.
#[must_use]
pub fn color(share: f64) -> [u8; 3] {
    let at = share.clamp(0.0, 1.0) * (COLORS.len() - 1) as f64;
    let first = (at as usize).min(COLORS.len() - 2);
    let part = at - first as f64;
    [0, 1, 2].map(|i| (COLORS[first][i] * (1.0 - part) + COLORS[first + 1][i] * part).round() as u8)
}

/// The scale of colours: from a number to another, with lines at round numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    from: f64,
    to: f64,
    step: f64,
}

impl Scale {
    /// From the least to the most, with lines at multiples of 1, 2 or 5 times a power of ten.
    #[must_use]
    pub fn of([least, most]: [f64; 2]) -> Self {
        let span = most - least;
        let coarse = (span / MOST_LINES).log10().floor();
        let steps = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * 10_f64.powf(coarse));
        let step = steps.into_iter().find(|step| span / step <= MOST_LINES).unwrap_or(span);
        Self {
            from: least,
            to: most,
            step: if step > 0.0 && step.is_finite() { step } else { f64::INFINITY },
        }
    }

    /// The numbers of its ends.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        [self.from, self.to]
    }

    /// The difference from one line to the next; infinite where there is none.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step
    }

    /// How far from one end to the other a number lies; 0 where the ends are one.
    #[must_use]
    pub fn share(&self, value: f64) -> f64 {
        if self.to > self.from { (value - self.from) / (self.to - self.from) } else { 0.0 }
    }

    /// Between which lines a number lies.
    #[must_use]
    pub fn band(&self, value: f64) -> i64 {
        (value / self.step).floor() as i64
    }

    /// The numbers at which lines are drawn.
    #[must_use]
    pub fn lines(&self) -> Vec<f64> {
        let bands = self.band(self.from)..self.band(self.to);
        bands.map(|band| (band + 1) as f64 * self.step).filter(|line| *line > self.from).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_at_round_numbers_and_few() {
        assert_eq!(Scale::of([0.0, 40.0]).lines(), [5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0]);
        for [least, most] in [[0.0, 1.0], [3.0, 3.5], [1e-9, 7e-9], [0.0, 12345.0]] {
            let lines = Scale::of([least, most]).lines().len();
            assert!((3..=11).contains(&lines), "{least} {most}: {lines}");
        }
        assert!(Scale::of([5.0, 5.0]).lines().is_empty());
    }

    #[test]
    fn larger_numbers_are_lighter() {
        let light = |share| color(share).map(u32::from).iter().sum::<u32>();
        assert!(light(0.0) < light(0.5) && light(0.5) < light(1.0));
        assert_eq!((color(-1.0), color(7.0)), (color(0.0), color(1.0)));
    }
}
