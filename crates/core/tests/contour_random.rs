//! Does the closed form agree with quadrature, and with itself, on random lamps behind random blockers?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

#[allow(dead_code, reason = "other tests of contours use the rest")]
mod quadrature;

use catoptra_core::Shape;
use catoptra_core::contour::{Blocker, Lamp, Leaving, Scratch, open, visible};
use catoptra_core::glam::DVec3;
use quadrature::{Random, Rule, Swept};

struct Trial {
    point: DVec3,
    normal: DVec3,
    lamp: Shape,
    two_sided: bool,
    shapes: Vec<Shape>,
}

impl Trial {
    fn new(seed: u64, most: u32) -> Self {
        let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        random.share();
        let lamp = random.lamp();
        let point = random.vector() * 0.5;
        let normal = if random.below(2) == 0 { DVec3::Y } else { random.unit() };
        let count = 1 + random.below(most);
        let shapes = (0..count).map(|_| random.blocker(point, &lamp)).collect();
        Self { point, normal, lamp, two_sided: random.below(2) == 0, shapes }
    }

    fn value(&self, scratch: &mut Scratch) -> Option<(f64, f64)> {
        let lamp = Lamp::of(&self.lamp, 0)?.with_two_sides(self.two_sided);
        let whole = open(self.point, self.normal, &lamp);
        Some((past(self.point, self.normal, &lamp, &self.shapes, scratch)?, whole))
    }

    fn truth(&self, off: f64, stripes: u32) -> f64 {
        let swept = Swept::of(&self.lamp, self.two_sided);
        Rule::new(self.point, self.normal, &swept, &self.shapes).value(off, stripes)
    }
}

fn past(at: DVec3, normal: DVec3, lamp: &Lamp, shapes: &[Shape], scratch: &mut Scratch) -> Option<f64> {
    let blockers: Vec<_> = shapes.iter().map(|shape| Blocker::of(shape).unwrap()).collect();
    let list: Vec<_> = blockers.iter().map(|blocker| (blocker, Leaving::Nothing)).collect();
    visible(at, normal, lamp, &list, scratch).ok()
}

#[test]
fn closed_forms_are_those_of_quadrature() {
    let mut scratch = Scratch::default();
    let (mut given_up, mut hidden) = (0, 0);
    for seed in 0..250 {
        let trial = Trial::new(seed, 8);
        let Some((value, whole)) = trial.value(&mut scratch) else {
            given_up += 1;
            continue;
        };
        // Few stripes may miss what is thin.
        let error = |stripes: u32| (value - trial.truth(1e-9, stripes)).abs();
        assert!(error(4) <= 1e-8 || error(1000) <= 1e-8, "{seed}: {value} of {whole}");
        hidden += u32::from(value < 0.99 * whole);
    }
    assert!(given_up < 25 && hidden > 100, "{given_up} without closed form, {hidden} hidden");
}

#[test]
fn many_configurations_stay_in_bounds() {
    let mut scratch = Scratch::default();
    for seed in 1000..21_000 {
        let Some((value, whole)) = Trial::new(seed, 8).value(&mut scratch) else { continue };
        assert!((0.0..=whole).contains(&value), "{seed}: {value} of {whole}");
    }
}
