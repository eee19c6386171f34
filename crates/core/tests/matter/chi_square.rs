//! Are directions drawn as densely as lobes say? Pearson's χ² test of counts in cells.

use std::f64::consts::TAU;

use catoptra_core::glam::DVec3;
use catoptra_core::lobe::local::LocalLobe;
use catoptra_core::lobe::{
    Boundary, BsdfLobe, Complement, Diffuse, Ggx, GgxReflection, Phong, PhongModel, PhongShape, RoughDiffuse,
    RoughInterface, Roughness, Sheen, SmoothInterface, ThinWall, fresnel::Fresnel,
};
use catoptra_core::{Rgb, Triple, Value};

use super::cubature::Patch;
use super::random::Random;
use super::{direction, material, number, seen_under};

const RINGS: usize = 20;
const SECTORS: usize = 24;
const COUNT: u32 = 40_000;

/// The chance of being wrong about any one of all tests together, shared out among them.
const SIGNIFICANCE: f64 = 0.01 / 100.0;

/// ln Γ (Lanczos' series as in *Numerical Recipes*, section 6.1).
fn ln_gamma(x: f64) -> f64 {
    const SERIES: [f64; 6] = [
        76.180_091_729_471_46,
        -86.505_320_329_416_77,
        24.014_098_240_830_91,
        -1.231_739_572_450_155,
        0.120_865_097_386_617_9e-2,
        -0.539_523_938_495_3e-5,
    ];
    let sum = (1..).zip(SERIES).fold(1.000_000_000_190_015, |sum, (k, c)| sum + c / (x + f64::from(k)));
    (x + 0.5) * (x + 5.5).ln() - (x + 5.5) + (2.506_628_274_631_000_5 * sum / x).ln()
}

/// How likely χ² of so many degrees of freedom is at least that: the upper incomplete gamma function, by its series or its
/// continued fraction (Lentz).
fn survival(chi2: f64, freedom: usize) -> f64 {
    let (a, x) = (freedom as f64 / 2.0, chi2 / 2.0);
    let scale = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum) = (1.0 / a, 1.0 / a);
        for k in 1..2000 {
            term *= x / (a + f64::from(k));
            sum += term;
        }
        return 1.0 - scale * sum;
    }
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (f64::MAX, 1.0 / b);
    let mut fraction = d;
    for k in 1..2000 {
        let an = -f64::from(k) * (f64::from(k) - a);
        b += 2.0;
        d = 1.0 / (an * d + b);
        c = b + an / c;
        fraction *= c * d;
    }
    scale * fraction
}

#[test]
fn the_test_knows_its_distribution() {
    // From tables: the values that χ² passes in one of twenty, and in one of a thousand cases.
    for (freedom, chi2, chance) in
        [(1, 3.841, 0.05), (10, 18.307, 0.05), (100, 124.342, 0.05), (50, 86.661, 0.001)]
    {
        assert!(
            (survival(chi2, freedom) / chance - 1.0).abs() < 1e-3,
            "{freedom}: {}",
            survival(chi2, freedom)
        );
    }
}

fn check(name: &str, sample: impl Fn(f64, [f64; 2]) -> Option<DVec3>, pdf: impl Fn(DVec3) -> f64) {
    let mut random = Random(7);
    let mut counted = vec![0.0; RINGS * SECTORS];
    for _ in 0..COUNT {
        if let Some(i) = sample(random.number(), [random.number(), random.number()]) {
            assert!((i.length() - 1.0).abs() < 1e-9, "{name}: {i}");
            let ring = ((i.z * 0.5 + 0.5) * RINGS as f64) as usize;
            let sector = (i.y.atan2(i.x).rem_euclid(TAU) / TAU * SECTORS as f64) as usize;
            counted[ring.min(RINGS - 1) * SECTORS + sector.min(SECTORS - 1)] += 1.0;
        }
    }
    let size = [2.0 / RINGS as f64, TAU / SECTORS as f64];
    let density = |z: f64, turn: f64| pdf(direction(z, turn));
    let expected = (0..RINGS * SECTORS).map(|cell| {
        let from = [(cell / SECTORS) as f64 * size[0] - 1.0, (cell % SECTORS) as f64 * size[1]];
        f64::from(COUNT) * Patch { from, size }.integral(2e-7, &density)
    });
    let (mut chi2, mut freedom, mut rest) = (0.0, 0, [0.0, 0.0]);
    let mut add = |expected: f64, counted: f64| {
        if expected > 0.0 {
            chi2 += (counted - expected) * (counted - expected) / expected;
            freedom += 1;
        }
    };
    let mut all = [0.0, 0.0];
    for (expected, counted) in expected.zip(&counted) {
        all = [all[0] + expected, all[1] + counted];
        if expected < 5.0 {
            rest = [rest[0] + expected, rest[1] + counted];
        } else {
            add(expected, *counted);
        }
    }
    // Cells where next to nothing is expected go together, and so do samples without a direction.
    assert!(rest[0] >= 1.0 || rest[1] < 10.0, "{name}: {rest:?}");
    if rest[0] >= 1.0 {
        add(rest[0], rest[1]);
    }
    let lost = [f64::from(COUNT) - all[0], f64::from(COUNT) - all[1]];
    assert!(
        lost[0] > -0.001 * f64::from(COUNT),
        "{name}: the density sums up to {}",
        all[0] / f64::from(COUNT)
    );
    if lost[0] >= 5.0 {
        add(lost[0], lost[1]);
    }
    let chance = survival(chi2, freedom - 1);
    assert!(chance > SIGNIFICANCE, "{name}: χ² = {chi2} of {freedom} cells, as likely as {chance}");
}

fn check_lobe(name: &str, lobe: impl Into<BsdfLobe>) {
    let lobe = lobe.into();
    for cosine in [1.0, 0.7, 0.2] {
        let o = direction(cosine, 0.4);
        let sample = |choose, u| lobe.sample(o, choose, u).filter(|s| s.delta.is_none()).map(|s| s.direction);
        check(&format!("{name} seen under {cosine}"), sample, |i| lobe.pdf(o, i));
    }
}

const GREY: Rgb = Rgb::new(0.8, 0.5, 0.2);

#[test]
fn diffuse() {
    check_lobe("diffuse", Diffuse { albedo: Triple::splat(0.5) });
    check_lobe("rough diffuse", RoughDiffuse::new(GREY, 0.8));
    check_lobe("sheen", Sheen::new(0.4));
}

#[test]
fn phong() {
    for model in [PhongModel::Classic, PhongModel::Normalised] {
        check_lobe("phong", Phong { specular: Triple::splat(0.5), shape: PhongShape::new(12.0, model) });
    }
}

#[test]
fn reflection() {
    let fresnel = Fresnel::metal(GREY, Rgb::WHITE);
    for (x, y) in [(0.1, 0.1), (0.5, 0.5), (1.0, 1.0), (0.5, 0.1), (0.15, 0.9)] {
        check_lobe(&format!("reflection {x} {y}"), GgxReflection { ggx: Ggx::new(x, y), fresnel });
    }
}

#[test]
fn interfaces() {
    for eta in [1.5, 1.0 / 1.5, 2.4] {
        for alpha in [0.15, 0.6] {
            let ggx = Ggx::new(alpha, 0.8 * alpha);
            let interface = RoughInterface { ggx, facet: SmoothInterface { eta, tint: GREY } };
            check_lobe(&format!("interface {eta} {alpha}"), interface);
            check_lobe(&format!("its complement {eta} {alpha}"), Complement::of_interface(&interface));
        }
    }
}

#[test]
fn walls_and_complements() {
    let wall = ThinWall { eta: 1.5, tint: GREY, facets: Some(Ggx::isotropic(0.3)) };
    check_lobe("wall", wall);
    let [reflected, through] = wall.mean_shares();
    check_lobe("complement of a wall", Complement::of_wall(Ggx::isotropic(0.3), reflected, through));
    let fresnel = Fresnel::metal(GREY, Rgb::WHITE);
    check_lobe("complement of metal", Complement::of_metal(Ggx::isotropic(0.5), fresnel));
    let boundary = Boundary::new(Roughness::new(0.4), Fresnel::clear(1.5));
    check_lobe("below", Complement::below(boundary, GREY));
}

#[test]
fn whole_surfaces() {
    let rich = [
        ("base-color", Value::Color(GREY)),
        ("metallic", number(0.3)),
        ("transmission", number(0.5)),
        ("coat", number(0.5)),
        ("coat-roughness", number(0.4)),
        ("sheen", number(0.5)),
        ("anisotropy", number(0.5)),
        ("anisotropy-rotation", number(0.5)),
    ];
    let color = [("color", Value::Color(GREY)), ("roughness", number(0.4))];
    let phong = [("diffuse", Value::Color(GREY)), ("reflectiveness", number(0.2))];
    let parts: [(&str, &[(&'static str, Value)]); 4] =
        [("principled", &rich), ("plastic", &color), ("rubber", &color), ("phong", &phong)];
    for (kind, given) in parts {
        let material = material(kind, given);
        for cosine in [0.9, 0.3] {
            for front in [true, false] {
                let mut at = seen_under(cosine);
                at.shading.front = front;
                let bsdf = material.bsdf(&at);
                let sample = |choose, u| bsdf.sample(choose, u).filter(|s| !s.is_delta).map(|s| s.direction);
                check(&format!("{kind} seen under {cosine}"), sample, |i| bsdf.pdf(i));
            }
        }
    }
}
