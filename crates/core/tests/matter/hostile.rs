//! Is there any surface, seen from anywhere, that answers with something that is no number?

use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{Bsdf, FieldKind, Kind, Material, Rgb, ShadingPoint, SurfacePoint, Value, Values};

use super::random::Random;

/// A share, often one of the ends.
fn share(random: &mut Random) -> f64 {
    let any = random.number();
    random.one_of(&[0.0, 1e-300, 1e-9, 0.009, 0.011, 0.5, 1.0 - 1e-12, 1.0, any, any, any])
}

fn value(random: &mut Random, kind: FieldKind) -> Value {
    let any = random.number();
    match kind {
        FieldKind::Number => Value::Number(random.one_of(&[
            1e-30,
            0.5,
            1.0,
            1.0 + 1e-9,
            1.00011,
            1.5,
            3.0,
            1e30,
            1.0 + 2.0 * any,
        ])),
        FieldKind::Length => Value::Number(random.one_of(&[1e-30, 1.0, 1e30])),
        FieldKind::Count => Value::Number(3.0),
        FieldKind::Fraction => Value::Number(share(random)),
        FieldKind::Angle => Value::Number(random.one_of(&[0.0, -1e6, any])),
        FieldKind::Color => Value::Color(Rgb::new(share(random), share(random), share(random))),
        FieldKind::Quantity => Value::Color(Rgb::new(0.0, any, 1e30)),
        FieldKind::Flag => Value::Flag(any < 0.5),
        FieldKind::Choice(words) => Value::Word(random.one_of(words).to_owned()),
        _ => unreachable!("no material has it"),
    }
}

fn made(random: &mut Random, kind: &Kind<Material>) -> Material {
    let values = kind.fields.iter().fold(Values::new(), |values, field| {
        let left_out = field.may_be_missing && (field.default.is_none() || random.number() < 0.3);
        if left_out { values } else { values.with(field.name, value(random, field.kind)) }
    });
    (kind.make)(&values).unwrap()
}

fn unit(random: &mut Random) -> DVec3 {
    let any = DVec3::from([(); 3].map(|()| 2.0 * random.number() - 1.0));
    let close = DVec3::new(1.0, 1e-9 * any.y, 1e-15 * any.z);
    random.one_of(&[any, any, close, DVec3::X, DVec3::Z]).normalize()
}

fn point(random: &mut Random) -> SurfacePoint {
    let (normal, viewer, geometric) = (unit(random), unit(random), unit(random));
    let geometric = random.one_of(&[normal, normal, geometric]);
    // The viewer's side as it should be, and as smooth normals sometimes have it.
    let side = |n: DVec3| if n.dot(viewer) < 0.0 { -n } else { n };
    let shading = ShadingPoint {
        normal: random.one_of(&[side(normal), side(normal), normal]).into(),
        to_viewer: viewer.into(),
        front: random.number() < 0.5,
        ..ShadingPoint::HEAD_ON
    };
    let tangent = unit(random) * random.one_of(&[0.0, 1e-300, 1.0, 1e30]);
    SurfacePoint {
        geometric: side(geometric),
        tangent: random.one_of(&[tangent, normal]),
        uv: DVec2::ZERO,
        outside_ior: random.one_of(&[1.0, 1.0, 1.0, 1.33, 1.5, 1e-30, 1e30]),
        shading,
    }
}

fn assert_sound(bsdf: &Bsdf, random: &mut Random, what: &dyn Fn() -> String) {
    let light = |rgb: Rgb, name: &str| {
        assert!(rgb.all(|v| v >= 0.0 && v.is_finite()), "{name} {rgb:?} of {}", what());
    };
    light(bsdf.ambient, "ambient");
    light(bsdf.diffuse(), "diffuse");
    let near_one = 1.0_f64.next_down();
    let number = |random: &mut Random| {
        let any = random.number();
        random.one_of(&[0.0, 1e-300, 0.25, 0.5, near_one, any, any])
    };
    let (choose, u) = (number(random), [number(random), number(random)]);
    if let Some(scattered) = bsdf.sample(choose, u) {
        light(scattered.weight, "weight");
        assert!((scattered.direction.length() - 1.0).abs() < 1e-6, "{} of {}", scattered.direction, what());
        let usable = scattered.pdf >= 0.0 && scattered.pdf.is_finite() && scattered.eta > 0.0;
        assert!(usable && scattered.is_delta == (scattered.pdf == 0.0), "{scattered:?} of {}", what());
    }
    for ray in bsdf.rays() {
        light(ray.weight, "ray");
        assert!((ray.direction.length() - 1.0).abs() < 1e-6, "{} of {}", ray.direction, what());
    }
    let direction = unit(random);
    light(bsdf.evaluate(direction), "value");
    light(bsdf.glossy(direction), "gloss");
    let pdf = bsdf.pdf(direction);
    assert!(pdf >= 0.0 && pdf.is_finite(), "pdf {pdf} of {}", what());
}

#[test]
fn every_answer_is_a_number() {
    let mut random = Random(11);
    for _ in 0..100_000 {
        let kind = random.one_of(Material::KINDS);
        let material = made(&mut random, &kind);
        let at = point(&mut random);
        let bsdf = material.bsdf(&at);
        assert_sound(&bsdf, &mut random, &|| format!("{material:?} at {at:?}"));
        if let Some(medium) = material.medium() {
            assert!(medium.ior > 0.0 && medium.absorption.all(|a| (0.0..=f64::MAX).contains(&a)));
        }
    }
}
