//! How does a material become one of another kind? It keeps what both kinds call by the same name.

use catoptra_core::{Field, FieldKind, InvalidPart, Kind, Material, Rgb, Value, Values};

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
