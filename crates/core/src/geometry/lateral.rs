//! The round side between two ends of an axis, a cylinder's or a cone's: where does a ray meet it, and where does it leave
//! the solid behind it?
//!
//! With a the axis from end to end, o and d the ray as seen from the lower end, m = o × a, n = d × a, h = o·a and e = d·a, a
//! point o + t d lies at the height h + t e of 0 to a², at |m + t n| / |a| from the axis. A side whose radius goes from r to
//! r + k is where a² |m + t n|² = (G + t E)², with G = r a² + k h and E = k e: an equation A t² + 2 B t + C = 0 that is negative
//! inside. Its discriminant B² − A C is a² (|G n − E m|² − (a² w)²), where w = o·n is the volume that ray and axis span: a
//! form that keeps its digits far from the axis, as that of the sphere does. Of a cylinder, k is 0, and a² is taken out.

use std::cmp::Ordering;

use glam::DVec3;

use super::FacetRoot;
use super::plane::plane_root;
use crate::exact::{Number, Radical, Root, Vector, Verdict};
use crate::{Ray, Span};

/// Which facet the round side is; the caps at the lower and the upper end follow it.
pub(super) const SIDE: u32 = 0;

/// The cap at the lower end.
pub(super) const LOWER: u32 = 1;

/// The cap at the upper end.
pub(super) const UPPER: u32 = 2;

/// A ray as seen from a round side.
#[derive(Debug)]
pub(super) struct Lateral<N> {
    /// A, B and C.
    square: N,
    half: N,
    constant: N,
    discriminant: N,
    /// h, e and a².
    height: N,
    climb: N,
    top: N,
}

/// Through which of the two ends of a chord a line goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    In,
    Out,
}

/// Where a ray that runs within a solid leaves it.
#[derive(Debug)]
pub(super) enum WayOut<N> {
    /// Through the side.
    Side(Root<N>),
    /// Beyond this end of the side.
    Cap(u32),
    /// Rounding has put its origin beside the solid.
    Nowhere,
}

impl<N: Number> WayOut<N> {
    /// The way out as far as it goes through one piece, of a ray that has left another; `cap` is a cap's middle and its normal.
    pub(super) fn through(
        self,
        [piece, left]: [u32; 2],
        own: &Ray,
        span: Span,
        cap: impl FnOnce(u32) -> (DVec3, Vector<N>),
    ) -> Verdict<Option<FacetRoot<N>>> {
        let root = match self {
            Self::Side(root) if piece == SIDE => Some(root),
            Self::Cap(out) if piece == out && out != left => {
                let (center, normal) = cap(out);
                plane_root(center, &normal, own)?
            }
            Self::Side(_) | Self::Cap(_) | Self::Nowhere => None,
        };
        root.map_or(Ok(None), |root| FacetRoot::on(span, root, piece))
    }
}

impl<N: Number> Lateral<N> {
    /// Of a cylinder.
    pub(super) fn of_cylinder([from, to]: [DVec3; 2], radius: f64, ray: &Ray) -> Self {
        let axis = Vector::<N>::of(to).minus(&Vector::of(from));
        let (o, d) = (Vector::of(ray.origin).minus(&Vector::of(from)), Vector::of(ray.direction));
        let (m, n, top) = (o.cross(&axis), d.cross(&axis), axis.squared());
        let (square, radius2) = (n.squared(), N::of(radius).squared());
        Self {
            discriminant: top.times(&radius2.times(&square).minus(&o.dot(&n).squared())),
            half: m.dot(&n),
            constant: m.squared().minus(&radius2.times(&top)),
            square,
            height: o.dot(&axis),
            climb: d.dot(&axis),
            top,
        }
    }

    /// Of a cone with a radius at each end.
    pub(super) fn of_cone([from, to]: [DVec3; 2], radii: [f64; 2], ray: &Ray) -> Self {
        let axis = Vector::<N>::of(to).minus(&Vector::of(from));
        let (o, d) = (Vector::of(ray.origin).minus(&Vector::of(from)), Vector::of(ray.direction));
        let (m, n, top) = (o.cross(&axis), d.cross(&axis), axis.squared());
        let (height, climb) = (o.dot(&axis), d.dot(&axis));
        let [lower, upper] = radii.map(N::of);
        let growth = upper.minus(&lower);
        let (g, e) = (lower.times(&top).plus(&growth.times(&height)), growth.times(&climb));
        let spread = n.scaled(&g).minus(&m.scaled(&e)).squared();
        let volume = top.times(&o.dot(&n));
        Self {
            square: top.times(&n.squared()).minus(&e.squared()),
            half: top.times(&m.dot(&n)).minus(&g.times(&e)),
            constant: top.times(&m.squared()).minus(&g.squared()),
            discriminant: top.times(&spread.minus(&volume.squared())),
            height,
            climb,
            top,
        }
    }

    /// Where a ray meets the side between its ends first.
    pub(super) fn nearest(&self, span: Span) -> Verdict<Option<FacetRoot<N>>> {
        // Outside the equation of a cone is negative in both its halves: a steep line leaves the one and enters the other.
        let order = if self.square.sign()?.is_lt() { [End::Out, End::In] } else { [End::In, End::Out] };
        for end in order {
            if let Some(root) = self.end(end)?
                && self.beyond(&root)?.is_none()
                && let Some(found) = FacetRoot::on(span, root, SIDE)?
            {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    /// Where a line comes to the inner or to the outer side, of the side without an end: (−B ∓ √(B² − A C)) / A.
    pub(super) fn end(&self, end: End) -> Verdict<Option<Root<N>>> {
        let way = match end {
            End::In => Ordering::Less,
            End::Out => Ordering::Greater,
        };
        let steep = match self.square.sign()? {
            Ordering::Equal if self.half.sign()? == way => {
                return Root::ratio(&self.constant.negative(), &self.half.plus(&self.half));
            }
            Ordering::Equal => return Ok(None),
            order => order.is_lt(),
        };
        if self.discriminant.sign()?.is_lt() {
            return Ok(None);
        }
        let turned = |n: &N| if steep { n.negative() } else { n.clone() };
        let radical = Radical {
            positive: (end == End::Out) != steep,
            square: self.discriminant.clone(),
            norm: turned(&self.constant),
        };
        let (rational, divisor) = (turned(&self.half).negative(), turned(&self.square));
        Ok(Some(Root { rational, radical: Some(radical), divisor, isolated: None }))
    }

    /// Whether a ray from the side runs to the solid's inner side.
    pub(super) fn runs_in(&self) -> Verdict<bool> {
        Ok(self.half.sign()?.is_lt())
    }

    /// Whether a ray runs along the axis.
    pub(super) fn is_along(&self) -> Verdict<bool> {
        Ok(self.square.sign()?.is_eq() && self.half.sign()?.is_eq())
    }

    /// How the ray's height changes.
    pub(super) fn climbs(&self) -> Verdict<Ordering> {
        self.climb.sign()
    }

    /// The other end of the chord that a ray from the side goes along on its inner side, at −2 B / A whatever rounding has
    /// made of the distance of its origin; `None` where it goes outwards, or the chord has no other end.
    pub(super) fn chord(&self) -> Verdict<Option<Root<N>>> {
        if !self.runs_in()? || self.square.sign()?.is_le() {
            return Ok(None);
        }
        Root::ratio(&self.half.plus(&self.half).negative(), &self.square)
    }

    /// Which cap a place on the line lies beyond.
    pub(super) fn beyond(&self, root: &Root<N>) -> Verdict<Option<u32>> {
        if root.side(&self.height, &self.climb)?.is_lt() {
            return Ok(Some(LOWER));
        }
        let over = root.side(&self.height.minus(&self.top), &self.climb)?;
        Ok(over.is_gt().then_some(UPPER))
    }

    /// Whether a place on the line lies where a cap beyond an end does, the border with the side included.
    pub(super) fn reaches(&self, root: &Root<N>, cap: u32) -> Verdict<bool> {
        if cap == LOWER {
            return Ok(root.side(&self.height, &self.climb)?.is_le());
        }
        Ok(root.side(&self.height.minus(&self.top), &self.climb)?.is_ge())
    }

    /// How a ray that runs inwards from a facet of the solid leaves it again.
    pub(super) fn way_out(&self, left: u32) -> Verdict<WayOut<N>> {
        let end = if left == SIDE { self.chord()? } else { self.end(End::Out)? };
        if let Some(root) = end
            && root.side(&N::of(0.0), &N::of(1.0))?.is_gt()
        {
            return Ok(self.beyond(&root)?.map_or(WayOut::Side(root), WayOut::Cap));
        }
        // Where the side leaves room for it, the ray goes on to the end that it runs to.
        Ok(match self.climb.sign()? {
            _ if self.square.sign()?.is_gt() => WayOut::Nowhere,
            Ordering::Less => WayOut::Cap(LOWER),
            Ordering::Greater => WayOut::Cap(UPPER),
            Ordering::Equal => WayOut::Nowhere,
        })
    }
}

/// What of a vector lies across a unit axis, as a unit vector: outwards from the axis. Where nothing does, what of the line of
/// sight does, towards the viewer, or else any vector across the axis.
pub(super) fn outwards(from_axis: DVec3, axis: DVec3, sight: DVec3) -> DVec3 {
    let across = |v: DVec3| (v - axis * v.dot(axis)).try_normalize();
    across(from_axis).or_else(|| across(-sight)).unwrap_or_else(|| axis.any_orthonormal_vector())
}

/// Refuses ends of an axis in one place.
pub(super) fn check_axis(from: DVec3, to: DVec3) -> Result<(), crate::InvalidPart> {
    if (to - from).try_normalize().is_some() {
        return Ok(());
    }
    Err(crate::InvalidPart::new("to", "must not be where from is", to))
}
