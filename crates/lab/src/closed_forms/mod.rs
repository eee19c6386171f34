//! Which light has a known answer? Scenes with points, and the irradiance there as quadrature over their lamps finds it.
//!
//! Metres, y up. The first two rooms are those of test cases 5.3, 5.6 and 5.7 of CIE 171:2006, *Test cases to assess the accuracy
//! of lighting computer programs*; truth is computed from their geometry.

mod flux;
mod scenes;
mod sweep;

use catoptra_core::glam::DVec3;

pub use flux::{ClosedRoom, closed_rooms};
use sweep::{Between, Flat};

/// A scene of known light.
#[derive(Debug, Clone)]
pub struct ClosedForm {
    /// What it shows.
    pub title: &'static str,
    /// In the format of scene files.
    pub scene: String,
    /// Radiance of its lamp, the same in every channel.
    pub radiance: f64,
    /// Where light is known.
    pub points: Vec<KnownLight>,
}

/// The light at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownLight {
    /// Metres.
    pub point: DVec3,
    /// Unit normal of the receiver.
    pub normal: DVec3,
    /// In the unit of the radiance, times steradians.
    pub irradiance: f64,
}

impl KnownLight {
    /// Whether an answer is as right as promised: within 0.01 %, or a millionth of the lamp's radiance.
    #[must_use]
    pub fn is_met_by(&self, found: f64, radiance: f64) -> bool {
        (found - self.irradiance).abs() <= (1e-4 * self.irradiance).max(1e-6 * radiance)
    }
}

/// All scenes of known light. Takes about a second.
#[must_use]
pub fn closed_forms() -> Vec<ClosedForm> {
    scenes::all()
}

/// A scene whose truth is swept: lamps as they look from a point, and what stands between.
fn swept(
    title: &'static str,
    scene: String,
    radiance: f64,
    lamp: impl Fn(DVec3) -> Flat,
    between: &[Between],
    at: &[(DVec3, DVec3)],
) -> ClosedForm {
    let known = |&(point, normal): &(DVec3, DVec3)| KnownLight {
        point,
        normal,
        irradiance: radiance * sweep::irradiance(point, normal, &lamp(point), between),
    };
    ClosedForm { title, scene, radiance, points: at.iter().map(known).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Digits that were found by other programs.
    #[test]
    fn truths_are_those_found_elsewhere() {
        let forms = closed_forms();
        let light = |title: &str, at: usize| {
            let form = forms.iter().find(|form| form.title.contains(title)).unwrap();
            form.points[at].irradiance
        };
        for (title, at, right) in [
            ("black room", 0, 32.676_898),
            ("black room", 9, 105.778_242),
            ("floor that shines", 0, 0.359_005_05),
            ("floor that shines", 8, 0.355_665_92),
            ("past a box", 2, 0.153_988_10),
            ("ball before a lamp", 0, 1.167_855_918),
            ("ball before a lamp", 4, 0.0),
            ("Three balls", 1, 1.228_170_730),
            ("square and a ball", 0, 0.146_451_544),
            ("ball that shines", 3, 0.001_166_140),
            ("behind a ball", 0, 0.111_456_517),
        ] {
            let found = light(title, at);
            assert!((found - right).abs() <= 1e-8 * right.max(1.0), "{title} {at}: {found}");
        }
    }
}
