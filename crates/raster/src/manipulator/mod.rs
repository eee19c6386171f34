//! By what is a thing moved, turned or scaled in the picture? Arrows, squares, rings and a circle about a pivot, and which of
//! them is under the pointer.

mod motion;

pub use motion::Motion;

use crate::outline::outwards;
use crate::projection::Projection;
use catoptra_core::glam::DVec3;
use std::f64::consts::TAU;

/// What is done to a thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Tool {
    /// It goes elsewhere.
    Move,
    /// It turns about the pivot.
    Turn,
    /// It grows or shrinks, alike in all directions, about the pivot.
    Scale,
}

/// One of three axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

/// Along what a thing moves, or about what it turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Constraint {
    /// In the plane of the picture, or about the line of sight.
    Free,
    /// Along an axis, or about it.
    Along(Axis),
    /// In the plane across an axis, or about that axis.
    Across(Axis),
}

/// Handles about a pivot, of constant size in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Manipulator {
    /// What its handles do.
    pub tool: Tool,
    /// Where it stands in the world.
    pub pivot: DVec3,
    /// The directions of its axes: of length 1, each across the others.
    pub axes: [DVec3; 3],
}

/// Length of an arrow, radius of a ring and of the circle of scale, in pixels of a display of scale 1.
pub(crate) const ARROW: f64 = 78.0;
pub(crate) const RING: f64 = 66.0;
/// From where to where along both axes the square of a plane lies.
pub(crate) const SQUARE: [f64; 2] = [20.0, 34.0];
/// Arrows begin so far from the pivot: what stands there can be clicked.
pub(crate) const GAP: f64 = 12.0;
/// Pixels about a line within which it is gripped.
const REACH: f64 = 7.0;
/// Corners of a ring.
const CORNERS: u32 = 64;
/// An axis nearer to the line of sight than this, as a cosine, is no line to pull along, and the plane beside it is no plane
/// to pull in.
const END_ON: f64 = 0.985;

impl Axis {
    /// All three.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// Its number, from 0.
    #[must_use]
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Its letter.
    #[must_use]
    pub const fn letter(self) -> char {
        ['x', 'y', 'z'][self.index()]
    }

    /// The two others.
    #[must_use]
    pub const fn others(self) -> [Self; 2] {
        match self {
            Self::X => [Self::Y, Self::Z],
            Self::Y => [Self::Z, Self::X],
            Self::Z => [Self::X, Self::Y],
        }
    }
}

impl Manipulator {
    /// The axes of the world.
    pub const WORLD: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];

    /// The direction of an axis.
    #[must_use]
    pub fn axis(&self, axis: Axis) -> DVec3 {
        self.axes[axis.index()]
    }

    /// The handle under the pixel (`x`, `y`) of a display with `scale` pixels to a pixel, if there is one.
    #[must_use]
    pub fn handle_at(&self, view: &Projection, (x, y): (f64, f64), scale: f64) -> Option<Constraint> {
        let near = |off: f64| off <= REACH * scale;
        // An arrow that points at the eye begins right at the pivot, as it is seen.
        let pivot = view.project(self.pivot)?;
        if (pivot.x - x).hypot(pivot.y - y) < (GAP - REACH) * scale {
            return None;
        }
        match self.tool {
            Tool::Move => {
                let planes = Axis::ALL.into_iter().filter(|axis| {
                    self.square(view, *axis, scale).is_some_and(|corners| holds(view, &corners, (x, y)))
                });
                let plane = planes.map(Constraint::Across).next();
                plane.or_else(|| {
                    let lines = Axis::ALL.into_iter().filter_map(|axis| {
                        let line = self.arrow(view, axis, scale)?;
                        Some((off_line(view, &line, (x, y))?, Constraint::Along(axis)))
                    });
                    nearest(lines.filter(|(off, _)| near(*off)))
                })
            }
            Tool::Turn => {
                let rings = Axis::ALL.into_iter().filter_map(|axis| {
                    let ring = self.ring(view, self.axis(axis), RING, scale)?;
                    Some((off_line(view, &ring, (x, y))?, Constraint::Along(axis)))
                });
                nearest(rings.filter(|(off, _)| near(*off)))
            }
            Tool::Scale => {
                let circle = self.circle(view, scale)?;
                off_line(view, &circle, (x, y)).filter(|off| near(*off)).map(|_| Constraint::Free)
            }
        }
    }

    /// The ends of the arrow along an axis; `None` where it is seen end-on or stands behind the eye.
    pub(crate) fn arrow(&self, view: &Projection, axis: Axis, scale: f64) -> Option<[DVec3; 2]> {
        let pixel = self.pixel(view, scale)?;
        let direction = self.axis(axis);
        let seen_end_on = direction.dot(self.sight(view)).abs() > END_ON;
        (!seen_end_on).then(|| [GAP, ARROW].map(|length| self.pivot + direction * (length * pixel)))
    }

    /// The corners of the square in the plane across an axis; `None` where it is seen edge-on.
    pub(crate) fn square(&self, view: &Projection, axis: Axis, scale: f64) -> Option<[DVec3; 4]> {
        let pixel = self.pixel(view, scale)?;
        let edge_on = self.axis(axis).dot(self.sight(view)).abs() < (1.0 - END_ON * END_ON).sqrt();
        let [u, v] = axis.others().map(|other| self.axis(other));
        let [near, far] = SQUARE;
        let corner = |(a, b): (f64, f64)| self.pivot + (u * a + v * b) * pixel;
        (!edge_on).then(|| [(near, near), (far, near), (far, far), (near, far)].map(corner))
    }

    /// A circle about the pivot and a unit vector, as a closed line.
    pub(crate) fn ring(
        &self,
        view: &Projection,
        about: DVec3,
        radius: f64,
        scale: f64,
    ) -> Option<Vec<DVec3>> {
        let radius = radius * self.pixel(view, scale)?;
        let at = |step: u32| outwards(about, TAU * f64::from(step % CORNERS) / f64::from(CORNERS));
        Some((0..=CORNERS).map(|step| self.pivot + at(step) * radius).collect())
    }

    /// The circle that faces the eye, by which a thing is scaled.
    pub(crate) fn circle(&self, view: &Projection, scale: f64) -> Option<Vec<DVec3>> {
        self.ring(view, self.sight(view), RING, scale)
    }

    /// Metres that a pixel of an ordinary display spans at the pivot.
    fn pixel(&self, view: &Projection, scale: f64) -> Option<f64> {
        view.metres_per_pixel(self.pivot).map(|pixel| pixel * scale)
    }

    /// The unit vector from the eye to the pivot.
    pub(crate) fn sight(&self, view: &Projection) -> DVec3 {
        (self.pivot - view.eye()).normalize_or(view.direction(0.5 * view.width(), 0.5 * view.height()))
    }
}

fn nearest(handles: impl Iterator<Item = (f64, Constraint)>) -> Option<Constraint> {
    handles.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, constraint)| constraint)
}

/// Pixels from a pointer to a line through points of the world.
fn off_line(view: &Projection, line: &[DVec3], pointer: (f64, f64)) -> Option<f64> {
    crate::grip::nearest_on(view, line, pointer).map(|(off, ..)| off)
}

/// Whether a convex outline of points of the world holds a pixel.
fn holds(view: &Projection, corners: &[DVec3; 4], (x, y): (f64, f64)) -> bool {
    let Some(seen) = corners.iter().map(|corner| view.project(*corner)).collect::<Option<Vec<_>>>() else {
        return false;
    };
    let side = |i: usize| {
        let (a, b) = (seen[i], seen[(i + 1) % seen.len()]);
        (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)
    };
    let sides = [0, 1, 2, 3].map(side);
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    fn view() -> Projection {
        Projection::new(&sample::camera(), sample::WIDTH, sample::HEIGHT)
    }

    fn manipulator(tool: Tool) -> Manipulator {
        Manipulator { tool, pivot: DVec3::new(0.5, 1.5, 0.3), axes: Manipulator::WORLD }
    }

    #[test]
    fn handles_are_gripped_where_they_are_drawn() {
        let view = view();
        for scale in [1.0, 2.0] {
            let held = |tool: Tool, at: DVec3| {
                let seen = view.project(at).unwrap();
                manipulator(tool).handle_at(&view, (seen.x, seen.y), scale)
            };
            let arrows = manipulator(Tool::Move);
            for axis in [Axis::X, Axis::Y] {
                let [_, tip] = arrows.arrow(&view, axis, scale).unwrap();
                assert_eq!(held(Tool::Move, tip), Some(Constraint::Along(axis)));
            }
            let corners = arrows.square(&view, Axis::Z, scale).unwrap();
            let middle = corners.iter().sum::<DVec3>() / 4.0;
            assert_eq!(held(Tool::Move, middle), Some(Constraint::Across(Axis::Z)));
            let ring = manipulator(Tool::Turn).ring(&view, DVec3::Z, RING, scale).unwrap();
            // Off the axes, where rings cross.
            assert_eq!(held(Tool::Turn, ring[8]), Some(Constraint::Along(Axis::Z)));
            let circle = manipulator(Tool::Scale).circle(&view, scale).unwrap();
            assert_eq!(held(Tool::Scale, circle[5]), Some(Constraint::Free));
        }
    }

    #[test]
    fn what_stands_at_the_pivot_can_be_clicked_from_wherever_it_is_seen() {
        let view = view();
        for tool in [Tool::Move, Tool::Scale] {
            for place in 0..100 {
                let pivot = DVec3::new(f64::from(place % 10) - 4.5, f64::from(place / 10) * 0.5, 0.3);
                let seen = view.project(pivot).unwrap();
                let handles = Manipulator { pivot, ..manipulator(tool) };
                assert_eq!(handles.handle_at(&view, (seen.x, seen.y), 1.0), None, "{tool:?} at {pivot}");
            }
        }
    }

    #[test]
    fn an_axis_that_is_seen_end_on_has_no_arrow() {
        let ahead = Manipulator { pivot: DVec3::new(0.0, 2.0, 0.0), ..manipulator(Tool::Move) };
        assert!(ahead.arrow(&view(), Axis::Z, 1.0).is_none() && ahead.arrow(&view(), Axis::X, 1.0).is_some());
        assert!(ahead.square(&view(), Axis::X, 1.0).is_none());
        let behind = Manipulator { pivot: DVec3::Z * 20.0, ..ahead };
        assert_eq!(behind.handle_at(&view(), (160.0, 120.0), 1.0), None);
    }
}
