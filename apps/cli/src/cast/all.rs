//! What does a ray meet in all, and in which order? Shape by shape, so that of surfaces that lie in one place each is told.

use catoptra_core::{Aabb, EntityId, Ray, Scene, Span};
use catoptra_tracer::{Pool, Snapshot, SurfaceId};
use miette::Result;

use crate::surfaces::{Met, snapshot_of};

/// A scene that is asked for all hits.
pub(super) struct AllHits<'a> {
    snapshot: &'a Snapshot,
    /// For each shape that is a mesh, a snapshot of it alone: its tree finds its triangles.
    meshes: Vec<Option<Snapshot>>,
    /// Boxes round shapes that end somewhere, in the snapshot's frame.
    bounds: Vec<Option<Aabb>>,
}

impl<'a> AllHits<'a> {
    pub(super) fn of(scene: &Scene, snapshot: &'a Snapshot, pool: &Pool) -> Result<Self> {
        let alone = |(prim, entity): (&catoptra_tracer::Prim, &EntityId)| {
            let shape = scene.world_shape(*entity).filter(|_| prim.mesh.is_some() && prim.member.is_none());
            shape.map(|shape| snapshot_of(shape, pool)).transpose()
        };
        let meshes =
            snapshot.prims().iter().zip(snapshot.entities().iter()).map(alone).collect::<Result<_>>()?;
        let bounds = snapshot.prims().iter().map(catoptra_tracer::Prim::bounds).collect();
        Ok(Self { snapshot, meshes, bounds })
    }

    /// All that a ray of the world meets on a closed stretch, nearest first; of hits at one place that of the older shape first.
    ///
    /// Hits of one shape that `f64` cannot tell apart are one, as where a ray meets the edge between two triangles.
    pub(super) fn hits(&self, ray: &Ray, [min, max]: [f64; 2]) -> Vec<Met> {
        let own = self.snapshot.own_ray(ray);
        let mut hits: Vec<Met> = Vec::new();
        if !ray.is_valid() {
            return hits;
        }
        for prim in 0..self.meshes.len() as u32 {
            let mut span = Span { min: min.max(Span::AHEAD.min), max };
            if self.bounds[prim as usize].is_some_and(|bounds| misses(&bounds, &own)) {
                continue;
            }
            while let Some((met, after)) = self.next(prim, (ray, &own), span) {
                hits.push(met);
                if !(after > span.min && after <= max) {
                    break;
                }
                span.min = after;
            }
        }
        // Stable: shapes stand in the order of their ids.
        hits.sort_by(|a, b| a.t.total_cmp(&b.t));
        hits
    }

    /// The next place where a ray meets a shape, and from where on to look for more.
    fn next(&self, prim: u32, (ray, own): (&Ray, &Ray), span: Span) -> Option<(Met, f64)> {
        let crossing = match &self.meshes[prim as usize] {
            Some(alone) => alone.nearest(&alone.own_ray(ray), span, None)?.crossing,
            None => {
                let prim = &self.snapshot.prims()[prim as usize];
                match &prim.member {
                    Some(member) => member.cross(own, span, None)?,
                    None => prim.shape.cross(own, span, None)?,
                }
            }
        };
        let surface = SurfaceId { prim, facet: crossing.facet };
        Some((Met::on(self.snapshot, ray, surface, crossing.t)?, crossing.latest()))
    }
}

/// Whether the line of a ray certainly misses a box: one round it that is larger by more than what is rounded here.
fn misses(bounds: &Aabb, ray: &Ray) -> bool {
    let reach = bounds.min.abs().max(bounds.max.abs()) + ray.origin.abs();
    let slack = 1e-12 * reach.max_element();
    let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let [low, high] =
            [bounds.min[axis] - slack, bounds.max[axis] + slack].map(|end| end - ray.origin[axis]);
        if ray.direction[axis] == 0.0 {
            if low > 0.0 || high < 0.0 {
                return true;
            }
            continue;
        }
        let ends = [low / ray.direction[axis], high / ray.direction[axis]];
        from = from.max(ends[0].min(ends[1]));
        to = to.min(ends[0].max(ends[1]));
    }
    from > to * (1.0 + 1e-12) + f64::MIN_POSITIVE && from.is_finite() && to.is_finite()
}

#[cfg(test)]
mod tests {
    use catoptra_core::glam::DVec3;

    use super::*;

    /// What rays along z meet, as names and distances.
    fn all(text: &str, ends: [f64; 2]) -> Vec<(String, f64)> {
        let (scene, _) = catoptra_scene::parse(text, "text", None).unwrap();
        let pool = Pool::new(1).unwrap();
        let snapshot = Snapshot::extract(&scene, &pool);
        let hits = AllHits::of(&scene, &snapshot, &pool).unwrap();
        let ray = Ray::new(DVec3::new(0.1, 0.2, 5.0), DVec3::NEG_Z);
        hits.hits(&ray, ends).iter().map(|met| (scene.name(met.entity).unwrap(), met.t)).collect()
    }

    #[test]
    fn surfaces_in_one_place_are_all_told() {
        let text = "matte \"m\" { color 1 }\nplane \"wall\" material=\"m\" { normal 0 0 1 }\n\
            box \"b\" material=\"m\" { min -1 -1 0; max 1 1 2 }\ntorus \"t\" material=\"m\" { major 1; minor 0.5 }\n";
        let names = |ends| all(text, ends).into_iter().map(|(name, _)| name).collect::<Vec<_>>();
        assert_eq!(names([0.0, f64::INFINITY]), ["b", "t", "t", "wall", "b", "t", "t"]);
        assert_eq!(names([3.5, 4.5]), ["t", "t"]);
        assert_eq!(all(text, [3.0, 3.0]), [("b".to_owned(), 3.0)]);
    }

    #[test]
    fn of_solids_what_is_their_surface() {
        let text = "matte \"m\" { color 1 }\ndifference \"d\" {\n    box \"b\" material=\"m\" { min -1 -1 -1; max 1 1 1 }\n    \
            box \"hole\" material=\"m\" { min -2 -2 -0.5; max 2 2 0.5 }\n}\n";
        let names: Vec<String> = all(text, [0.0, f64::INFINITY]).into_iter().map(|(name, _)| name).collect();
        assert_eq!(names.len(), 4, "{names:?}");
        assert!(names[0].ends_with('b') && names[1].ends_with("hole"), "{names:?}");
    }
}
