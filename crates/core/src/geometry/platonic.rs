//! The five regular solids.

use glam::DVec3;

use super::Geometry;
use super::faceted::Faceted;
use super::faceted_geometry::faceted_geometry;
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Part, Value, Values};

/// A regular solid whose corners lie at `radius` from `center`. Facets are its faces.
#[derive(Debug, Clone, PartialEq)]
pub struct Platonic {
    kind: usize,
    center: DVec3,
    radius: f64,
    pub(super) solid: Faceted,
}

/// The words for them.
const SOLIDS: &[&str] = &["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"];

/// For each which of them has its corners in the direction of this one's faces; of the first that of its opposite.
const DUALS: [usize; 5] = [0, 2, 1, 4, 3];

impl Platonic {
    /// One of `"tetrahedron"`, `"cube"`, `"octahedron"`, `"dodecahedron"` and `"icosahedron"`.
    ///
    /// # Errors
    /// Another word, a centre that is not finite, a radius that is not positive and finite.
    pub fn new(solid: &str, center: DVec3, radius: f64) -> Result<Self, InvalidPart> {
        let values = Values::new().with("solid", Value::Word(solid.to_owned()));
        let values = values.with("center", Value::Vector(center));
        crate::part::make(&values.with("radius", Value::Number(radius)))
    }

    /// Its corners and faces.
    #[must_use]
    pub fn solid(&self) -> &Faceted {
        &self.solid
    }
}

/// Directions of the corners, of one length.
fn corners(kind: usize) -> Vec<DVec3> {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let signs = |count: u32| {
        let sign = |i: u32, k: u32| if i >> k & 1 == 0 { 1.0 } else { -1.0 };
        (0..1 << count).map(move |i| DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2)))
    };
    // All that one point of a coordinate plane becomes by its signs, and by exchanging axes in turn.
    let turned = |a: f64, b: f64| {
        let each = signs(2).map(move |sign| DVec3::new(0.0, a * sign.x, b * sign.y));
        each.flat_map(|p| [p, DVec3::new(p.z, p.x, p.y), DVec3::new(p.y, p.z, p.x)])
    };
    match kind {
        0 => signs(3).filter(|p| p.element_product() > 0.0).collect(),
        1 => signs(3).collect(),
        2 => DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]).collect(),
        3 => signs(3).chain(turned(1.0 / golden, golden)).collect(),
        _ => turned(golden, 1.0).collect(),
    }
}

/// The outlines of the faces: for each direction of a face, those corners that lie farthest along it, counter-clockwise.
fn faces(kind: usize) -> Vec<Vec<u32>> {
    let corners = corners(kind);
    let outline = |towards: DVec3| {
        let towards = if kind == 0 { -towards } else { towards };
        let height = |i: u32| corners[i as usize].dot(towards);
        let numbers = 0..corners.len() as u32;
        let most = numbers.clone().map(height).fold(f64::NEG_INFINITY, f64::max);
        // The next lower ones lie lower by a third or more.
        let mut outline: Vec<u32> = numbers.filter(|&i| height(i) > 0.9 * most).collect();
        let right = towards.any_orthogonal_vector().normalize();
        let up = towards.normalize().cross(right);
        let turn = |i: u32| corners[i as usize].dot(up).atan2(corners[i as usize].dot(right));
        outline.sort_by(|&a, &b| turn(a).total_cmp(&turn(b)));
        outline
    };
    self::corners(DUALS[kind]).into_iter().map(outline).collect()
}

impl Part for Platonic {
    const NAME: &'static str = "platonic";
    const DOC: &'static str = "One of the five regular solids.";
    const FIELDS: &'static [Field] = &[
        Field::required("solid", FieldKind::Choice(SOLIDS), "", "Which one."),
        Field::required("center", FieldKind::Point, "m", "The middle.").or(|| Value::Vector(DVec3::ZERO)),
        Field::required("radius", FieldKind::Length, "m", "Distance from the middle to the corners."),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let (kind, center) = (given.choice("solid")?, given.point("center")?);
        let radius = given.positive("radius")?;
        let corners = corners(kind).into_iter().map(|p| center + p * (radius / p.length())).collect();
        let solid = Faceted::convex(corners, faces(kind));
        if solid.is_flat() {
            return Err(InvalidPart::new("radius", "must not be lost to rounding beside center", radius));
        }
        Ok(Self { kind, center, radius, solid })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("solid", Value::Word(SOLIDS[self.kind].to_owned()))
            .with("center", Value::Vector(self.center))
            .with("radius", Value::Number(self.radius))
    }
}

impl Geometry for Platonic {
    faceted_geometry!();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_have_the_faces_that_their_names_say() {
        for (solid, faces, sides) in
            SOLIDS.iter().zip([4, 6, 8, 12, 20]).zip([3, 4, 3, 5, 3]).map(|((s, f), n)| (s, f, n))
        {
            let it = Platonic::new(solid, DVec3::ONE, 2.0).unwrap();
            let edge = {
                let outline = it.solid.outline(0);
                it.solid.corners()[outline[0] as usize].distance(it.solid.corners()[outline[1] as usize])
            };
            assert_eq!(it.solid.count(), faces, "{solid}");
            for facet in 0..faces {
                let outline: Vec<DVec3> =
                    it.solid.outline(facet).iter().map(|&i| it.solid.corners()[i as usize]).collect();
                assert_eq!(outline.len(), sides, "{solid}");
                let middle = outline.iter().sum::<DVec3>() / outline.len() as f64;
                assert!(
                    it.solid.normal(facet).distance((middle - DVec3::ONE).normalize()) < 1e-14,
                    "{solid}"
                );
                for i in 0..sides {
                    assert!((outline[i].distance(outline[(i + 1) % sides]) - edge).abs() < 1e-14, "{solid}");
                    assert!((outline[i].distance(DVec3::ONE) - 2.0).abs() < 1e-14, "{solid}");
                }
            }
        }
    }
}
