//! The convex solid between points or planes.

use std::sync::Arc;

use glam::DVec3;

use super::Geometry;
use super::faceted::Faceted;
use super::faceted_geometry::faceted_geometry;
use super::half_spaces::{HalfSpace, common};
use super::hull::hull;
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Part, Rows, Value, Values};

/// The smallest convex solid round points, or what half spaces have in common. Facets are its faces: of points in any order,
/// of planes in theirs.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyhedron {
    /// The rows of the field that was given, in its own space.
    given: Arc<(&'static str, Rows)>,
    pub(super) solid: Faceted,
}

/// The most points or planes: with more of them a mesh does better.
const MOST_POINTS: usize = 1000;
const MOST_PLANES: usize = 64;

const POINT: &str = "point";
const PLANE: &str = "plane";

impl Polyhedron {
    /// The hull of points.
    ///
    /// # Errors
    /// A point that is not finite, points in one plane, or more than 1,000.
    pub fn hull_of(points: impl IntoIterator<Item = DVec3>) -> Result<Self, InvalidPart> {
        let rows = Rows::of(points.into_iter().map(|p| p.to_array()));
        crate::part::make(&Values::new().with(POINT, Value::Rows(rows)))
    }

    /// All points `p` with `normal · p <= offset` for each of the pairs.
    ///
    /// # Errors
    /// A normal or an offset that is not finite, a normal of 0, planes that do not enclose a finite space, or more than 64.
    pub fn between(planes: impl IntoIterator<Item = (DVec3, f64)>) -> Result<Self, InvalidPart> {
        let rows = planes.into_iter().map(|(n, offset)| [n.x, n.y, n.z, offset]);
        crate::part::make(&Values::new().with(PLANE, Value::Rows(Rows::of(rows))))
    }

    /// Its corners and faces.
    #[must_use]
    pub fn solid(&self) -> &Faceted {
        &self.solid
    }
}

impl Polyhedron {
    /// The hull of points, at least four that do not lie in a plane.
    ///
    /// # Errors
    /// Points that are not finite, and too few to enclose anything.
    pub fn of_points(points: impl IntoIterator<Item = DVec3>) -> Result<Self, InvalidPart> {
        let rows = Rows::of(points.into_iter().map(|point| point.to_array()));
        crate::part::make(&Values::new().with(POINT, Value::Rows(rows)))
    }

    /// What lies behind all of some planes: for each its outward normal, and how far it lies along that, in lengths of the normal.
    ///
    /// # Errors
    /// Numbers that are not finite, and planes that enclose nothing.
    pub fn of_planes(planes: impl IntoIterator<Item = (DVec3, f64)>) -> Result<Self, InvalidPart> {
        let rows = Rows::of(planes.into_iter().map(|(normal, along)| normal.extend(along).to_array()));
        crate::part::make(&Values::new().with(PLANE, Value::Rows(rows)))
    }
}

impl Part for Polyhedron {
    const NAME: &'static str = "polyhedron";
    const DOC: &'static str = "The convex solid between points or planes.";
    const FIELDS: &'static [Field] = &[
        Field::required(POINT, FieldKind::Rows(3), "m", "A point that it reaches to; at least four.")
            .instead_of(PLANE),
        Field::required(
            PLANE,
            FieldKind::Rows(4),
            "m",
            "The outward normal of a face, and how far the face lies along it, in lengths of the normal.",
        )
        .instead_of(POINT),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        match (given.has(POINT), given.has(PLANE)) {
            (true, true) => Err(InvalidPart::new(PLANE, "must not be given beside point", "both")),
            (false, true) => of_planes(given.rows(PLANE)?),
            _ => of_points(given.rows(POINT)?),
        }
    }

    fn values(&self) -> Values {
        let (name, rows) = &*self.given;
        Values::new().with(name, Value::Rows(rows.clone()))
    }
}

fn of_points(rows: Rows) -> Result<Polyhedron, InvalidPart> {
    let points: Vec<DVec3> = rows.iter().map(DVec3::from_slice).collect();
    if !(4..=MOST_POINTS).contains(&points.len()) {
        let requirement = format!("must be given 4 to {MOST_POINTS} times");
        return Err(InvalidPart::new(POINT, requirement, points.len()));
    }
    let outlines = hull(&points).unwrap_or_default();
    // Points within it are no corners.
    let mut used: Vec<u32> = outlines.concat();
    used.sort_unstable();
    used.dedup();
    let corners = used.iter().map(|&i| points[i as usize]).collect();
    let renumbered = |outline: Vec<u32>| {
        outline.iter().map(|corner| used.partition_point(|other| other < corner) as u32).collect()
    };
    let solid = Faceted::convex(corners, outlines.into_iter().map(renumbered).collect());
    if solid.is_flat() {
        return Err(InvalidPart::new(
            POINT,
            "must not all lie in one plane",
            format!("{} that do", points.len()),
        ));
    }
    Ok(Polyhedron { given: Arc::new((POINT, rows)), solid })
}

fn of_planes(rows: Rows) -> Result<Polyhedron, InvalidPart> {
    let plane = |row: &[f64]| HalfSpace { normal: DVec3::from_slice(row), offset: row[3] };
    let planes: Vec<HalfSpace> = rows.iter().map(plane).collect();
    if !(4..=MOST_PLANES).contains(&planes.len()) {
        let requirement = format!("must be given 4 to {MOST_PLANES} times");
        return Err(InvalidPart::new(PLANE, requirement, planes.len()));
    }
    if planes.iter().any(|plane| plane.normal.try_normalize().is_none()) {
        return Err(InvalidPart::new(PLANE, "must have a normal other than 0", "0 0 0"));
    }
    let open = || {
        let found = format!("{} that leave it open, flat or empty", planes.len());
        InvalidPart::new(PLANE, "must enclose a finite space", found)
    };
    let (corners, outlines) = common(&planes).ok_or_else(open)?;
    let within = |corner: &DVec3| corner.abs().max_element() <= crate::part::LARGEST;
    let solid = Faceted::convex(corners, outlines);
    if solid.is_flat() || !solid.corners().iter().all(within) {
        return Err(open());
    }
    Ok(Polyhedron { given: Arc::new((PLANE, rows)), solid })
}

impl Geometry for Polyhedron {
    faceted_geometry!();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ray, Span};

    fn wedge() -> Polyhedron {
        let flat = [DVec3::ZERO, DVec3::X, DVec3::Y];
        Polyhedron::hull_of(flat.into_iter().chain(flat.map(|p| p + DVec3::Z * 2.0))).unwrap()
    }

    #[test]
    fn it_is_entered_and_left_through_its_faces() {
        let ray = Ray::new(DVec3::new(0.25, 0.25, -3.0), DVec3::Z);
        let entry = wedge().cross(&ray, Span::AHEAD, None).unwrap();
        assert_eq!((entry.t, entry.normal), (3.0, DVec3::NEG_Z));
        let exit = wedge().cross(&Ray::new(ray.at(3.0), DVec3::Z), Span::AHEAD, Some(entry.facet)).unwrap();
        assert_eq!((exit.t, exit.normal), (2.0, DVec3::Z));
        let out = Ray::new(DVec3::new(0.25, 0.25, 2.0 - 1e-15), DVec3::new(0.1, 0.0, 1.0));
        assert_eq!(wedge().cross(&out, Span::AHEAD, Some(exit.facet)), None);
    }

    #[test]
    fn the_diagonal_of_a_face_is_no_seam() {
        let cube = Polyhedron::between(DVec3::AXES.into_iter().flat_map(|axis| [(axis, 1.0), (-axis, 1.0)]));
        let cube = cube.unwrap();
        for x in [-0.5, 0.0, 0.25] {
            for y in [x, -x] {
                let hit = cube.cross(&Ray::new(DVec3::new(x, y, 5.0), -DVec3::Z), Span::AHEAD, None).unwrap();
                assert_eq!((hit.t, hit.normal, hit.facet), (4.0, DVec3::Z, 4));
            }
        }
    }

    #[test]
    fn what_encloses_nothing_is_refused_in_words() {
        let refused = |polyhedron: Result<Polyhedron, InvalidPart>| polyhedron.unwrap_err().to_string();
        let square = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + DVec3::Y];
        assert_eq!(
            refused(Polyhedron::hull_of(square)),
            "point must not all lie in one plane, not 4 that do"
        );
        assert_eq!(
            refused(Polyhedron::hull_of(square[..3].to_vec())),
            "point must be given 4 to 1000 times, not 3"
        );
        let open = refused(Polyhedron::between(square.map(|p| (p + DVec3::Z, 1.0))));
        assert_eq!(open, "plane must enclose a finite space, not 4 that leave it open, flat or empty");
    }
}
