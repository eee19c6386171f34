//! Does a [`Caster`] answer a file of hard cases as exact arithmetic does?
//!
//! `CATOPTRA_STRESS` names a folder with such a file and its answers, `public.cases` and `public.answers`, in the format that
//! `crates/lab/src/stress/format.md` describes. Without it nothing is asked.

use std::collections::HashMap;
use std::path::Path;

use catoptra_core::Shape;
use catoptra_core::glam::DVec3;
use catoptra_core::optics::{reflect, refract};
use catoptra_lab::stress::{Case, Cases, Posed, Question, Reply, pose, read_answers, read_cases, score};
use catoptra_tracer::{Caster, Pool, RayColumns, WorldHit, WorldRay};

#[test]
fn a_caster_answers_every_case_right() {
    let Some(folder) = std::env::var_os("CATOPTRA_STRESS") else {
        return println!("skipped: CATOPTRA_STRESS names no folder with public.cases and public.answers");
    };
    let text =
        |name: &str| std::fs::read_to_string(Path::new(&folder).join(name)).expect("a file of the set");
    let cases = read_cases(&text("public.cases")).expect("cases");
    let answers = read_answers(&text("public.answers")).expect("answers");
    let scores = score(&cases.cases, &answers, &answered(&cases));
    assert!(!scores.is_empty());
    for (group, score) in &scores {
        println!("{group}: {} of {} wrong", score.wrong, score.cases);
    }
    let wrong: Vec<_> = scores.iter().filter(|(_, score)| score.wrong > 0).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

fn answered(cases: &Cases) -> HashMap<u64, Reply> {
    let mut replies = HashMap::new();
    for (number, stage) in cases.stages.iter().enumerate() {
        let posed = pose(stage).expect("a scene");
        let asked = Asked { caster: Caster::from_scene(&posed.scene).expect("threads"), posed };
        let of_stage = cases.cases.iter().filter(|case| case.stage == number);
        replies.extend(of_stage.map(|case| (case.id, asked.reply(case))));
    }
    replies
}

/// A stage of a case file, and its caster.
struct Asked {
    caster: Caster,
    posed: Posed,
}

impl Asked {
    fn reply(&self, case: &Case) -> Reply {
        let [origin, direction] = [case.origin, case.direction].map(|v| DVec3::from(v.map(f64::from)));
        let ray = match case.question {
            Question::Nearest { min, max } => {
                WorldRay::new(origin, direction).and_then(|ray| ray.within([min.into(), max.into()]))
            }
            _ => WorldRay::new(origin, direction),
        };
        // What is no ray meets nothing.
        let hit = ray.ok().and_then(|ray| Some((ray, self.nearest(&ray)?)));
        match case.question {
            Question::Nearest { .. } => {
                Reply::Nearest(hit.and_then(|(_, hit)| Some((self.primitive(&hit)?, hit.t))))
            }
            Question::Shadow(light) => {
                let light = DVec3::from(light.map(f64::from));
                Reply::Occluded(hit.is_none_or(|(ray, hit)| self.is_hidden(&ray, &hit, light)))
            }
            Question::Mirrors(count) => Reply::Path(self.follow(hit, count, mirrored)),
            Question::Glass(count, index) => {
                let index = f64::from(index);
                let bend = |d: DVec3, n: DVec3| {
                    let (n, ratio) = if d.dot(n) < 0.0 { (n, 1.0 / index) } else { (-n, index) };
                    refract(d, n, ratio).unwrap_or_else(|| mirrored(d, n))
                };
                Reply::Path(self.follow(hit, count, bend))
            }
        }
    }

    fn primitive(&self, hit: &WorldHit) -> Option<u32> {
        self.posed.primitive(hit.surface.prim, hit.surface.facet)
    }

    /// By the search of one ray and by that of many, which must agree.
    fn nearest(&self, ray: &WorldRay) -> Option<WorldHit> {
        let alone = self.caster.nearest(ray);
        let (origin, direction) = ([ray.ray().origin], [ray.ray().direction]);
        let (ends, leaving) = ([[ray.span().min, ray.span().max]], [ray.surface_left()]);
        let rays = RayColumns::new(&origin, &direction).and_then(|rays| rays.within(&ends));
        let rays = rays.and_then(|rays| rays.leaving(&leaving)).expect("a column of one");
        let many = self.caster.nearest_many(&rays, Pool::shared().expect("threads")).expect("a ray");
        assert_eq!(alone.map(|hit| hit.surface), many.surface(0), "{ray:?}");
        assert_eq!(self.caster.all(ray).first().map(|hit| hit.surface), many.surface(0), "{ray:?}");
        many.get(0)
    }

    /// Whether a light is on the other side of the surface than the ray comes from, or something stands before it.
    fn is_hidden(&self, ray: &WorldRay, hit: &WorldHit, light: DVec3) -> bool {
        let faces_away = match &self.caster.snapshot().prims()[hit.surface.prim as usize].shape {
            // Whoever lies in a plane is on neither of its sides.
            Shape::Plane(plane) => {
                let side = |point: DVec3| plane.side_of(point - self.caster.snapshot().frame());
                side(light).is_ne() && side(light) != side(ray.ray().origin)
            }
            _ => (light - hit.point).dot(hit.normal) * ray.ray().direction.dot(hit.normal) >= 0.0,
        };
        let way = WorldRay::new(hit.point, light - hit.point);
        let way =
            way.and_then(|way| way.leaving(hit.surface).within([f64::from_bits(1), 1.0_f64.next_down()]));
        faces_away || way.is_ok_and(|way| self.caster.any(&way))
    }

    /// Follows a ray over `count` surfaces, each of which turns its unit direction.
    fn follow(
        &self,
        first: Option<(WorldRay, WorldHit)>,
        count: u32,
        turn: impl Fn(DVec3, DVec3) -> DVec3,
    ) -> Option<([f64; 3], f64, u32)> {
        let (mut ray, mut hit) = first?;
        let mut length = 0.0;
        for surface in 1.. {
            length += hit.t * ray.ray().direction.length();
            if surface >= count {
                return Some((hit.point.to_array(), length, self.primitive(&hit)?));
            }
            let turned = turn(ray.ray().direction.normalize(), hit.normal);
            ray = WorldRay::new(hit.point, turned).ok()?.leaving(hit.surface);
            hit = self.nearest(&ray)?;
        }
        None
    }
}

/// A direction mirrored about a unit normal.
fn mirrored(direction: DVec3, normal: DVec3) -> DVec3 {
    reflect(direction.into(), normal.into()).into()
}
