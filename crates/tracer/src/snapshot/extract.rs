//! How a snapshot is taken of a scene.

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::geometry::Plane;
use catoptra_core::glam::DVec3;
use catoptra_core::{
    Aabb, EntityId, Light, Material, MaterialId, Placement, Rgb, Role, Scene, Shape, TriangleMesh,
};

use super::origin::{frame_for, origin_for, relative};
use super::{Columns, LightRow, MaterialRow, Prim, Snapshot};
use crate::accel::{Box32, MeshTree, Preset, Tree};
use crate::numeric::BOUNDS_ERROR;

impl Snapshot {
    /// Freezes a scene. Trees over meshes are built on the threads of the pool this is called in.
    #[must_use]
    pub fn extract(scene: &Scene) -> Self {
        Self::extract_after(scene, None)
    }

    /// Freezes a scene, taking over from an earlier snapshot the trees of meshes that are still there.
    #[must_use]
    pub fn extract_after(scene: &Scene, earlier: Option<&Self>) -> Self {
        Self::extract_with(scene, earlier, Preset::default())
    }

    /// As [`extract_after`](Self::extract_after); trees of meshes that were not there before are built as `preset` says.
    #[must_use]
    pub fn extract_with(scene: &Scene, earlier: Option<&Self>, preset: Preset) -> Self {
        let placed: Vec<(EntityId, Shape, MaterialId)> = scene
            .entities_of(Role::Shape)
            .filter_map(|id| Some((id, scene.world_shape(id)?, scene.material_of(id)?)))
            .collect();
        let eye = scene.main_camera().and_then(|id| scene.world_camera(id)).map(|camera| camera.eye());
        let origin = origin_for(placed.iter().filter_map(|(_, shape, _)| shape.bounds()), eye);
        let frame = frame_for(placed.iter().map(|(_, shape, _)| shape), origin);
        let rows: HashMap<MaterialId, u32> = scene.materials().map(|(id, ..)| id).zip(0..).collect();
        let mut trees = MeshTrees::after(earlier, preset);
        let prims: Vec<Prim> = placed
            .iter()
            .map(|(_, shape, material)| Prim {
                shape: relative(shape, frame).into_owned(),
                material: rows[material],
                mesh: trees.of(shape),
            })
            .collect();
        let lights: Vec<Light> =
            scene.entities_of(Role::Light).filter_map(|id| scene.world_light(id)).collect();
        let (bounded, unbounded): (Vec<u32>, Vec<u32>) =
            (0..prims.len() as u32).partition(|&i| prims[i as usize].shape.bounds().is_some());
        let boxes = bounded.iter().filter_map(|&i| prims[i as usize].shape.bounds());
        let boxes: Vec<Box32> = boxes.map(|b| around(b, origin - frame)).collect();
        let columns = Columns::of(&prims, &bounded, &trees.meshes, origin - frame);
        let ambient = lights.iter().map(Light::ambient).fold(Rgb::BLACK, |a, b| a + b);
        let to_frame = Placement::IDENTITY.moved(-frame).unwrap_or_default();
        let lights: Vec<Light> = lights.iter().filter(|l| shines(l)).map(|l| l.placed(&to_frame)).collect();
        let planes: Vec<&Plane> =
            columns.planes.iter().filter_map(|row| plane_of(&prims[row.prim as usize])).collect();
        let materials: Vec<Material> =
            scene.materials().map(|(.., material)| material.relative_to(origin)).collect();
        let material_rows: Vec<_> = materials.iter().map(MaterialRow::new).collect();
        Self {
            origin,
            frame,
            constants: [ambient.into(), scene.settings().background().into()],
            has_mirrors: material_rows.iter().any(|row| row.lobes.mirror),
            material_rows,
            light_rows: lights.iter().map(|light| LightRow::new(light, origin - frame, &planes)).collect(),
            has_cones: lights.iter().any(Light::has_cone),
            columns,
            tree: Tree::build(&boxes),
            entities: placed.iter().map(|(id, ..)| *id).collect(),
            prims,
            unbounded,
            bounded,
            meshes: trees.meshes,
            materials,
            ambient,
            lights,
            background: scene.settings().background(),
        }
    }
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

/// A box, relative to an origin, and wider by what rounding may make of its corners and of rays.
fn around(bounds: Aabb, origin: DVec3) -> Box32 {
    let largest = bounds.min.abs().max(bounds.max.abs()).max(origin.abs()).max_element();
    let slack = DVec3::splat(BOUNDS_ERROR * largest + f64::MIN_POSITIVE);
    Aabb { min: bounds.min - origin - slack, max: bounds.max - origin + slack }.into()
}

/// The trees over the meshes of a scene, each built once.
struct MeshTrees<'a> {
    earlier: &'a [Arc<MeshTree>],
    preset: Preset,
    meshes: Vec<Arc<MeshTree>>,
    places: HashMap<*const TriangleMesh, u32>,
}

impl<'a> MeshTrees<'a> {
    fn after(earlier: Option<&'a Snapshot>, preset: Preset) -> Self {
        let earlier = earlier.map_or(&[][..], |snapshot| &snapshot.meshes);
        Self { earlier, preset, meshes: Vec::new(), places: HashMap::new() }
    }

    fn of(&mut self, shape: &Shape) -> Option<u32> {
        let Shape::Mesh(mesh) = shape else { return None };
        let (mesh, preset) = (&mesh.source().mesh, self.preset);
        Some(*self.places.entry(Arc::as_ptr(mesh)).or_insert_with(|| {
            let known = self.earlier.iter().find(|tree| Arc::ptr_eq(tree.mesh(), mesh));
            self.meshes.push(known.map_or_else(|| Arc::new(MeshTree::build(mesh, preset)), Arc::clone));
            self.meshes.len() as u32 - 1
        }))
    }
}
