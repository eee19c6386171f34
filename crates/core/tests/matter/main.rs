//! Does matter do with light what physics says: keep it, send it both ways alike, bend and absorb it by the laws, and draw
//! directions as densely as it claims?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod chi_square;
mod closed_forms;
mod cubature;
mod furnace;
mod hostile;
mod random;
mod reciprocity;

use catoptra_core::glam::DVec3;
use catoptra_core::{Material, Rgb, ShadingPoint, SurfacePoint, Value, Values};

fn white() -> Value {
    Value::Color(Rgb::WHITE)
}

fn number(v: f64) -> Value {
    Value::Number(v)
}

fn material(kind: &str, given: &[(&'static str, Value)]) -> Material {
    let kind = Material::kind_named(kind).unwrap();
    let known = given.iter().filter(|(name, _)| kind.field(name).is_some());
    let values = known.fold(Values::new(), |values, (name, value)| values.with(name, value.clone()));
    (kind.make)(&values).unwrap()
}

/// The origin of a surface that faces up along z, seen from over the x axis.
fn seen_under(cosine: f64) -> SurfacePoint {
    let to_viewer = direction(cosine, 0.0);
    SurfacePoint::flat(ShadingPoint { to_viewer: to_viewer.into(), ..ShadingPoint::HEAD_ON })
}

/// A unit vector of that cosine to z, turned about it by so many radians.
fn direction(cosine: f64, turn: f64) -> DVec3 {
    let across = (1.0 - cosine * cosine).max(0.0).sqrt();
    DVec3::new(across * turn.cos(), across * turn.sin(), cosine)
}
