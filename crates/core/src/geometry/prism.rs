//! The straight solid over a flat outline.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::Geometry;
use super::ears::{Fault, check, is_counter_clockwise, side, triangles};
use super::faceted::{Chart, Facet, Faceted};
use super::faceted_geometry::faceted_geometry;
use super::parametrization::level_axes;
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Part, Rows, Value, Values};

/// All that an outline sweeps over when it is moved along an axis. Facet 0 is the base, 1 the top, 2 and on the sides, from
/// each corner of the outline to the next.
#[derive(Debug, Clone, PartialEq)]
pub struct Prism {
    given: Arc<Source>,
    pub(super) solid: Faceted,
}

/// What it was made of, in its own space.
#[derive(Debug, PartialEq)]
struct Source {
    outline: Rows,
    height: f64,
    from: DVec3,
    axis: DVec3,
}

/// The most corners of an outline: with more of them a mesh does better.
const MOST_CORNERS: usize = 1000;

impl Prism {
    /// Over an outline in the plane through `from` across `axis` (any length), `height` metres along that. The outline's
    /// coordinates run to the right and upwards as texture coordinates of a plane do: of an upright prism along x and −z.
    ///
    /// # Errors
    /// Fewer than 3 or more than 1,000 corners, an outline that crosses or touches itself, numbers that are not finite, a
    /// height that is not positive.
    pub fn new(
        outline: impl IntoIterator<Item = DVec2>,
        height: f64,
        from: DVec3,
        axis: DVec3,
    ) -> Result<Self, InvalidPart> {
        let rows = Rows::of(outline.into_iter().map(|p| p.to_array()));
        let values = Values::new().with("point", Value::Rows(rows)).with("height", Value::Number(height));
        crate::part::make(&values.with("from", Value::Vector(from)).with("axis", Value::Vector(axis)))
    }

    /// Its corners and facets.
    #[must_use]
    pub fn solid(&self) -> &Faceted {
        &self.solid
    }
}

impl Part for Prism {
    const NAME: &'static str = "prism";
    const DOC: &'static str = "The straight solid over a flat outline.";
    const FIELDS: &'static [Field] = &[
        Field::required(
            "point",
            FieldKind::Rows(2),
            "m",
            "A corner of the outline, to the right and upwards: along x and −z where the axis is upright.",
        ),
        Field::required("height", FieldKind::Length, "m", "How far it reaches along the axis."),
        Field::required("from", FieldKind::Point, "m", "Where the outline's 0 0 lies.")
            .or(|| Value::Vector(DVec3::ZERO)),
        Field::required("axis", FieldKind::Direction, "", "Perpendicular to the outline.")
            .or(|| Value::Vector(DVec3::Y)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let rows = given.rows("point")?;
        let outline: Vec<DVec2> = rows.iter().map(DVec2::from_slice).collect();
        if !(3..=MOST_CORNERS).contains(&outline.len()) {
            let requirement = format!("must be given 3 to {MOST_CORNERS} times");
            return Err(InvalidPart::new("point", requirement, outline.len()));
        }
        check(&outline).map_err(|fault| refuse(&outline, fault))?;
        let (height, from, axis) =
            (given.positive("height")?, given.point("from")?, given.direction("axis")?);
        let solid = solid(outline, height, from, axis.normalize());
        if solid.is_flat() {
            return Err(InvalidPart::new("height", "must not be lost to rounding", height));
        }
        Ok(Self { given: Arc::new(Source { outline: rows, height, from, axis }), solid })
    }

    fn values(&self) -> Values {
        let Source { outline, height, from, axis } = &*self.given;
        Values::new()
            .with("point", Value::Rows(outline.clone()))
            .with("height", Value::Number(*height))
            .with("from", Value::Vector(*from))
            .with("axis", Value::Vector(*axis))
    }
}

fn refuse(outline: &[DVec2], fault: Fault) -> InvalidPart {
    let place = |i: u32| outline[i as usize % outline.len()];
    let edge = |i: u32| {
        let ([a, b], [c, d]) = (place(i).to_array(), place(i + 1).to_array());
        format!("{} from {a} {b} to {c} {d}", i + 1)
    };
    match fault {
        Fault::Meet(i, j) => {
            let requirement = "must go round an outline that does not cross or touch itself";
            InvalidPart::new("point", requirement, format!("edge {} that meets edge {}", edge(i), edge(j)))
        }
        Fault::Folds(i) => {
            let [x, y] = place(i).to_array();
            let requirement = "must go on from each corner to another one, and not straight back";
            InvalidPart::new("point", requirement, format!("as from corner {}, {x} {y}", i + 1))
        }
    }
}

fn solid(mut outline: Vec<DVec2>, height: f64, from: DVec3, axis: DVec3) -> Faceted {
    if !is_counter_clockwise(&outline) {
        outline.reverse();
    }
    let count = outline.len() as u32;
    let [right, up] = level_axes(axis);
    let base: Vec<DVec3> = outline.iter().map(|p| from + right * p.x + up * p.y).collect();
    let top = base.iter().map(|&p| p + axis * height);
    let corners: Vec<DVec3> = base.iter().copied().chain(top).collect();
    let cut = triangles(&outline);
    let mut facets = vec![
        Facet {
            outline: (0..count).rev().collect(),
            triangles: cut.iter().map(|&[a, b, c]| [a, c, b]).collect(),
        },
        Facet {
            outline: (count..2 * count).collect(),
            triangles: cut.iter().map(|triangle| triangle.map(|i| i + count)).collect(),
        },
    ];
    facets.extend((0..count).map(|i| {
        let next = (i + 1) % count;
        Facet::convex(vec![i, next, next + count, i + count])
    }));
    let turn =
        |i: usize| side(outline[i], outline[(i + 1) % outline.len()], outline[(i + 2) % outline.len()]);
    let is_convex = (0..outline.len()).all(|i| turn(i).is_ge());
    let places = corners.clone();
    let at = |i: u32| places[i as usize];
    Faceted::new(corners, facets, is_convex, |facet, normal| match facet.outline[..] {
        [a, b, c, d] if a + count == d && b + count == c => {
            Chart { corner: at(a), along_u: at(b) - at(a), along_v: at(d) - at(a) }
        }
        _ => {
            let is_top = facet.outline[0] >= count;
            debug_assert!(normal == DVec3::ZERO || (normal.dot(axis) > 0.0) == is_top, "caps look away");
            let axes = [if is_top { right } else { -right }, up];
            Chart::round(facet.outline.iter().map(|&i| at(i)), axes)
        }
    })
}

impl Geometry for Prism {
    faceted_geometry!();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ray, Span};

    /// An L, 2 m high.
    fn corner() -> Prism {
        let outline = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        Prism::new(outline.map(DVec2::from), 2.0, DVec3::ZERO, DVec3::Y).unwrap()
    }

    #[test]
    fn a_ray_goes_in_and_out_of_both_arms() {
        // Upwards on paper is −z.
        let mut ray = Ray::new(DVec3::new(4.0, 1.0, 1.0), DVec3::new(-1.0, 0.0, -1.0));
        let mut met = Vec::new();
        let mut leaving = None;
        while let Some(hit) = corner().cross(&ray, Span::AHEAD, leaving) {
            met.push((ray.at(hit.t), hit.normal.dot(ray.direction) < 0.0));
            (ray, leaving) = (Ray::new(ray.at(hit.t), ray.direction), Some(hit.facet));
        }
        let at = |x: f64, z: f64| DVec3::new(x, 1.0, z);
        assert_eq!(
            met,
            [(at(3.0, 0.0), true), (at(2.0, -1.0), false), (at(1.0, -2.0), true), (at(0.0, -3.0), false)]
        );
    }

    #[test]
    fn the_gap_between_its_arms_is_empty() {
        let down = |x: f64, z: f64| {
            corner().cross(&Ray::new(DVec3::new(x, 9.0, z), DVec3::NEG_Y), Span::AHEAD, None)
        };
        assert_eq!(down(0.5, -2.0).map(|hit| (hit.t, hit.normal, hit.facet)), Some((7.0, DVec3::Y, 1)));
        assert!(down(2.0, -2.0).is_none());
    }

    #[test]
    fn the_winding_makes_no_difference() {
        let clockwise = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]].map(DVec2::from);
        let prism = Prism::new(clockwise, 1.0, DVec3::ZERO, DVec3::Z).unwrap();
        let hit = prism.cross(&Ray::new(DVec3::new(0.5, 0.5, 9.0), -DVec3::Z), Span::AHEAD, None).unwrap();
        assert_eq!((hit.t, hit.normal, hit.facet), (8.0, DVec3::Z, 1));
    }

    #[test]
    fn an_outline_that_crosses_itself_is_refused_with_both_edges() {
        let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 1.5]].map(DVec2::from);
        let message = Prism::new(bow, 1.0, DVec3::ZERO, DVec3::Y).unwrap_err().to_string();
        assert_eq!(
            message,
            "point must go round an outline that does not cross or touch itself, \
             not edge 1 from 0 0 to 2 2 that meets edge 3 from 2 0 to 0 1.5"
        );
    }
}
