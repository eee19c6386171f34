//! Which of a lamp and a blocker is in front, as seen from the eye, wherever both are met?
//!
//! Both are convex: where they do not touch, a plane parts them, and the side of it that the eye lies on decides. On the
//! blocker's side the blocker is in front; on the lamp's side it never hides the lamp.

use glam::DVec3;

use super::lamp::{Face, Lamp, Outline, Round};
use super::swept::Swept;
use crate::numeric::EDGE_ROUNDING;

/// How a blocker stands to a lamp.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    InFront,
    Never,
    /// They touch, or no plane was found that parts them.
    Unknown,
}

impl Place {
    fn in_front_if(is_in_front: bool) -> Self {
        if is_in_front { Self::InFront } else { Self::Never }
    }
}

/// How far a difference of two points may be off, for what lies in a plane but for rounding.
pub(super) fn rounding(a: DVec3, b: DVec3) -> f64 {
    EDGE_ROUNDING * (a.abs().max_element() + b.abs().max_element())
}

/// Where a sphere stands that does not hold the eye.
pub(super) fn of_sphere(eye: DVec3, lamp: &Lamp, center: DVec3, radius: f64) -> Place {
    if let Some(place) = by_lamp_plane(eye, lamp, center, |_| radius) {
        return place;
    }
    let nearest = nearest_on_lamp(lamp, center);
    let out = center - nearest;
    if out.length() <= radius || is_inside_ball(&lamp.outline, center) {
        return Place::Unknown;
    }
    Place::in_front_if(out.dot(eye - nearest) > 0.0)
}

/// Where a disk stands.
pub(super) fn of_disk(eye: DVec3, lamp: &Lamp, disk: &Round) -> Place {
    if let Some(place) = by_lamp_plane(eye, lamp, disk.center, |axis| disk.reach(axis)) {
        return place;
    }
    if let Some(place) = by_own_plane(eye, lamp, disk.center, disk.normal) {
        return place;
    }
    by_nearest(eye, lamp, |x| disk.nearest(x), |axis| axis.dot(disk.center) - disk.reach(axis))
}

/// Where a flat polygon stands to a sphere that shines.
pub(super) fn of_polygon(eye: DVec3, lamp: &Lamp, flat: Face<'_>) -> Place {
    if let Some(place) = by_own_plane(eye, lamp, flat.corners[0], flat.normal) {
        return place;
    }
    let least = |axis: DVec3| flat.corners.iter().map(|&c| axis.dot(c)).fold(f64::INFINITY, f64::min);
    by_nearest(eye, lamp, |x| flat.nearest(x), least)
}

/// Where a solid round an axis stands that does not hold the eye.
pub(super) fn of_swept(eye: DVec3, lamp: &Lamp, swept: &Swept) -> Place {
    let middle = swept.ends[0].midpoint(swept.ends[1]);
    let reach = |axis: DVec3| {
        (swept.most_along(axis) - axis.dot(middle)).max(swept.most_along(-axis) + axis.dot(middle))
    };
    if let Some(place) = by_lamp_plane(eye, lamp, middle, reach) {
        return place;
    }
    by_nearest(eye, lamp, |x| swept.nearest(x), |axis| -swept.most_along(-axis))
}

/// What follows from the plane of a flat lamp: `reach` tells how far a blocker extends about its middle along a unit vector.
fn by_lamp_plane(eye: DVec3, lamp: &Lamp, middle: DVec3, reach: impl Fn(DVec3) -> f64) -> Option<Place> {
    let (base, normal) = match &lamp.outline {
        Outline::Polygon(flat) => (flat.corners()[0], flat.normal),
        Outline::Disk(disk) => (disk.center, disk.normal),
        Outline::Sphere { .. } => return None,
    };
    let up = if normal.dot(eye - base) < 0.0 { -normal } else { normal };
    let (height, reach, off) = (up.dot(middle - base), reach(up), rounding(middle, base));
    // What lies in the plane hides nothing.
    if height + reach <= off {
        Some(Place::Never)
    } else if height - reach >= -off {
        Some(Place::InFront)
    } else {
        None
    }
}

/// What follows where the lamp lies wholly on one side of the plane of a flat blocker.
fn by_own_plane(eye: DVec3, lamp: &Lamp, base: DVec3, normal: DVec3) -> Option<Place> {
    let (least, most) = (-lamp.most_along(-normal), lamp.most_along(normal));
    let (plane, eye_at) = (normal.dot(base), normal.dot(eye));
    if least >= plane {
        Some(Place::in_front_if(eye_at < plane))
    } else if most <= plane {
        Some(Place::in_front_if(eye_at > plane))
    } else {
        None
    }
}

/// How many steps between the two bodies are made before they count as touching. Each goes to the nearest point of the
/// other; two bodies apart by a share of their size need a few.
const STEPS: usize = 48;

/// What follows from the points of both that are nearest to one another.
fn by_nearest(
    eye: DVec3,
    lamp: &Lamp,
    nearest: impl Fn(DVec3) -> DVec3,
    least_along: impl Fn(DVec3) -> f64,
) -> Place {
    let mut on_lamp = lamp.middle();
    for _ in 0..STEPS {
        let on_blocker = nearest(on_lamp);
        on_lamp = nearest_on_lamp(lamp, on_blocker);
        let axis = on_blocker - on_lamp;
        let most = lamp.most_along(axis);
        if least_along(axis) > most {
            return Place::in_front_if(axis.dot(eye) > most);
        }
    }
    Place::Unknown
}

/// Whether a ball lies wholly around a lamp, touches none of it, or neither.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Within {
    All,
    Nothing,
    Part,
}

/// How much of a lamp a ball holds.
pub(super) fn held_by_ball(lamp: &Lamp, center: DVec3, radius: f64) -> Within {
    let farthest = match &lamp.outline {
        Outline::Polygon(flat) => flat.corners().iter().map(|c| c.distance(center)).fold(0.0, f64::max),
        Outline::Disk(disk) => {
            let away = disk.center - center;
            let height = disk.normal.dot(away);
            height.hypot((away - disk.normal * height).length() + disk.radius)
        }
        Outline::Sphere { center: middle, radius } => middle.distance(center) + radius,
    };
    if farthest <= radius {
        Within::All
    } else if nearest_on_lamp(lamp, center).distance(center) >= radius
        && !is_inside_ball(&lamp.outline, center)
    {
        Within::Nothing
    } else {
        Within::Part
    }
}

fn is_inside_ball(outline: &Outline, point: DVec3) -> bool {
    matches!(outline, Outline::Sphere { center, radius } if center.distance(point) <= *radius)
}

/// The point of a lamp that is nearest to another; of a sphere's surface.
pub(super) fn nearest_on_lamp(lamp: &Lamp, x: DVec3) -> DVec3 {
    match &lamp.outline {
        Outline::Polygon(flat) => flat.face().nearest(x),
        Outline::Disk(disk) => disk.nearest(x),
        Outline::Sphere { center, radius } => *center + (x - *center).normalize_or_zero() * *radius,
    }
}

impl Lamp {
    fn middle(&self) -> DVec3 {
        match &self.outline {
            Outline::Polygon(flat) => {
                let corners = flat.corners();
                corners.iter().sum::<DVec3>() / corners.len() as f64
            }
            Outline::Disk(disk) => disk.center,
            Outline::Sphere { center, .. } => *center,
        }
    }

    /// How far it reaches along a vector.
    pub(super) fn most_along(&self, axis: DVec3) -> f64 {
        match &self.outline {
            Outline::Polygon(flat) => {
                flat.corners().iter().map(|&c| axis.dot(c)).fold(f64::NEG_INFINITY, f64::max)
            }
            Outline::Disk(disk) => axis.dot(disk.center) + disk.reach(axis),
            Outline::Sphere { center, radius } => axis.dot(*center) + radius * axis.length(),
        }
    }
}

impl Round {
    /// How far it extends about its middle along a vector.
    fn reach(&self, axis: DVec3) -> f64 {
        self.normal.cross(axis).length() * self.radius
    }

    fn nearest(&self, x: DVec3) -> DVec3 {
        let away = x - self.center;
        let flat = away - self.normal * self.normal.dot(away);
        let length = flat.length();
        if length <= self.radius { self.center + flat } else { self.center + flat * (self.radius / length) }
    }
}

impl Face<'_> {
    pub(super) fn nearest(&self, x: DVec3) -> DVec3 {
        let corners = self.corners;
        let edges = || (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]));
        if edges().all(|(a, b)| self.normal.cross(b - a).dot(x - a) >= 0.0) {
            return x - self.normal * self.normal.dot(x - corners[0]);
        }
        let on_edges = edges().map(|(a, b)| {
            let along = b - a;
            a + along * ((x - a).dot(along) / along.length_squared()).clamp(0.0, 1.0)
        });
        let nearer =
            |best: DVec3, p: DVec3| if p.distance_squared(x) < best.distance_squared(x) { p } else { best };
        on_edges.fold(corners[0], nearer)
    }
}
