//! What do rays of the world meet, asked by whoever has rays of their own?
//!
//! A [`Caster`] is a snapshot that is asked in the world: [`WorldRay`]s go in, [`WorldHit`]s come out, and nothing about frames,
//! backends or materials has to be known. Its answers are those of pictures, by the same code.

mod column;
mod error;
mod hit;
mod many;
mod ray;
mod triangles;

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::{Crossing, EntityId, Placement, Scene, TriangleMesh};

pub use column::Coordinates;
pub use error::{CasterError, InvalidRay, InvalidRays};
pub use hit::WorldHit;
pub use many::{RayColumns, RayHits};
pub use ray::WorldRay;

use crate::snapshot::{Hit, OwnShape, RaySegment};
use crate::{
    Cancelled, Control, Irradiance, Pool, Preset, ProbeOptions, Receiver, Snapshot, SurfaceId, irradiance_at,
};

/// Triangles or a scene, ready to be asked what rays meet.
///
/// Rays and hits are in the world, in `f64`. Hit or miss, which triangle, and which of two is in front are the answers of exact
/// arithmetic on the numbers given, however far from the origin: no ray slips through an edge or a corner. Nothing is
/// changed by asking, so that one caster serves any number of threads.
///
/// ```
/// use catoptra_tracer::{Caster, WorldRay};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let caster = Caster::from_triangles(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]])?;
/// let hit = caster.nearest(&WorldRay::new([0.2, 0.2, 5.0], [0.0, 0.0, -1.0])?).ok_or("a miss")?;
/// assert_eq!((hit.triangle, hit.t, hit.normal.z), (0, 5.0, 1.0));
/// assert!(!caster.any(&WorldRay::new(hit.point, [0.0, 0.0, 1.0])?.leaving(hit.surface)));
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Caster {
    snapshot: Arc<Snapshot>,
    /// Shapes as they are in their own spaces, which alone know how they were turned.
    own: HashMap<u32, OwnShape>,
}

impl Caster {
    /// Over triangles: corners in the world, metres, and three corner numbers for each. Numbers that `f32` can hold are kept as they are;
    /// others (`f64` ones may be) are rounded to 24 bits of how far they lie from the middle of all. Trees are built on the
    /// [shared pool](Pool::shared). Triangles without area are never met.
    ///
    /// # Errors
    /// No triangles, positions that are not finite, corner numbers out of range, and a system that gives no threads.
    pub fn from_triangles<C: Copy + Into<f64>>(
        positions: &[[C; 3]],
        triangles: &[[u32; 3]],
    ) -> Result<Self, CasterError> {
        Self::from_mesh(triangles::mesh(positions, triangles)?)
    }

    /// Over a mesh, such as a model file holds (`catoptra_scene::model::read_mesh`), as it lies in its own space with
    /// its [offset](TriangleMesh::offset). Trees are built on the [shared pool](Pool::shared).
    ///
    /// # Errors
    /// A system that gives no threads.
    pub fn from_mesh(mesh: impl Into<Arc<TriangleMesh>>) -> Result<Self, CasterError> {
        Self::from_scene(&triangles::scene(mesh.into())?)
    }

    /// Over all shapes of a scene that are not hidden, and over lights that are surfaces. Trees are built on the
    /// [shared pool](Pool::shared).
    ///
    /// # Errors
    /// A system that gives no threads.
    pub fn from_scene(scene: &Scene) -> Result<Self, CasterError> {
        let pool = Pool::shared()?;
        Ok(Self::of_snapshot(Snapshot::extract(scene, pool), scene))
    }

    /// As [`from_scene`](Self::from_scene), on the threads of `pool`, with progress and a way to stop.
    ///
    /// # Errors
    /// [`Cancelled`] when `control` said so before the last tree was built.
    pub fn from_scene_with(
        scene: &Scene,
        preset: Preset,
        pool: &Pool,
        control: &Control,
    ) -> Result<Self, Cancelled> {
        Ok(Self::of_snapshot(Snapshot::extract_unless_cancelled(scene, preset, pool, control)?, scene))
    }

    /// Over a snapshot that pictures are traced of too, and the scene that it was taken of: of another scene, texture
    /// coordinates are wrong.
    #[must_use]
    pub fn of_snapshot(snapshot: impl Into<Arc<Snapshot>>, scene: &Scene) -> Self {
        let snapshot = snapshot.into();
        let numbered = snapshot.entities().iter().zip(0..);
        let own = numbered.filter_map(|(&id, prim)| Some((prim, OwnShape::of(scene, id)?))).collect();
        Self { snapshot, own }
    }

    /// What is asked, for all that the tracer knows of it.
    #[must_use]
    pub fn snapshot(&self) -> &Snapshot {
        &self.snapshot
    }

    /// The surface that a ray leaves which starts on a triangle of an entity (a face of a box or another solid with faces; 0 of
    /// what is round or flat), for [`WorldRay::leaving`]. `None` where the caster has no such entity.
    #[must_use]
    pub fn surface(&self, entity: EntityId, triangle: u32) -> Option<SurfaceId> {
        Some(SurfaceId { prim: self.prim(entity)?, facet: triangle })
    }

    fn prim(&self, entity: EntityId) -> Option<u32> {
        self.snapshot.entities().binary_search(&entity).ok().map(|prim| prim as u32)
    }

    /// The shape that a ray meets nowhere which leaves an entity.
    fn prim_left(&self, entity: Option<EntityId>) -> Option<u32> {
        Some(self.snapshot.first_in_place(self.prim(entity?)?))
    }

    /// What a ray meets first; `None` where it meets nothing. Of surfaces in one place the one with the lower number.
    #[must_use]
    pub fn nearest(&self, ray: &WorldRay) -> Option<WorldHit> {
        let hit = self.follow(ray, |segment| self.snapshot.nearest_on(segment))?;
        Some(self.told(ray, &hit))
    }

    /// How the surface looks that a ray is known to meet at `t`, from a picture or a [query](crate::query) of this
    /// caster's snapshot. `None` where it has no normal there, and where the caster has no such surface.
    #[must_use]
    pub fn hit_on(&self, ray: &WorldRay, surface: SurfaceId, t: f64) -> Option<WorldHit> {
        self.snapshot.prims().get(surface.prim as usize)?;
        let on = |segment: &RaySegment<'_>| self.snapshot.crossing_on(segment, surface, t);
        let crossing = Crossing { t, ..self.follow(ray, on)? };
        Some(self.told(ray, &Hit { surface, crossing }))
    }

    /// Whether a ray meets anything.
    #[must_use]
    pub fn any(&self, ray: &WorldRay) -> bool {
        self.follow(ray, |segment| self.snapshot.is_occluded_on(segment))
    }

    /// All that a ray meets, nearest first; of surfaces in one place that with the lower number first. Of triangles with the same
    /// corners, and of meshes of the same triangles in one place, only the first is met.
    ///
    /// A ray through an edge or a corner meets every triangle there. Of one round surface, meetings that lie closer together
    /// than `f64` tells apart, as those of a ray that grazes it, are one.
    #[must_use]
    pub fn all(&self, ray: &WorldRay) -> Vec<WorldHit> {
        let hits = self.follow(ray, |segment| self.snapshot.all_on(segment));
        hits.iter().map(|hit| self.told(ray, hit)).collect()
    }

    /// How many surfaces a ray meets: as many as [`all`](Self::all) lists.
    #[must_use]
    pub fn count(&self, ray: &WorldRay) -> usize {
        self.follow(ray, |segment| self.snapshot.all_on(segment).len())
    }

    /// The light at receivers, as [`irradiance_at`] tells it.
    ///
    /// # Errors
    /// [`Cancelled`] when `control` said so before the last receiver was asked.
    pub fn irradiance_at(
        &self,
        receivers: &[Receiver],
        options: &ProbeOptions,
        pool: &Pool,
        control: &Control,
    ) -> Result<Vec<Irradiance>, Cancelled> {
        irradiance_at(&self.snapshot, receivers, options, pool, control)
    }

    fn follow<T>(&self, ray: &WorldRay, search: impl FnOnce(&RaySegment<'_>) -> T) -> T {
        let without = self.prim_left(ray.entity_left());
        let search = |segment: &RaySegment<'_>| search(&RaySegment { without, ..*segment });
        self.snapshot.follow(&ray.ray(), ray.span(), ray.surface_left(), search)
    }

    /// A hit as it is told.
    fn told(&self, ray: &WorldRay, Hit { surface, crossing }: &Hit) -> WorldHit {
        let point = ray.at(crossing.t);
        let (shape, to_own) = match self.own.get(&surface.prim) {
            Some(own) => (&own.shape, own.to_own),
            None => {
                let to_frame = Placement::IDENTITY.moved(-self.snapshot.frame()).unwrap_or_default();
                (&self.snapshot.prims()[surface.prim as usize].shape, to_frame)
            }
        };
        WorldHit {
            entity: self.snapshot.entities()[surface.prim as usize],
            triangle: surface.facet,
            t: crossing.t,
            point,
            normal: crossing.normal,
            shading_normal: crossing.shading_normal,
            uv: shape.parametrization(to_own.point(point), surface.facet).uv,
            surface: *surface,
        }
    }
}
