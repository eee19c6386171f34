//! How far is a thing moved, turned or scaled when the pointer pulls from one pixel to another? Pure geometry.

use super::{Axis, Constraint, Manipulator, Tool};
use crate::projection::Projection;
use catoptra_core::glam::DVec3;
use catoptra_core::{InvalidPart, Placement};
use std::f64::consts::PI;

/// A plane nearer to edge-on than this, as a sine, tells no angle: then the pointer's turn about the pivot does.
const EDGE_ON: f64 = 0.2;

/// The least and the most that one pull scales by.
const FACTORS: [f64; 2] = [1e-3, 1e3];

/// What is done to a thing, about a pivot and along axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion {
    /// Metres along each of the axes.
    Move(DVec3),
    /// Radians about a unit vector of the world, right-handed.
    Turn {
        /// About what.
        axis: DVec3,
        /// How far.
        angle: f64,
    },
    /// How many times as large.
    Scale(f64),
}

impl Manipulator {
    /// What comes of a pull from a pixel to another; `None` where it says nothing, as along an axis seen end-on.
    #[must_use]
    pub fn motion(
        &self,
        view: &Projection,
        constraint: Constraint,
        (from, to): ((f64, f64), (f64, f64)),
    ) -> Option<Motion> {
        let motion = match self.tool {
            Tool::Move => self.moved(view, constraint, from, to)?,
            Tool::Turn => self.turned(view, constraint, from, to)?,
            Tool::Scale => self.scaled(view, from, to)?,
        };
        motion.is_finite().then_some(motion)
    }

    /// What typing a number does, in metres, degrees or as a factor: along the first axis that is free to go.
    #[must_use]
    pub fn typed(&self, view: &Projection, constraint: Constraint, number: f64) -> Motion {
        match self.tool {
            Tool::Move => {
                let axis = match constraint {
                    Constraint::Free => Axis::X,
                    Constraint::Along(axis) => axis,
                    Constraint::Across(axis) => axis.others()[0],
                };
                Motion::Move(Self::WORLD[axis.index()] * number)
            }
            Tool::Turn => {
                Motion::Turn { axis: self.turns_about(view, constraint), angle: number.to_radians() }
            }
            Tool::Scale => Motion::Scale(number.abs().clamp(FACTORS[0], FACTORS[1])),
        }
    }

    fn moved(
        &self,
        view: &Projection,
        constraint: Constraint,
        from: (f64, f64),
        to: (f64, f64),
    ) -> Option<Motion> {
        if let Constraint::Along(axis) = constraint {
            let line = (self.pivot, self.axis(axis));
            let by = crate::grip::along(view, line, to)? - crate::grip::along(view, line, from)?;
            return Some(Motion::Move(Self::WORLD[axis.index()] * by));
        }
        let normal = match constraint {
            Constraint::Across(axis) => self.axis(axis),
            _ => view.direction(0.5 * view.width(), 0.5 * view.height()),
        };
        let by = self.on_plane(view, normal, to)? - self.on_plane(view, normal, from)?;
        let mut parts = DVec3::from_array(self.axes.map(|axis| axis.dot(by)));
        if let Constraint::Across(axis) = constraint {
            // But for rounding it is 0 already.
            parts[axis.index()] = 0.0;
        }
        Some(Motion::Move(parts))
    }

    fn turned(
        &self,
        view: &Projection,
        constraint: Constraint,
        from: (f64, f64),
        to: (f64, f64),
    ) -> Option<Motion> {
        let axis = self.turns_about(view, constraint);
        let facing = axis.dot(self.sight(view));
        let by_plane = || {
            let arm = |pixel| Some((self.on_plane(view, axis, pixel)? - self.pivot).normalize_or_zero());
            let (a, b) = (arm(from)?, arm(to)?);
            Some(axis.dot(a.cross(b)).atan2(a.dot(b)))
        };
        let plane = if facing.abs() > EDGE_ON { by_plane() } else { None };
        let angle = match plane {
            Some(angle) => angle,
            None => {
                let pivot = view.project(self.pivot)?;
                let at = |(x, y): (f64, f64)| (y - pivot.y).atan2(x - pivot.x);
                // Seen clockwise, as y points down: that is right-handed about what points away.
                let clockwise = (at(to) - at(from) + PI).rem_euclid(2.0 * PI) - PI;
                if facing >= 0.0 { clockwise } else { -clockwise }
            }
        };
        Some(Motion::Turn { axis, angle })
    }

    fn scaled(&self, view: &Projection, from: (f64, f64), to: (f64, f64)) -> Option<Motion> {
        let pivot = view.project(self.pivot)?;
        let off = |(x, y): (f64, f64)| (x - pivot.x).hypot(y - pivot.y);
        let factor = off(to) / off(from).max(1.0);
        Some(Motion::Scale(factor.clamp(FACTORS[0], FACTORS[1])))
    }

    /// The unit vector that a turn goes about: an axis, or the line of sight, towards the eye.
    fn turns_about(&self, view: &Projection, constraint: Constraint) -> DVec3 {
        match constraint {
            Constraint::Along(axis) | Constraint::Across(axis) => self.axis(axis),
            Constraint::Free => -self.sight(view),
        }
    }

    /// Where the ray through a pixel meets a plane through the pivot; `None` behind the eye and along the plane.
    fn on_plane(&self, view: &Projection, normal: DVec3, (x, y): (f64, f64)) -> Option<DVec3> {
        let ray = view.direction(x, y);
        let t = (self.pivot - view.eye()).dot(normal) / ray.dot(normal);
        (t > 0.0 && t.is_finite()).then(|| view.eye() + ray * t)
    }
}

impl Motion {
    fn is_finite(self) -> bool {
        match self {
            Self::Move(by) => by.is_finite(),
            Self::Turn { axis, angle } => axis.is_finite() && angle.is_finite(),
            Self::Scale(factor) => factor.is_finite(),
        }
    }

    /// In whole steps of so many metres, of radians, or of a factor.
    #[must_use]
    pub fn in_steps(self, metres: f64, radians: f64, factor: f64) -> Self {
        let whole = |value: f64, step: f64| if step > 0.0 { (value / step).round() * step } else { value };
        match self {
            Self::Move(by) => Self::Move(by.map(|part| whole(part, metres))),
            Self::Turn { axis, angle } => Self::Turn { axis, angle: whole(angle, radians) },
            Self::Scale(by) => Self::Scale(whole(by, factor).max(factor.max(FACTORS[0]))),
        }
    }

    /// The same in the space of a group or a thing that is placed so in the world: a placement there that moves, turns or
    /// scales about the manipulator's pivot.
    ///
    /// # Errors
    /// What leads beyond all numbers.
    pub fn within(self, manipulator: &Manipulator, outer: &Placement) -> Result<Placement, InvalidPart> {
        let inner = outer.inverse();
        let about = inner.point(manipulator.pivot);
        match self {
            Self::Move(by) => {
                let [x, y, z] = manipulator.axes;
                Placement::IDENTITY.moved(inner.vector(x * by.x + y * by.y + z * by.z))
            }
            Self::Turn { axis, angle } => Placement::IDENTITY.turned(about, inner.direction(axis), angle),
            Self::Scale(factor) => Placement::IDENTITY.moved(-about)?.scaled(factor)?.moved(about),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use catoptra_core::glam::DQuat;

    fn view() -> Projection {
        Projection::new(&sample::camera(), sample::WIDTH, sample::HEIGHT)
    }

    fn tilted(tool: Tool) -> Manipulator {
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 0.5).normalize(), 0.6);
        Manipulator {
            tool,
            pivot: DVec3::new(0.5, 1.5, 0.3),
            axes: Manipulator::WORLD.map(|axis| turn * axis),
        }
    }

    fn seen(point: DVec3) -> (f64, f64) {
        let seen = view().project(point).unwrap();
        (seen.x, seen.y)
    }

    /// Where a motion takes a point.
    fn goes(manipulator: &Manipulator, motion: Motion, point: DVec3) -> DVec3 {
        motion.within(manipulator, &Placement::IDENTITY).unwrap().point(point)
    }

    #[test]
    fn what_is_pulled_stays_under_the_pointer() {
        let m = tilted(Tool::Move);
        for axis in Axis::ALL {
            let start = m.pivot + m.axis(axis) * 0.2;
            let wanted = start + m.axis(axis) * 0.7;
            let motion = m.motion(&view(), Constraint::Along(axis), (seen(start), seen(wanted))).unwrap();
            assert!((goes(&m, motion, start) - wanted).length() < 1e-9, "along {axis:?}");
            let [u, v] = axis.others().map(|other| m.axis(other));
            let (start, wanted) = (m.pivot + u * 0.3 + v * 0.2, m.pivot - u * 0.1 + v * 0.6);
            let motion = m.motion(&view(), Constraint::Across(axis), (seen(start), seen(wanted))).unwrap();
            assert!((goes(&m, motion, start) - wanted).length() < 1e-9, "across {axis:?}");
            assert!(matches!(motion, Motion::Move(by) if by[axis.index()] == 0.0));
        }
        let (from, to) = (seen(m.pivot), (40.0, 70.0));
        let motion = m.motion(&view(), Constraint::Free, (from, to)).unwrap();
        let (x, y) = seen(goes(&m, motion, m.pivot));
        assert!((x - to.0).abs() < 1e-9 && (y - to.1).abs() < 1e-9);
    }

    #[test]
    fn a_ring_turns_with_the_pointer() {
        let m = tilted(Tool::Turn);
        for axis in Axis::ALL {
            let turn = |angle: f64| DQuat::from_axis_angle(m.axis(axis), angle);
            let start = m.pivot + m.axis(axis.others()[0]) * 0.5;
            for angle in [-2.5, -0.4, 0.9] {
                let wanted = m.pivot + turn(angle) * (start - m.pivot);
                let pull = (seen(start), seen(wanted));
                let motion = m.motion(&view(), Constraint::Along(axis), pull).unwrap();
                let Motion::Turn { angle: found, .. } = motion else { panic!("{motion:?}") };
                assert!((found - angle).abs() < 1e-9, "{axis:?} by {angle}: {found}");
                assert!((goes(&m, motion, start) - wanted).length() < 1e-9);
            }
        }
    }

    #[test]
    fn a_free_turn_follows_the_pointer_about_the_pivot() {
        let m = tilted(Tool::Turn);
        let start = m.pivot + DVec3::X * 0.3;
        let (x, y) = seen(m.pivot);
        let (from, to) = ((x + 50.0, y), (x, y - 50.0));
        let motion = m.motion(&view(), Constraint::Free, (from, to)).unwrap();
        let Motion::Turn { angle, .. } = motion else { panic!("{motion:?}") };
        assert!((angle - 0.5 * PI).abs() < 0.05, "{angle}");
        assert!(seen(goes(&m, motion, start)).1 < y - 2.0, "what was right of the pivot is above it");
    }

    #[test]
    fn scale_is_the_distance_from_the_pivot() {
        let m = tilted(Tool::Scale);
        let (x, y) = seen(m.pivot);
        let motion = m.motion(&view(), Constraint::Free, ((x + 40.0, y), (x, y + 60.0))).unwrap();
        assert!(matches!(motion, Motion::Scale(factor) if (factor - 1.5).abs() < 1e-9));
        assert_eq!(goes(&m, motion, m.pivot), m.pivot);
    }

    #[test]
    fn steps_and_typed_numbers_are_exact() {
        let moved = Motion::Move(DVec3::new(0.26, -0.74, 0.0)).in_steps(0.5, 0.0, 0.0);
        assert_eq!(moved, Motion::Move(DVec3::new(0.5, -0.5, 0.0)));
        let turned = Motion::Turn { axis: DVec3::Y, angle: 0.4 }.in_steps(1.0, PI / 12.0, 0.1);
        assert!(matches!(turned, Motion::Turn { angle, .. } if (angle - PI / 6.0).abs() < 1e-12));
        assert!(matches!(Motion::Scale(0.01).in_steps(1.0, 1.0, 0.1), Motion::Scale(by) if by == 0.1));
        let m = tilted(Tool::Move);
        assert_eq!(m.typed(&view(), Constraint::Along(Axis::Z), 2.0), Motion::Move(DVec3::Z * 2.0));
        assert_eq!(m.typed(&view(), Constraint::Across(Axis::X), 2.0), Motion::Move(DVec3::Y * 2.0));
        assert_eq!(tilted(Tool::Scale).typed(&view(), Constraint::Free, 2.0), Motion::Scale(2.0));
    }

    #[test]
    fn in_a_group_the_world_sees_the_same() {
        let outer = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::new(1.0, 0.4, 0.2), 0.7).unwrap();
        let outer = outer.scaled(1.5).unwrap().moved(DVec3::new(0.3, 0.6, -1.0)).unwrap();
        let point = DVec3::new(0.2, 0.9, 0.1);
        for (tool, motion) in [
            (Tool::Move, Motion::Move(DVec3::new(0.3, -0.2, 0.5))),
            (Tool::Turn, Motion::Turn { axis: DVec3::new(0.6, 0.8, 0.0), angle: 0.8 }),
            (Tool::Scale, Motion::Scale(1.7)),
        ] {
            let m = tilted(tool);
            let inner = motion.within(&m, &outer).unwrap();
            let by_group = outer.point(inner.point(outer.inverse().point(point)));
            assert!((by_group - goes(&m, motion, point)).length() < 1e-12, "{tool:?}");
        }
    }
}
