//! What a snapshot takes out of a scene.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use catoptra_core::glam::DVec3;
use catoptra_core::material::Emissive;
use catoptra_core::texture::Texture;
use catoptra_core::{
    Camera, EntityId, Finish, Lamp, Light, Material, MaterialId, Placed, PlacedSolid, Placement, Scene,
    Settings, Shape, Solid, TextureId,
};

/// All that a [`Snapshot`](super::Snapshot) is made of, copied out of a scene. It needs the scene no more, so that a
/// window can go on editing while another thread builds trees.
///
/// Meshes are shared and not copied. Measured: 10,000 balls in 1 ms.
#[derive(Debug)]
pub struct Extraction {
    /// By age, those that are the bodies of lights as well; with the index of their material.
    pub(super) shapes: Vec<(Placed<Shape>, u32)>,
    /// Shapes whose materials ask where on them a point lies, by their places in the list, as they are in their own spaces.
    pub(super) own: BTreeMap<u32, OwnShape>,
    /// Solids made of several shapes, and these shapes by their places in the list.
    pub(super) solids: Vec<(Arc<Solid>, Vec<u32>)>,
    /// Surface lights that are no bodies.
    pub(super) unseen: Vec<Lamp>,
    pub(super) parts: Arc<Parts>,
    /// Position of the first camera.
    pub(super) eye: Option<DVec3>,
}

/// The solids of a scene, of shapes listed by age. Whatever changes a part of one changes how all of it looks.
fn solids(scene: &Scene, shapes: &mut [(Placed<Shape>, u32)]) -> Vec<(Arc<Solid>, Vec<u32>)> {
    let mut solids = Vec::new();
    for PlacedSolid { solid, members, touched } in scene.world_solids() {
        let places: Vec<u32> = members
            .iter()
            .filter_map(|member| shapes.binary_search_by_key(member, |(shape, _)| shape.id).ok())
            .map(|place| place as u32)
            .collect();
        for &place in &places {
            let shape = &mut shapes[place as usize].0;
            shape.touched = shape.touched.max(touched);
        }
        if places.len() == members.len() {
            solids.push((Arc::new(solid), places));
        }
    }
    solids
}

/// A shape before it is placed.
#[derive(Debug, Clone)]
pub(crate) struct OwnShape {
    pub(crate) shape: Shape,
    pub(crate) to_world: Placement,
    pub(crate) to_own: Placement,
}

impl OwnShape {
    /// That of a shape, or of a light that is a surface.
    pub(crate) fn of(scene: &Scene, id: EntityId) -> Option<Self> {
        let to_world = scene.world_placement(id)?;
        let shape = scene.shape(id).or_else(|| Some(scene.light(id)?.lamp()?.shape))?;
        Some(Self { shape, to_world, to_own: to_world.inverse() })
    }
}

/// Everything but the shapes, in the world, by age.
#[derive(Debug)]
pub(super) struct Parts {
    pub(super) revision: u64,
    pub(super) lights: Vec<Placed<Light>>,
    pub(super) cameras: Vec<Placed<Camera>>,
    pub(super) materials: Vec<(MaterialId, Material)>,
    /// Of these materials.
    pub(super) finishes: Vec<Finish>,
    pub(super) textures: BTreeMap<TextureId, Texture>,
    /// The bodies of lights; as materials of shapes they follow the scene's.
    pub(super) bodies: Vec<Body>,
    pub(super) settings: Settings,
}

/// What is particular about the body of a light.
#[derive(Debug)]
pub(super) struct Body {
    /// How it looks.
    pub(super) material: Material,
    /// Whether things throw shadows in its light.
    pub(super) shadow: bool,
}

impl Extraction {
    /// Of a scene as it is now.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let cameras = scene.world_cameras();
        let main = scene.main_camera().and_then(|id| cameras.iter().find(|camera| camera.id == id));
        let eye = main.map(|camera| camera.part.eye());
        let materials: Vec<_> = scene.materials().map(|(id, _, material)| (id, material.clone())).collect();
        let rows: HashMap<MaterialId, u32> = materials.iter().map(|(id, _)| *id).zip(0..).collect();
        let mut shapes: Vec<_> =
            scene.world_shapes().into_iter().map(|(shape, material)| (shape, rows[&material])).collect();
        let (lights, settings) = (scene.world_lights(), *scene.settings());
        let (mut bodies, mut unseen) = (Vec::new(), Vec::new());
        for light in &lights {
            match light.part.lamp() {
                Some(Lamp { shape, emission, visible: true, shadow }) => {
                    let placed = Placed { id: light.id, touched: light.touched, part: shape };
                    shapes.push((placed, (materials.len() + bodies.len()) as u32));
                    bodies.push(Body { material: Emissive::from(emission).into(), shadow });
                }
                Some(lamp) => unseen.push(lamp),
                None => {}
            }
        }
        shapes.sort_by_key(|(shape, _)| shape.id);
        let solids = solids(scene, &mut shapes);
        let asks: Vec<bool> = materials
            .iter()
            .map(|(id, material)| {
                material.is_textured() || material.needs_bsdf() || !scene.finish(*id).is_plain()
            })
            .collect();
        let asking =
            shapes.iter().zip(0..).filter(|((_, material), _)| asks.get(*material as usize) == Some(&true));
        let own = asking.filter_map(|((shape, _), at)| Some((at, OwnShape::of(scene, shape.id)?))).collect();
        let finishes = materials.iter().map(|(id, _)| scene.finish(*id)).collect();
        let textures = scene.textures().map(|(id, _, texture)| (id, texture.clone())).collect();
        let parts = Parts {
            revision: scene.revision(),
            lights,
            cameras,
            materials,
            finishes,
            textures,
            bodies,
            settings,
        };
        Self { shapes, own, solids, unseen, parts: Arc::new(parts), eye }
    }

    /// The materials of shapes, by their index.
    pub(super) fn materials(&self) -> impl Iterator<Item = &Material> {
        self.parts
            .materials
            .iter()
            .map(|(_, material)| material)
            .chain(self.parts.bodies.iter().map(|body| &body.material))
    }

    /// The scene's [revision](Scene::revision) when it was copied.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.parts.revision
    }
}
