//! How does the tracer answer a case file, through the code that renders pictures?

use catoptra_core::glam::DVec3;
use catoptra_core::optics::{reflect, refract};
use catoptra_core::{Crossing, Ray, Shape, Span};
use catoptra_tracer::query::{HitList, RayList, find_nearest, find_occluded};
use catoptra_tracer::{Backend, Pool, Snapshot, SurfaceId};

use super::{Case, Cases, Posed, Question, Reply, pose};

/// Who is asked: a backend, and the threads it may use.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// The way to trace.
    pub backend: &'a dyn Backend,
    /// Its threads.
    pub pool: &'a Pool,
}

/// Answers all cases, in their order.
#[must_use]
pub fn answer(cases: &Cases, asked: Asked<'_>) -> Vec<(u64, Reply)> {
    let mut replies = vec![None; cases.cases.len()];
    for (number, stage) in cases.stages.iter().enumerate() {
        let Ok(posed) = pose(stage) else { continue };
        let snapshot = Snapshot::extract(&posed.scene, asked.pool);
        let places: Vec<usize> = (0..cases.cases.len()).filter(|&i| cases.cases[i].stage == number).collect();
        let of_stage: Vec<&Case> = places.iter().map(|&i| &cases.cases[i]).collect();
        let stage = Staged { posed: &posed, snapshot: &snapshot, asked };
        for (place, reply) in places.iter().zip(stage.answer(&of_stage)) {
            replies[*place] = Some(reply);
        }
    }
    cases.cases.iter().zip(replies).filter_map(|(case, reply)| Some((case.id, reply?))).collect()
}

/// A stage ready to be asked about.
struct Staged<'a> {
    posed: &'a Posed,
    snapshot: &'a Snapshot,
    asked: Asked<'a>,
}

impl Staged<'_> {
    /// All rays of a kind at once, as packets are.
    fn answer(&self, cases: &[&Case]) -> Vec<Reply> {
        let rays: Vec<Ray> = cases.iter().map(|case| ray_of(case)).collect();
        let mut list = RayList::new();
        cases.iter().zip(&rays).for_each(|(case, ray)| list.push(ray, span_of(case), None));
        let hits = self.nearest(&list);
        let asked = cases.iter().zip(&rays).enumerate();
        asked.map(|(at, (case, ray))| self.reply(case, ray, hits.get(at))).collect()
    }

    fn nearest(&self, rays: &RayList) -> HitList {
        let mut hits = HitList::default();
        find_nearest(self.asked.backend, self.snapshot, rays, &mut hits, self.asked.pool);
        hits
    }

    fn reply(&self, case: &Case, ray: &Ray, hit: Option<(SurfaceId, f64)>) -> Reply {
        match case.question {
            Question::Nearest { .. } => {
                Reply::Nearest(hit.and_then(|(place, t)| Some((self.primitive(place)?, t))))
            }
            Question::Shadow(light) => {
                let light = DVec3::from(light.map(f64::from));
                Reply::Occluded(hit.is_none_or(|(place, t)| self.is_hidden(ray, place, t, light)))
            }
            Question::Mirrors(count) => Reply::Path(self.follow(ray, hit, count, mirrored)),
            Question::Glass(count, index) => {
                let index = f64::from(index);
                // From the side that the normal points to into the glass, or out of it.
                let bend = |d: DVec3, n: DVec3| {
                    let (n, ratio) = if d.dot(n) < 0.0 { (n, 1.0 / index) } else { (-n, index) };
                    refract(d, n, ratio).unwrap_or_else(|| mirrored(d, n))
                };
                Reply::Path(self.follow(ray, hit, count, bend))
            }
        }
    }

    fn primitive(&self, place: SurfaceId) -> Option<u32> {
        self.posed.primitive(place.prim, place.facet)
    }

    fn crossing(&self, ray: &Ray, place: SurfaceId, t: f64) -> Option<Crossing> {
        let own = self.snapshot.own_ray(ray);
        self.snapshot.prims()[place.prim as usize].shape.crossing(&own, t, place.facet)
    }

    /// Whether a light is on the other side of the surface than the ray comes from, or something stands before it.
    fn is_hidden(&self, ray: &Ray, place: SurfaceId, t: f64, light: DVec3) -> bool {
        let point = ray.at(t);
        let towards = light - point;
        if self.faces_away(ray, place, t, light) {
            return true;
        }
        let mut ways = RayList::new();
        let Span { min, max } = Span::until(1.0_f64.next_down());
        ways.push(&Ray::new(point, towards), [min, max], Some(place));
        let mut hidden = Vec::new();
        find_occluded(self.asked.backend, self.snapshot, &ways, &mut hidden, self.asked.pool);
        hidden.contains(&true)
    }

    /// Whether a light is on the other side of the surface than the ray comes from. One that lies in a plane is on neither: a
    /// segment within a plane does not hit it.
    fn faces_away(&self, ray: &Ray, place: SurfaceId, t: f64, light: DVec3) -> bool {
        if let Shape::Plane(plane) = &self.snapshot.prims()[place.prim as usize].shape {
            let side = |point: DVec3| plane.side_of(self.snapshot.own_ray(&Ray::new(point, DVec3::X)).origin);
            let of_light = side(light);
            return of_light.is_ne() && of_light != side(ray.origin);
        }
        let Some(crossing) = self.crossing(ray, place, t) else { return true };
        (light - ray.at(t)).dot(crossing.normal) * ray.direction.dot(crossing.normal) >= 0.0
    }

    /// Follows a ray over `count` surfaces, each of which turns its unit direction.
    fn follow(
        &self,
        ray: &Ray,
        first: Option<(SurfaceId, f64)>,
        count: u32,
        turn: impl Fn(DVec3, DVec3) -> DVec3,
    ) -> Option<([f64; 3], f64, u32)> {
        let (mut ray, mut hit, mut length) = (*ray, first, 0.0);
        for surface in 1.. {
            let (place, t) = hit?;
            let point = ray.at(t);
            length += t * ray.direction.length();
            if surface >= count {
                return Some((point.to_array(), length, self.primitive(place)?));
            }
            let crossing = self.crossing(&ray, place, t)?;
            ray = Ray::new(point, turn(ray.direction.normalize(), crossing.normal));
            let mut ways = RayList::new();
            ways.push(&ray, [Span::AHEAD.min, Span::AHEAD.max], Some(place));
            hit = self.nearest(&ways).get(0);
        }
        None
    }
}

fn ray_of(case: &Case) -> Ray {
    Ray::new(DVec3::from(case.origin.map(f64::from)), DVec3::from(case.direction.map(f64::from)))
}

fn span_of(case: &Case) -> [f64; 2] {
    match case.question {
        Question::Nearest { min, max } => [min.into(), max.into()],
        _ => [Span::AHEAD.min, Span::AHEAD.max],
    }
}

/// A direction mirrored about a unit normal.
fn mirrored(direction: DVec3, normal: DVec3) -> DVec3 {
    reflect(direction.into(), normal.into()).into()
}
