//! Does every kind of part describe itself truly: are its values what it was made from, and does it refuse by name
//! what is none of them?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

#[allow(dead_code, reason = "the tests of shapes use the rest")]
mod samples;

use std::f64::consts::PI;
use std::fmt::Debug;
use std::sync::Arc;

use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::light::Pole;
use catoptra_core::{
    Camera, Field, FieldKind, Finish, Image, ImageSource, IntensityProfile, InvalidPart, Kind, Light,
    Material, Part, Placement, ProfileSource, Rgb, Rows, Settings, Shape, Texture, TextureId, TextureUse,
    Value, Values,
};
use samples::samples_of;

/// A value that a field of this kind takes, where no other field has a say; the `i`-th field's own.
fn plain(kind: FieldKind, i: usize) -> Value {
    let n = i as f64;
    match kind {
        FieldKind::Number | FieldKind::Length => Value::Number(0.5 + n),
        FieldKind::Count => Value::Number(3.0 + n),
        FieldKind::Fraction => Value::Number(0.25),
        FieldKind::Angle => Value::Number(0.3 + 0.1 * n),
        FieldKind::Point => Value::Vector(DVec3::new(n, -2.0, 1.0 / 3.0)),
        FieldKind::Direction => Value::Vector(DVec3::new(1.0, -0.1 - n, 3.0)),
        FieldKind::Color => Value::Color(Rgb::new(0.1, 1.0 / 3.0, 0.0)),
        FieldKind::Quantity => Value::Color(Rgb::new(0.0, 1.0 / 3.0, 4000.0)),
        FieldKind::Flag => Value::Flag(false),
        FieldKind::Choice(words) => Value::Word(words[words.len() - 1].to_owned()),
        FieldKind::Mesh => unreachable!("meshes have samples"),
        FieldKind::Profile => profile(),
        FieldKind::Pair => Value::Pair(DVec2::new(100.5 + n, 1000.0)),
        FieldKind::Image => image(),
        FieldKind::Texture => Value::Texture(texture()),
        FieldKind::Rows(_) => unreachable!("shapes with rows have samples"),
    }
}

/// A picture of two pixels.
fn image() -> Value {
    let image = Image::from_bytes([2, 1], 1, vec![0, 255]).unwrap();
    Value::Image(ImageSource { path: "a.png".into(), image: Arc::new(image) })
}

fn texture() -> TextureId {
    TextureId::from_index(7).unwrap()
}

/// A lamp that shines downwards alike.
fn profile() -> Value {
    let profile = IntensityProfile::new(Pole::Nadir, vec![0.0, 90.0], vec![0.0], vec![5.0; 2]).unwrap();
    Value::Profile(ProfileSource { path: "lamp.ies".into(), profile: Arc::new(profile) })
}

/// Good values for every field of a kind.
fn good<T>(kind: &Kind<T>) -> Values {
    if let Some(sample) = samples_of(kind.name).into_iter().next_back() {
        return sample.shape.values();
    }
    // Of radiance and power a light takes one.
    let taken = |field: &Field| field.default.is_some() || !field.may_be_missing || field.name == "radiance";
    let fields = kind.fields.iter().enumerate().filter(|(_, field)| taken(field));
    // A surface light has the fields of its shape.
    let surface =
        kind.name.strip_suffix("-light").map(samples_of).and_then(|samples| samples.into_iter().next_back());
    let of_surface = surface.map(|sample| sample.shape.values()).unwrap_or_default();
    fields.fold(Values::new(), |values, (i, field)| {
        let value = of_surface.get(field.name).cloned().unwrap_or_else(|| plain(field.kind, i));
        values.with(field.name, value)
    })
}

fn camera() -> Values {
    Camera::look_at(DVec3::new(1.0, 2.0, 1.0 / 3.0), DVec3::X, DVec3::new(0.1, 1.0, 0.0), 0.7)
        .unwrap()
        .values()
}

fn looking() -> Values {
    Camera::looking(DVec3::ONE, DVec3::new(1.0, 2.0, 3.0), DVec3::Y, 2.0).unwrap().values()
}

/// What no field of this kind takes.
fn bad(kind: FieldKind) -> Vec<Value> {
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    let vectors = (0..3).flat_map(|axis| {
        bad.map(|bad| {
            let mut v = DVec3::ONE;
            v[axis] = bad;
            v
        })
    });
    let colors: Vec<Value> = vectors.clone().map(|v| Value::Color(Rgb::new(v.x, v.y, v.z))).collect();
    let vectors: Vec<Value> = vectors.map(Value::Vector).collect();
    let and = |values: Vec<Value>, more: &[f64]| {
        [values, more.iter().map(|&n| Value::Number(n)).collect()].concat()
    };
    let numbers: Vec<Value> = bad.into_iter().map(Value::Number).collect();
    let negative = Value::Color(Rgb::new(0.5, -1e-9, 0.5));
    match kind {
        FieldKind::Number | FieldKind::Angle => numbers,
        FieldKind::Length => and(numbers, &[0.0, -0.0, -1.0]),
        FieldKind::Count => and(numbers, &[-1.0, 0.5]),
        FieldKind::Fraction => and(numbers, &[-1e-9, 1.000_001]),
        FieldKind::Point => vectors,
        FieldKind::Direction => {
            [vectors, vec![Value::Vector(DVec3::ZERO), Value::Vector(-DVec3::ZERO)]].concat()
        }
        FieldKind::Color => [colors, vec![negative, Value::Color(Rgb::new(0.0, 0.0, 1.000_001))]].concat(),
        FieldKind::Quantity => [colors, vec![negative]].concat(),
        FieldKind::Pair => {
            bad.into_iter().flat_map(|v| [DVec2::new(v, 1.0), DVec2::new(1.0, v)]).map(Value::Pair).collect()
        }
        FieldKind::Flag | FieldKind::Mesh | FieldKind::Profile | FieldKind::Image | FieldKind::Texture => {
            Vec::new()
        }
        FieldKind::Rows(width) => {
            let row = |bad: f64| vec![bad; width];
            let wider = Rows::default().with(&row(1.0)).with(&row(0.5));
            let wider =
                wider.iter().map(|row| [row, &[0.0]].concat()).fold(Rows::default(), |r, row| r.with(&row));
            let bad = bad.into_iter().map(|bad| Value::Rows(Rows::default().with(&row(0.0)).with(&row(bad))));
            bad.chain([Value::Rows(wider), Value::Rows(Rows::default())]).collect()
        }
        FieldKind::Choice(_) => vec![Value::Word(String::new()), Value::Word("no such word".into())],
    }
}

/// Values of every sort but the one that the field takes.
fn of_other_sorts(kind: FieldKind) -> Vec<Value> {
    let all = [
        Value::Number(0.5),
        Value::Vector(DVec3::ONE),
        Value::Color(Rgb::grey(0.5)),
        Value::Flag(true),
        Value::Word("word".into()),
        samples_of("mesh")[0].shape.values().get("file").unwrap().clone(),
        profile(),
        Value::Pair(DVec2::ONE),
        image(),
        Value::Texture(texture()),
        Value::Rows(Rows::default().with(&[1.0])),
    ];
    let own = match kind {
        FieldKind::Number | FieldKind::Length | FieldKind::Count | FieldKind::Fraction | FieldKind::Angle => {
            0
        }
        FieldKind::Point | FieldKind::Direction => 1,
        FieldKind::Color | FieldKind::Quantity => 2,
        FieldKind::Flag => 3,
        FieldKind::Choice(_) => 4,
        FieldKind::Mesh => 5,
        FieldKind::Profile => 6,
        FieldKind::Pair => 7,
        FieldKind::Image => 8,
        FieldKind::Texture => 9,
        FieldKind::Rows(_) => 10,
    };
    all.into_iter().enumerate().filter(|(sort, _)| *sort != own).map(|(_, value)| value).collect()
}

fn without(values: &Values, field: &str) -> Values {
    values
        .iter()
        .filter(|(name, _)| *name != field)
        .fold(Values::new(), |kept, (n, v)| kept.with(n, v.clone()))
}

fn refused_by_name(error: &InvalidPart, field: &Field, kind: &str, why: &dyn Debug) {
    assert_eq!(error.field(), field.name, "{kind} with {} {why:?}: {error}", field.name);
    let message = error.to_string();
    assert!(message.starts_with(&format!("{} must ", field.name)), "{kind}: {message}");
    assert!(message.contains(", not "), "{kind}: {message}");
}

/// Everything that a description promises, for one kind.
fn check<T: Debug + PartialEq>(kind: &Kind<T>, good: &Values, values: impl Fn(&T) -> Values) {
    let part = (kind.make)(good).unwrap_or_else(|error| panic!("{}: {error}", kind.name));
    for (name, value) in good.iter() {
        assert_eq!(values(&part).get(name), Some(value), "{} keeps {name} as it was given", kind.name);
    }
    assert_eq!((kind.make)(&values(&part)).unwrap(), part, "{}", kind.name);
    let order: Vec<_> =
        kind.fields.iter().map(|f| f.name).filter(|n| values(&part).get(n).is_some()).collect();
    assert_eq!(values(&part).iter().map(|(name, _)| name).collect::<Vec<_>>(), order, "{}", kind.name);
    for field in kind.fields.iter().filter(|field| good.get(field.name).is_some()) {
        for value in bad(field.kind).into_iter().chain(of_other_sorts(field.kind)) {
            match (kind.make)(&good.clone().with(field.name, value.clone())) {
                Err(error) => refused_by_name(&error, field, kind.name, &value),
                Ok(part) => panic!("{} takes {value:?} for {}: {part:?}", kind.name, field.name),
            }
        }
        match ((kind.make)(&without(good, field.name)), field.default) {
            // One of several, of which one is enough: the error may name another.
            (outcome, None) if field.may_be_missing => assert!(outcome.is_err(), "{}", kind.name),
            (Err(error), None) => refused_by_name(&error, field, kind.name, &"missing"),
            (Ok(_), None) => panic!("{} goes without {}", kind.name, field.name),
            (part, Some(default)) => {
                let part = part.unwrap_or_else(|error| panic!("{} by default: {error}", kind.name));
                assert_eq!(values(&part).get(field.name), Some(&default()), "{} {}", kind.name, field.name);
            }
        }
    }
}

fn check_words<T>(kinds: &[Kind<T>]) {
    for (i, kind) in kinds.iter().enumerate() {
        assert!(!kind.name.is_empty() && kind.doc.ends_with('.'), "{}", kind.name);
        assert!(kinds[..i].iter().all(|other| other.name != kind.name), "two kinds are called {}", kind.name);
        for (i, field) in kind.fields.iter().enumerate() {
            assert!(field.doc.ends_with('.'), "{} {}", kind.name, field.name);
            assert!(kind.fields[..i].iter().all(|other| other.name != field.name));
            assert_eq!(kind.field(field.name).map(|f| f.doc), Some(field.doc));
        }
    }
}

#[test]
fn every_shape_describes_itself() {
    check_words(Shape::KINDS);
    for kind in Shape::KINDS {
        check(kind, &good(kind), Shape::values);
    }
}

#[test]
fn every_material_describes_itself() {
    check_words(Material::KINDS);
    for kind in Material::KINDS {
        check(kind, &good(kind), Material::values);
    }
}

#[test]
fn every_texture_describes_itself() {
    check_words(Texture::KINDS);
    for kind in Texture::KINDS {
        check(kind, &good(kind), Texture::values);
    }
}

/// A field that may be painted gives back its texture, and takes no channel if it is a colour; no other field takes a
/// texture, nor does any of a texture.
#[test]
fn colours_and_fractions_of_materials_take_textures() {
    let by = TextureUse::of(texture());
    let red = TextureUse { channel: Some(catoptra_core::texture::Channel::Red), ..by };
    for kind in Material::KINDS {
        let good = good(kind);
        for field in kind.fields {
            let Some(value) = good.get(field.name) else { continue };
            let [painted, channel] =
                [by, red].map(|by| good.clone().with(field.name, value.clone().textured(by)));
            if !field.kind.is_paintable() {
                refused_by_name(&(kind.make)(&painted).unwrap_err(), field, kind.name, value);
                continue;
            }
            let material = (kind.make)(&painted).unwrap_or_else(|error| panic!("{}: {error}", kind.name));
            assert_eq!(material.values(), painted, "{}", kind.name);
            assert!(material.is_textured(), "{} {}", kind.name, field.name);
            assert_eq!((kind.make)(&channel).is_ok(), field.kind == FieldKind::Fraction, "{}", kind.name);
        }
        assert!(!(kind.make)(&good).unwrap().is_textured(), "{}", kind.name);
    }
    for kind in Texture::KINDS {
        for (field, value) in kind.fields.iter().filter_map(|f| Some((f, good(kind).get(f.name)?.clone()))) {
            let painted = good(kind).with(field.name, value.clone().textured(by));
            refused_by_name(&(kind.make)(&painted).unwrap_err(), field, kind.name, &value);
        }
    }
}

#[test]
fn no_material_has_a_field_of_finishes() {
    for kind in Material::KINDS {
        for field in Finish::KIND.fields {
            assert!(kind.field(field.name).is_none(), "{} {}", kind.name, field.name);
        }
    }
}

#[test]
fn finishes_describe_themselves() {
    check_words(&[Finish::KIND]);
    let kind = Finish::KIND;
    let fields = kind.fields.iter().enumerate();
    let all = fields.fold(Values::new(), |all, (i, field)| all.with(field.name, plain(field.kind, i)));
    let finish = (kind.make)(&all).unwrap();
    assert_eq!(finish.values(), all);
    for field in kind.fields {
        for value in bad(field.kind).into_iter().chain(of_other_sorts(field.kind)) {
            let error = (kind.make)(&all.clone().with(field.name, value.clone())).unwrap_err();
            refused_by_name(&error, field, kind.name, &value);
        }
    }
    assert_eq!((kind.make)(&Values::new()).unwrap(), Finish::default());
    assert!(Finish::default().is_plain() && !finish.is_plain());
    let alone = (kind.make)(&Values::new().with("normal-strength", Value::Number(2.0))).unwrap_err();
    assert_eq!(alone.field(), "normal-strength");
}

#[test]
fn every_light_describes_itself() {
    check_words(Light::KINDS);
    for kind in Light::KINDS {
        check(kind, &good(kind), Light::values);
    }
}

#[test]
fn lights_with_a_profile_describe_themselves() {
    for name in ["point-light", "spot-light"] {
        let kind = Light::kind_named(name).unwrap();
        let fields = kind.fields.iter().enumerate();
        let all = fields.fold(Values::new(), |all, (i, field)| all.with(field.name, plain(field.kind, i)));
        let light = (kind.make)(&all).unwrap();
        assert_eq!(light.values(), all);
        for field in kind.fields {
            for value in bad(field.kind).into_iter().chain(of_other_sorts(field.kind)) {
                let error = (kind.make)(&all.clone().with(field.name, value.clone())).unwrap_err();
                refused_by_name(&error, field, kind.name, &value);
            }
        }
    }
}

#[test]
fn cameras_and_settings_describe_themselves() {
    check_words(std::slice::from_ref(Camera::KIND));
    check(Camera::KIND, &camera(), Part::values);
    check(Camera::KIND, &looking(), Part::values);
    check_words(std::slice::from_ref(Settings::KIND));
    check(Settings::KIND, &good(Settings::KIND), Settings::values);
}

#[test]
fn numbers_beyond_single_precision_are_refused() {
    let shape = |kind: &str, field, value| {
        let kind = Shape::kind_named(kind).unwrap();
        (kind.make)(&good(kind).with(field, value)).map_err(|error| error.to_string())
    };
    let light = |value| {
        let kind = Light::kind_named("point-light").unwrap();
        (kind.make)(&good(kind).with("intensity", value)).map_err(|error| error.to_string())
    };
    let (largest, beyond) = (f64::from(f32::MAX), f64::from(f32::MAX).next_up());
    assert!(shape("sphere", "radius", Value::Number(largest)).is_ok());
    assert!(shape("sphere", "center", Value::Vector(DVec3::Z * -largest)).is_ok());
    assert!(light(Value::Color(Rgb::new(0.0, largest, 1.0))).is_ok());
    let refused = [
        shape("sphere", "radius", Value::Number(beyond)).unwrap_err(),
        shape("sphere", "center", Value::Vector(DVec3::Z * -beyond)).unwrap_err(),
        shape("plane", "normal", Value::Vector(DVec3::X * 1e300)).unwrap_err(),
        light(Value::Color(Rgb::new(0.0, beyond, 1.0))).unwrap_err(),
    ];
    for message in refused {
        assert!(message.contains("must be at most 3.4e38 in magnitude, not "), "{message}");
    }
}

#[test]
fn values_of_a_plane_are_those_it_was_given() {
    let values = Values::new()
        .with("point", Value::Vector(DVec3::ONE))
        .with("normal", Value::Vector(DVec3::new(1.0, 2.0, 3.0)));
    assert_eq!((Shape::kind_named("plane").unwrap().make)(&values).unwrap().values(), values);
}

#[test]
fn one_changed_value_changes_that_value_alone() {
    let light = (Light::kind_named("point-light").unwrap().make)(&good(&Light::KINDS[1])).unwrap();
    let moved = light.with("position", Value::Vector(DVec3::ONE)).unwrap();
    assert_eq!(moved.values(), light.values().with("position", Value::Vector(DVec3::ONE)));
    assert_eq!(light.with("radius", Value::Number(1.0)).unwrap_err().field(), "radius");
    assert_eq!(light.with("intensity", Value::Number(1.0)).unwrap_err().field(), "intensity");
}

#[test]
fn radiance_and_power_take_each_others_place() {
    let grown = Placement::IDENTITY.scaled(3.0).unwrap();
    for name in ["rectangle-light", "disk-light", "sphere-light"] {
        let kind = Light::kind_named(name).unwrap();
        for two_sided in [false, true] {
            let given = good(kind);
            let sided =
                given.get("two-sided").map(|_| given.clone().with("two-sided", Value::Flag(two_sided)));
            let given = sided.unwrap_or(given);
            let light = (kind.make)(&given).unwrap();
            let placed = light.placed(&grown);
            let power = placed.equivalent("power").unwrap();
            let by_power = light.with("power", power.clone()).unwrap();
            assert_eq!(by_power.values().get("power"), Some(&power));
            assert_eq!(by_power.values().get("radiance"), None);
            // The same light, and where it stands, not as it would be unscaled.
            let shines = |light: &Light| light.placed(&grown).lamp().unwrap().emission.radiance.to_array();
            for (a, b) in shines(&by_power).into_iter().zip(shines(&light)) {
                assert!((a - b).abs() <= 1e-15 * b, "{name}: {a} became {b}");
            }
            let radiance = by_power.placed(&grown).equivalent("radiance").unwrap();
            let back = by_power.with("radiance", radiance).unwrap();
            assert_eq!(back.values().get("power"), None);
            assert_eq!(
                back.placed(&grown).equivalent("radiance"),
                by_power.placed(&grown).equivalent("radiance")
            );
            assert_eq!(light.equivalent("shadow"), None);
        }
    }
}

#[test]
fn the_power_of_a_lamp_is_its_radiance_over_all_ways_that_it_shines() {
    let part = |name: &str, given: &[(&'static str, Value)]| {
        let values = given.iter().fold(Values::new(), |all, (name, value)| all.with(name, value.clone()));
        (Light::kind_named(name).unwrap().make)(&values).unwrap()
    };
    let power = |light: &Light| light.equivalent("power");
    let radiance = ("radiance", Value::Color(Rgb::grey(2.0)));
    let disk = part("disk-light", &[("radius", Value::Number(3.0)), radiance.clone()]);
    assert_eq!(power(&disk), Some(Value::Color(Rgb::grey(2.0 * PI * (PI * 9.0)))));
    let ball = part("sphere-light", &[("radius", Value::Number(3.0)), radiance.clone()]);
    assert_eq!(power(&ball), Some(Value::Color(Rgb::grey(2.0 * PI * (4.0 * PI * 9.0)))));
    let edges = [("corner", DVec3::ONE), ("edge-u", 2.0 * DVec3::X), ("edge-v", 0.5 * DVec3::Z)];
    let mut given = edges.map(|(name, v)| (name, Value::Vector(v))).to_vec();
    given.extend([radiance, ("two-sided", Value::Flag(true))]);
    assert_eq!(power(&part("rectangle-light", &given)), Some(Value::Color(Rgb::grey(2.0 * PI * 2.0))));
}

/// Why a kind of shape refuses vectors for its fields, in order.
fn refusal(kind: &str, vectors: &[[f64; 3]]) -> &'static str {
    let kind = Shape::kind_named(kind).unwrap();
    let values = kind
        .fields
        .iter()
        .zip(vectors)
        .fold(Values::new(), |values, (field, &v)| values.with(field.name, Value::Vector(v.into())));
    match (kind.make)(&values) {
        Err(error) => error.field(),
        Ok(shape) => panic!("made {shape:?}"),
    }
}

#[test]
fn shapes_without_area_or_volume_are_refused() {
    let (o, x, y) = ([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    assert_eq!(refusal("triangle", &[o, o, x]), "c");
    assert_eq!(refusal("triangle", &[x, x, x]), "c");
    assert_eq!(refusal("triangle", &[o, x, [2.0, 0.0, 0.0]]), "c");
    assert_eq!(refusal("tetrahedron", &[o, x, [2.0, 0.0, 0.0], y]), "c");
    assert_eq!(refusal("tetrahedron", &[o, x, y, [0.3, 0.4, 0.0]]), "d");
    assert_eq!(refusal("tetrahedron", &[o, x, y, o]), "d");
    assert_eq!(refusal("rectangle", &[o, x, x]), "edge-v");
    assert_eq!(refusal("rectangle", &[o, x, [1e-6, 1.0, 0.0]]), "edge-v");
    assert_eq!(refusal("box", &[o, [1.0, -1.0, 1.0]]), "max");
    assert_eq!(refusal("plane", &[o, [1e-200, 0.0, 0.0]]), "normal");
}

#[test]
fn corners_on_one_line_or_in_one_plane_but_for_rounding_are_refused() {
    for k in [3.0, 7.0, 1.1, 1e-3, 1e9] {
        let (a, b) = ([0.1, 0.2, 0.3], [0.1 + 0.1 * k, 0.2 + 0.7 * k, 0.3 - 0.3 * k]);
        let c = [0.1 + 0.13 * k, 0.2 + 0.91 * k, 0.3 - 0.39 * k];
        assert_eq!(refusal("triangle", &[a, b, c]), "c", "{k}");
        let away = [5.0 * k, k, 2.0 * k];
        assert_eq!(refusal("tetrahedron", &[a, b, c, away]), "c", "{k}");
        let in_plane = |u: f64, v: f64| {
            let (a, b, away) = (DVec3::from(a), DVec3::from(b), DVec3::from(away));
            (a + (b - a) * u + (away - a) * v).to_array()
        };
        assert_eq!(refusal("tetrahedron", &[a, b, away, in_plane(0.3, 0.7)]), "d", "{k}");
        assert_eq!(refusal("tetrahedron", &[a, b, away, in_plane(-2.1, 1.3)]), "d", "{k}");
    }
}

#[test]
fn thin_shapes_of_any_size_are_taken() {
    for size in [1e-6, 1.0, 1e6] {
        let make = |kind: &str, vectors: &[DVec3]| {
            let kind = Shape::kind_named(kind).unwrap();
            let values =
                kind.fields.iter().zip(vectors).fold(Values::new(), |values, (field, v)| {
                    values.with(field.name, Value::Vector(*v * size))
                });
            (kind.make)(&values).unwrap_or_else(|error| panic!("{} of {size} m: {error}", kind.name))
        };
        let thin = [DVec3::ONE, DVec3::new(2.0, 1.0, 1.0), DVec3::new(1.5, 1.0 + 1e-9, 1.0)];
        make("triangle", &thin);
        make("tetrahedron", &[thin[0], thin[1], DVec3::new(1.0, 2.0, 1.0), DVec3::new(1.2, 1.2, 1.0 + 1e-9)]);
        make("box", &[DVec3::ONE, DVec3::new(2.0, 2.0, 1.0 + 1e-9)]);
    }
}

#[test]
fn cones_that_are_none_are_refused() {
    let kind = Light::kind_named("spot-light").unwrap();
    let refused = |inner: f64, outer: f64, falloff: f64| {
        let values = good(kind).with("inner", Value::Number(inner)).with("outer", Value::Number(outer));
        (kind.make)(&values.with("falloff", Value::Number(falloff))).unwrap_err().to_string()
    };
    let message = refused(0.5, 0.4, 1.0);
    assert!(message.starts_with("outer must not be under inner"), "{message}");
    assert!(refused(-0.1, 0.4, 1.0).starts_with("inner must"));
    assert!(refused(0.0, 0.0, 1.0).starts_with("outer must"));
    assert!(refused(0.1, 6.3, 1.0).starts_with("outer must"));
    assert!(refused(0.1, 0.2, -1.0).starts_with("falloff must"));
}

#[test]
fn views_that_are_none_are_refused() {
    let refused = |field, value| (Camera::KIND.make)(&camera().with(field, value)).unwrap_err().field();
    for fov in [0.0, -0.1, std::f64::consts::PI, 4.0] {
        assert_eq!(refused("fov", Value::Number(fov)), "fov", "{fov}");
    }
    assert_eq!(refused("direction", Value::Vector(DVec3::X)), "direction", "beside a target");
    let eye = DVec3::new(1.0, 2.0, 1.0 / 3.0);
    assert_eq!(refused("target", Value::Vector(eye)), "target", "where the eye is");
    assert_eq!(refused("up", Value::Vector(eye - DVec3::X)), "up", "along the view");
    assert_eq!(Camera::look_at(DVec3::NAN, eye, DVec3::Y, 1.0).unwrap_err().field(), "eye");
    assert_eq!(Camera::looking(eye, DVec3::ZERO, DVec3::Y, 1.0).unwrap_err().field(), "direction");
}
