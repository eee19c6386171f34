//! A closed surface of flat facets over shared corners: what polyhedra, regular solids and prisms are made of.
//!
//! Every facet is cut into triangles, and those are what rays meet: placing a facet of more than three corners rounds it out
//! of its plane, and triangles that share their corners leave no gap whatever rounding does. A facet counts as one piece: a ray
//! that leaves it skips all its triangles.

use std::cmp::Ordering;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::crossings::Crossings;
use super::triangle::{area, meet_triangle, unit_normal};
use super::{FacetRoot, Parametrization};
use crate::exact::{Located, Number, Vector, Verdict};
use crate::numeric::EDGE_ROUNDING;
use crate::solid::Passage;
use crate::{Aabb, Crossing, Placement, Ray, Span};

/// A solid with flat facets; their normals point outwards.
#[derive(Debug, Clone, PartialEq)]
pub struct Faceted {
    corners: Vec<DVec3>,
    /// Unit normals of the facets.
    normals: Vec<DVec3>,
    charts: Vec<Chart>,
    plan: Arc<Plan>,
}

/// What placing does not change.
#[derive(Debug, PartialEq)]
struct Plan {
    facets: Vec<Facet>,
    is_convex: bool,
}

/// A facet by the numbers of its corners.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Facet {
    /// Counter-clockwise as seen from outside.
    pub(super) outline: Vec<u32>,
    /// What it is cut into, wound alike.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Texture coordinates of a facet: 0 0 at a point, 1 0 and 0 1 one edge further.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Chart {
    pub(super) corner: DVec3,
    pub(super) along_u: DVec3,
    pub(super) along_v: DVec3,
}

impl Facet {
    /// A convex one, cut into triangles that share its first corner.
    pub(super) fn convex(outline: Vec<u32>) -> Self {
        let triangles = (2..outline.len()).map(|i| [outline[0], outline[i - 1], outline[i]]).collect();
        Self { outline, triangles }
    }
}

impl Chart {
    /// The smallest rectangle round points with sides along two unit vectors.
    pub(super) fn round(points: impl Iterator<Item = DVec3>, [right, up]: [DVec3; 2]) -> Self {
        let (mut low, mut high, mut on) = (DVec2::INFINITY, DVec2::NEG_INFINITY, DVec3::ZERO);
        for p in points {
            let place = DVec2::new(p.dot(right), p.dot(up));
            (low, high, on) = (low.min(place), high.max(place), p);
        }
        let corner = on + right * (low.x - on.dot(right)) + up * (low.y - on.dot(up));
        Self { corner, along_u: right * (high.x - low.x), along_v: up * (high.y - low.y) }
    }
}

impl Faceted {
    /// From corners, and facets which together close it.
    pub(super) fn new(
        corners: Vec<DVec3>,
        facets: Vec<Facet>,
        is_convex: bool,
        chart: impl Fn(&Facet, DVec3) -> Chart,
    ) -> Self {
        let normals = normals(&corners, &facets);
        let charts = facets.iter().zip(&normals).map(|(facet, normal)| chart(facet, *normal)).collect();
        Self { corners, normals, charts, plan: Arc::new(Plan { facets, is_convex }) }
    }

    /// A convex one, whose facets have texture coordinates as upright as they can be.
    pub(super) fn convex(corners: Vec<DVec3>, outlines: Vec<Vec<u32>>) -> Self {
        let places = corners.clone();
        let chart = |facet: &Facet, normal: DVec3| {
            let points = facet.outline.iter().map(|&i| places[i as usize]);
            Chart::round(points, super::parametrization::level_axes(normal))
        };
        Self::new(corners, outlines.into_iter().map(Facet::convex).collect(), true, chart)
    }

    /// All corners.
    #[must_use]
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// How many facets it has.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.plan.facets.len() as u32
    }

    /// Whether it is convex, but for rounding.
    #[must_use]
    pub fn is_convex(&self) -> bool {
        self.plan.is_convex
    }

    /// The numbers of a facet's corners, counter-clockwise as seen from outside.
    ///
    /// # Panics
    /// A facet number out of range.
    #[must_use]
    pub fn outline(&self, facet: u32) -> &[u32] {
        &self.plan.facets[facet as usize].outline
    }

    /// The unit normal of a facet, outwards; zero of one without area.
    ///
    /// # Panics
    /// A facet number out of range.
    #[must_use]
    pub fn normal(&self, facet: u32) -> DVec3 {
        self.normals[facet as usize]
    }

    /// The triangles of a facet, wound so that `(q − p) × (r − p)` points outwards.
    ///
    /// # Panics
    /// A facet number out of range.
    pub fn triangles(&self, facet: u32) -> impl ExactSizeIterator<Item = [DVec3; 3]> {
        let triangles = &self.plan.facets[facet as usize].triangles;
        triangles.iter().map(|triangle| triangle.map(|i| self.corners[i as usize]))
    }

    /// Whether it holds so little within so much surface that rounding alone may have made it.
    pub(super) fn is_flat(&self) -> bool {
        let base = self.corners.first().copied().unwrap_or_default();
        let (mut volume, mut area) = (0.0, 0.0);
        for [p, q, r] in (0..self.count()).flat_map(|facet| self.triangles(facet)) {
            let doubled = (q - p).cross(r - p);
            volume += doubled.dot(p - base);
            area += doubled.length();
        }
        let largest = self.corners.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        !(volume > EDGE_ROUNDING * largest * area && volume.is_finite())
    }

    pub(super) fn nearest_root<N: Number>(
        &self,
        facet: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        match leaving {
            Some(left) if left == facet => return Ok(None),
            Some(left)
                if self.plan.is_convex && left < self.count() && self.side_of::<N>(left, own)?.is_gt() =>
            {
                return Ok(None);
            }
            _ => {}
        }
        let mut best: Option<FacetRoot<N>> = None;
        for triangle in self.triangles(facet) {
            let Some(next) = meet_triangle(&triangle, own, span, facet)? else { continue };
            let is_nearer = match &best {
                Some(best) => next.root.compare(&best.root)?.is_lt(),
                None => true,
            };
            if is_nearer {
                best = Some(next);
            }
        }
        Ok(best)
    }

    /// To which side of a facet a ray runs, `Greater` outwards: by its area as a vector, the sum of its triangles'.
    fn side_of<N: Number>(&self, facet: u32, ray: &Ray) -> Verdict<Ordering> {
        let direction = Vector::<N>::of(ray.direction);
        let sides = self.triangles(facet).map(|triangle| area(&triangle).dot(&direction));
        sides.fold(N::of(0.0), |sum, side| sum.plus(&side)).sign()
    }

    /// Where the line of a ray runs inside it; as [`Geometry::passage`](super::Geometry::passage), and right for concave ones.
    pub(super) fn passage<N: Number>(&self, own: &Ray, leaving: Option<u32>) -> Verdict<Passage<N>> {
        let mut crossings = Crossings::new(own);
        for facet in 0..self.count() {
            for triangle in self.triangles(facet) {
                crossings.add(&triangle, facet)?;
            }
        }
        let passage = crossings.passage()?;
        match leaving.filter(|&left| left < self.count()) {
            Some(left) => passage.after_leaving(|facet| facet == left, self.side_of::<N>(left, own)?),
            None => Ok(passage),
        }
    }

    pub(super) fn crossing(&self, at: Located, facet: u32) -> Option<Crossing> {
        let normal = *self.normals.get(facet as usize)?;
        (normal != DVec3::ZERO).then(|| Crossing::flat(at, normal, facet))
    }

    pub(super) fn bounds(&self) -> Aabb {
        Aabb::of(self.corners.iter().copied())
    }

    pub(super) fn placed(&self, placement: &Placement) -> Self {
        let corners: Vec<DVec3> = self.corners.iter().map(|&p| placement.point(p)).collect();
        let charts = self.charts.iter().map(|chart| Chart {
            corner: placement.point(chart.corner),
            along_u: placement.vector(chart.along_u),
            along_v: placement.vector(chart.along_v),
        });
        let normals = normals(&corners, &self.plan.facets);
        Self { charts: charts.collect(), normals, corners, plan: Arc::clone(&self.plan) }
    }

    pub(super) fn parametrization(&self, point: DVec3, facet: u32) -> Parametrization {
        let Some(Chart { corner, along_u, along_v }) = self.charts.get(facet as usize).copied() else {
            return Parametrization { uv: DVec2::ZERO, along_u: DVec3::ZERO, along_v: DVec3::ZERO };
        };
        let share = |along: DVec3| (point - corner).dot(along) / along.length_squared();
        Parametrization { uv: DVec2::new(share(along_u), share(along_v)), along_u, along_v }
    }
}

/// The unit normals of facets.
fn normals(corners: &[DVec3], facets: &[Facet]) -> Vec<DVec3> {
    let normal = |facet: &Facet| {
        let triangles = facet.triangles.iter().map(|triangle| triangle.map(|i| corners[i as usize]));
        let largest = triangles.max_by(|a, b| {
            let area2 = |[p, q, r]: &[DVec3; 3]| (q - p).cross(r - p).length_squared();
            area2(a).total_cmp(&area2(b))
        });
        largest.and_then(|triangle| unit_normal(&triangle)).unwrap_or(DVec3::ZERO)
    };
    facets.iter().map(normal).collect()
}
