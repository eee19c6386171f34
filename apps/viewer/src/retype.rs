//! How does a part become one of another kind? It keeps what both kinds call by the same name; a shape or a light stays about
//! where it is, and as large.

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Field, FieldKind, InvalidPart, Kind, Light, Material, Rgb, Shape, Value, Values};

use crate::making::{sizing, starters};

/// The shape of that kind: as large as the old one and in its place, with those of its values that both kinds have.
///
/// # Errors
/// A kind that needs a file.
pub(crate) fn shape(old: &Shape, kind: &'static str) -> Result<Shape, InvalidPart> {
    let new = starters::shape(kind).ok_or(InvalidPart::new("kind", "must need no file", kind))?;
    let new = match (old.bounds(), new.bounds()) {
        (Some(to), Some(from)) => fitted(new.kind().fields, &new.values(), &from, &to)
            .and_then(|values| (new.kind().make)(&values).ok())
            .unwrap_or(new),
        _ => new,
    };
    Ok(keeping(new, &old.values(), Shape::values, |values| {
        Shape::kind_named(kind).and_then(|kind| (kind.make)(values).ok())
    }))
}

/// The light of that kind: in the place of the old one, with those of its values that both kinds have.
///
/// # Errors
/// A kind that needs a file.
pub(crate) fn light(old: &Light, kind: &'static str) -> Result<Light, InvalidPart> {
    let new = starters::light(kind).ok_or(InvalidPart::new("kind", "must need no file", kind))?;
    let surface = old.lamp().and_then(|lamp| lamp.shape.bounds());
    let at = surface.map(|bounds| bounds.centre()).or_else(|| old.position());
    let size = surface.map_or(1.0, |bounds| bounds.size().max_element());
    let size = if new.lamp().is_some() { size } else { 1.0 };
    let fields = new.kind().fields;
    let values = sizing::scaled(fields, &new.values(), size);
    let middle =
        new.lamp().and_then(|lamp| lamp.shape.bounds()).map_or(DVec3::ZERO, |bounds| bounds.centre());
    let by = at.map_or(DVec3::ZERO, |at| at - middle * size);
    let new = (new.kind().make)(&sizing::moved(fields, &values, by)).unwrap_or(new);
    Ok(keeping(new, &old.values(), Light::values, |values| {
        Light::kind_named(kind).and_then(|kind| (kind.make)(values).ok())
    }))
}

/// A part with the values of an old one that it has by the same names: all at once, or else those that it takes one after
/// the other.
fn keeping<T>(new: T, old: &Values, values: impl Fn(&T) -> Values, make: impl Fn(&Values) -> Option<T>) -> T {
    let own = values(&new);
    let common = || old.iter().filter(|(name, _)| own.get(name).is_some());
    let all = common().fold(own.clone(), |all, (name, value)| all.with(name, value.clone()));
    if let Some(part) = make(&all) {
        return part;
    }
    let mut part = new;
    for (name, value) in common() {
        if let Some(kept) = make(&values(&part).with(name, value.clone())) {
            part = kept;
        }
    }
    part
}

/// Values of a part in another place: what fills one box fills the other, as large in its largest side.
fn fitted(fields: &[Field], values: &Values, from: &Aabb, to: &Aabb) -> Option<Values> {
    let factor = to.size().max_element() / from.size().max_element();
    if !(factor.is_finite() && factor > 0.0) {
        return None;
    }
    let scaled = sizing::scaled(fields, values, factor);
    Some(sizing::moved(fields, &scaled, to.centre() - from.centre() * factor))
}

/// The material of that kind which keeps every value that the kind knows by name and accepts; without its texture, if it
/// accepts it only so. All else is as when left out; a colour that must be given is the first one of the old material, and a
/// mirror keeps no reflectiveness of 0, with which it would be black.
///
/// # Errors
/// A kind that cannot be made from usual values.
pub(crate) fn of_kind(material: &Material, kind: &Kind<Material>) -> Result<Material, InvalidPart> {
    let old = material.values();
    let required = kind.fields.iter().filter(|field| !field.may_be_missing);
    let mut values = Values::new();
    for field in required {
        if let Some(value) = usual(field, &old) {
            values.set(field.name, value);
        }
    }
    for field in kind.fields {
        let Some(kept) = old.get(field.name).filter(|kept| !blackens(kind, field, kept)) else { continue };
        let accepted = [kept.clone(), kept.clone().untextured()]
            .map(|value| values.clone().with(field.name, value))
            .into_iter()
            .find(|values| (kind.make)(values).is_ok());
        values = accepted.unwrap_or(values);
    }
    (kind.make)(&values)
}

/// Whether nothing would be seen of the new material but black.
fn blackens(kind: &Kind<Material>, field: &Field, value: &Value) -> bool {
    kind.name == "mirror" && field.name == "reflectiveness" && *value == Value::Number(0.0)
}

/// What a field is that must be given, if the old material has none of that name.
fn usual(field: &Field, old: &Values) -> Option<Value> {
    let color = || {
        let colors = old.iter().filter_map(|(_, value)| match value.clone().untextured() {
            Value::Color(c) if c.max_channel() <= 1.0 => Some(c),
            _ => None,
        });
        colors.into_iter().next().unwrap_or(Rgb::grey(0.5))
    };
    match field.kind {
        FieldKind::Color => Some(Value::Color(color())),
        FieldKind::Quantity => Some(Value::Color(Rgb::WHITE)),
        FieldKind::Number | FieldKind::Length | FieldKind::Count | FieldKind::Fraction => {
            Some(Value::Number(1.0))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::{TextureId, TextureUse};

    use super::*;

    fn made(kind: &str, values: &Values) -> Material {
        (Material::kind_named(kind).unwrap().make)(values).unwrap()
    }

    fn became(material: &Material, kind: &str) -> Material {
        of_kind(material, Material::kind_named(kind).unwrap()).unwrap()
    }

    #[test]
    fn every_kind_becomes_every_other_and_keeps_what_they_share() {
        for from in Material::KINDS {
            let usual = of_kind(&made("glass", &Values::new()), from).unwrap();
            for to in Material::KINDS {
                let new = became(&usual, to.name);
                assert_eq!(new.kind_name(), to.name);
                for (name, value) in new.values().iter() {
                    let is_kept = from.field(name).map(|f| f.kind) == to.field(name).map(|f| f.kind);
                    if let Some(old) = usual.values().get(name).filter(|_| is_kept) {
                        let blackens = blackens(to, to.field(name).unwrap(), old);
                        assert_eq!(value == old, !blackens, "{name} of {} as {}", from.name, to.name);
                    }
                }
            }
        }
    }

    #[test]
    fn every_shape_becomes_every_other_in_its_place() {
        let all = || Shape::KINDS.iter().filter_map(|kind| starters::shape(kind.name));
        for old in all() {
            let values = sizing::scaled(old.kind().fields, &old.values(), 3.0);
            let values = sizing::moved(old.kind().fields, &values, DVec3::new(5.0, 1.0, 2.0));
            let old = (old.kind().make)(&values).unwrap();
            for new in all() {
                let new = shape(&old, new.kind_name()).unwrap();
                assert_eq!(Some(&(new.kind().make)(&new.values()).unwrap()), Some(&new), "it can be saved");
                let Some((was, is)) = old.bounds().zip(new.bounds()) else { continue };
                let apart = was.centre().distance(is.centre());
                assert!(apart < was.size().max_element(), "{} as {}", old.kind_name(), new.kind_name());
            }
        }
    }

    #[test]
    fn a_light_keeps_its_place_and_what_both_kinds_have() {
        let spot = starters::light("spot-light").unwrap();
        let at = DVec3::new(1.0, 2.0, 3.0);
        let spot = spot.with("position", Value::Vector(at)).unwrap();
        for kind in Light::KINDS {
            let new = light(&spot, kind.name).unwrap();
            assert_eq!(new.kind_name(), kind.name);
            assert!(new.position().is_none_or(|position| position == at), "{}", kind.name);
            let lamp = new.lamp().and_then(|lamp| lamp.shape.bounds());
            assert!(lamp.is_none_or(|bounds| bounds.centre().distance(at) < 1e-9), "{}", kind.name);
        }
        let point = light(&spot, "point-light").unwrap();
        assert_eq!(point.values().get("intensity"), spot.values().get("intensity"));
    }

    #[test]
    fn a_texture_goes_along_where_it_is_taken() {
        let wood = TextureUse::of(TextureId::from_index(1).unwrap());
        let red = Value::Color(Rgb::new(0.6, 0.1, 0.1));
        let painted = made("matte", &Values::new().with("color", red.clone().textured(wood)));
        assert_eq!(became(&painted, "mirror").values().get("color"), Some(&red.clone().textured(wood)));
        let kept = became(&painted, "plastic").values().get("color").cloned().map(Value::untextured);
        assert_eq!(kept, Some(red));
    }

    #[test]
    fn a_color_that_must_be_given_is_the_first_of_the_old_material() {
        let green = Value::Color(Rgb::new(0.1, 0.6, 0.2));
        let old = made("principled", &Values::new().with("base-color", green.clone()));
        assert_eq!(became(&old, "matte").values().get("color"), Some(&green));
    }

    #[test]
    fn a_named_metal_stays_one_among_metals_only() {
        let gold = made("metal", &Values::new().with("preset", Value::Word("gold".to_owned())));
        assert_eq!(became(&gold, "metal"), gold);
        assert!(became(&gold, "plastic").values().get("preset").is_none());
    }
}
