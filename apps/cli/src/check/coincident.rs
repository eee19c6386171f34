//! Which surfaces lie in one place where cameras see them? Which of them is shown is then decided by their order, or by rounding.

use std::collections::{HashMap, HashSet};

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, EntityId, Shape, Span};
use catoptra_tracer::Prim;

use super::stage::{Sighting, Stage};
use super::{Finding, Lint};

pub(super) const LINT: Lint = Lint { name: "coincident", find };

/// Rays that are asked about.
const RAYS: usize = 1 << 14;

/// Surfaces this near to each other, as a share of the distance from the eye, count as one.
const NEAR: f64 = 1e-9;

/// How many rays must find two surfaces in one place: where they only cross, hardly one does.
const ENOUGH: usize = 3;

/// A mesh of more triangles is not asked whether it lies on others: it would have to be asked triangle by triangle.
const MOST_TRIANGLES: usize = 2000;

fn find(stage: &Stage<'_>) -> Vec<Finding> {
    let mut pairs: Vec<([EntityId; 2], DVec3)> = twins(stage);
    let same: HashSet<[EntityId; 2]> = pairs.iter().map(|(pair, _)| *pair).collect();
    let mut counts: HashMap<[u32; 2], (usize, DVec3)> = HashMap::new();
    let bounds: Vec<Option<Aabb>> = stage.snapshot().prims().iter().map(Prim::bounds).collect();
    for seen in stage.some_seen(RAYS) {
        for other in others_at(stage, seen, &bounds) {
            let pair = [seen.surface.prim.min(other), seen.surface.prim.max(other)];
            counts.entry(pair).or_insert((0, seen.ray.at(seen.t))).0 += 1;
        }
    }
    let mut counts: Vec<_> = counts.into_iter().filter(|(_, (count, _))| *count >= ENOUGH).collect();
    counts.sort_unstable_by_key(|(pair, _)| *pair);
    for ([a, b], (_, point)) in counts {
        if let (Some(a), Some(b)) = (stage.entity(a), stage.entity(b))
            && !same.contains(&[a, b])
        {
            pairs.push(([a, b], point));
        }
    }
    let told = |([a, b], at): ([EntityId; 2], DVec3)| Finding {
        line: stage.file.line_of_entity(b),
        message: format!(
            "\"{}\" lies in the surface of \"{}\", at {} {} {}: which of them is seen is left to chance",
            stage.name(b),
            stage.name(a),
            at.x as f32,
            at.y as f32,
            at.z as f32
        ),
    };
    pairs.into_iter().map(told).collect()
}

/// Shapes other than the one that is seen whose surface lies at the same place and looks the same way or the opposite one.
fn others_at(stage: &Stage<'_>, seen: &Sighting, bounds: &[Option<Aabb>]) -> Vec<u32> {
    let ray = stage.snapshot().own_ray(&seen.ray);
    let (point, prims) = (ray.at(seen.t), stage.snapshot().prims());
    let slack = DVec3::splat(NEAR * (seen.t * ray.direction.length() + point.abs().max_element()));
    let near = Span { min: seen.t * (1.0 - NEAR), max: seen.t * (1.0 + NEAR) };
    let own = &prims[seen.surface.prim as usize];
    let Some(normal) = own.shape.crossing(&ray, seen.t, seen.surface.facet).map(|at| at.normal) else {
        return Vec::new();
    };
    let holds = |bounds: &Aabb| Aabb { min: bounds.min - slack, max: bounds.max + slack }.contains(point);
    let is_there = |prim: &usize| {
        let other = &prims[*prim];
        if *prim == seen.surface.prim as usize || other.body == own.body {
            return false;
        }
        if !bounds[*prim].as_ref().is_none_or(holds) || is_large(&other.shape) {
            return false;
        }
        let crossing = match &other.member {
            Some(member) => member.cross(&ray, near, None),
            None => other.shape.cross(&ray, near, None),
        };
        crossing.is_some_and(|crossing| crossing.normal.dot(normal).abs() > 1.0 - 1e-6)
    };
    (0..prims.len()).filter(is_there).map(|prim| prim as u32).collect()
}

fn is_large(shape: &Shape) -> bool {
    shape.as_mesh().is_some_and(|mesh| mesh.source().mesh.triangles().len() > MOST_TRIANGLES)
}

/// Shapes that stand twice in one place.
fn twins(stage: &Stage<'_>) -> Vec<([EntityId; 2], DVec3)> {
    let mut there: HashMap<[u64; 6], Vec<usize>> = HashMap::new();
    let mut pairs = Vec::new();
    let prims = stage.snapshot().prims();
    for (at, prim) in prims.iter().enumerate().filter(|(_, prim)| prim.member.is_none()) {
        let Some(Aabb { min, max }) = prim.bounds() else { continue };
        let key = [min.x, min.y, min.z, max.x, max.y, max.z].map(f64::to_bits);
        let before = there.entry(key).or_default();
        let twin = before.iter().find(|other| prims[**other].shape == prim.shape);
        if let Some((a, b)) = twin.and_then(|twin| stage.entity(*twin as u32).zip(stage.entity(at as u32))) {
            pairs.push(([a, b], min.midpoint(max) + stage.snapshot().frame()));
        }
        before.push(at);
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::super::tests::findings;
    use super::*;

    const START: &str = "camera \"c\" { eye 0 3 5; target 0 0 0 }\nmatte \"m\" { color 0.5 }\nplane \"floor\" material=\"m\"\n";

    fn messages(more: &str) -> Vec<String> {
        findings(&LINT, &format!("{START}{more}")).into_iter().map(|(_, message)| message).collect()
    }

    #[test]
    fn a_rug_in_the_floor_is_told_and_a_box_on_it_is_not() {
        let rug = "rectangle \"rug\" material=\"m\" { corner -1 0 1; edge-u 2 0 0; edge-v 0 0 -2 }\n";
        let told = messages(rug);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].starts_with("\"rug\" lies in the surface of \"floor\", at "), "{told:?}");
        assert!(messages("box \"crate\" material=\"m\" { min -1 0 -1; max 1 1 1 }\n").is_empty());
        assert!(messages("sphere \"half\" material=\"m\" { center 0 0 0; radius 1 }\n").is_empty());
    }

    #[test]
    fn twins_are_told_wherever_they_are() {
        let ball = |name: &str| format!("sphere \"{name}\" material=\"m\" {{ center 0 1 90; radius 1 }}\n");
        let told = messages(&(ball("a") + &ball("b")));
        assert!(
            told.len() == 1 && told[0].starts_with("\"b\" lies in the surface of \"a\", at 0 1 90"),
            "{told:?}"
        );
    }
}
