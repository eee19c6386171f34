//! Where does a line run inside a shape that encloses something?

use std::cmp::Ordering;

use smallvec::SmallVec;

use crate::exact::{Number, Root, Verdict};
use crate::geometry::{FacetRoot, Geometry};
use crate::{Ray, Span};

/// Where a line comes into a shape and out of it.
#[derive(Debug, Clone)]
pub struct Passage<N> {
    /// Whether the line begins inside.
    pub inside: bool,
    /// Where it comes in or goes out, in turn, in order; two in one place where it touches the shape.
    pub ends: SmallVec<[End<N>; 2]>,
}

/// A place on a line where it crosses the surface of a shape.
#[derive(Debug, Clone)]
pub struct End<N> {
    /// Where, as an equation's root.
    pub root: Root<N>,
    /// Which flat piece of the shape.
    pub facet: u32,
}

impl<N> Passage<N> {
    /// Of a line that passes by.
    #[must_use]
    pub fn by() -> Self {
        Self { inside: false, ends: SmallVec::new() }
    }
}

impl<N: Number> Passage<N> {
    /// What of a whole line's passage is ahead of a ray that leaves some facets in one plane, of which is told whether the ray
    /// runs to the outer side of them (`Greater`) or to the inner one.
    ///
    /// All up to where the line crosses such a facet is behind the ray, and as rounding may have put its origin beside the surface,
    /// a first end that would not be one on the side that the ray runs to is none.
    ///
    /// # Errors
    /// When such numbers cannot decide what is ahead.
    pub(crate) fn after_leaving(mut self, leaves: impl Fn(u32) -> bool, side: Ordering) -> Verdict<Self> {
        let mut behind = 0;
        for (place, end) in self.ends.iter().enumerate() {
            if leaves(end.facet) || end.root.side(&N::of(0.0), &N::of(1.0))?.is_le() {
                behind = place + 1;
            }
        }
        let is_inside = |behind: usize| self.inside != (behind % 2 == 1);
        if side.is_ne() && is_inside(behind) != side.is_lt() && behind < self.ends.len() {
            behind += 1;
        }
        self.inside = is_inside(behind);
        self.ends.drain(..behind);
        Ok(self)
    }
}

impl<N> From<FacetRoot<N>> for End<N> {
    fn from(found: FacetRoot<N>) -> Self {
        Self { root: found.root, facet: found.facet }
    }
}

/// Every place of a line.
const LINE: Span = Span { min: f64::NEG_INFINITY, max: f64::INFINITY };

/// The passage of a ray's line through a convex shape, in the shape's own space: it comes in where it meets the shape first,
/// and goes out where the line the other way meets it first. A ray that `leaving` says to leave a facet inwards begins inside,
/// whatever rounding has made of its origin, and one that leaves outwards passes by.
pub(crate) fn convex<N: Number>(
    shape: &impl Geometry,
    own: &Ray,
    leaving: Option<u32>,
) -> Verdict<Passage<N>> {
    let inwards = leaving.is_some();
    let enters = match leaving {
        None => first_on::<N>(shape, own, LINE, None)?,
        Some(_) => first_on(shape, own, Span::AHEAD, leaving)?,
    };
    let Some(enters) = enters else { return Ok(Passage::by()) };
    let Some(back) = first_on::<N>(shape, &Ray::new(own.origin, -own.direction), LINE, None)? else {
        return Ok(Passage::by());
    };
    let out = End { root: back.root.negated(), facet: back.facet };
    let ends = if inwards { SmallVec::from_iter([out]) } else { SmallVec::from([enters.into(), out]) };
    Ok(Passage { inside: inwards, ends })
}

/// The first place where a ray meets any piece of a shape.
fn first_on<N: Number>(
    shape: &impl Geometry,
    own: &Ray,
    span: Span,
    leaving: Option<u32>,
) -> Verdict<Option<FacetRoot<N>>> {
    let mut first: Option<FacetRoot<N>> = None;
    for piece in 0..shape.pieces() {
        let Some(next) = shape.nearest_root::<N>(piece, own, span, leaving)? else { continue };
        let sooner = match &first {
            None => true,
            Some(first) => next.root.compare(&first.root)?.is_lt(),
        };
        if sooner {
            first = Some(next);
        }
    }
    Ok(first)
}
