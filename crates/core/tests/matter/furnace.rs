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
    let spread: f64 = sides.map(|side| over_side(side, 1e-6, |i| bsdf.evaluate(i).r)).iter().sum();
    delta + spread
}

fn check(kind: &str, given: &[(&'static str, Value)], (roughness, inside): (&'static str, bool)) {
    check_within(1e-3, kind, given, (roughness, inside));
}

fn check_within(
    most: f64,
    kind: &str,
    given: &[(&'static str, Value)],
    (roughness_field, inside): (&'static str, bool),
) {
    let mut worst: f64 = 0.0;
    for roughness in ROUGHNESSES {
        let given = [given, &[(roughness_field, number(roughness))]].concat();
        let material = material(kind, &given);
        for k in 0..16 {
            let cosine = (f64::from(k) + 0.5) / 16.0;
            let mut at = seen_under(cosine);
            at.shading.front = !inside;
            let peak = if roughness_field == "sheen-roughness" { Peak::Nowhere } else { Peak::Mirrored };
            let shown = shown(&material.bsdf(&at), &at, peak);
            if (shown - 1.0).abs() > most {
                eprintln!("{kind} {given:?}, cosine {cosine}: {shown}");
            }
            worst = worst.max((shown - 1.0).abs());
        }
    }
    assert!(worst <= most, "{kind} {given:?}: {worst}");
}

const FRONT: (&str, bool) = ("roughness", false);

#[test]
fn matte() {
    check("matte", &[("color", white())], FRONT);
}

#[test]
fn metal() {
    check("metal", &[("color", white())], FRONT);
}

#[test]
fn plastic() {
    check("plastic", &[("color", white())], FRONT);
    check("plastic", &[("color", white()), ("ior", number(1.8))], FRONT);
}

#[test]
fn rubber() {
    check("rubber", &[("color", white())], FRONT);
}

#[test]
fn glass_from_outside() {
    check("glass", &[], FRONT);
    check("glass", &[("ior", number(1.33))], FRONT);
    check("glass", &[("ior", number(2.42))], FRONT);
}

#[test]
fn glass_from_inside() {
    // The edge of total reflection limits what the table of rough boundaries can tell.
    check_within(3e-3, "glass", &[], ("roughness", true));
    check_within(3e-3, "glass", &[("ior", number(1.33))], ("roughness", true));
}

#[test]
fn thin_glass() {
    check("glass", &[("thin", Value::Flag(true))], FRONT);
}

#[test]
fn principled_bases() {
    for metallic in [0.0, 0.4, 1.0] {
        check("principled", &[("metallic", number(metallic))], FRONT);
    }
    for transmission in [0.5, 1.0] {
        check("principled", &[("transmission", number(transmission))], FRONT);
    }
}

#[test]
fn principled_layers() {
    let coat = [("coat", number(1.0)), ("coat-roughness", number(0.3))];
    let sheen = [("sheen", number(1.0))];
    check("principled", &coat, FRONT);
    check("principled", &coat[..1], ("coat-roughness", false));
    check("principled", &[&coat[..], &sheen, &[("metallic", number(1.0))]].concat(), FRONT);
    check("principled", &sheen, ("sheen-roughness", false));
    check("principled", &[("opacity", number(0.3)), ("transmission", number(0.5))], FRONT);
}

#[test]
fn stretched_facets_lose_and_gain_little() {
    // What they lose is known for facets alike in all directions only.
    for metallic in [0.0, 1.0] {
        let given = [("metallic", number(metallic)), ("anisotropy", number(0.5))];
        check_within(0.06, "principled", &given, FRONT);
    }
}
