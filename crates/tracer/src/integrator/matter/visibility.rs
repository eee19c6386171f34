//! How much light comes through between two points?
//!
//! Opaque surfaces let nothing through and cut-outs what they leave open. Clear matter bends light, so that none comes straight
//! through; as an approximation it may be let through without being bent, with what its surfaces and its inside leave of it.

use catoptra_core::{Ray, Rgb, Span};

use super::{Media, Met, PathRay};
use crate::SurfaceId;
use crate::integrator::Search;
use crate::integrator::walker::Walker;

/// Surfaces that a shadow ray may pass before it counts as blocked.
const MOST_SURFACES: usize = 4096;

impl<S: Search> Walker<'_, S> {
    /// The share of light per channel that comes along a stretch of a ray; `through_glass` as the head of the file says.
    pub(super) fn comes_through(
        &self,
        (ray, span): (Ray, Span),
        leaving: Option<SurfaceId>,
        media: &Media,
        through_glass: bool,
    ) -> Rgb {
        let snapshot = self.frame.snapshot;
        if !snapshot.matter().is_see_through {
            let blocked = self.search.occluded(snapshot, &ray, span, leaving);
            return if blocked { Rgb::BLACK } else { Rgb::WHITE };
        }
        let mut path = PathRay::new(ray, leaving, media.clone());
        let mut left = span.max;
        for _ in 0..MOST_SURFACES {
            let rest = Span { max: left, ..span };
            let Some(hit) = self.search.nearest(snapshot, &path.ray, rest, path.leaving) else {
                let metres = if left.is_finite() { left * ray.direction.length() } else { f64::INFINITY };
                return path.weight * path.media.left_after(snapshot, metres);
            };
            left -= hit.crossing.t;
            if !snapshot.matter().row(&snapshot.prims()[hit.surface.prim as usize]).is_see_through() {
                return Rgb::BLACK;
            }
            match self.arrive(path, Some(hit), None) {
                Met::Nothing(_) => return Rgb::BLACK,
                Met::Passed(on) => path = on,
                Met::Surface(vertex, on) => {
                    let mut share = Rgb::grey(1.0 - vertex.opacity);
                    if through_glass {
                        for way in vertex.bsdf.rays().iter().filter(|way| way.is_transmitted) {
                            share += way.weight * vertex.opacity;
                        }
                    }
                    let weight = on.weight * share;
                    if !(weight.max_channel() > 0.0) {
                        return Rgb::BLACK;
                    }
                    let point = vertex.surface.point;
                    let media = if vertex.opacity > 0.0 { vertex.behind } else { on.media.clone() };
                    path = PathRay { weight, media, ..on.straight_on(&hit, point) };
                }
            }
        }
        Rgb::BLACK
    }
}
