//! What absorbs nothing shows 1 in an even surrounding of 1, at every angle and roughness.

use catoptra_core::glam::DVec3;
use catoptra_core::{Bsdf, SurfacePoint, Value};

use super::cubature::over_side;
use super::{material, number, seen_under, white};

const ROUGHNESSES: [f64; 8] = [0.0, 0.12, 0.25, 0.38, 0.5, 0.65, 0.8, 1.0];

/// Near which direction most is seen.
#[derive(Clone, Copy, PartialEq)]
enum Peak {
    Mirrored,
    Nowhere,
}

/// What is shown in an even surrounding of radiance 1, in the first channel: by integration of what is scattered over ranges of
/// directions, and by all choices of a lobe for what is not.
fn shown(bsdf: &Bsdf, at: &SurfacePoint, peak: Peak) -> f64 {
    const CHOICES: u32 = 5_000;
    let choices = (0..CHOICES).map(|k| (f64::from(k) + 0.5) / f64::from(CHOICES));
    let delta = choices.filter_map(|choose| bsdf.sample(choose, [0.3, 0.7])).filter(|s| s.is_delta);
    let delta = delta.map(|s| s.weight.r).sum::<f64>() / f64::from(CHOICES);
    if !bsdf.is_lit() {
        return delta;
    }
    let o = DVec3::from(at.shading.to_viewer);
    let through = bsdf.rays().into_iter().find(|ray| ray.is_transmitted);
    let through = through.map_or(-o, |ray| ray.direction);
    let reflected = match peak {
        Peak::Mirrored => DVec3::new(-o.x, -o.y, o.z),
        Peak::Nowhere => DVec3::Z,
    };
    let sides = [reflected, through];
    let spread: f64 = sides.map(|side| over_side(side, 5e-6, |i| bsdf.evaluate(i).r)).iter().sum();
    delta + spread
}

/// How closely to look.
struct Watch {
    /// The field that all roughnesses are given to.
    roughness: &'static str,
    inside: bool,
    /// Roughnesses from this one on.
    from: usize,
    /// Of roughnesses and angles every so many-th.
    step: usize,
    /// The most that may be lost or gained.
    most: f64,
}

const CLOSE: Watch = Watch { roughness: "roughness", inside: false, from: 0, step: 1, most: 1e-3 };
const COARSE: Watch = Watch { step: 3, ..CLOSE };

fn check(kind: &str, given: &[(&'static str, Value)], watch: &Watch) {
    let mut worst: f64 = 0.0;
    for roughness in ROUGHNESSES[watch.from..].iter().copied().step_by(watch.step) {
        let given = [given, &[(watch.roughness, number(roughness))]].concat();
        let material = material(kind, &given);
        for k in (0..16).step_by(watch.step) {
            let cosine = (f64::from(k) + 0.5) / 16.0;
            let mut at = seen_under(cosine);
            at.shading.front = !watch.inside;
            let peak = if watch.roughness == "sheen-roughness" { Peak::Nowhere } else { Peak::Mirrored };
            let shown = shown(&material.bsdf(&at), &at, peak);
            if (shown - 1.0).abs() > watch.most {
                eprintln!("{kind} {given:?}, cosine {cosine}: {shown}");
            }
            worst = worst.max((shown - 1.0).abs());
        }
    }
    assert!(worst <= watch.most, "{kind} {given:?}: {worst}");
}

#[test]
fn matte() {
    check("matte", &[("color", white())], &COARSE);
}

#[test]
fn metal() {
    check("metal", &[("color", white())], &CLOSE);
}

#[test]
fn plastic() {
    check("plastic", &[("color", white())], &CLOSE);
    check("plastic", &[("color", white()), ("ior", number(1.8))], &COARSE);
}

#[test]
fn rubber() {
    check("rubber", &[("color", white())], &CLOSE);
}

#[test]
fn glass_from_outside() {
    check("glass", &[], &CLOSE);
    check("glass", &[("ior", number(1.33))], &COARSE);
    check("glass", &[("ior", number(2.42))], &COARSE);
}

#[test]
fn glass_from_inside() {
    // The edge of total reflection limits what the table of rough boundaries can tell.
    let inside = Watch { inside: true, most: 3e-3, ..CLOSE };
    check("glass", &[], &inside);
    check("glass", &[("ior", number(1.33))], &Watch { step: 3, ..inside });
}

#[test]
fn thin_glass() {
    check("glass", &[("thin", Value::Flag(true))], &CLOSE);
}

#[test]
fn principled_bases() {
    check("principled", &[("metallic", number(0.0))], &CLOSE);
    check("principled", &[("metallic", number(1.0))], &CLOSE);
    check("principled", &[("transmission", number(1.0))], &CLOSE);
    check("principled", &[("metallic", number(0.4)), ("transmission", number(0.5))], &COARSE);
}

#[test]
fn principled_layers() {
    let coat = [("coat", number(1.0)), ("coat-roughness", number(0.3))];
    let sheen = [("sheen", number(1.0))];
    check("principled", &[&coat[..], &sheen].concat(), &CLOSE);
    check("principled", &coat[..1], &Watch { roughness: "coat-roughness", ..COARSE });
    check("principled", &[&coat[..], &sheen, &[("metallic", number(1.0))]].concat(), &COARSE);
    check("principled", &sheen, &Watch { roughness: "sheen-roughness", ..COARSE });
}

#[test]
fn stretched_facets() {
    // What they lose is computed by few points for each viewer. Facets that are smooth across make a line too fine to integrate.
    let watch = Watch { from: 1, most: 1e-2, ..COARSE };
    for (field, share) in [("metallic", 0.0), ("metallic", 1.0), ("transmission", 1.0)] {
        check("principled", &[(field, number(share)), ("anisotropy", number(0.5))], &watch);
    }
}
