//! The flat triangle, seen from both sides, and the crossing that every shape made of triangles shares.

use std::cmp::Ordering;

use glam::{DVec2, DVec3};

use super::coplanar::lies_in_plane;
use super::parametrization::{BARYCENTRIC, in_triangle};
use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{
    Bounded, Difference, Dyadic, Located, Number, Root, Vector, Verdict, count_tie, decide,
    sign_of_determinant,
};
use crate::numeric::{EDGE_ROUNDING, EDGE_VALUE_ERROR, NORMAL_SINE};
use crate::part::Given;
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// Flat triangle; its normal is `(b − a) × (c − a)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangle {
    corners: [DVec3; 3],
}

impl Triangle {
    /// From its corners.
    ///
    /// # Errors
    /// A corner that is not finite, or corners on one line.
    pub fn new(a: DVec3, b: DVec3, c: DVec3) -> Result<Self, InvalidPart> {
        crate::part::make(&corner_values(&[a, b, c]))
    }

    /// Its corners a, b, c.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 3] {
        self.corners
    }
}

impl Part for Triangle {
    const NAME: &'static str = "triangle";
    const DOC: &'static str = "A flat triangle, seen from both sides.";
    const FIELDS: &'static [Field] = &[
        Field::required("a", FieldKind::Point, "m", "First corner."),
        Field::required("b", FieldKind::Point, "m", "Second corner."),
        Field::required("c", FieldKind::Point, "m", "Third corner."),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let corners = [given.point("a")?, given.point("b")?, given.point("c")?];
        check_area(&corners)?;
        Ok(Self { corners })
    }

    fn values(&self) -> Values {
        corner_values(&self.corners)
    }
}

impl Geometry for Triangle {
    fn nearest_root<N: Number>(
        &self,
        _: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        if leaving.is_some() { Ok(None) } else { meet_triangle(&self.corners, own, span, 0) }
    }

    fn crossing(&self, _: &Ray, at: Located, facet: u32) -> Option<Crossing> {
        Some(Crossing::flat(at, unit_normal(&self.corners)?, facet))
    }

    fn bounds(&self) -> Option<Aabb> {
        Some(Aabb::of(self.corners))
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self { corners: self.corners.map(|p| placement.point(p)) }
    }

    fn parametrization(&self, point: DVec3, _: u32) -> Parametrization {
        in_triangle(&self.corners, BARYCENTRIC, point)
    }

    fn is_closed(&self) -> bool {
        false
    }
}

/// Where a ray meets a triangle, edges and corners included; not where it runs within the triangle's plane, nor a
/// triangle without area.
///
/// By the signs of three volumes, each spanned by an edge as seen from the origin and the direction (Segura and Feito,
/// "Algorithms to test ray–triangle intersection", WSCG 2001): triangles that share an edge share the volume, so that
/// no ray passes between them.
pub(super) fn meet_triangle<N: Number>(
    corners: &[DVec3; 3],
    ray: &Ray,
    span: Span,
    facet: u32,
) -> Verdict<Option<FacetRoot<N>>> {
    if are_opposite(&sides(corners, ray)) {
        return Ok(None);
    }
    match meet_plane(corners, ray)? {
        Some(root) => FacetRoot::on(span, root, facet),
        None => Ok(None),
    }
}

/// Where a ray meets the plane of a triangle, whether within the triangle or not; nowhere where it runs within the plane.
fn meet_plane<N: Number>(corners: &[DVec3; 3], ray: &Ray) -> Verdict<Option<Root<N>>> {
    let a = Vector::<N>::of(corners[0]).minus(&Vector::of(ray.origin));
    let direction = Vector::of(ray.direction);
    let normal = area(corners);
    Root::ratio(&normal.dot(&a), &normal.dot(&direction))
}

/// The signs of the three volumes, of the edges bc, ca and ab; where two are opposite, that of the third may be left out.
fn sides(corners: &[DVec3; 3], ray: &Ray) -> [Ordering; 3] {
    let (volumes, error) = volumes(corners, ray);
    let certain = volumes.map(|v| {
        if v > error {
            Ordering::Greater
        } else if v < -error {
            Ordering::Less
        } else {
            Ordering::Equal
        }
    });
    if are_opposite(&certain) {
        return certain;
    }
    let edges = edges(corners);
    std::array::from_fn(|i| match certain[i] {
        Ordering::Equal => side_of_edge(edges[i], ray),
        sign => sign,
    })
}

/// The edges bc, ca and ab.
fn edges(&[a, b, c]: &[DVec3; 3]) -> [[DVec3; 2]; 3] {
    [[c, b], [a, c], [b, a]]
}

/// Whether a line passes by a triangle: two of its volumes have opposite signs.
fn are_opposite(signs: &[Ordering; 3]) -> bool {
    signs.contains(&Ordering::Less) && signs.contains(&Ordering::Greater)
}

/// The sign of the volume that an edge spans with the direction as seen from the origin; 0 where the line of the ray meets
/// the edge's.
fn side_of_edge([p, q]: [DVec3; 2], ray: &Ray) -> Ordering {
    let seen = |to: DVec3| Difference { from: ray.origin, to };
    sign_of_determinant(&[seen(p), seen(q), Difference::of(ray.direction)])
}

/// Whether a ray meets two triangles, both of which it meets, at one point for a reason that is seen without working out where:
/// it passes through an edge or a corner of both, or they lie in one plane.
pub(super) fn meet_together(first: &[DVec3; 3], second: &[DVec3; 3], ray: &Ray) -> bool {
    are_together(first, second, |edge| side_of_edge(edges(first)[edge], ray).is_eq())
}

/// The same where it is known whether the line of the ray meets the lines of the first one's edges bc, ca and ab.
fn are_together(first: &[DVec3; 3], second: &[DVec3; 3], through: impl Fn(usize) -> bool) -> bool {
    let common = first.map(|p| second.contains(&p));
    let at_edge_or_corner = match common {
        [true, true, true] => true,
        [false, true, true] => through(0),
        [true, false, true] => through(1),
        [true, true, false] => through(2),
        // The line lies in the planes that it spans with both edges at a corner: it is the line in which they cross.
        [true, false, false] => through(1) && through(2),
        [false, true, false] => through(2) && through(0),
        [false, false, true] => through(0) && through(1),
        [false, false, false] => false,
    };
    let together = at_edge_or_corner || lies_in_plane(second, first);
    if together {
        count_tie();
    }
    together
}

/// Where a ray meets a triangle, and how that compares with where it meets another that it is known to meet; `None` where it misses.
pub(super) fn met_beside(
    corners: &[DVec3; 3],
    held: &[DVec3; 3],
    ray: &Ray,
    span: Span,
) -> Option<(Located, Ordering)> {
    let signs = sides(corners, ray);
    if are_opposite(&signs) {
        return None;
    }
    let met = decide(|| locate::<Bounded>(corners, ray, span), || locate::<Dyadic>(corners, ray, span))?;
    // Where `f64` does not say where the other is met, it may be anywhere.
    let held_at = locate::<Bounded>(held, ray, span).ok().flatten();
    let held_at = held_at.unwrap_or(Located { t: met.t, error: f64::INFINITY });
    let order = met.order(
        &held_at,
        || are_together(corners, held, |edge| signs[edge].is_eq()),
        || [corners, held].map(|corners| meet_plane(corners, ray)),
        || [corners, held].map(|corners| meet_plane(corners, ray)),
    );
    Some((met, order))
}

/// Where on a span a ray meets the plane of a triangle.
fn locate<N: Number>(corners: &[DVec3; 3], ray: &Ray, span: Span) -> Verdict<Option<Located>> {
    match meet_plane::<N>(corners, ray)? {
        Some(root) => N::locate(&root, span),
        None => Ok(None),
    }
}

/// `(q − p) × (r − p)` of a triangle with corners p, q and r: its normal, twice as long as its area is large.
pub(super) fn area<N: Number>(corners: &[DVec3; 3]) -> Vector<N> {
    let [p, q, r] = corners.map(Vector::of);
    q.minus(&p).cross(&r.minus(&p))
}

/// Whether plain `f64` is certain that a line passes by a triangle: two of the three volumes have opposite signs.
pub(super) fn passes_by(corners: &[DVec3; 3], ray: &Ray) -> bool {
    let (volumes, error) = volumes(corners, ray);
    volumes.iter().any(|&v| v > error) && volumes.iter().any(|&v| v < -error)
}

/// The volumes that the edges span with the direction as seen from the origin, and the bound on their error.
fn volumes(corners: &[DVec3; 3], ray: &Ray) -> ([f64; 3], f64) {
    let [a, b, c] = corners.map(|p| p - ray.origin);
    let d = ray.direction;
    let reach = a.abs().max(b.abs()).max(c.abs()).max_element();
    let size = d.abs().element_sum();
    // Underflow costs half of 2⁻¹⁰⁷⁴ in each of a few products, some of them multiplied by the direction.
    let error = EDGE_VALUE_ERROR * reach * reach * size + f64::MIN_POSITIVE * (1.0 + size);
    ([c.cross(b).dot(d), a.cross(c).dot(d), b.cross(a).dot(d)], error)
}

/// The weights of the three corners at the point where a ray meets a triangle; they sum up to one. For what is
/// interpolated, not for what is decided.
///
/// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
pub(super) fn weights(corners: &[DVec3; 3], ray: &Ray) -> [f64; 3] {
    let [p, q, r] = sheared(corners.map(|p| p - ray.origin), ray.direction);
    let edge = |v: DVec2, w: DVec2| v.x * w.y - v.y * w.x;
    let weights = [edge(r, q), edge(p, r), edge(q, p)];
    let shares = weights.map(|w| w / weights.iter().sum::<f64>());
    if shares.iter().all(|share| share.is_finite()) { shares } else { [1.0 / 3.0; 3] }
}

/// Where points lie across the ray through the origin along `direction`, moved along its largest component.
fn sheared(points: [DVec3; 3], direction: DVec3) -> [DVec2; 3] {
    let size = direction.abs();
    let along = if size.x > size.y.max(size.z) {
        0
    } else if size.y > size.z {
        1
    } else {
        2
    };
    let (x, y) = ((along + 1) % 3, (along + 2) % 3);
    let shear = DVec2::new(direction[x], direction[y]) / direction[along];
    points.map(|p| DVec2::new(p[x], p[y]) - shear * p[along])
}

/// Unit vector along `(b − a) × (c − a)`, of corners a, b and c in metres; `None` without area.
#[must_use]
pub fn unit_normal(corners: &[DVec3; 3]) -> Option<DVec3> {
    let [a, b, c] = corners;
    let (u, v) = (b - a, c - a);
    let normal = u.cross(v);
    let size = u.length() * v.length();
    if normal.length() > NORMAL_SINE * size && normal.length() > f64::MIN_POSITIVE {
        normal.try_normalize()
    } else {
        thin_normal(corners)
    }
}

/// As [`unit_normal`], of a triangle so thin or so small that `f64` loses the normal.
#[cold]
fn thin_normal(corners: &[DVec3; 3]) -> Option<DVec3> {
    let [a, b, c] = corners.map(Vector::<Dyadic>::of);
    let n = b.minus(&a).cross(&c.minus(&a));
    let bits =
        [&n.x, &n.y, &n.z].into_iter().filter(|c| c.signum().is_ne()).map(Dyadic::magnitude_bits).max()?;
    let [x, y, z] = [n.x, n.y, n.z].map(|c| c.doubled(-bits).to_f64());
    DVec3::new(x, y, z).try_normalize()
}

/// Refuses corners that lie on one line, but for what rounding makes of it.
pub(super) fn check_area([a, b, c]: &[DVec3; 3]) -> Result<(), InvalidPart> {
    let (u, v) = (b - a, c - a);
    let largest = [a, b, c].map(|p| p.abs().max_element()).into_iter().fold(0.0, f64::max);
    let area = u.cross(v).length();
    if area > EDGE_ROUNDING * largest * (u.length() + v.length()) && area.is_finite() {
        return Ok(());
    }
    Err(InvalidPart::new("c", "must not lie on one line with a and b", c))
}

/// Corners as values named a, b, c, d.
pub(super) fn corner_values(corners: &[DVec3]) -> Values {
    let names = ["a", "b", "c", "d"];
    names.iter().zip(corners).fold(Values::new(), |values, (name, p)| values.with(name, Value::Vector(*p)))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn triangle() -> Triangle {
        Triangle::new(DVec3::ZERO, DVec3::X, DVec3::Y).unwrap()
    }

    #[test]
    fn the_middle_is_hit_and_beyond_the_edge_is_not() {
        let at = |x: f64, y: f64| Ray::new(DVec3::new(x, y, 5.0), -DVec3::Z);
        assert_eq!(triangle().cross(&at(0.25, 0.25), Span::AHEAD, None).unwrap().t, 5.0);
        assert!(triangle().cross(&at(0.51, 0.5), Span::AHEAD, None).is_none());
    }

    #[test]
    fn corner_weights_rebuild_the_point() {
        let ray = Ray::new(DVec3::new(0.2, 0.3, 1.0), DVec3::new(0.1, 0.05, -1.0));
        let t = triangle().cross(&ray, Span::AHEAD, None).unwrap().t;
        let w = weights(&triangle().corners, &ray);
        let rebuilt =
            triangle().corners[0] * w[0] + triangle().corners[1] * w[1] + triangle().corners[2] * w[2];
        assert!((rebuilt - ray.at(t)).length() < 1e-15);
    }

    #[test]
    fn volumes_are_as_exact_as_their_bound_says_and_the_bound_is_not_idle() {
        let mut worst = 0.0_f64;
        for i in 0..20_000_u32 {
            // Coordinates of like size and many digits, where roundings add up.
            let at = |k: u32| {
                let angle = f64::from(i * 16 + k);
                DVec3::new(angle.sin(), (angle * 1.3).cos(), (angle * 0.7 + 1.0).sin())
            };
            let (corners, ray) = ([at(0), at(1), at(2)], Ray::new(at(3), at(4)));
            let (values, error) = volumes(&corners, &ray);
            let direction = Vector::<Dyadic>::of(ray.direction);
            let [a, b, c] = corners.map(|p| Vector::of(p).minus(&Vector::of(ray.origin)));
            let exact = [c.cross(&b), a.cross(&c), b.cross(&a)].map(|n| n.dot(&direction));
            for (value, exact) in values.into_iter().zip(exact) {
                worst = worst.max((Dyadic::of(value).minus(&exact)).over(&Dyadic::of(error)).abs());
            }
        }
        assert!(0.1 < worst && worst <= 1.0, "{worst}");
    }

    /// Where a line meets a triangle, exactly.
    fn exactly(corners: &[DVec3; 3], ray: &Ray) -> Option<Root<Dyadic>> {
        meet_triangle(corners, ray, Span { min: f64::NEG_INFINITY, max: f64::INFINITY }, 0)
            .unwrap()
            .map(|met| met.root)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn triangles_that_meet_a_ray_together_have_equal_roots(
            points in prop::collection::vec([-3_i32..4, -3..4, -3..4], 6),
            eye in [-0.4..0.4_f64, -0.4..0.4, 5.0..6.0_f64],
            common in 0..4_usize, shape in 0..4_usize, share in -0.5..1.5_f64,
        ) {
            let point = |i: usize| DVec3::from(points[i].map(f64::from));
            let first = [point(0), point(1), point(2)];
            let mut second = [point(3), point(4), point(5)];
            if shape == 3 {
                // In the plane of the first.
                second = second.map(|p| first[0] + (first[1] - first[0]) * p.x + (first[2] - first[0]) * p.y);
            }
            second[..common].copy_from_slice(&first[..common]);
            second.rotate_left(shape % 3);
            prop_assume!(check_area(&first).is_ok() && check_area(&second).is_ok());
            let eye = DVec3::from(eye);
            // At a corner, at a point of an edge's line near enough to the edge, at the middle; each as near as directions come.
            for at in [first[0], first[0].lerp(first[1], 0.5), first[0].lerp(first[1], share), (first[0] + first[1] + first[2]) / 3.0] {
                for eye in [eye, eye.round()] {
                    let ray = Ray::new(eye, at - eye);
                    let roots = [&first, &second].map(|corners| exactly(corners, &ray));
                    if let [a, Some(b)] = &roots {
                        let everywhere = Span { min: f64::NEG_INFINITY, max: f64::INFINITY };
                        let order = met_beside(&first, &second, &ray, everywhere).map(|(_, order)| order);
                        prop_assert_eq!(order, a.as_ref().map(|a| a.compare(b).unwrap()));
                    }
                    if let [Some(a), Some(b)] = roots {
                        let equal = a.compare(&b).unwrap().is_eq();
                        let together = meet_together(&first, &second, &ray);
                        prop_assert!(equal || !together, "{:?} {:?} {:?}", first, second, ray);
                        // What is seen is all that mostly happens: an edge, a corner or a plane in common.
                        let features = common == 3 || shape == 3 || (common > 0 && at == first[0] && eye == eye.round());
                        prop_assert!(together || !features, "{:?} {:?} {:?}", first, second, ray);
                    }
                }
            }
        }
    }

    #[test]
    fn the_normal_of_a_sliver_is_right() {
        // Thinner than f64 can tell: b lies 2⁻⁷⁰ beside the line from a to c, which f64 takes for the line.
        let thin = [DVec3::ZERO, DVec3::new(1.0, 1.0, 2.0_f64.powi(-70)), DVec3::new(3.0, 3.0, 0.0)];
        let normal = unit_normal(&thin).unwrap();
        assert!(normal.distance(DVec3::new(-1.0, 1.0, 0.0) / 2.0_f64.sqrt()) < 1e-15, "{normal}");
        let tiny = thin.map(|p| p * 2.0_f64.powi(-500));
        assert!(unit_normal(&tiny).unwrap().distance(normal) < 1e-15);
    }

    #[test]
    fn a_ray_in_its_plane_misses() {
        let ray = Ray::new(DVec3::new(-1.0, 0.2, 0.0), DVec3::X);
        assert!(triangle().cross(&ray, Span::AHEAD, None).is_none());
    }

    #[test]
    fn corners_on_a_line_are_refused() {
        assert_eq!(Triangle::new(DVec3::ZERO, DVec3::X, DVec3::X * 2.0).unwrap_err().field(), "c");
    }
}
