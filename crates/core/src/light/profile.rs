//! How much light does a luminaire send which way? A table over two angles, as goniophotometers measure it.

use crate::InvalidPart;
use crate::part::LARGEST;

/// The axis that a profile's polar angles are counted from, in the luminaire's own space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pole {
    /// Nadir: azimuth 0 is the luminaire's horizontal and azimuth 90° lies counterclockwise from it, seen from above.
    Nadir,
    /// 90° clockwise from the luminaire's horizontal, seen from above: azimuth 0 is nadir, azimuth 90° the horizontal.
    Across,
}

/// Intensities of a luminaire by direction, in candela, which scenes take for W/sr as they stand: interpolated
/// linearly in both angles, and dark beyond the last angles.
#[derive(Debug, Clone, PartialEq)]
pub struct IntensityProfile {
    pole: Pole,
    polar: Angles,
    azimuth: Angles,
    candela: Vec<f64>,
}

impl IntensityProfile {
    /// From ascending polar angles (at least two, in 0..=180 degrees), ascending azimuths (one for a profile that is
    /// the same all round, else at least two over 360 degrees at most), and the intensities in candela: one row of
    /// polar angles for each azimuth.
    ///
    /// # Errors
    /// Angles that are too few, out of order or out of range; intensities that are too few or too many, negative or
    /// beyond [`LARGEST`].
    pub fn new(
        pole: Pole,
        polar: Vec<f64>,
        azimuth: Vec<f64>,
        candela: Vec<f64>,
    ) -> Result<Self, InvalidPart> {
        check_angles("polar", &polar, 2, 0.0, 180.0)?;
        let first = azimuth.first().copied().unwrap_or_default();
        check_angles("azimuth", &azimuth, 1, first, first + 360.0)?;
        if first.abs() > 180.0 {
            return Err(InvalidPart::new("azimuth", "must begin in -180..180 degrees", first));
        }
        if polar.len().checked_mul(azimuth.len()) != Some(candela.len()) {
            let requirement = format!("must be {} by {} numbers", azimuth.len(), polar.len());
            return Err(InvalidPart::new("candela", requirement, candela.len()));
        }
        if let Some(wrong) = candela.iter().find(|v| !(0.0..=LARGEST).contains(*v)) {
            return Err(InvalidPart::new("candela", "must lie in 0..3.4e38", wrong));
        }
        Ok(Self { pole, polar: Angles::new(polar, 180.0), azimuth: Angles::new(azimuth, 360.0), candela })
    }

    /// The axis of the polar angles.
    #[must_use]
    pub fn pole(&self) -> Pole {
        self.pole
    }

    /// The polar angles, degrees, ascending.
    #[must_use]
    pub fn polar(&self) -> &[f64] {
        &self.polar.degrees
    }

    /// The azimuths, degrees, ascending; one where the profile is the same all round.
    #[must_use]
    pub fn azimuth(&self) -> &[f64] {
        &self.azimuth.degrees
    }

    /// The intensities, candela: a row of polar angles for each azimuth.
    #[must_use]
    pub fn candela(&self) -> &[f64] {
        &self.candela
    }

    /// Whether the intensity does not depend on the azimuth.
    #[inline(always)]
    #[must_use]
    pub fn is_round(&self) -> bool {
        self.azimuth.degrees.len() == 1
    }

    /// The intensity in a direction, candela: polar angle in 0..=π and azimuth in −π..=π, radians. NaN sees darkness.
    #[must_use]
    pub fn intensity(&self, polar: f64, azimuth: f64) -> f64 {
        let Some((row, along)) = self.polar.find(polar.to_degrees()) else { return 0.0 };
        let width = self.polar.degrees.len();
        let at = |column: usize| {
            let place = column * width + row;
            mix(self.candela[place], self.candela[place + 1], along)
        };
        if self.is_round() {
            return at(0);
        }
        let turned = azimuth.to_degrees();
        let first = self.azimuth.degrees[0];
        let wrapped = if turned < first { turned + 360.0 } else { turned };
        match self.azimuth.find(wrapped) {
            Some((column, across)) => mix(at(column), at(column + 1), across),
            None => 0.0,
        }
    }

    /// The largest intensity of all, candela.
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.candela.iter().copied().fold(0.0, f64::max)
    }

    /// The light that is sent out in all directions together, lumens: the integral of the interpolated intensity.
    #[must_use]
    pub fn flux(&self) -> f64 {
        let width = self.polar.degrees.len();
        let rows: Vec<f64> = self.candela.chunks_exact(width).map(|row| self.zone(row)).collect();
        if self.is_round() {
            return rows[0] * std::f64::consts::TAU;
        }
        let steps = self.azimuth.degrees.windows(2).map(|pair| (pair[1] - pair[0]).to_radians());
        steps.zip(rows.windows(2)).map(|(step, pair)| step * (pair[0] + pair[1]) / 2.0).sum()
    }

    /// The integral of one row over the polar angle: of linear pieces times its sine.
    fn zone(&self, row: &[f64]) -> f64 {
        let cells = self.polar.degrees.windows(2).zip(row.windows(2));
        cells
            .map(|(angles, values)| {
                let [from, to] = [angles[0].to_radians(), angles[1].to_radians()];
                let slope = (values[1] - values[0]) / (to - from);
                values[0] * from.cos() - values[1] * to.cos() + slope * (to.sin() - from.sin())
            })
            .sum()
    }
}

fn mix(from: f64, to: f64, share: f64) -> f64 {
    from + (to - from) * share
}

fn check_angles(
    name: &'static str,
    angles: &[f64],
    least: usize,
    from: f64,
    to: f64,
) -> Result<(), InvalidPart> {
    if angles.len() < least {
        return Err(InvalidPart::new(name, format!("must be at least {least} angles"), angles.len()));
    }
    if let Some(wrong) = angles.iter().find(|v| !(from..=to).contains(*v)) {
        return Err(InvalidPart::new(name, format!("must lie in {from}..{to} degrees"), wrong));
    }
    match angles.windows(2).find(|pair| pair[1] <= pair[0]) {
        Some(pair) => {
            let found = format!("{} after {}", pair[1], pair[0]);
            Err(InvalidPart::new(name, "must be in ascending order", found))
        }
        None => Ok(()),
    }
}

/// Ascending angles, and how to find the pair that an angle lies between.
#[derive(Debug, Clone, PartialEq)]
struct Angles {
    degrees: Vec<f64>,
    /// Pairs per degree, if all were alike: where to look first.
    density: f64,
    /// The angles that are lit; no bound at the ends of the range of all angles, which rounding may overstep.
    lit: (f64, f64),
}

impl Angles {
    /// `whole` is the range of all angles.
    fn new(degrees: Vec<f64>, whole: f64) -> Self {
        let (first, last) = (degrees[0], degrees[degrees.len() - 1]);
        let density = if first < last { (degrees.len() - 1) as f64 / (last - first) } else { 0.0 };
        let closed = last - first >= whole;
        let lower = if closed || first == 0.0 { f64::NEG_INFINITY } else { first };
        let upper = if closed || last == whole { f64::INFINITY } else { last };
        Self { degrees, density, lit: (lower, upper) }
    }

    /// The pair of angles that an angle lies between, by the index of the lower one, and its place between them in
    /// 0..=1; none outside all of them.
    fn find(&self, angle: f64) -> Option<(usize, f64)> {
        if !(self.lit.0 <= angle && angle <= self.lit.1) {
            return None;
        }
        let (first, pairs) = (self.degrees[0], self.degrees.len() - 1);
        let guess = ((angle - first) * self.density) as usize;
        let holds = guess < pairs && self.degrees[guess] <= angle && angle < self.degrees[guess + 1];
        let place =
            if holds { guess } else { self.degrees[1..pairs].partition_point(|&upper| upper <= angle) };
        let (lower, upper) = (self.degrees[place], self.degrees[place + 1]);
        Some((place, ((angle - lower) / (upper - lower)).clamp(0.0, 1.0)))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    /// 1000 cos θ down to the horizontal, by the degree.
    fn cosine() -> IntensityProfile {
        let polar: Vec<f64> = (0..=90).map(f64::from).collect();
        let candela = polar.iter().map(|v| 1000.0 * v.to_radians().cos().max(0.0)).collect();
        IntensityProfile::new(Pole::Nadir, polar, vec![0.0], candela).unwrap()
    }

    #[test]
    fn a_cosine_sends_out_pi_times_its_peak() {
        let flux = cosine().flux();
        // Chords of a cosine over one degree lie low by up to 1°²/8, on average by 1°²/12.
        let chords = 1.0_f64.to_radians().powi(2) / 12.0;
        assert!((flux / (1000.0 * PI) - 1.0 + chords).abs() < 1e-7, "{flux}");
    }

    #[test]
    fn intensities_are_those_of_the_table_and_linear_between() {
        let profile =
            IntensityProfile::new(Pole::Nadir, vec![0.0, 10.0, 90.0], vec![0.0, 90.0, 180.0, 360.0], {
                vec![8.0, 4.0, 0.0, 8.0, 2.0, 1.0, 8.0, 0.0, 3.0, 8.0, 4.0, 0.0]
            })
            .unwrap();
        let at = |polar: f64, azimuth: f64| profile.intensity(polar.to_radians(), azimuth.to_radians());
        let expected = [
            (0.0, 0.0, 8.0),
            (10.0, 90.0, 2.0),
            (5.0, 90.0, 5.0),
            (50.0, 90.0, 1.5),
            (10.0, 45.0, 3.0),
            (10.0, -90.0, 2.0),
            (10.0, 180.0, 0.0),
            (10.0, -180.0, 0.0),
            (10.0, -0.0, 4.0),
        ];
        for (polar, azimuth, candela) in expected {
            let found = at(polar, azimuth);
            assert!((found - candela).abs() < 1e-12, "{polar} {azimuth}: {found}, not {candela}");
        }
        assert_eq!((at(91.0, 0.0), profile.intensity(f64::NAN, 0.0), profile.peak()), (0.0, 0.0, 8.0));
    }

    #[test]
    fn rounding_past_the_ends_of_all_angles_is_no_darkness() {
        let profile =
            IntensityProfile::new(Pole::Nadir, vec![0.0, 180.0], vec![0.0, 360.0], vec![1.0, 3.0, 1.0, 3.0]);
        let profile = profile.unwrap();
        assert_eq!(profile.intensity(f64::from(PI as f32), -f64::MIN_POSITIVE), 3.0);
        assert!((profile.flux() - 8.0 * PI).abs() < 1e-12);
    }

    #[test]
    fn uneven_angles_are_found_as_well() {
        let polar: Vec<f64> = (0..=40).map(|i| f64::from(i * i) * 180.0 / 1600.0).collect();
        let candela = polar.clone();
        let profile = IntensityProfile::new(Pole::Nadir, polar, vec![0.0], candela).unwrap();
        for tenth in 0..=1800 {
            let angle = f64::from(tenth) / 10.0;
            assert!((profile.intensity(angle.to_radians(), 1.0) - angle).abs() < 1e-12, "{angle}");
        }
    }

    #[test]
    fn what_is_outside_the_azimuths_is_dark() {
        let row = vec![2.0; 4];
        let profile = IntensityProfile::new(Pole::Across, vec![0.0, 180.0], vec![-90.0, 90.0], row).unwrap();
        assert_eq!(profile.intensity(FRAC_PI_2, 0.0), 2.0);
        assert_eq!(profile.intensity(FRAC_PI_2, 3.0), 0.0);
        assert_eq!(profile.intensity(FRAC_PI_2, -3.0), 0.0);
        assert!((profile.flux() - 4.0 * PI).abs() < 1e-12);
    }

    #[test]
    fn tables_that_are_none_are_refused() {
        let make = |polar: &[f64], azimuth: &[f64], candela: &[f64]| {
            let made = IntensityProfile::new(Pole::Nadir, polar.to_vec(), azimuth.to_vec(), candela.to_vec());
            made.unwrap_err().to_string()
        };
        assert_eq!(make(&[0.0], &[0.0], &[1.0]), "polar must be at least 2 angles, not 1");
        assert_eq!(make(&[0.0, 190.0], &[0.0], &[1.0; 2]), "polar must lie in 0..180 degrees, not 190");
        assert_eq!(
            make(&[0.0, 9.0, 9.0], &[0.0], &[1.0; 3]),
            "polar must be in ascending order, not 9 after 9"
        );
        assert_eq!(make(&[0.0, 9.0], &[], &[]), "azimuth must be at least 1 angles, not 0");
        assert_eq!(
            make(&[0.0, 9.0], &[0.0, 361.0], &[0.0; 4]),
            "azimuth must lie in 0..360 degrees, not 361"
        );
        assert_eq!(make(&[0.0, 9.0], &[0.0], &[0.0; 3]), "candela must be 1 by 2 numbers, not 3");
        assert_eq!(make(&[0.0, 9.0], &[0.0], &[0.0, -1.0]), "candela must lie in 0..3.4e38, not -1");
        assert!(make(&[0.0, f64::NAN], &[0.0], &[0.0; 2]).contains("polar"));
    }
}
