//! How does a stage of a case file become a scene as a user would make it?

use std::sync::Arc;

use catoptra_core::geometry::{Cuboid, Mesh, Plane, Sphere};
use catoptra_core::glam::DVec3;
use catoptra_core::{
    InvalidPart, MaterialId, MeshSource, Rgb, Scene, SceneError, Shape, TriangleMesh, material::Matte,
};

use super::{Primitive, Stage};

/// Why a stage could not become a scene.
#[derive(Debug, thiserror::Error)]
pub enum PoseError {
    /// The scene refused something.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A shape or material refused its values.
    #[error(transparent)]
    Part(#[from] InvalidPart),
}

/// A scene and which primitives its shapes are made of.
#[derive(Debug)]
pub struct Posed {
    /// The scene.
    pub scene: Scene,
    /// For every shape, in the order of their ids, the primitive behind each of its facets; a shape that is one
    /// primitive names it once.
    primitives: Vec<Vec<u32>>,
}

impl Posed {
    /// The primitive that a facet of a shape stands for; shapes are counted in the order of their ids.
    #[must_use]
    pub fn primitive(&self, shape: u32, facet: u32) -> Option<u32> {
        match &self.primitives.get(shape as usize)?[..] {
            [one] => Some(*one),
            triangles => triangles.get(facet as usize).copied(),
        }
    }
}

/// Builds the scene of a stage. Triangles that stand next to each other become one mesh. What a shape's constructor
/// refuses cannot be hit and is left out; its id stays unused.
///
/// # Errors
/// None that a stage could bring about: names are counted, and a shape that refuses its values is left out.
pub fn pose(stage: &Stage) -> Result<Posed, PoseError> {
    let mut scene = Scene::new();
    let white = scene.add_material("white", Matte::new(Rgb::WHITE)?)?;
    let mut posed = Posed { scene, primitives: Vec::new() };
    let mut run = Vec::new();
    for (primitive, id) in stage.primitives.iter().zip(0..) {
        if let Primitive::Triangle(corners) = primitive {
            if corners.as_flattened().iter().all(|c| c.is_finite()) {
                run.push((*corners, id));
            }
            continue;
        }
        posed.add_mesh(&mut run, white)?;
        if let Ok(shape) = shape_of(primitive) {
            posed.add(shape, vec![id], white)?;
        }
    }
    posed.add_mesh(&mut run, white)?;
    Ok(posed)
}

impl Posed {
    fn add(&mut self, shape: Shape, primitives: Vec<u32>, material: MaterialId) -> Result<(), SceneError> {
        self.scene.add_shape(&format!("shape {}", self.primitives.len()), shape, material, None)?;
        self.primitives.push(primitives);
        Ok(())
    }

    fn add_mesh(
        &mut self,
        run: &mut Vec<([[f32; 3]; 3], u32)>,
        material: MaterialId,
    ) -> Result<(), SceneError> {
        let corners: Vec<[f32; 3]> = run.iter().flat_map(|(corners, _)| *corners).collect();
        let triangles = (0..run.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let ids: Vec<u32> = run.drain(..).map(|(_, id)| id).collect();
        match TriangleMesh::new(corners, triangles, None, None) {
            Ok(mesh) => {
                let source = MeshSource { path: String::new(), mesh: Arc::new(mesh) };
                self.add(Mesh::new(source).into(), ids, material)
            }
            // No triangles.
            Err(_) => Ok(()),
        }
    }
}

fn shape_of(primitive: &Primitive) -> Result<Shape, InvalidPart> {
    let point = |p: [f32; 3]| DVec3::from(p.map(f64::from));
    Ok(match *primitive {
        Primitive::Triangle(_) => return Err(InvalidPart::new("triangle", "belongs to a mesh", "")),
        Primitive::Sphere(center, radius) => Sphere::new(point(center), radius.into())?.into(),
        Primitive::Plane(through, normal) => Plane::new(point(through), point(normal))?.into(),
        Primitive::Volume(low, high) | Primitive::Box(low, high) => {
            Cuboid::new(point(low), point(high))?.into()
        }
    })
}
