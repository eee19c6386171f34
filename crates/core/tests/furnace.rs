//! Does every surface that absorbs nothing show 1 in an even surrounding of 1, at every angle and roughness?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use catoptra_core::glam::DVec3;
use catoptra_core::{Material, Rgb, ShadingPoint, SurfacePoint, Value, Values};

const ROUGHNESSES: [f64; 8] = [0.0, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 1.0];

fn seen_under(cosine: f64) -> SurfacePoint {
    let to_viewer = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
    SurfacePoint::flat(ShadingPoint { to_viewer: to_viewer.into(), ..ShadingPoint::HEAD_ON })
}

/// What is shown in an even surrounding of radiance 1.
fn shown(material: &Material, at: &SurfacePoint) -> Rgb {
    const COUNT: u32 = 1 << 14;
    let bsdf = material.bsdf(at);
    let sum = (0..COUNT).fold(Rgb::BLACK, |sum, k| {
        // Roberts' sequence of three dimensions.
        let [choose, u, v] = [0.819_172_513_396_164_5, 0.671_043_606_703_789_3, 0.549_700_477_901_970_1]
            .map(|step| (f64::from(k) * step + 0.5).fract());
        bsdf.sample(choose, [u, v]).map_or(sum, |scattered| sum + scattered.weight)
    });
    sum / f64::from(COUNT)
}

fn check(kind: &str, given: &[(&'static str, Value)]) {
    let kind = Material::kind_named(kind).unwrap();
    for roughness in ROUGHNESSES {
        let values =
            given.iter().fold(Values::new(), |values, (name, value)| values.with(name, value.clone()));
        let material = (kind.make)(&values.with("roughness", Value::Number(roughness))).unwrap();
        for k in 0..16 {
            let cosine = (f64::from(k) + 0.5) / 16.0;
            for front in [true, false] {
                let mut at = seen_under(cosine);
                at.shading.front = front;
                let shown = shown(&material, &at);
                for channel in shown.to_array() {
                    if (channel - 1.0).abs() > 1e-3 {
                        eprintln!("{} r {roughness} µ {cosine} front {front}: {channel}", kind.name);
                        break;
                    }
                }
            }
        }
    }
}

#[test]
fn all() {
    let t = std::time::Instant::now();
    let white = || Value::Color(Rgb::WHITE);
    check("metal", &[("color", white())]);
    eprintln!("{:?}", t.elapsed());
    check("plastic", &[("color", white())]);
    eprintln!("{:?}", t.elapsed());
    check("rubber", &[("color", white())]);
    eprintln!("{:?}", t.elapsed());
    check("glass", &[]);
    eprintln!("{:?}", t.elapsed());
    check("glass", &[("thin", Value::Flag(true))]);
    eprintln!("{:?}", t.elapsed());
}
