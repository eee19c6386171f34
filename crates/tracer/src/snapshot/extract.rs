//! Builds a snapshot from what was taken out of a scene, and takes over what is unchanged from an earlier one.

use std::sync::Arc;

use catoptra_core::geometry::Plane;
use catoptra_core::glam::DVec3;
use catoptra_core::{Finish, Lamp, Light, Material, Member, Placed, Placement, Rgb, Scene, Shape};

use super::index::{Index, MeshTrees};
use super::lamps::Shining;
use super::origin::{frame_for, origin_for, relative};
use super::{Extraction, Lamps, LightRow, MaterialRow, Matter, Prim, Snapshot, SnapshotDiff};
use crate::accel::Preset;
use crate::{Cancelled, Control, Pool};

impl Snapshot {
    /// Freezes a scene. Trees are built on the threads of `pool`; the snapshot does not depend on how many there are.
    #[must_use]
    pub fn extract(scene: &Scene, pool: &Pool) -> Self {
        Self::extract_with(scene, Preset::default(), pool)
    }

    /// As [`extract`](Self::extract), with trees over meshes as `preset` says.
    #[must_use]
    pub fn extract_with(scene: &Scene, preset: Preset, pool: &Pool) -> Self {
        unwatched(|control| Self::extract_unless_cancelled(scene, preset, pool, control))
    }

    /// As [`extract_with`](Self::extract_with), telling `control` how many of the meshes' triangles have found their leaf.
    ///
    /// # Errors
    /// [`Cancelled`] when `control` said so before the last tree was built.
    pub fn extract_unless_cancelled(
        scene: &Scene,
        preset: Preset,
        pool: &Pool,
        control: &Control,
    ) -> Result<Self, Cancelled> {
        Extraction::of(scene).build(MeshTrees::new(preset, pool, control), None)
    }

    /// Freezes a scene, taking over from an earlier snapshot what is still the same, and returns what is not. The
    /// snapshot is the one that [`extract`](Self::extract) makes, bit for bit; the earlier one may be of another scene.
    #[must_use]
    pub fn after(scene: &Scene, earlier: &Self, pool: &Pool) -> (Self, SnapshotDiff) {
        Extraction::of(scene).after(earlier, pool)
    }
}

impl Extraction {
    /// The snapshot, as [`Snapshot::extract`] makes it.
    #[must_use]
    pub fn snapshot(&self, pool: &Pool) -> Snapshot {
        unwatched(|control| self.build(MeshTrees::new(Preset::default(), pool, control), None))
    }

    /// The snapshot and what it changes, as [`Snapshot::after`] makes them.
    ///
    /// Trees of meshes that are still there are taken over; and where no edit touched a shape and the origin stays, so
    /// are the tree over all shapes and the columns of the kernels.
    #[must_use]
    pub fn after(&self, earlier: &Snapshot, pool: &Pool) -> (Snapshot, SnapshotDiff) {
        let snapshot =
            unwatched(|control| self.build(MeshTrees::after(earlier, pool, control), Some(earlier)));
        let diff = SnapshotDiff::between(earlier, &snapshot);
        (snapshot, diff)
    }

    fn build(&self, mut trees: MeshTrees<'_>, earlier: Option<&Snapshot>) -> Result<Snapshot, Cancelled> {
        let shapes = self.shapes.iter().map(|(shape, _)| &shape.part);
        trees.announce(shapes.clone());
        let origin = origin_for(shapes.clone().filter_map(Shape::bounds), self.eye);
        let frame = frame_for(shapes, origin);
        let prims = self.prims(frame, &mut trees)?;
        let same =
            earlier.filter(|e| same_bits([e.origin, e.frame], [origin, frame]) && self.keeps_shapes(e));
        let preset = trees.preset();
        let index = match same {
            Some(earlier) => Arc::clone(&earlier.index),
            None => Arc::new(Index::build(&prims, trees, origin - frame)),
        };
        let lights = self.parts.lights.iter().map(|light| &light.part);
        let ambient = lights.clone().map(Light::ambient).fold(Rgb::BLACK, |a, b| a + b);
        let to_frame = Placement::IDENTITY.moved(-frame).unwrap_or_default();
        let lights: Vec<Light> = lights.filter(|l| shines(l)).map(|l| l.placed(&to_frame)).collect();
        let planes: Vec<&Plane> =
            index.columns.planes.iter().filter_map(|row| plane_of(&prims[row.prim as usize])).collect();
        let materials: Vec<Material> =
            self.materials().map(|material| material.relative_to(origin)).collect();
        let material_rows: Vec<_> = materials.iter().map(MaterialRow::new).collect();
        let background = self.parts.settings.background();
        let lamps = self.lamps(&prims, frame, origin);
        Ok(Snapshot {
            lamps,
            matter: self.matter(&prims, origin),
            origin,
            frame,
            preset,
            constants: [ambient.into(), background.into()],
            has_mirrors: material_rows.iter().any(|row| row.lobes.mirror),
            material_rows,
            light_rows: lights.iter().map(|light| LightRow::new(light, origin - frame, &planes)).collect(),
            has_cones: lights.iter().any(Light::has_cone),
            entities: self.shapes.iter().map(|(shape, _)| shape.id).collect(),
            touched: self.shapes.iter().map(|(shape, _)| shape.touched).collect(),
            prims,
            index,
            materials,
            ambient,
            lights,
            background,
            parts: Arc::clone(&self.parts),
        })
    }

    fn prims(&self, frame: DVec3, trees: &mut MeshTrees<'_>) -> Result<Vec<Prim>, Cancelled> {
        let prim = |((shape, material), body): (&(Placed<Shape>, u32), u32)| {
            let mesh = trees.of(&shape.part)?;
            let shape = relative(&shape.part, frame).into_owned();
            Ok(Prim { shape, material: *material, mesh, member: None, body })
        };
        let mut prims: Vec<Prim> = self.shapes.iter().zip(0..).map(prim).collect::<Result<_, _>>()?;
        let to_frame = Placement::IDENTITY.moved(-frame).ok().filter(|_| frame != DVec3::ZERO);
        for (solid, places) in &self.solids {
            let solid = to_frame.map_or_else(|| Arc::clone(solid), |moved| Arc::new(solid.placed(&moved)));
            for (&place, number) in places.iter().zip(0..) {
                let prim = &mut prims[place as usize];
                prim.member = Member::new(Arc::clone(&solid), number);
                // What of a mesh is the solid's surface, its own tree does not know.
                prim.mesh = None;
                prim.body = places[0];
            }
        }
        Ok(prims)
    }

    fn lamps(&self, prims: &[Prim], frame: DVec3, origin: DVec3) -> Lamps {
        let named = self.parts.materials.iter().map(|(_, material)| (material, true));
        let bodies = self.parts.bodies.iter().map(|body| (&body.material, body.shadow));
        // What shines otherwise from point to point is met by paths alone.
        let shining = |(material, shadow): (&Material, bool)| {
            let emission = material.emission().filter(|_| !material.emission_is_textured());
            emission.map(|emission| Shining { emission, shadow })
        };
        let shining: Vec<_> = named.chain(bodies).map(shining).collect();
        let unseen: Vec<_> = self
            .unseen
            .iter()
            .map(|lamp| Lamp { shape: relative(&lamp.shape, frame).into_owned(), ..lamp.clone() })
            .collect();
        Lamps::new(prims, |material| shining[material as usize], &unseen, origin - frame)
    }

    fn matter(&self, prims: &[Prim], origin: DVec3) -> Matter {
        let parts = &self.parts;
        let finishes = parts.finishes.iter().copied().chain(std::iter::repeat(Finish::default()));
        let materials: Vec<_> = self.materials().map(|material| material.relative_to(origin)).collect();
        let surroundings =
            parts.lights.iter().filter_map(|light| light.part.environment().cloned()).collect();
        Matter::new(
            prims,
            materials.iter().zip(finishes),
            parts.textures.clone(),
            self.own.clone(),
            surroundings,
        )
    }

    /// Whether the shapes are those of a snapshot, bit for bit, for no edit has touched any.
    fn keeps_shapes(&self, earlier: &Snapshot) -> bool {
        let before = earlier.entities.iter().copied().zip(earlier.touched.iter().copied());
        self.shapes.iter().map(|(shape, _)| (shape.id, shape.touched)).eq(before)
    }
}

/// Does work that nobody can cancel.
fn unwatched<T>(work: impl FnOnce(&Control) -> Result<T, Cancelled>) -> T {
    match work(&Control::default()) {
        Ok(done) => done,
        Err(Cancelled) => unreachable!("nobody else has the control"),
    }
}

fn same_bits(a: [DVec3; 2], b: [DVec3; 2]) -> bool {
    let bits = |places: [DVec3; 2]| places.map(|place| place.to_array().map(f64::to_bits));
    bits(a) == bits(b)
}

/// Whether a light shines from somewhere, rather than from everywhere.
fn shines(light: &Light) -> bool {
    light.position().is_some() || light.direction().is_some()
}

fn plane_of(prim: &Prim) -> Option<&Plane> {
    match &prim.shape {
        Shape::Plane(plane) => Some(plane),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::geometry::{Mesh, Sphere};
    use catoptra_core::light::PointLight;
    use catoptra_core::material::Matte;
    use catoptra_core::{Edit, MeshSource, TriangleMesh};

    use super::*;
    use crate::pool::one_thread;

    /// A ball, a mesh and a lamp.
    fn scene() -> Scene {
        let mut scene = Scene::new();
        let grey = scene.add_material("grey", Matte::new(Rgb::grey(0.5)).unwrap()).unwrap();
        let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let mesh = Arc::new(TriangleMesh::new(corners, vec![[0, 1, 2]], None, None).unwrap());
        scene.add_shape("ball", Sphere::new(DVec3::ZERO, 1.0).unwrap(), grey, None).unwrap();
        scene.add_shape("mesh", Mesh::new(MeshSource { path: String::new(), mesh }), grey, None).unwrap();
        scene.add_light("lamp", PointLight::new(DVec3::Y * 4.0, Rgb::WHITE).unwrap(), None).unwrap();
        scene
    }

    /// Snapshots before and after an edit of something.
    fn around(edit: impl FnOnce(&Scene) -> Edit) -> [Snapshot; 2] {
        let mut scene = scene();
        let earlier = Snapshot::extract(&scene, one_thread());
        scene.apply(edit(&scene)).unwrap();
        let (later, _) = Snapshot::after(&scene, &earlier, one_thread());
        [earlier, later]
    }

    #[test]
    fn what_shapes_are_searched_with_outlives_other_edits() {
        let grey = |scene: &Scene| scene.material_named("grey").unwrap();
        let lamp = |scene: &Scene| scene.entity_named("lamp").unwrap();
        let black: Material = Matte::new(Rgb::BLACK).unwrap().into();
        let moved = Placement::IDENTITY.moved(DVec3::X).unwrap();
        for [earlier, later] in [
            around(|scene| Edit::Material(grey(scene), black)),
            around(|scene| Edit::Placement(lamp(scene), moved)),
            around(|scene| Edit::Remove(lamp(scene))),
        ] {
            assert!(Arc::ptr_eq(&earlier.index, &later.index));
        }
    }

    #[test]
    fn a_mesh_that_moves_keeps_its_tree() {
        let moved = Placement::IDENTITY.moved(DVec3::X).unwrap();
        let [earlier, later] = around(|scene| Edit::Placement(scene.entity_named("mesh").unwrap(), moved));
        assert!(!Arc::ptr_eq(&earlier.index, &later.index));
        assert!(Arc::ptr_eq(&earlier.meshes()[0], &later.meshes()[0]));
    }

    #[test]
    fn a_preset_is_kept() {
        let scene = scene();
        let earlier = Snapshot::extract_with(&scene, Preset::Best, one_thread());
        let (later, _) = Snapshot::after(&scene, &earlier, one_thread());
        assert_eq!(later.preset, Preset::Best);
    }
}
