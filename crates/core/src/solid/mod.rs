//! Where does a ray meet a solid that is made of others: their union, their intersection, or one without the rest?
//!
//! (Roth, "Ray casting for modeling solids", Computer Graphics and Image Processing 18, 1982.) Along a ray every member is a
//! list of places where the ray comes in and goes out, kept as roots of equations ([`Passage`]). In the order of all these
//! places, what counts as the solid's surface is where the solid's [`Rule`] changes its answer. Places that are one and the
//! same are passed at once, so faces of members that lie on each other leave nothing between them. As for single shapes, that is
//! computed in numbers that know their error first, and where those cannot decide in exact ones.

mod passage;
mod rule;
mod sweep;

use std::sync::Arc;

use smallvec::SmallVec;

use crate::contour::are_parallel;
use crate::exact::{Bounded, Dyadic, Number, Root, Verdict, decide};
use crate::geometry::FacetRoot;
use crate::numeric::HELD_WITHIN;
use crate::{Aabb, Crossing, Placement, Ray, Shape, Span};

pub(crate) use passage::convex;
pub use passage::{End, Passage};
pub use rule::{Operation, Rule};
use sweep::Sweep;

/// Shapes and the rule by which they make a solid.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    shapes: Vec<Shape>,
    rule: Rule,
}

impl Solid {
    /// Of shapes, numbered in this order, that all [enclose something](Shape::is_solid).
    ///
    /// `None` where a shape does not, or the rule names one that is not there.
    #[must_use]
    pub fn new(shapes: Vec<Shape>, rule: Rule) -> Option<Self> {
        let knows = names_at_most(&rule, shapes.len());
        (knows && shapes.iter().all(Shape::is_solid)).then_some(Self { shapes, rule })
    }

    /// The shapes that it is made of.
    #[must_use]
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// When a point is inside.
    #[must_use]
    pub fn rule(&self) -> &Rule {
        &self.rule
    }

    /// The same, placed elsewhere.
    #[must_use]
    pub fn placed(&self, placement: &Placement) -> Self {
        Self {
            shapes: self.shapes.iter().map(|shape| shape.placed(placement)).collect(),
            rule: self.rule.clone(),
        }
    }

    /// A box round it; `None` where it has no end.
    #[must_use]
    pub fn bounds(&self) -> Option<Aabb> {
        let own: Vec<_> = self.shapes.iter().map(Shape::bounds).collect();
        self.rule.bounds(&own)
    }
}

impl Solid {
    /// Where a ray runs inside of one of the shapes.
    fn passage<N: Number>(&self, number: u32, ray: &Ray, leaving: Option<Left>) -> Verdict<Passage<N>> {
        let shape = &self.shapes[number as usize];
        let Some(left) = leaving else { return shape.passage(ray, None) };
        if left.member == number {
            return shape.passage(ray, Some(left.facet));
        }
        let passage = shape.passage::<N>(ray, None)?;
        for end in &passage.ends {
            if self.is_left_too(shape, end, ray, left)? {
                return shape.passage(ray, Some(end.facet));
            }
        }
        Ok(passage)
    }

    /// Whether a ray that leaves one shape leaves another as well, as their surfaces lie on each other there.
    fn is_left_too<N: Number>(&self, shape: &Shape, end: &End<N>, ray: &Ray, left: Left) -> Verdict<bool> {
        let size = ray.origin.abs().max_element().max(extent(shape));
        let near = HELD_WITHIN * size / ray.direction.length();
        let at = N::locate(&end.root, Span { min: -near, max: near });
        // Where such numbers cannot tell, it is near.
        if at == Ok(None) {
            return Ok(false);
        }
        let here = crate::exact::Located { t: 0.0, error: near };
        let normals = [(&self.shapes[left.member as usize], left.facet), (shape, end.facet)]
            .map(|(shape, facet)| shape.crossing_at(ray, here, facet).map(|crossing| crossing.normal));
        let [Some(one), Some(other)] = normals else { return Ok(false) };
        Ok(are_parallel(one, other))
    }
}

/// The largest coordinate of a shape; 0 of one without end.
fn extent(shape: &Shape) -> f64 {
    shape.bounds().map_or(0.0, |bounds| bounds.min.abs().max(bounds.max.abs()).max_element())
}

fn names_at_most(rule: &Rule, count: usize) -> bool {
    match rule {
        Rule::Shape(number) => (*number as usize) < count,
        Rule::Combined(_, members) => members.iter().all(|member| names_at_most(member, count)),
    }
}

/// The surface of a solid that a ray leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Left {
    /// The number of the shape among those of the solid.
    pub member: u32,
    /// Which flat piece of it.
    pub facet: u32,
}

/// One shape of a solid, as far as its surface is the solid's.
#[derive(Debug, Clone)]
pub struct Member {
    solid: Arc<Solid>,
    number: u32,
}

/// Where a ray meets the solid on a member, and whether it comes in.
struct Met<N> {
    at: FacetRoot<N>,
    enters: bool,
}

impl Member {
    /// The shape of that number; `None` where there is none.
    #[must_use]
    pub fn new(solid: Arc<Solid>, number: u32) -> Option<Self> {
        ((number as usize) < solid.shapes.len()).then_some(Self { solid, number })
    }

    /// Its number among the shapes of the solid.
    #[must_use]
    pub fn number(&self) -> u32 {
        self.number
    }

    /// The solid that it is a part of.
    #[must_use]
    pub fn solid(&self) -> &Solid {
        &self.solid
    }

    /// The whole shape.
    #[must_use]
    pub fn shape(&self) -> &Shape {
        &self.solid.shapes[self.number as usize]
    }

    /// The same part of the solid, placed elsewhere.
    #[must_use]
    pub fn placed(&self, placement: &Placement) -> Self {
        Self { solid: Arc::new(self.solid.placed(placement)), number: self.number }
    }

    /// A box round what of the shape's surface is the solid's; `None` where that has no end.
    #[must_use]
    pub fn bounds(&self) -> Option<Aabb> {
        match (self.shape().bounds(), self.solid.bounds()) {
            (Some(own), Some(all)) => {
                Some(own.intersection(all)).filter(|both| !both.is_empty()).or(Some(own))
            }
            (own, all) => own.or(all),
        }
    }

    /// As [`Geometry::cross`](crate::Geometry::cross): the nearest place on `span` where a ray meets the solid on this
    /// member. The normal is on the outer side of the solid. `leaving` names the surface of the solid that the ray leaves.
    #[must_use]
    pub fn cross(&self, ray: &Ray, span: Span, leaving: Option<Left>) -> Option<Crossing> {
        if !ray.is_valid() {
            return None;
        }
        let (at, facet, enters) = decide(
            || self.nearest::<Bounded>(ray, span, leaving).map(located),
            || self.nearest::<Dyadic>(ray, span, leaving).map(located),
        )?;
        let mut crossing = self.shape().crossing_at(ray, at, facet)?;
        if enters == (crossing.normal.dot(ray.direction) > 0.0) {
            crossing.normal = -crossing.normal;
            crossing.shading_normal = -crossing.shading_normal;
        }
        Some(crossing)
    }

    /// The root behind a crossing that [`cross`](Self::cross) has found.
    ///
    /// # Errors
    /// When such numbers cannot decide whether there is one.
    pub fn root<N: Number>(&self, ray: &Ray, span: Span, leaving: Option<Left>) -> Verdict<Option<Root<N>>> {
        Ok(self.nearest(ray, span, leaving)?.map(|met| met.at.root))
    }

    fn nearest<N: Number>(&self, ray: &Ray, span: Span, leaving: Option<Left>) -> Verdict<Option<Met<N>>> {
        let own = self.solid.passage::<N>(self.number, ray, leaving)?;
        if own.ends.is_empty() {
            return Ok(None);
        }
        let mut passages: SmallVec<[Passage<N>; 4]> = SmallVec::new();
        for number in 0..self.solid.shapes.len() as u32 {
            let is_own = number == self.number;
            passages.push(if is_own { own.clone() } else { self.solid.passage(number, ray, leaving)? });
        }
        let mut sweep = Sweep::new(passages);
        while let Some(step) = sweep.next_step(&self.solid.rule)? {
            if let Some((_, end)) = step.surface.filter(|(member, _)| *member == self.number)
                && let Some(at) = FacetRoot::on(span, end.root, end.facet)?
            {
                return Ok(Some(Met { at, enters: step.enters }));
            }
        }
        Ok(None)
    }
}

fn located<N>(met: Option<Met<N>>) -> Option<(crate::exact::Located, u32, bool)> {
    met.map(|met| (met.at.at, met.at.facet, met.enters))
}

#[cfg(test)]
mod tests;
