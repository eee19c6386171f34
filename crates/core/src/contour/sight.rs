//! What does each blocker hide of a lamp, from where the eye is?

use glam::DVec3;

use super::blocker::{Blocker, Kind, Solid, SolidFace};
use super::cone::{Cone, Heights, looks_at};
use super::conic::{Conic, Cut};
use super::held;
use super::lamp::{Face, Flat, Lamp, Round};
use super::place::{self, Place, Within, rounding};
use super::swept::Swept;
use super::view::View;
use super::{Leaving, NoClosedForm, Scratch};

/// A lamp as seen from the eye, and what blockers have left of it so far.
#[derive(Debug)]
pub(super) struct Sight<'a> {
    pub eye: DVec3,
    pub lamp: &'a Lamp,
    pub view: &'a View,
    pub scratch: &'a mut Scratch,
    /// Whether a cone has been taken away.
    pub is_cut: bool,
}

/// Whether anything of the lamp may still be seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Seen {
    Nothing,
    Something,
}

type Answer = Result<Seen, NoClosedForm>;

impl Sight<'_> {
    /// Takes away what a blocker hides.
    pub(super) fn hide(&mut self, blocker: &Blocker, leaving: Leaving) -> Answer {
        match (&blocker.kind, leaving) {
            (Kind::Plane(..) | Kind::Disk(_) | Kind::Polygon(_), Leaving::Facet(_)) => Ok(Seen::Something),
            (Kind::Plane(base, normal), _) => self.hide_plane(*base, *normal),
            (Kind::Disk(disk), _) => self.hide_disk(disk),
            (Kind::Polygon(flat), _) => self.hide_polygon(flat.face()),
            (Kind::Sphere(center, radius), _) => self.hide_sphere(*center, *radius, leaving),
            (Kind::Solid(solid), _) => self.hide_solid(solid, leaving),
            (Kind::Swept(swept), _) => self.hide_swept(swept, leaving),
            (Kind::Ground(normal), _) => {
                let mut cone = Cone::EVERYTHING;
                cone.push_any(-*normal);
                Ok(self.take(&cone))
            }
        }
    }

    fn hide_plane(&mut self, base: DVec3, normal: DVec3) -> Answer {
        let above = normal.dot(self.eye - base);
        if !(above.abs() > held::reach(self.eye, base)) {
            return Ok(Seen::Something);
        }
        let off = rounding(base, self.eye);
        let up = normal * above.signum();
        let [least, most] =
            [-self.lamp.most_along(-up), self.lamp.most_along(up)].map(|at| at - up.dot(base));
        if least >= -off {
            return Ok(Seen::Something);
        }
        if most <= off {
            return Ok(Seen::Nothing);
        }
        if !self.view.is_flat {
            return Err(NoClosedForm::CutsSphere);
        }
        // Where the lamp's plane L·x = H meets the other, N·x = −above: beyond their common line.
        let mut cone = Cone::EVERYTHING;
        cone.push_any(-(up * self.view.height + self.view.away * above.abs()));
        Ok(self.take(&cone))
    }

    fn hide_sphere(&mut self, center: DVec3, radius: f64, leaving: Leaving) -> Answer {
        let from_eye = center - self.eye;
        let is_own = leaving != Leaving::Nothing;
        let is_held = !is_own && held::on_sphere(self.eye, center, radius);
        if is_own && self.view.normal.dot(from_eye) <= 0.0 {
            return Ok(Seen::Something);
        }
        if is_own || is_held || from_eye.length() <= radius {
            return match place::held_by_ball(self.lamp, center, radius) {
                Within::All => Ok(Seen::Something),
                Within::Nothing if is_held => Ok(self.hide_side(from_eye)),
                Within::Nothing => Ok(Seen::Nothing),
                Within::Part => Err(NoClosedForm::PartlyWithin),
            };
        }
        let conic = Conic::outline(self.view.normal, from_eye, radius);
        let place = place::of_sphere(self.eye, self.lamp, center, radius);
        if place == Place::Unknown && place::held_by_ball(self.lamp, center, radius) == Within::All {
            return Ok(Seen::Nothing);
        }
        self.hide_round(conic, place)
    }

    /// Hides what lies on one side of a plane through the eye, given by a vector to that side.
    fn hide_side(&mut self, side: DVec3) -> Seen {
        let mut cone = Cone::EVERYTHING;
        cone.push_any(side);
        match cone.planes() {
            // The horizon hides as much already.
            &[side] if held::are_parallel(side, self.view.normal) && side.dot(self.view.normal) < 0.0 => {
                Seen::Something
            }
            _ => self.take(&cone),
        }
    }

    fn hide_disk(&mut self, disk: &Round) -> Answer {
        let center = disk.center - self.eye;
        let towards = disk.normal.dot(center);
        if !(towards.abs() > held::reach(self.eye, disk.center)) {
            return Ok(Seen::Something);
        }
        let conic = Conic::rim(self.view.normal, center, disk.normal * towards.signum(), disk.radius);
        self.hide_round(conic, place::of_disk(self.eye, self.lamp, disk))
    }

    fn hide_round(&mut self, conic: Conic, place: Place) -> Answer {
        // Of a polygon, pieces that no outline meets give the same bits whether one is listed or not.
        let is_certain = place == Place::InFront && self.view.round.is_none();
        if place == Place::Never {
            return Ok(Seen::Something);
        }
        if is_certain || self.scratch.curves.meets_lamp(self.view.outline(), &conic) {
            if place == Place::Unknown {
                return Err(NoClosedForm::Touches);
            }
            self.scratch.curves.push(conic);
        }
        Ok(Seen::Something)
    }

    fn hide_polygon(&mut self, flat: Face<'_>) -> Answer {
        let Some(cone) = Cone::of_polygon(self.eye, flat) else { return Ok(Seen::Something) };
        if self.view.is_flat {
            return Ok(match cone.before_lamp(self.eye, flat, self.view) {
                Some(cone) => self.take(&cone),
                None => Seen::Something,
            });
        }
        match place::of_polygon(self.eye, self.lamp, flat) {
            Place::InFront => Ok(self.take(&cone)),
            Place::Unknown if self.may_meet_lamp(&cone) => Err(NoClosedForm::Touches),
            Place::Never | Place::Unknown => Ok(Seen::Something),
        }
    }

    fn hide_solid(&mut self, solid: &Solid, leaving: Leaving) -> Answer {
        let left = match leaving {
            Leaving::Facet(facet) => solid.facets.iter().position(|&f| f == facet),
            Leaving::Nothing => None,
        };
        if left.is_some_and(|face| solid.faces[face].view().normal.dot(self.view.normal) > 0.0) {
            return Ok(Seen::Something);
        }
        let is_seen = left.is_none() && solid.faces.iter().any(|face| looks_at(self.eye, face.view()));
        if is_seen {
            return self.hide_solid_from_outside(solid);
        }
        // From within, or on a face: all but the face that holds the eye.
        let eye = self.eye;
        let holds_eye =
            |face: Face<'_>| face.normal.dot(eye - face.corners[0]) >= -held::reach(eye, face.corners[0]);
        for (i, face) in solid.faces.iter().map(SolidFace::view).enumerate() {
            // Where the horizon is the face's plane, the solid lies below it.
            let up = face.normal.dot(self.view.normal) > 0.0;
            if left.is_none() && up && held::are_parallel(face.normal, self.view.normal) && holds_eye(face) {
                return Ok(Seen::Something);
            }
            if left != Some(i) && self.hide_polygon(face)? == Seen::Nothing {
                return Ok(Seen::Nothing);
            }
        }
        Ok(Seen::Something)
    }

    fn hide_solid_from_outside(&mut self, solid: &Solid) -> Answer {
        if self.view.is_flat {
            let heights = Heights::of(self.eye, &solid.corners, self.view);
            if heights.are_beyond() {
                return Ok(Seen::Something);
            }
            if heights.are_in_front()
                && let Some(cone) = Cone::of_solid(self.eye, solid)
            {
                return Ok(self.take(&cone));
            }
        }
        let eye = self.eye;
        for face in solid.faces.iter().map(SolidFace::view).filter(|face| looks_at(eye, *face)) {
            if self.hide_polygon(face)? == Seen::Nothing {
                return Ok(Seen::Nothing);
            }
        }
        Ok(Seen::Something)
    }

    /// A solid round an axis: both its ends, and the flat piece between them.
    fn hide_swept(&mut self, swept: &Swept, leaving: Leaving) -> Answer {
        if let Leaving::Facet(facet) = leaving {
            let looks_out = swept.normal(self.eye, facet).dot(self.view.normal) > 0.0;
            return if looks_out { Ok(Seen::Something) } else { Err(NoClosedForm::Within) };
        }
        let (above, normal) = swept.place(self.eye);
        let reach = swept.reach(self.eye);
        if above < -reach {
            return Err(NoClosedForm::Within);
        }
        if above <= reach {
            // What lies below the plane that touches it there.
            return normal.map_or(Err(NoClosedForm::Within), |normal| Ok(self.hide_side(-normal)));
        }
        match place::of_swept(self.eye, self.lamp, swept) {
            Place::Never => return Ok(Seen::Something),
            Place::Unknown => return Err(NoClosedForm::Touches),
            Place::InFront => {}
        }
        for end in [0, 1] {
            let center = swept.ends[end] - self.eye;
            if swept.has_balls {
                self.hide_round(Conic::outline(self.view.normal, center, swept.radii[end]), Place::InFront)?;
                continue;
            }
            let disk = swept.disk(end);
            let towards = disk.normal.dot(center);
            if disk.radius > 0.0 && towards.abs() > held::reach(self.eye, disk.center) {
                let axis = disk.normal * towards.signum();
                self.hide_round(Conic::rim(self.view.normal, center, axis, disk.radius), Place::InFront)?;
            }
        }
        let between = swept.between(self.eye).and_then(|[a, b, c, d]| {
            // Both lines meet in an apex.
            if b == c { Flat::new(&[a, b, d]) } else { Flat::new(&[a, b, c, d]) }
        });
        let cone = between.and_then(|flat| Cone::of_polygon(self.eye, flat.face()));
        Ok(cone.map_or(Seen::Something, |cone| self.take(&cone)))
    }

    /// Whether a cone may meet the outline of a round lamp: whether no plane of it leaves that outside.
    fn may_meet_lamp(&self, cone: &Cone) -> bool {
        let outline = self.view.round.as_ref();
        outline.is_none_or(|lamp| !cone.planes().iter().any(|plane| matches!(lamp.cut(*plane), Cut::Outside)))
    }

    fn take(&mut self, cone: &Cone) -> Seen {
        if cone.planes().is_empty() {
            return Seen::Something;
        }
        let Scratch { pieces, next, spare, curves } = &mut *self.scratch;
        self.is_cut |= next.set_to_rest(pieces, cone.planes(), spare, |hidden| curves.lamp_meets(hidden));
        std::mem::swap(pieces, next);
        if pieces.is_empty() { Seen::Nothing } else { Seen::Something }
    }
}
