//! How does a part become larger, and how does it stand elsewhere, by its own values? What is measured in metres grows, and
//! points move: a part that was placed would not tell that by its values, and could not be saved so.

use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{Field, FieldKind, Rows, Value, Values};

/// The unit of what grows.
const METRES: &str = "m";

/// Values of a part that is larger by a factor, about the origin.
pub(crate) fn scaled(fields: &[Field], values: &Values, factor: f64) -> Values {
    changed(fields, values, |field, value| match value {
        _ if field.unit != METRES => value.clone(),
        Value::Number(v) => Value::Number(v * factor),
        Value::Vector(v) => Value::Vector(tidy(*v * factor)),
        Value::Pair(v) => Value::Pair(DVec2::new(v.x * factor, v.y * factor)),
        Value::Rows(rows) => Value::Rows(each_row(rows, |row| row.iter().map(|v| v * factor).collect())),
        other => other.clone(),
    })
}

/// Values of a part that stands elsewhere.
pub(crate) fn moved(fields: &[Field], values: &Values, by: DVec3) -> Values {
    changed(fields, values, |field, value| match (field.kind, value) {
        (FieldKind::Point, Value::Vector(v)) => Value::Vector(tidy(*v + by)),
        (FieldKind::Rows(3), Value::Rows(rows)) => {
            let by = by.to_array();
            Value::Rows(each_row(rows, |row| row.iter().zip(by).map(|(v, by)| v + by).collect()))
        }
        _ => value.clone(),
    })
}

fn changed(fields: &[Field], values: &Values, change: impl Fn(&Field, &Value) -> Value) -> Values {
    values.iter().fold(Values::new(), |all, (name, value)| {
        let field = fields.iter().find(|field| field.name == name);
        all.with(name, field.map_or_else(|| value.clone(), |field| change(field, value)))
    })
}

fn each_row(rows: &Rows, change: impl Fn(&[f64]) -> Vec<f64>) -> Rows {
    rows.iter().fold(Rows::default(), |all, row| all.with(&change(row)))
}

/// Without the noise of the last digits.
fn tidy(v: DVec3) -> DVec3 {
    DVec3::from_array(v.to_array().map(|v| format!("{v:.9}").parse().unwrap_or(v) + 0.0))
}

#[cfg(test)]
mod tests {
    use catoptra_core::Shape;

    use super::*;
    use crate::making::starters;

    #[test]
    fn shapes_grow_and_move_by_their_values() {
        let by = DVec3::new(5.0, 1.0, 2.0);
        for kind in Shape::KINDS {
            let Some(shape) = starters::shape(kind.name) else { continue };
            let values = moved(kind.fields, &scaled(kind.fields, &shape.values(), 3.0), by);
            let other = (kind.make)(&values).unwrap();
            assert_eq!(other.values(), values, "{}", kind.name);
            let Some((was, is)) = shape.bounds().zip(other.bounds()) else { continue };
            assert!((is.min - (was.min * 3.0 + by)).length() < 1e-6, "{}: {was:?} {is:?}", kind.name);
            assert!((is.max - (was.max * 3.0 + by)).length() < 1e-6, "{}: {was:?} {is:?}", kind.name);
        }
    }
}
