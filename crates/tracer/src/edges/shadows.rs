//! Where does light end on a flat surface? The edges of hard shadows, thrown along straight lines by what stands between a
//! lamp and the surface.

use catoptra_core::glam::{DMat3, DVec3};

use super::body::{Body, Border, Level, Rim};
use super::sight::{EVERYWHERE, Outline, Sight, circle, common, outer, silhouette};
use super::stage::Lamp;
use crate::numeric::NEAREST_SHARE;

/// A flat surface that shadows fall on, seen in a part of the picture.
pub(crate) struct Receiver<'a> {
    sight: &'a Sight,
    /// With its normal on the side that is seen and lit.
    level: Level,
    lamp: Lamp,
    within: [f64; 4],
}

impl<'a> Receiver<'a> {
    /// `None` where no light of the lamp is seen on the surface.
    pub(crate) fn new(sight: &'a Sight, level: &Level, lamp: Lamp, within: [f64; 4]) -> Option<Self> {
        let seen = level.height(sight.eye);
        let level = if seen < 0.0 { Level { normal: -level.normal, offset: -level.offset } } else { *level };
        let lit = match lamp {
            Lamp::At(place) => level.height(place),
            Lamp::Along(way) => -level.normal.dot(way),
        };
        (seen != 0.0 && lit > 0.0).then_some(Self { sight, level, lamp, within })
    }

    /// Adds the outlines of a body's shadow.
    pub(crate) fn add_shadow(&self, body: &Body, found: &mut Vec<Outline>) {
        match body {
            Body::Ball { center, radius } if self.level.height(*center) > -radius => {
                found.extend(self.conic(*center, *radius, None));
            }
            Body::Flats { flats, rims, solid } => {
                let lit = |side: usize| self.is_lit(&flats[side].level);
                let turns = |rim: &&Rim| !*solid || lit(rim.sides[0]) != lit(rim.sides[1]);
                found.extend(rims.iter().filter(turns).filter_map(|rim| self.segment(rim.ends)));
                for flat in flats {
                    if let Border::Circle { center, radius } = flat.border {
                        found.extend(self.conic(center, radius, Some(flat.level.normal)));
                    }
                }
            }
            _ => {}
        }
    }

    fn is_lit(&self, level: &Level) -> bool {
        match self.lamp {
            Lamp::At(place) => level.height(place) > 0.0,
            Lamp::Along(way) => level.normal.dot(way) < 0.0,
        }
    }

    /// Where the shadow of a segment lies.
    fn segment(&self, [from, to]: [DVec3; 2]) -> Option<Outline> {
        // Between the surface and, where it has a place, the lamp.
        let most = match self.lamp {
            Lamp::At(place) => self.level.height(place) * (1.0 - NEAREST_SHARE),
            Lamp::Along(_) => f64::INFINITY,
        };
        let [low, high] = [from, to].map(|end| self.level.height(end));
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for (here, there) in [(low, high), (most - low, most - high)] {
            if here < 0.0 && there < 0.0 {
                return None;
            }
            if here < 0.0 {
                first = first.max(here / (here - there));
            } else if there < 0.0 {
                last = last.min(here / (here - there));
            }
        }
        if !(first < last) {
            return None;
        }
        let ends = [first, last].map(|share| self.thrown(from + (to - from) * share));
        let outline = self.sight.segment(ends)?;
        Some(Outline { bounds: common(outline.bounds, self.within), ..outline })
    }

    /// Where the shadow of a point falls.
    fn thrown(&self, point: DVec3) -> DVec3 {
        let height = self.level.height(point);
        match self.lamp {
            Lamp::At(place) => {
                let lamp = self.level.height(place);
                place + (point - place) * (lamp / (lamp - height))
            }
            Lamp::Along(way) => point - way * (height / self.level.normal.dot(way)),
        }
    }

    /// The outline of the shadow of a ball, or of a disk of a unit normal.
    ///
    /// A point of the surface that is seen along d lies, times n·d, at e (n·d) − h(e) d: linear in d. So the cone round what
    /// throws the shadow, an equation of degree two for the point, is one for d.
    fn conic(&self, center: DVec3, radius: f64, disk: Option<DVec3>) -> Option<Outline> {
        let (normal, depth) = (self.level.normal, -self.level.height(self.sight.eye));
        let from =
            |place: DVec3| outer(self.sight.eye - place, normal) + DMat3::from_diagonal(DVec3::splat(depth));
        let q = match self.lamp {
            Lamp::At(place) => {
                let to_center = center - place;
                let reach = self.level.height(place) - self.level.height(center);
                if reach < -radius || to_center.length_squared() <= radius * radius {
                    return None;
                }
                let cone = match disk {
                    Some(own) => circle(own, own.dot(to_center), to_center, radius),
                    None => silhouette(to_center, radius),
                };
                let map = from(place);
                map.transpose() * cone * map
            }
            Lamp::Along(way) => {
                let (map, one) = (from(center), DMat3::IDENTITY);
                let (tube, scale) = match disk {
                    Some(own) => {
                        let slope = own.dot(way);
                        let mixed = (outer(way, own) + outer(own, way)) * slope;
                        (one * (slope * slope) - mixed + outer(own, own), slope * slope)
                    }
                    None => (one - outer(way, way), 1.0),
                };
                map.transpose() * tube * map - outer(normal, normal) * (radius * radius * scale)
            }
        };
        let form = self.sight.quadratic(&q);
        let bounds = form.ellipse_bounds().unwrap_or(EVERYWHERE);
        Some(Outline { form, bounds: common(bounds, self.within) })
    }
}
