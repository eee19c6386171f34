//! Which parts of a line are hidden behind what was traced?

use crate::depth::DepthField;
use crate::projection::{Projection, Spot};
use catoptra_core::glam::DVec3;

/// Pixels between two looks at the depth field, on a display of scale 1.
const STEP: f64 = 4.0;
/// Most looks along one line.
const MOST: f64 = 4096.0;

/// A view, how far each of its pixels sees, and how fine its pixels are.
#[derive(Clone, Copy)]
pub(crate) struct Sight<'a> {
    pub(crate) view: &'a Projection,
    pub(crate) depth: Option<DepthField<'a>>,
    /// Pixels in a pixel of a display of scale 1.
    pub(crate) scale: f32,
}

impl Sight<'_> {
    /// Whether a point of the world is hidden behind a traced surface.
    pub(crate) fn hides(&self, point: DVec3) -> bool {
        self.view.project(point).is_some_and(|seen| self.covers(seen.x, seen.y, seen.distance))
    }

    /// Tells a line's parts in order, each with whether it is hidden; one look every four pixels.
    pub(crate) fn split(&self, from: Spot, to: Spot, mut part: impl FnMut(Spot, Spot, bool)) {
        let looks = match self.depth {
            Some(_) => (from.pixels_to(to) / (STEP * f64::from(self.scale))).ceil().clamp(1.0, MOST),
            None => 1.0,
        };
        let at = |look: f64| from.towards(to, look / looks);
        let (mut start, mut hidden) = (from, self.hides_spot(at(0.5)));
        for look in 1..looks as u32 {
            let next = self.hides_spot(at(f64::from(look) + 0.5));
            if next != hidden {
                let end = at(f64::from(look));
                part(start, end, hidden);
                (start, hidden) = (end, next);
            }
        }
        part(start, to, hidden);
    }

    fn hides_spot(&self, spot: Spot) -> bool {
        self.depth.is_some() && self.covers(spot.x, spot.y, self.view.distance(spot))
    }

    fn covers(&self, x: f64, y: f64, distance: f64) -> bool {
        self.depth.is_some_and(|depth| depth.hides(x / self.view.width(), y / self.view.height(), distance))
    }
}
