//! Are painted values and materials at a point what they are multiplied to?

use crate::texture::{Channel, Level, Paint, Texel, Texture, TexturePoint, TextureSource, TextureUse};
use crate::{FieldKind, Material, Rgb, TextureId, Value, Values};

/// A source with one texel everywhere.
struct Everywhere(Texel);

impl TextureSource for Everywhere {
    fn texture(&self, _: TextureId) -> Option<&Texture> {
        None
    }

    fn texel(&self, _: TextureId, _: &TexturePoint) -> Texel {
        self.0
    }
}

#[test]
fn paint_multiplies_and_stays_a_reflectance() {
    let texel = Texel { color: Rgb::new(0.5, 3.0, 0.25), alpha: 0.75 };
    let (source, at) = (Everywhere(texel), TexturePoint::default());
    let by = TextureUse::of(TextureId::from_index(1).unwrap());
    let paint = Paint::new(Rgb::new(0.5, 0.5, 1.0), Some(by));
    assert_eq!(paint.at(&source, &at), Rgb::new(0.25, 1.0, 0.25));
    assert_eq!(paint.light_at(&source, &at), Rgb::new(0.25, 1.5, 0.25));
    assert_eq!(Paint::from(Rgb::grey(0.3)).at(&source, &at), Rgb::grey(0.3));
    let level = |channel| Level::new(0.5, Some(TextureUse { channel, ..by })).at(&source, &at);
    let all = [None, Some(Channel::Red), Some(Channel::Green), Some(Channel::Blue), Some(Channel::Alpha)];
    assert_eq!(all.map(level), [0.25, 0.25, 1.0, 0.125, 0.375]);
    assert_eq!(level(Some(Channel::Luminance)), (0.5 * texel.color.luminance()).min(1.0));
    struct Nowhere;
    impl TextureSource for Nowhere {
        fn texture(&self, _: TextureId) -> Option<&Texture> {
            None
        }
    }
    assert_eq!(paint.at(&Nowhere, &at), paint.rgb());
}

#[test]
fn a_resolved_material_is_the_one_that_was_never_textured() {
    let by = TextureUse::of(TextureId::from_index(1).unwrap());
    let (source, at) = (Everywhere(Texel::opaque(Rgb::grey(0.5))), TexturePoint::default());
    for kind in Material::KINDS {
        let plain = |grey: f64| {
            kind.fields.iter().fold(Values::new(), |values, field| match field.default {
                _ if field.kind.is_paintable() && field.kind == FieldKind::Fraction => {
                    values.with(field.name, Value::Number(grey))
                }
                _ if field.kind.is_paintable() => values.with(field.name, Value::Color(Rgb::grey(grey))),
                Some(default) => values.with(field.name, default()),
                None => values,
            })
        };
        let painted = plain(0.5).iter().fold(Values::new(), |values, (name, value)| {
            let is_paintable = kind.field(name).unwrap().kind.is_paintable();
            values.with(name, if is_paintable { value.clone().textured(by) } else { value.clone() })
        });
        let painted = (kind.make)(&painted).unwrap();
        let right = (kind.make)(&plain(0.25)).unwrap();
        assert_eq!(painted.resolved(&source, &at), right, "{}", kind.name);
        assert_eq!(right.resolved(&source, &at), right);
        assert_eq!(painted.lobe_kinds(), right.lobe_kinds());
        // Painted altogether mirroring or black, it may still have every lobe somewhere.
        let full = plain(1.0).iter().fold(Values::new(), |values, (name, value)| {
            let is_paintable = kind.field(name).unwrap().kind.is_paintable();
            values.with(name, if is_paintable { value.clone().textured(by) } else { value.clone() })
        });
        assert_eq!((kind.make)(&full).unwrap().lobe_kinds(), right.lobe_kinds(), "{}", kind.name);
    }
}

#[test]
fn light_of_its_own_under_a_texture_is_told_as_under_white() {
    let by = TextureUse::of(TextureId::from_index(1).unwrap());
    let light = Value::Color(Rgb::new(1.0, 2.0, 3.0));
    let mut shining = 0;
    for kind in Material::KINDS {
        let required = kind.fields.iter().filter(|field| !field.may_be_missing);
        let plain = required.fold(Values::new(), |values, field| values.with(field.name, light.clone()));
        let Some(emission) = kind.fields.iter().find(|field| field.kind == FieldKind::Quantity) else {
            continue;
        };
        let plain = (kind.make)(&plain.with(emission.name, light.clone())).unwrap();
        let painted = plain.with(emission.name, light.clone().textured(by)).unwrap();
        assert!(plain.emission().is_some_and(|shown| shown.radiance == Rgb::new(1.0, 2.0, 3.0)));
        assert_eq!(painted.emission(), plain.emission());
        assert!(painted.emission_is_textured() && !plain.emission_is_textured(), "{}", kind.name);
        for field in kind.fields.iter().filter(|field| field.kind == FieldKind::Fraction) {
            let rough = plain.with(field.name, Value::Number(0.5).textured(by)).unwrap();
            assert!(rough.is_textured() && !rough.emission_is_textured(), "{} {}", kind.name, field.name);
        }
        shining += 1;
    }
    assert_eq!(shining, 2);
}

#[test]
fn a_textured_metal_by_name_keeps_its_name() {
    let by = TextureUse::of(TextureId::from_index(1).unwrap());
    let (source, at) = (Everywhere(Texel::opaque(Rgb::grey(0.5))), TexturePoint::default());
    let gold = |roughness: Value| {
        let values = Values::new().with("preset", Value::Word("gold".to_owned()));
        (Material::kind_named("metal").unwrap().make)(&values.with("roughness", roughness)).unwrap()
    };
    let painted = gold(Value::Number(0.5).textured(by));
    assert_eq!(painted.resolved(&source, &at), gold(Value::Number(0.25)));
}
