//! Does a lobe spread directions as densely as it says, and do they weigh what it shows in all? By quadrature and by
//! counting, for tests of any lobe.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::{Sample, Scatter, ShadingPoint};
use crate::Triple;

/// Rings and sectors of the quadrature, and of the cells that directions are counted in.
const FINE: usize = 480;
const COARSE: usize = 8;

/// How many directions are counted.
const COUNT: u32 = 1 << 17;

/// What a lobe gives in all over the half sphere.
pub(super) struct Found {
    /// Its density.
    pub(super) spread: f64,
    /// What it shows, in the first channel: the directional albedo.
    pub(super) albedo: f64,
}

/// The origin of a surface with that normal, seen from `degrees` off the normal.
pub(super) fn seen(normal: DVec3, degrees: f64) -> ShadingPoint<f64> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let to_viewer = normal * cos + normal.any_orthonormal_vector() * sin;
    ShadingPoint { normal: normal.into(), to_viewer: to_viewer.into(), ..ShadingPoint::HEAD_ON }
}

/// Holds the directions that a lobe chooses against its density, cell by cell, and what they weigh against what it shows.
pub(super) fn check(lobe: &impl Scatter<f64>, at: &ShadingPoint<f64>) -> Found {
    let (cells, found) = quadrature(lobe, at);
    let (mut counted, mut weight) = (vec![0.0; COARSE * COARSE], 0.0);
    for i in 0..COUNT {
        // Roberts' sequence of two dimensions, by powers of the plastic number.
        let u =
            [0.754_877_666_246_693, 0.569_840_290_998_053].map(|step| (f64::from(i) * step + 0.5).fract());
        let sample = lobe.sample(at, u);
        if sample.lanes {
            hold_together(lobe, at, &sample);
            counted[cell_of(at, sample.direction.into())] += 1.0 / f64::from(COUNT);
            weight += lobe.evaluate(at, sample.direction, sample.cosine).x / sample.pdf / f64::from(COUNT);
        }
    }
    for (cell, (counted, expected)) in counted.iter().zip(&cells).enumerate() {
        assert!((counted - expected).abs() < 1e-3, "cell {cell}: {counted}, not {expected}");
    }
    assert!((weight - found.albedo).abs() < 2e-3 * found.albedo, "{weight}, not {}", found.albedo);
    found
}

fn hold_together(lobe: &impl Scatter<f64>, at: &ShadingPoint<f64>, sample: &Sample<f64>) {
    let direction = DVec3::from(sample.direction);
    assert!((direction.length() - 1.0).abs() < 1e-14, "{}", direction.length());
    assert!((direction.dot(at.normal.into()) - sample.cosine).abs() < 1e-14, "{}", sample.cosine);
    let pdf = lobe.pdf(at, sample.direction, sample.cosine);
    assert!((pdf - sample.pdf).abs() <= 1e-9 * pdf, "{} and {pdf}", sample.pdf);
}

/// The two directions across the normal that angles are counted from.
fn frame(at: &ShadingPoint<f64>) -> [DVec3; 3] {
    let normal = DVec3::from(at.normal);
    let (x, y) = normal.any_orthonormal_pair();
    [x, y, normal]
}

/// Which cell of equal angles a direction lies in.
fn cell_of(at: &ShadingPoint<f64>, direction: DVec3) -> usize {
    let [x, y, z] = frame(at).map(|axis| axis.dot(direction));
    let polar = z.clamp(0.0, 1.0).acos() / FRAC_PI_2;
    let azimuth = y.atan2(x).rem_euclid(2.0 * PI) / (2.0 * PI);
    let [ring, sector] = [polar, azimuth].map(|part| ((part * COARSE as f64) as usize).min(COARSE - 1));
    ring * COARSE + sector
}

/// The density's integral over each cell, and the integrals over all, by the midpoint rule.
fn quadrature(lobe: &impl Scatter<f64>, at: &ShadingPoint<f64>) -> (Vec<f64>, Found) {
    let [x, y, normal] = frame(at);
    let mut cells = vec![0.0; COARSE * COARSE];
    let mut found = Found { spread: 0.0, albedo: 0.0 };
    let middle = |i: usize, whole: f64| (i as f64 + 0.5) / FINE as f64 * whole;
    for (ring, sector) in (0..FINE).flat_map(|ring| (0..FINE).map(move |sector| (ring, sector))) {
        let (sin, cos) = middle(ring, FRAC_PI_2).sin_cos();
        let (across, along) = middle(sector, 2.0 * PI).sin_cos();
        let direction = Triple::from((x * along + y * across) * sin + normal * cos);
        let solid_angle = sin * (FRAC_PI_2 / FINE as f64) * (2.0 * PI / FINE as f64);
        let share = lobe.pdf(at, direction, cos) * solid_angle;
        cells[ring * COARSE / FINE * COARSE + sector * COARSE / FINE] += share;
        found.spread += share;
        found.albedo += lobe.evaluate(at, direction, cos).x * solid_angle;
    }
    (cells, found)
}
